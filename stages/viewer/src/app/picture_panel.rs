//! The picture in progress, and the mouse over it: click a pixel, drag a cell, wipe.

use super::colors;
use super::compare_panel::NAMES;
use super::pair_view::{self, PairTextures, dragged_wipe};
use super::single_picture::{Look, SinglePicture, image_of};
use super::zoom::Zoom;
use crate::command::Command;
use crate::luminance;
use crate::session::Session;
use egui::{
    Align2, Color32, FontId, Pos2, Rect, Response, Role, Sense, Stroke, TextureHandle,
    TextureOptions, Ui, WidgetInfo,
};
use kit::film::Cell;
use kit::{Film, FilmSize, Spectrum};
use pathtracer::rate_picture::viridis;
use pathtracer::tone::Tone;

/// The picture and its textures.
#[derive(Default)]
pub(super) struct PicturePanel {
    /// What the texture shows, and the texture.
    shown: Option<(ShownKey, TextureHandle)>,
    pair: PairTextures,
    single: SinglePicture,
    zoom: Zoom,
    /// The pixel where a drag in cell mode started.
    cell_start: Option<(u32, u32)>,
}

/// What decides how the picture looks.
#[derive(Clone, PartialEq)]
struct ShownKey {
    version: u64,
    rate: bool,
    heat: Option<(bool, u64)>,
    render: u64,
    tone: Tone,
    false_color: bool,
}

