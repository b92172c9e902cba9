//! Names beside points, so that none covers another one.

use crate::canvas::{Canvas, Label, Position};
use crate::style::INK;

/// Left, top, right, bottom.
type Rect = [f64; 4];

/// The space between two names in one line, so that they are not read as one.
const BETWEEN_NAMES: f64 = 8.0;

/// The places that are taken.
pub struct Labels {
    inner: Rect,
    taken: Vec<Rect>,
}

impl Labels {
    /// Labels in the rectangle `inner`.
    pub fn new(inner: Rect) -> Labels {
        Labels {
            inner,
            taken: Vec::new(),
        }
    }

    /// Keeps a disc free, such as a marker.
    pub fn keep_free(&mut self, (x, y): Position, radius: f64) {
        self.taken
            .push([x - radius, y - radius, x + radius, y + radius]);
    }

    /// Keeps a rectangle free.
    pub fn keep_box_free(&mut self, rect: Rect) {
        self.taken.push(rect);
    }

    /// Draws a name at the free place that is nearest to a point, with a thin line if that is not
    /// beside it. Only the first of its lines is bold. If nothing is free, the name is drawn over
    /// the others.
    pub fn place(&mut self, canvas: &Canvas, text: &str, (x, y): Position, label: Label) {
        let lines: Vec<&str> = text.lines().collect();
        let step = 1.15 * label.size;
        let width = lines.iter().map(|line| label.width(line));
        let size = [width.fold(0.0, f64::max), step * lines.len() as f64];
        let rect = self.take((x, y), size);
        let [left, top, right, bottom] = rect;
        let nearest = (x.clamp(left, right), y.clamp(top, bottom));
        if (nearest.0 - x).hypot(nearest.1 - y) > 14.0 {
            canvas.line(&[(x, y), nearest], INK, 0.4);
        }
        for (i, line) in lines.iter().enumerate() {
            let bold = label.bold && i == 0;
            let y = top + step * (i as f64 + 0.5);
            canvas.text(line, (left, y), Label { bold, ..label });
        }
    }

    /// The nearest free rectangle of a size, which is taken from now on.
    fn take(&mut self, point: Position, size: [f64; 2]) -> Rect {
        let rect = self.free(point, size);
        let [left, top, right, bottom] = rect;
        self.taken
            .push([left - BETWEEN_NAMES, top, right + BETWEEN_NAMES, bottom]);
        rect
    }

    /// The nearest free rectangle of a size.
    fn free(&self, (x, y): Position, [w, h]: [f64; 2]) -> Rect {
        let at = |gap: f64, angle: f64| {
            let (dx, dy) = (angle.cos(), angle.sin());
            let middle = (x + dx * (gap + 0.5 * w), y + dy * (gap + 0.5 * h));
            [
                middle.0 - 0.5 * w,
                middle.1 - 0.5 * h,
                middle.0 + 0.5 * w,
                middle.1 + 0.5 * h,
            ]
        };
        let around = (0..30).flat_map(|ring| {
            let gap = 7.0 + 7.0 * f64::from(ring);
            (0..16).map(move |k| at(gap, f64::from(k) * std::f64::consts::PI / 8.0))
        });
        let fits = |rect: &Rect| {
            rect[0] >= self.inner[0]
                && rect[1] >= self.inner[1]
                && rect[2] <= self.inner[2]
                && rect[3] <= self.inner[3]
                && !self.taken.iter().any(|other| overlap(rect, other))
        };
        let mut around = around;
        around.find(fits).unwrap_or(at(7.0, 0.0))
    }
}

fn overlap(a: &Rect, b: &Rect) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_one_point_stay_apart_and_inside() {
        let inner = [0.0, 0.0, 400.0, 300.0];
        let mut labels = Labels::new(inner);
        labels.keep_free((395.0, 150.0), 5.0);
        let mut names: Vec<Rect> = Vec::new();
        for _ in 0..12 {
            let rect = labels.take((395.0, 150.0), [80.0, 11.0]);
            assert!(rect[0] >= 0.0 && rect[2] <= 400.0, "{rect:?}");
            let wider = [rect[0] - 7.9, rect[1], rect[2] + 7.9, rect[3]];
            assert!(!names.iter().any(|other| overlap(&wider, other)));
            names.push(rect);
        }
    }
}
