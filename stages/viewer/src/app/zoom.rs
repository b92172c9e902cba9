//! How a picture is enlarged and moved in its place.

use egui::{PointerButton, Pos2, Rect, Response, Ui, Vec2};
use kit::FilmSize;

/// The enlargements of the wheel: whole numbers of the screen's pixels for each pixel of the
/// picture, and the inverse of some.
const SCALES: [f32; 16] = [
    0.125, 0.25, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0, 96.0,
];
/// The points of scrolling that are one step.
const STEP: f32 = 40.0;

/// The enlargement of a picture, and which part of it is visible. A picture that is not enlarged
/// fits its place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Zoom {
    /// The enlargement, and the point of the picture in the middle, as shares of its edges.
    enlarged: Option<(f32, Vec2)>,
    /// Scrolling that is not a whole step yet.
    scrolled: f32,
}

impl Zoom {
    /// Fits the picture into its place again.
    pub(super) fn fit(&mut self) {
        *self = Zoom::default();
    }

    /// Where a picture of the size `film` is.
    pub(super) fn area(&self, rect: Rect, film: FilmSize, pixels_per_point: f32) -> Rect {
        let Some((scale, center)) = self.enlarged else {
            return fitted(rect, film);
        };
        let size = scale / pixels_per_point * size_of(film);
        Rect::from_min_size(rect.center() - center * size, size)
    }

    /// The wheel enlarges the picture at the mouse. The right and the middle button move it, and
    /// the left one if `left_moves`.
    pub(super) fn mouse(
        &mut self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        film: FilmSize,
        left_moves: bool,
    ) {
        let points = ui.ctx().pixels_per_point();
        if let Some(at) = response.hover_pos() {
            self.scrolled += ui.input(|input| input.smooth_scroll_delta().y) / STEP;
            let steps = self.scrolled.trunc();
            self.scrolled -= steps;
            if steps != 0.0 {
                self.step(steps > 0.0, at, rect, film, points);
            }
        }
        let moves = response.dragged_by(PointerButton::Secondary)
            || response.dragged_by(PointerButton::Middle)
            || left_moves && response.dragged_by(PointerButton::Primary);
        if let (true, Some((scale, center))) = (moves, &mut self.enlarged) {
            *center -= response.drag_delta() / (*scale / points * size_of(film));
            *center = center.clamp(Vec2::ZERO, Vec2::splat(1.0));
        }
    }

    /// The next enlargement. What is at `at` stays there.
    fn step(&mut self, larger: bool, at: Pos2, rect: Rect, film: FilmSize, points: f32) {
        let area = self.area(rect, film, points);
        let fit = points * fitted(rect, film).width() / film.w as f32;
        let now = self.enlarged.map_or(fit, |(scale, _)| scale);
        let next = match larger {
            true => SCALES.iter().find(|scale| **scale > 1.01 * now),
            false => SCALES.iter().rfind(|scale| **scale < 0.99 * now),
        };
        let Some(next) = next else { return };
        if *next <= fit {
            return self.fit();
        }
        let share = ((at - area.min) / area.size()).clamp(Vec2::ZERO, Vec2::splat(1.0));
        let center = share + (rect.center() - at) / (*next / points * size_of(film));
        self.enlarged = Some((*next, center));
    }

    /// The enlargement in percent, if there is one.
    pub(super) fn percent(&self) -> Option<f32> {
        self.enlarged.map(|(scale, _)| 100.0 * scale)
    }
}

fn size_of(film: FilmSize) -> Vec2 {
    Vec2::new(film.w as f32, film.h as f32)
}

/// The largest rectangle of the film's shape in the middle of `rect`.
pub(super) fn fitted(rect: Rect, film: FilmSize) -> Rect {
    let size = size_of(film);
    let scale = (rect.width() / size.x).min(rect.height() / size.y);
    Rect::from_center_size(rect.center(), size * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILM: FilmSize = FilmSize { w: 40, h: 30 };

    fn place() -> Rect {
        Rect::from_min_size(Pos2::new(10.0, 20.0), Vec2::new(420.0, 330.0))
    }

    #[test]
    fn what_is_under_the_mouse_stays_there() {
        let at = Pos2::new(100.0, 300.0);
        let share = |zoom: &Zoom| {
            let area = zoom.area(place(), FILM, 1.0);
            (at - area.min) / area.size()
        };
        let mut zoom = Zoom::default();
        let before = share(&zoom);
        for percent in [1200.0, 1600.0, 2400.0] {
            zoom.step(true, at, place(), FILM, 1.0);
            assert_eq!(zoom.percent(), Some(percent), "whole numbers");
            assert!((share(&zoom) - before).length() < 1e-4);
        }
        for _ in 0..3 {
            zoom.step(false, at, place(), FILM, 1.0);
        }
        assert_eq!(zoom.area(place(), FILM, 1.0), fitted(place(), FILM));
    }

    #[test]
    fn an_enlargement_counts_pixels_of_the_screen() {
        let zoom = Zoom {
            enlarged: Some((4.0, Vec2::splat(0.5))),
            scrolled: 0.0,
        };
        assert_eq!(zoom.area(place(), FILM, 2.0).size(), Vec2::new(80.0, 60.0));
    }
}