impl PicturePanel {
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        rect: Rect,
        session: &mut Session,
        commands: &mut Vec<Command>,
    ) {
        // An enlarged picture ends where its place does.
        let mut place = ui.new_child(egui::UiBuilder::new().max_rect(rect));
        place.set_clip_rect(rect.intersect(ui.clip_rect()));
        let ui = &mut place;
        let response = ui.interact(rect, ui.scope_id().with("picture"), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "picture"));
        if self.compare(ui, rect, &response, session) {
            return self.zoom_button(ui, rect);
        }
        if let Some(picture) = session.single_picture().cloned() {
            self.zoom.mouse(ui, &response, rect, picture.size, true);
            let area = self
                .zoom
                .area(rect, picture.size, ui.ctx().pixels_per_point());
            self.single.paint(ui, area, &picture, Look::of(session));
            let hovered = response.hover_pos();
            session.point_at_pixel(hovered.and_then(|at| pixel_at(area, picture.size, at)));
            return self.zoom_button(ui, rect);
        }
        let Some(render) = session.render() else {
            let text = match session.scene() {
                Some(_) => "R renders the picture",
                None => "Drop a .dae file here, or pictures: .png, .exr, .hdr, .sums",
            };
            hint(ui, rect, text);
            return;
        };
        if let Some(failure) = render.failure() {
            hint(
                ui,
                rect,
                &format!("{failure}: there is no picture without it"),
            );
            return;
        }
        let film = render.job().film;
        let left_moves = !session.cell_mode();
        self.zoom.mouse(ui, &response, rect, film, left_moves);
        let area = self.zoom.area(rect, film, ui.ctx().pixels_per_point());
        self.update_texture(ui, session);
        self.paint(ui, area);
        let pixel = |at: Pos2| pixel_at(area, film, at);
        let hovered = response.hover_pos().and_then(pixel);
        session.point_at_pixel(hovered);
        if session.cell_mode() {
            let clamped = |at: Pos2| pixel(at.clamp(area.min, area.max - egui::Vec2::splat(0.01)));
            if response.drag_started() {
                let press = ui.input(|input| input.pointer.press_origin());
                self.cell_start = press.and_then(clamped);
            }
            let end = response.interact_pointer_pos().and_then(clamped);
            if let (Some(start), Some(end)) = (self.cell_start, end) {
                let cell = cell_between(start, end);
                outline(ui, area, film, cell, colors::palette(ui).wrong);
                if response.drag_stopped() {
                    commands.push(Command::SetCell(cell));
                    self.cell_start = None;
                }
            }
        } else if response.clicked()
            && let Some((x, y)) = response.interact_pointer_pos().and_then(pixel)
        {
            commands.push(Command::Inspect(x, y));
        }
        self.paint_marks(ui, area, session, film);
        self.zoom_button(ui, rect);
    }

    /// How much the picture is enlarged; a click ends that.
    fn zoom_button(&mut self, ui: &mut Ui, rect: Rect) {
        let Some(percent) = self.zoom.percent() else {
            return;
        };
        let at = Rect::from_min_size(rect.min + egui::vec2(8.0, 8.0), egui::vec2(120.0, 22.0));
        let button = ui.put(at, egui::Button::new(format!("{percent} %: fit again")));
        if button.clicked() {
            self.zoom.fit();
        }
    }

    /// Shows two pictures. Returns whether there are two of one size.
    fn compare(&mut self, ui: &Ui, rect: Rect, response: &Response, session: &mut Session) -> bool {
        let Some((number, pair)) = session
            .compared()
            .and_then(|compared| Some((compared.number, compared.pair.clone()?)))
        else {
            return false;
        };
        // The left button wipes.
        self.zoom.mouse(ui, response, rect, pair.size(), false);
        let area = self
            .zoom
            .area(rect, pair.size(), ui.ctx().pixels_per_point());
        let hovered = response.hover_pos();
        session.point_at_pixel(hovered.and_then(|at| pixel_at(area, pair.size(), at)));
        let Some(comparison) = session.comparison_mut() else {
            return false;
        };
        if let Some(at) = response
            .interact_pointer_pos()
            .filter(|_| response.dragged_by(egui::PointerButton::Primary))
        {
            comparison.display.wipe = dragged_wipe(area, at);
        }
        let display = comparison.display;
        let shows_render = comparison.first.is_none();
        pair_view::paint(ui, area, display, self.pair.of(ui, number, &pair), NAMES);
        if let Some((x, y)) = response
            .interact_pointer_pos()
            .filter(|_| response.clicked() && shows_render)
            .and_then(|at| pixel_at(area, pair.size(), at))
        {
            session.apply(Command::Inspect(x, y));
        }
        if shows_render {
            self.paint_marks(ui, area, session, pair.size());
        }
        true
    }

    fn update_texture(&mut self, ui: &Ui, session: &Session) {
        let Some(render) = session.render() else {
            return;
        };
        let shown = render.shown();
        let heat = session.heat();
        let map = heat
            .kind
            .zip(heat.map())
            .filter(|(_, map)| map.size == render.job().film);
        let key = ShownKey {
            version: shown.version,
            rate: session.shows_rate(),
            heat: map.map(|(kind, map)| {
                let sum = map.pixels.iter().map(|counters| kind.of(counters)).sum();
                (kind == crate::session::HeatKind::Boxes, sum)
            }),
            render: render.number(),
            tone: session.tone,
            false_color: session.false_color(),
        };
        if self.shown.as_ref().is_some_and(|(of, _)| *of == key) {
            return;
        }
        let film = &shown.film;
        let cell = render.job().cell;
        let image = match map {
            Some((kind, map)) => {
                let most = map
                    .pixels
                    .iter()
                    .map(|c| kind.of(c))
                    .max()
                    .unwrap_or(0)
                    .max(1);
                image_of(film.size(), |x, y| {
                    let share = kind.of(&map.get(x, y)) as f64 / most as f64;
                    Some(viridis(share))
                })
            }
            None if session.shows_rate() => {
                let most = render.job().samples * shown.pass;
                image_of(film.size(), |x, y| {
                    let samples = film.get(x, y).samples;
                    Some(viridis(f64::from(samples) / f64::from(most.max(1))))
                })
            }
            None => image_of(film.size(), |x, y| {
                let radiance = shown_radiance(film, shown.preview.as_ref(), cell, (x, y))?;
                Some(match session.false_color() {
                    true => luminance::false_color(radiance, session.tone.exposure),
                    false => session.tone.to_bytes(radiance),
                })
            }),
        };
        let options = TextureOptions::NEAREST;
        match &mut self.shown {
            Some((of, texture)) => {
                texture.set(image, options);
                *of = key;
            }
            None => self.shown = Some((key, ui.ctx().load_texture("picture", image, options))),
        }
    }

    fn paint(&self, ui: &Ui, area: Rect) {
        let Some((_, texture)) = &self.shown else {
            return;
        };
        let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
        let painter = ui.painter_at(area);
        painter.image(texture.id(), area, whole, Color32::WHITE);
    }

    fn paint_marks(&self, ui: &Ui, area: Rect, session: &Session, film: FilmSize) {
        if let Some(cell) = session.settings().and_then(|settings| settings.cell) {
            outline(ui, area, film, cell, colors::palette(ui).wrong);
        }
        let of_replay = session.inspector.inspected().map(|i| i.replay.pixel);
        if let Some((x, y)) = session.inspector.running().or(of_replay) {
            let cell = Cell {
                x0: x,
                y0: y,
                x1: x + 1,
                y1: y + 1,
            };
            outline(
                ui,
                area.expand(0.0),
                film,
                cell,
                colors::palette(ui).selected,
            );
            let center = screen_rect(area, film, cell).center();
            ui.painter_at(area).circle_stroke(
                center,
                9.0,
                Stroke::new(1.5, colors::palette(ui).selected),
            );
        }
    }
}

