//! A picture file that is shown alone: without a render, and without another file to compare with.

use crate::compare::Reference;
use crate::luminance;
use crate::session::Session;
use egui::{Color32, ColorImage, Pos2, Rect, TextureHandle, TextureOptions, Ui};
use kit::FilmSize;
use pathtracer::tone::Tone;
use std::sync::Arc;

/// The texture of the picture, and what it is of.
#[derive(Default)]
pub(super) struct SinglePicture {
    shown: Option<(Arc<Reference>, Look, TextureHandle)>,
}

/// How a picture file is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Look {
    tone: Tone,
    false_color: bool,
    /// The place of the layer; `None` for the picture itself.
    layer: Option<usize>,
}

impl Look {
    pub(super) fn of(session: &Session) -> Look {
        Look {
            tone: session.tone,
            false_color: session.false_color(),
            layer: session.layer().map(|(place, _)| place),
        }
    }

    /// The bytes of a pixel: with tone and false colours if the file has radiance.
    pub(super) fn bytes(self, picture: &Reference, x: u32, y: u32) -> [u8; 3] {
        if let Some(layer) = self.layer.and_then(|place| picture.layers.get(place)) {
            return layer.bytes(x, y, self.tone);
        }
        match picture.radiance(x, y) {
            Some(radiance) if self.false_color => {
                luminance::false_color(radiance.into(), self.tone.exposure)
            }
            Some(radiance) => self.tone.to_bytes(radiance.into()),
            None => picture.get(x, y),
        }
    }
}

impl SinglePicture {
    /// Paints the picture.
    pub(super) fn paint(&mut self, ui: &Ui, area: Rect, picture: &Arc<Reference>, look: Look) {
        let is_shown = |shown: &(Arc<Reference>, Look, TextureHandle)| {
            Arc::ptr_eq(&shown.0, picture) && shown.1 == look
        };
        if !self.shown.as_ref().is_some_and(is_shown) {
            let image = image_of(picture.size, |x, y| Some(look.bytes(picture, x, y)));
            let texture = ui
                .ctx()
                .load_texture("file", image, TextureOptions::NEAREST);
            self.shown = Some((Arc::clone(picture), look, texture));
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
