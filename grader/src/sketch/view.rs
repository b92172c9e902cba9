//! A view of space: the plane of a drawing, and the part of it that is drawn.

use super::model::{Ink, Stroke};
use judge::shown::ShownRay;
use kit::Vec3;

/// A parallel projection onto a plane.
pub(super) struct View {
    pub(super) origin: Vec3,
    pub(super) right: Vec3,
    pub(super) up: Vec3,
}

impl View {
    pub(super) fn place(&self, p: Vec3) -> [f64; 2] {
        let offset = p - self.origin;
        // The sum of 0 removes the sign of a zero.
        [self.right.dot(offset) + 0.0, self.up.dot(offset) + 0.0]
    }
}

/// A rectangle of a plane.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    min: [f64; 2],
    max: [f64; 2],
}

impl Frame {
    /// The smallest frame around `shape`, with those of `others` that are no farther away from it
    /// than three times its size, and a margin. `None` without a size.
    pub(super) fn around(shape: &[[f64; 2]], others: &[[f64; 2]]) -> Option<Frame> {
        let first = *shape.first()?;
        let mut frame = Frame {
            min: first,
            max: first,
        };
        frame.grow(shape);
        let reach = 3.0 * frame.size().max(f64::MIN_POSITIVE);
        let near = others
            .iter()
            .copied()
            .filter(|p| (0..2).all(|i| p[i] > frame.min[i] - reach && p[i] < frame.max[i] + reach));
        let near: Vec<[f64; 2]> = near.collect();
        frame.grow(&near);
        let margin = 0.15 * frame.size();
        frame.min = frame.min.map(|x| x - margin);
        frame.max = frame.max.map(|x| x + margin);
        (margin > 0.0 && margin.is_finite()).then_some(frame)
    }

    fn grow(&mut self, points: &[[f64; 2]]) {
        for p in points {
            self.min = [0, 1].map(|i| self.min[i].min(p[i]));
            self.max = [0, 1].map(|i| self.max[i].max(p[i]));
        }
    }

    fn size(&self) -> f64 {
        (self.max[0] - self.min[0]).max(self.max[1] - self.min[1])
    }

    pub(super) fn contains(&self, p: [f64; 2]) -> bool {
        (0..2).all(|i| (self.min[i]..=self.max[i]).contains(&p[i]))
    }

    /// The interval of `t` in which the line `o + t d` is inside; `None` if it never is, or if it
    /// is one point.
    fn clip(&self, o: [f64; 2], d: [f64; 2]) -> Option<[f64; 2]> {
        let inside = inside([self.min, self.max], o, d);
        inside.filter(|[from, to]| from < to && from.is_finite() && to.is_finite())
    }
}

/// The interval of `t` in which the line `o + t d` is in the rectangle from `min` to `max`. Its
/// start is after its end if the line is never inside; `None` if it is parallel to a side, and
/// outside.
pub(super) fn inside([min, max]: [[f64; 2]; 2], o: [f64; 2], d: [f64; 2]) -> Option<[f64; 2]> {
    let mut inside = [f64::NEG_INFINITY, f64::INFINITY];
    for i in 0..2 {
        if d[i] == 0.0 {
            if !(min[i]..=max[i]).contains(&o[i]) {
                return None;
            }
            continue;
        }
        let ends = [min, max].map(|corner| (corner[i] - o[i]) / d[i]);
        inside[0] = inside[0].max(ends[0].min(ends[1]));
        inside[1] = inside[1].min(ends[0].max(ends[1]));
    }
    Some(inside)
}

/// Draws the ray as far as the frame shows it: from its origin on, or from a hit that is behind it.
pub(super) fn ray(strokes: &mut Vec<Stroke>, view: &View, frame: &Frame, shown: &ShownRay) {
    let ray = &shown.ray;
    let hits = shown.expected.iter().chain(&shown.yours).copied();
    let first = hits.fold(0.0, f64::min);
    let o = view.place(ray.o);
    let to = view.place(ray.o + ray.d);
    let d = [to[0] - o[0], to[1] - o[1]];
    let at = |t: f64| [o[0] + t * d[0], o[1] + t * d[1]];
    if let Some([start, end]) = frame.clip(o, d)
        && end > first
    {
        let start = start.max(first);
        let range = [start.max(ray.min_t), end.min(ray.max_t)];
        if range[0] < range[1] {
            let head = range.map(at);
            strokes.push(match range[1] == end {
                true => Stroke::Arrow(Ink::Ray, head),
                false => Stroke::Line(Ink::Ray, head),
            });
        }
        let before = [start, range[0].min(end)];
        let behind = [range[1].max(start), end];
        if before[0] < before[1] {
            strokes.push(Stroke::Line(Ink::Outside, before.map(at)));
        }
        if behind[0] < behind[1] && range[0] < range[1] {
            strokes.push(Stroke::Arrow(Ink::Outside, behind.map(at)));
        }
    }
    if frame.contains(o) {
        strokes.push(Stroke::Mark(Ink::Ray, o));
    }
}