/// The radiance of a pixel: of the film, else of the preview; `None` before both.
fn shown_radiance(
    film: &Film,
    preview: Option<&Film>,
    cell: Cell,
    (x, y): (u32, u32),
) -> Option<Spectrum> {
    let pixel = film.get(x, y);
    if pixel.samples > 0 {
        return Some(pixel.radiance);
    }
    // The pixels of the preview are larger than those of the cell: some reach beyond it.
    let is_in_cell = (cell.x0..cell.x1).contains(&x) && (cell.y0..cell.y1).contains(&y);
    let preview = preview.filter(|_| is_in_cell)?;
    let (size, small) = (film.size(), preview.size());
    let scaled =
        |at: u32, from: u32, to: u32| (u64::from(at) * u64::from(to) / u64::from(from)) as u32;
    let pixel = preview.get(scaled(x, size.w, small.w), scaled(y, size.h, small.h));
    (pixel.samples > 0).then_some(pixel.radiance)
}

/// The pixel of the film at a point of the window.
fn pixel_at(area: Rect, film: FilmSize, at: Pos2) -> Option<(u32, u32)> {
    let x = ((at.x - area.left()) / area.width() * film.w as f32).floor();
    let y = ((area.bottom() - at.y) / area.height() * film.h as f32).floor();
    let inside = x >= 0.0 && y >= 0.0 && x < film.w as f32 && y < film.h as f32;
    inside.then_some((x as u32, y as u32))
}

/// The rectangle of pixels between two pixels, both included.
fn cell_between(a: (u32, u32), b: (u32, u32)) -> Cell {
    Cell {
        x0: a.0.min(b.0),
        y0: a.1.min(b.1),
        x1: a.0.max(b.0) + 1,
        y1: a.1.max(b.1) + 1,
    }
}

/// Where a cell is in the window.
fn screen_rect(area: Rect, film: FilmSize, cell: Cell) -> Rect {
    let x = |x: u32| area.left() + area.width() * x as f32 / film.w as f32;
    let y = |y: u32| area.bottom() - area.height() * y as f32 / film.h as f32;
    Rect::from_min_max(
        Pos2::new(x(cell.x0), y(cell.y1)),
        Pos2::new(x(cell.x1), y(cell.y0)),
    )
}

fn outline(ui: &Ui, area: Rect, film: FilmSize, cell: Cell, color: Color32) {
    let rect = screen_rect(area, film, cell);
    let stroke = Stroke::new(1.5, color);
    ui.painter_at(area.expand(2.0))
        .rect_stroke(rect, 0.0, stroke, egui::StrokeKind::Outside);
}

pub(super) fn hint(ui: &Ui, rect: Rect, text: &str) {
    let font = FontId::proportional(18.0);
    let color = ui.visuals().text_color();
    ui.painter_at(rect)
        .text(rect.center(), Align2::CENTER_CENTER, text, font, color);
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::PixelEstimate;

    /// A preview of 2 by 2 pixels covers more than a cell of 3 by 3 of 8 by 8 pixels.
    #[test]
    fn the_preview_ends_where_the_cell_does() {
        let mut preview = Film::new(FilmSize { w: 2, h: 2 });
        let pixel = PixelEstimate {
            radiance: Spectrum::WHITE,
            samples: 1,
        };
        preview.set(0, 0, pixel);
        let film = Film::new(FilmSize { w: 8, h: 8 });
        let cell = Cell {
            x0: 0,
            y0: 0,
            x1: 3,
            y1: 3,
        };
        let shown = |x, y| shown_radiance(&film, Some(&preview), cell, (x, y)).is_some();
        assert!(shown(0, 0) && shown(2, 2));
        assert!(!shown(3, 2) && !shown(2, 3));
    }
}
