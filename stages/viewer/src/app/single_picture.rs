//! A picture file that is shown alone: without a render, and without another file to compare with.

use crate::compare::Reference;
use crate::session::Session;
use egui::{Color32, ColorImage, Pos2, Rect, TextureHandle, TextureOptions, Ui};
use kit::FilmSize;
use pathtracer::tone::Tone;
use std::sync::Arc;

/// The texture of the picture, and what it is of.
#[derive(Default)]
pub(super) struct SinglePicture {
    shown: Option<(Arc<Reference>, Tone, TextureHandle)>,
}

/// The bytes of a pixel: with this tone if the file has radiance.
pub(super) fn bytes(picture: &Reference, tone: Tone, x: u32, y: u32) -> [u8; 3] {
    match picture.radiance(x, y) {
        Some(radiance) => tone.to_bytes(radiance.into()),
        None => picture.get(x, y),
    }
}

impl SinglePicture {
    /// The picture that is shown alone, if there is one.
    pub(super) fn of(session: &Session) -> Option<Arc<Reference>> {
        let is_alone = session.render().is_none() && session.first_picture().is_none();
        session.kept().last().filter(|_| is_alone).cloned()
    }

    /// Paints the picture.
    pub(super) fn paint(&mut self, ui: &Ui, area: Rect, picture: &Arc<Reference>, tone: Tone) {
        let is_shown = |shown: &(Arc<Reference>, Tone, TextureHandle)| {
            Arc::ptr_eq(&shown.0, picture) && shown.1 == tone
        };
        if !self.shown.as_ref().is_some_and(is_shown) {
            let image = image_of(picture.size, |x, y| Some(bytes(picture, tone, x, y)));
            let texture = ui
                .ctx()
                .load_texture("file", image, TextureOptions::NEAREST);
            self.shown = Some((Arc::clone(picture), tone, texture));
        }
        if let Some((.., texture)) = &self.shown {
            let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
            ui.painter_at(area)
                .image(texture.id(), area, whole, Color32::WHITE);
        }
    }
}

/// An image whose rows start at the top, of pixels that count from the bottom.
pub(super) fn image_of(size: FilmSize, pixel: impl Fn(u32, u32) -> Option<[u8; 3]>) -> ColorImage {
    let mut pixels = Vec::with_capacity(size.whole().area() as usize);
    for y in (0..size.h).rev() {
        for x in 0..size.w {
            pixels.push(match pixel(x, y) {
                Some([r, g, b]) => Color32::from_rgb(r, g, b),
                None => Color32::TRANSPARENT,
            });
        }
    }
    ColorImage::new([size.w as usize, size.h as usize], pixels)
}
