//! Lines in a 3D view: projected, and hidden by the surfaces of the traced picture.

use super::colors::{self, Palette, Pattern};
use crate::project::Projection;
use crate::view_picture::ViewPicture;
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Ui, Vec2 as Vector};
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
    /// The colours of the theme.
    pub(super) palette: &'static Palette,
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
/// The radius of the marks of points.
const MARK: f32 = 7.0;
/// The width of the lines of marks and arrows.
const MARK_WIDTH: f32 = 2.5;

impl<'a> Lines<'a> {
    pub(super) fn new(
        ui: &Ui,
        rect: Rect,
        camera: &Camera,
        picture: Option<&'a ViewPicture>,
    ) -> Lines<'a> {
        Lines {
            palette: colors::palette(ui),
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

    /// Where a point appears in the window; `None` behind the camera, and for a point that is none.
    pub(super) fn point(&self, p: Vec3) -> Option<Pos2> {
        let film = self.projection.point(p).filter(|film| film.is_finite());
        film.map(|film| self.at(film))
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
        self.patterned(a, b, stroke, hidden, Pattern::Solid);
    }

    /// A line from `a` to `b` with a pattern.
    pub(super) fn patterned(
        &self,
        a: Vec3,
        b: Vec3,
        stroke: Stroke,
        hidden: Hidden,
        pattern: Pattern,
    ) {
        let Some((a, b)) = self.projection.segment(a, b) else {
            return;
        };
        let (Some(from), Some(to)) = (self.point(a), self.point(b)) else {
            return;
        };
        // Outside the window a line near the camera may be millions of points long.
        let Some([first, last]) = shares_inside(self.rect.expand(4.0), from, to) else {
            return;
        };
        if hidden == Hidden::Shown || self.picture.is_none() {
            self.stroke([from, to], [first, last], stroke, pattern);
            return;
        }
        let length = from.distance(to) * (last - first);
        let pieces = ((length / PIECE).ceil() as usize).clamp(1, 600);
        let share = |i: f64| f64::from(first) + f64::from(last - first) * i / pieces as f64;
        // The middle of a piece decides; equal neighbours become one stroke.
        let is_hidden = |i: usize| self.hides(self.between(a, b, share(i as f64 + 0.5)));
        let mut start = 0;
        let mut state = is_hidden(0);
        for i in 1..=pieces {
            let next = i < pieces && is_hidden(i);
            if i < pieces && next == state {
                continue;
            }
            let shares = [start, i].map(|i| share(i as f64) as f32);
            if !state {
                self.stroke([from, to], shares, stroke, pattern);
            } else if hidden == Hidden::Faint {
                let color = stroke.color.gamma_multiply(FAINT);
                self.stroke([from, to], shares, Stroke { color, ..stroke }, pattern);
            }
            (start, state) = (i, next);
        }
    }

    /// The part of a line between two shares of its length. Its pattern starts where the line does.
    fn stroke(&self, [from, to]: [Pos2; 2], shares: [f32; 2], stroke: Stroke, pattern: Pattern) {
        let ends = shares.map(|share| from.lerp(to, share));
        let Some([dash, gap]) = pattern.dash(stroke.width) else {
            self.painter.line_segment(ends, stroke);
            return;
        };
        let before = from.distance(ends[0]) % (dash + gap);
        let length = ends[0].distance(ends[1]);
        let mut at = -before;
        while at < length {
            let [start, end] = [at.max(0.0), (at + dash).min(length)];
            if end > start {
                let part = [start, end].map(|along| ends[0].lerp(ends[1], along / length));
                self.painter.line_segment(part, stroke);
            }
            at += dash + gap;
        }
    }

    /// The point of the segment that appears at this share of its length in the window.
    fn between(&self, a: Vec3, b: Vec3, share: f64) -> Vec3 {
        let (za, zb) = (self.projection.depth(a), self.projection.depth(b));
        // Perspective: what is even in the window is even in 1/z.
        let t = share * za / (zb + share * (za - zb));
        a + t * (b - a)
    }

    /// Draws a line through points.
    pub(super) fn path(&self, points: &[Vec3], stroke: Stroke, hidden: Hidden, pattern: Pattern) {
        for pair in points.windows(2) {
            self.patterned(pair[0], pair[1], stroke, hidden, pattern);
        }
    }

    /// Draws the outline of a polygon.
    pub(super) fn outline(
        &self,
        corners: &[Vec3],
        stroke: Stroke,
        hidden: Hidden,
        pattern: Pattern,
    ) {
        let closed = corners.iter().chain(corners.first()).copied();
        self.path(&closed.collect::<Vec<_>>(), stroke, hidden, pattern);
    }

    /// Draws a circle around a point: `u` and `v` are two of its radii, at a right angle.
    pub(super) fn circle(&self, center: Vec3, [u, v]: [Vec3; 2], stroke: Stroke) {
        let at = |i: u32| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 64.0).sin_cos();
            center + cos * u + sin * v
        };
        let points: Vec<Vec3> = (0..64).map(at).collect();
        self.outline(&points, stroke, Hidden::Shown, Pattern::Solid);
    }

    /// The twelve edges of a box.
    pub(super) fn aabb(&self, b: &Aabb, stroke: Stroke, hidden: Hidden) {
        self.patterned_box(b, stroke, hidden, Pattern::Solid);
    }

    /// The twelve edges of a box, with a pattern.
    pub(super) fn patterned_box(&self, b: &Aabb, stroke: Stroke, hidden: Hidden, pattern: Pattern) {
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
                self.patterned(corner(i), corner(i | axis), stroke, hidden, pattern);
            }
        }
    }

    /// A point as a disc.
    pub(super) fn disc(&self, p: Vec3, radius: f32, color: Color32) {
        if let Some(at) = self.point(p) {
            self.painter.circle_filled(at, radius, color);
        }
    }

    /// A triangle of the scene: what is in front of its edges hides them.
    pub(super) fn face(&self, points: [Vec3; 3], fill: Color32, stroke: Stroke) {
        self.triangle(points, fill, Stroke::NONE);
        self.outline(&points, stroke, Hidden::Faint, Pattern::Solid);
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
            self.outline(&points, stroke, Hidden::Shown, Pattern::Solid);
        }
    }

    /// A tint over the visible part of a primitive. Returns whether the picture knows it.
    pub(super) fn tint(&self, prim: u32, color: Color32) -> bool {
        let Some(picture) = self.picture else {
            return false;
        };
        let pixel = self.rect.size() / Vector::new(picture.size.0 as f32, picture.size.1 as f32);
        let mut mesh = egui::Mesh::default();
        for (row, columns) in picture.runs_of(prim) {
            let corner = |column: usize, row: usize| {
                self.rect.min + Vector::new(column as f32, row as f32) * pixel
            };
            let ends = [corner(columns.start, row), corner(columns.end, row + 1)];
            mesh.add_colored_rect(Rect::from_min_max(ends[0], ends[1]), color);
        }
        self.painter.add(mesh);
        true
    }

    /// The outline of a sphere: a circle around its centre, facing the camera.
    pub(super) fn sphere(&self, center: Vec3, radius: f64, camera: &Camera, stroke: Stroke) {
        let radii = [camera.c2w.x_axis, camera.c2w.y_axis].map(|axis| radius * axis);
        self.circle(center, radii, stroke);
    }

    /// A sphere as three circles.
    pub(super) fn ball(&self, center: Vec3, radius: f64, stroke: Stroke) {
        for (u, v) in [(Vec3::X, Vec3::Y), (Vec3::Y, Vec3::Z), (Vec3::Z, Vec3::X)] {
            self.circle(center, [radius * u, radius * v], stroke);
        }
    }

    /// The mark of what is exact: a ring.
    pub(super) fn ring(&self, p: Vec3, color: Color32) {
        if let Some(at) = self.point(p) {
            ring(&self.painter, at, color);
        }
    }

    /// The mark of what the student's code returned: a cross.
    pub(super) fn cross(&self, p: Vec3, color: Color32) {
        if let Some(at) = self.point(p) {
            cross(&self.painter, at, color);
        }
    }

    /// The end of a range at `p` of a line along `d`: a bar across the line, with a name. `side` is
    /// 1 or -1: where the name is.
    pub(super) fn end_mark(&self, p: Vec3, d: Vec3, color: Color32, name: &str, side: f32) {
        let Some(at) = self.point(p) else { return };
        let small = 1e-3 * self.projection.distance(p) / d.length();
        let along = self
            .point(p + small * d)
            .map_or(Vector::X, |next| next - at);
        let across = MARK * 1.4 * side * along.normalized().rot90();
        let across = if across.length() > 0.0 {
            across
        } else {
            Vector::X * MARK
        };
        let stroke = Stroke::new(MARK_WIDTH, color);
        self.painter
            .line_segment([at - across, at + across], stroke);
        let align = match across.x < 0.0 {
            true => Align2::RIGHT_CENTER,
            false => Align2::LEFT_CENTER,
        };
        self.name(at + 1.5 * across, align, color, name);
    }

    /// An arrow along `d` from `o`, with a name at its head.
    pub(super) fn arrow(&self, o: Vec3, d: Vec3, length: f64, color: Color32, name: &str) {
        self.patterned_arrow(o, length * d, color, name, Pattern::Solid);
    }

    /// An arrow from `o` to `o + d` with a pattern, and a name at its head.
    pub(super) fn patterned_arrow(
        &self,
        o: Vec3,
        d: Vec3,
        color: Color32,
        name: &str,
        pattern: Pattern,
    ) {
        let stroke = Stroke::new(2.0, color);
        self.patterned(o, o + d, stroke, Hidden::Shown, pattern);
        let (Some(from), Some(to)) = (self.point(o), self.point(o + d)) else {
            return;
        };
        let back = (from - to).normalized();
        if back == Vector::ZERO {
            self.painter.circle_filled(to, 3.0, color);
        }
        let head = [
            to,
            to + 9.0 * back + 4.0 * back.rot90(),
            to + 9.0 * back - 4.0 * back.rot90(),
        ];
        let head = Shape::convex_polygon(head.to_vec(), color, Stroke::NONE);
        self.painter.add(head);
        self.name(to - 12.0 * back, Align2::CENTER_CENTER, color, name);
    }

    /// A name at a point of the window, on a shade of the background.
    fn name(&self, at: Pos2, align: Align2, color: Color32, name: &str) {
        if name.is_empty() {
            return;
        }
        let font = FontId::proportional(12.0);
        let galley = self.painter.layout_no_wrap(name.to_owned(), font, color);
        let mut area = align.anchor_size(at, galley.size());
        // A name at the edge of the view stays in it.
        let inside = self.rect.shrink(4.0);
        let low = (inside.min - area.min).max(Vector::ZERO);
        let high = (area.max - inside.max).max(Vector::ZERO);
        area = area.translate(low - high);
        let shade = self.palette.backdrop.gamma_multiply(0.8);
        self.painter.rect_filled(area.expand(2.0), 2.0, shade);
        self.painter.galley(area.min, galley, color);
    }

    /// Names a point of the world.
    pub(super) fn name_at(&self, p: Vec3, color: Color32, name: &str) {
        if let Some(at) = self.point(p) {
            let above = at + Vector::new(0.0, -16.0);
            self.name(above, Align2::CENTER_CENTER, color, name);
        }
    }
}

