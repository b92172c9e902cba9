//! Lines in a 3D view: projected, and hidden by the surfaces of the traced picture.

use crate::project::Projection;
use crate::view_picture::ViewPicture;
use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, Ui};
use kit::{Aabb, Camera, Vec2, Vec3};

/// What happens to the hidden part of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hidden {
    /// It is drawn as if it were visible.
    Shown,
    /// It is drawn faintly.
    Faint,
    /// It is not drawn.
    Left,
}

/// Draws lines of world space into a view.
pub(super) struct Lines<'a> {
    painter: Painter,
    rect: Rect,
    projection: Projection,
    /// The surfaces that hide lines.
    picture: Option<&'a ViewPicture>,
}

/// The length of the pieces of a line that are visible or hidden as a whole, in points.
const PIECE: f32 = 5.0;
/// The opacity of hidden lines.
const FAINT: f32 = 0.22;
impl<'a> Lines<'a> {
    pub(super) fn new(
        ui: &Ui,
        rect: Rect,
        camera: &Camera,
        picture: Option<&'a ViewPicture>,
    ) -> Lines<'a> {
        Lines {
            painter: ui.painter_at(rect),
            rect,
            projection: Projection::new(camera),
            // Surfaces of another camera would hide the wrong lines.
            picture: picture.filter(|picture| picture.request.camera == *camera),
        }
    }

    /// Where a position on the film is in the window.
    fn at(&self, film: Vec2) -> Pos2 {
        let rect = self.rect;
        Pos2::new(
            rect.left() + rect.width() * film.x as f32,
            rect.bottom() - rect.height() * film.y as f32,
        )
    }

    /// Where a point appears in the window; `None` behind the camera.
    pub(super) fn point(&self, p: Vec3) -> Option<Pos2> {
        self.projection.point(p).map(|film| self.at(film))
    }

    fn hides(&self, p: Vec3) -> bool {
        let film = self.projection.point(p);
        let (Some(picture), Some(film)) = (self.picture, film) else {
            return false;
        };
        picture.hides(film, self.projection.distance(p))
    }

    /// A line from `a` to `b`.
    pub(super) fn line(&self, a: Vec3, b: Vec3, stroke: Stroke, hidden: Hidden) {
        let Some((a, b)) = self.projection.segment(a, b) else {
            return;
        };
        let (Some(from), Some(to)) = (self.point(a), self.point(b)) else {
            return;
        };
        if hidden == Hidden::Shown || self.picture.is_none() {
            self.painter.line_segment([from, to], stroke);
            return;
        }
        let visible = self
            .rect
            .expand(1.0)
            .intersects(Rect::from_two_pos(from, to));
        if !visible {
            return;
        }
        let pieces = ((from.distance(to) / PIECE).ceil() as usize).clamp(1, 600);
        let share = |i: usize| i as f64 / pieces as f64;
        // The middle of a piece decides; equal neighbours become one stroke.
        let is_hidden = |i: usize| self.hides(self.between(a, b, share(i) + 0.5 / pieces as f64));
        let mut start = 0;
        let mut state = is_hidden(0);
        for i in 1..=pieces {
            let next = i < pieces && is_hidden(i);
            if i < pieces && next == state {
                continue;
            }
            let ends = [share(start), share(i)].map(|s| from.lerp(to, s as f32));
            if !state {
                self.painter.line_segment(ends, stroke);
            } else if hidden == Hidden::Faint {
                let color = stroke.color.gamma_multiply(FAINT);
                self.painter.line_segment(ends, Stroke { color, ..stroke });
            }
            (start, state) = (i, next);
        }
    }

    /// The point of the segment that appears at this share of its length in the window.
    fn between(&self, a: Vec3, b: Vec3, share: f64) -> Vec3 {
        let (za, zb) = (self.projection.depth(a), self.projection.depth(b));
        // Perspective: what is even in the window is even in 1/z.
        let t = share * za / (zb + share * (za - zb));
        a + t * (b - a)
    }

    /// The twelve edges of a box.
    pub(super) fn aabb(&self, b: &Aabb, stroke: Stroke, hidden: Hidden) {
        if b.is_empty() || !(b.min.is_finite() && b.max.is_finite()) {
            return;
        }
        let corner = |i: usize| {
            Vec3::new(
                if i & 1 == 0 { b.min.x } else { b.max.x },
                if i & 2 == 0 { b.min.y } else { b.max.y },
                if i & 4 == 0 { b.min.z } else { b.max.z },
            )
        };
        for i in 0..8 {
            for axis in [1, 2, 4].into_iter().filter(|axis| i & axis == 0) {
                self.line(corner(i), corner(i | axis), stroke, hidden);
            }
        }
    }

    /// A point as a disc.
    pub(super) fn disc(&self, p: Vec3, radius: f32, color: Color32) {
        if let Some(at) = self.point(p) {
            self.painter.circle_filled(at, radius, color);
        }
    }

    /// A filled triangle. Its edges are lines of their own: an outline would have long spikes at sharp
    /// corners.
    pub(super) fn triangle(&self, points: [Vec3; 3], fill: Color32, stroke: Stroke) {
        let at: Option<Vec<Pos2>> = points.iter().map(|p| self.point(*p)).collect();
        if let Some(at) = at {
            self.painter
                .add(Shape::convex_polygon(at, fill, Stroke::NONE));
        }
        if stroke.width > 0.0 {
            let [a, b, c] = points;
            for (from, to) in [(a, b), (b, c), (c, a)] {
                self.line(from, to, stroke, Hidden::Shown);
            }
        }
    }

    /// The outline of a sphere: a circle around its centre, facing the camera.
    pub(super) fn sphere(&self, center: Vec3, radius: f64, camera: &Camera, stroke: Stroke) {
        let circle = |i: u32| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 64.0).sin_cos();
            center + radius * (cos * camera.c2w.x_axis + sin * camera.c2w.y_axis)
        };
        for i in 0..64 {
            self.line(circle(i), circle(i + 1), stroke, Hidden::Shown);
        }
    }

    /// A sphere as three circles.
    pub(super) fn ball(&self, center: Vec3, radius: f64, stroke: Stroke) {
        for (u, v) in [(Vec3::X, Vec3::Y), (Vec3::Y, Vec3::Z), (Vec3::Z, Vec3::X)] {
            let at = |i: u32| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 64.0).sin_cos();
                center + radius * (cos * u + sin * v)
            };
            for i in 0..64 {
                self.line(at(i), at(i + 1), stroke, Hidden::Shown);
            }
        }
    }

    /// An arrow along `d` from `o`, as long as `length` points in the window if possible.
    pub(super) fn arrow(&self, o: Vec3, d: Vec3, length: f64, color: Color32, name: &str) {
        let end = o + length * d;
        self.line(o, end, Stroke::new(2.0, color), Hidden::Shown);
        if let Some(at) = self.point(end) {
            self.painter.circle_filled(at, 3.0, color);
            let font = egui::FontId::proportional(12.0);
            let offset = egui::vec2(6.0, -6.0);
            self.painter
                .text(at + offset, egui::Align2::LEFT_BOTTOM, name, font, color);
        }
    }
}