/// The mark of what is exact, in a view and in its legend.
pub(super) fn ring(painter: &Painter, at: Pos2, color: Color32) {
    painter.circle_stroke(at, MARK, Stroke::new(MARK_WIDTH, color));
}

/// The mark of what is the student's, in a view and in its legend.
pub(super) fn cross(painter: &Painter, at: Pos2, color: Color32) {
    let arm = 0.75 * MARK;
    for arm in [Vector::new(arm, arm), Vector::new(arm, -arm)] {
        painter.line_segment([at - arm, at + arm], Stroke::new(MARK_WIDTH, color));
    }
}

/// A short piece of a line, for a legend.
pub(super) fn sample(painter: &Painter, at: Pos2, stroke: Stroke, pattern: Pattern) {
    let [from, to] = [at - Vector::X * 12.0, at + Vector::X * 12.0];
    match pattern.dash(stroke.width) {
        None => {
            painter.line_segment([from, to], stroke);
        }
        Some([dash, gap]) => {
            painter.extend(Shape::dashed_line(&[from, to], stroke, dash, gap));
        }
    }
}

/// The shares of the segment from `from` to `to` between which it is in `rect` (Liang and Barsky,
/// "A New Concept and Method for Line Clipping", 1984); `None` if it is outside.
fn shares_inside(rect: Rect, from: Pos2, to: Pos2) -> Option<[f32; 2]> {
    let d = to - from;
    let (mut first, mut last) = (0.0_f32, 1.0_f32);
    for (start, step, low, high) in [
        (from.x, d.x, rect.min.x, rect.max.x),
        (from.y, d.y, rect.min.y, rect.max.y),
    ] {
        if step == 0.0 {
            if start < low || start > high {
                return None;
            }
            continue;
        }
        let [a, b] = [(low - start) / step, (high - start) / step];
        first = first.max(a.min(b));
        last = last.min(a.max(b));
    }
    (first <= last).then_some([first, last])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_cut_at_the_edge_of_the_view() {
        let rect = Rect::from_min_max(Pos2::ZERO, Pos2::new(100.0, 100.0));
        let cut = |from: [f32; 2], to: [f32; 2]| shares_inside(rect, from.into(), to.into());
        assert_eq!(cut([10.0, 10.0], [90.0, 20.0]), Some([0.0, 1.0]));
        assert_eq!(cut([-100.0, 50.0], [300.0, 50.0]), Some([0.25, 0.5]));
        assert_eq!(cut([-10.0, 50.0], [-10.0, 60.0]), None);
        assert_eq!(cut([-50.0, 90.0], [50.0, 190.0]), None);
    }
}
