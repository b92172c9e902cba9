//! The drawing: strokes in a plane.

use super::words::Anchor;

/// A drawing of one call.
#[derive(Clone, Debug, PartialEq)]
pub struct Sketch {
    pub(super) strokes: Vec<Stroke>,
    /// What is seen, and from where.
    pub(super) caption: String,
    pub(super) layout: Layout,
    pub(super) axis: Option<TAxis>,
}

/// How the plane is put on the sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// With the same scale along both axes.
    Shape,
    /// The second coordinate counts lines, from 0 at the top down.
    Rows,
}

/// What a stroke is, by which it gets its sign or its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ink {
    /// An edge of a shape; as a mark, a point that the ray passes.
    Shape,
    /// The ray in its range; as a mark, its origin.
    Ray,
    /// The ray outside of its range.
    Outside,
    Light,
    Expected,
    Yours,
}

/// A part of a drawing. Coordinates go to the right and up.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Stroke {
    Line(Ink, [[f64; 2]; 2]),
    /// A line that ends with a head.
    Arrow(Ink, [[f64; 2]; 2]),
    Mark(Ink, [f64; 2]),
    /// A word, right of its point if it starts there, left if it ends there, or around it.
    Word(Anchor, [f64; 2], String),
}

/// The sides of a polygon.
pub(super) fn sides<const N: usize>(corners: [[f64; 2]; N]) -> [[[f64; 2]; 2]; N] {
    std::array::from_fn(|i| [corners[i], corners[(i + 1) % N]])
}

/// The range of a ray, and where on it the hits are.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TAxis {
    pub(super) range: [f64; 2],
    pub(super) expected: Vec<f64>,
    pub(super) yours: Vec<f64>,
}

impl Sketch {
    /// A drawing without an axis of `t`.
    pub(super) fn new(strokes: Vec<Stroke>, caption: &str, layout: Layout) -> Sketch {
        Sketch {
            strokes,
            caption: caption.into(),
            layout,
            axis: None,
        }
    }

    fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        self.strokes.iter().flat_map(Stroke::points)
    }

    /// Whether all points can be drawn: also the size of the drawing has to be finite.
    pub(super) fn is_finite(&self) -> bool {
        let [min, max] = self.bounds();
        let axis = self.axis.as_ref().map_or([0.0; 2], TAxis::extent);
        let sizes = [max[0] - min[0], max[1] - min[1], axis[1] - axis[0]];
        let are_points_finite = self.points().flatten().all(f64::is_finite);
        !self.strokes.is_empty() && are_points_finite && sizes.into_iter().all(f64::is_finite)
    }

    /// The smallest and the largest coordinates.
    pub(super) fn bounds(&self) -> [[f64; 2]; 2] {
        let start = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        self.points().fold(start, |[min, max], p| {
            [
                [0, 1].map(|i| min[i].min(p[i])),
                [0, 1].map(|i| max[i].max(p[i])),
            ]
        })
    }

    /// Whether the drawing or its axis has marks of this ink, or lines that are out of range.
    pub(super) fn shows(&self, ink: Ink) -> bool {
        let on_axis = self.axis.as_ref().is_some_and(|axis| match ink {
            Ink::Expected => !axis.expected.is_empty(),
            Ink::Yours => !axis.yours.is_empty(),
            _ => false,
        });
        on_axis || self.has(ink, ink != Ink::Outside)
    }

    /// Whether a mark, an arrow or a line has this ink.
    pub(super) fn has(&self, ink: Ink, is_mark: bool) -> bool {
        self.strokes.iter().any(|stroke| match stroke {
            Stroke::Mark(of, _) => is_mark && *of == ink,
            Stroke::Line(of, _) | Stroke::Arrow(of, _) => !is_mark && *of == ink,
            _ => false,
        })
    }
}

impl Stroke {
    /// A word beside the tip of an arrow.
    pub(super) fn word_at_tip([from, tip]: [[f64; 2]; 2], word: &str) -> Stroke {
        let anchor = match tip[0] < from[0] {
            true => Anchor::End,
            false => Anchor::Start,
        };
        Stroke::Word(anchor, tip, word.into())
    }

    fn points(&self) -> Vec<[f64; 2]> {
        match self {
            Stroke::Line(_, ends) | Stroke::Arrow(_, ends) => ends.to_vec(),
            Stroke::Mark(_, at) | Stroke::Word(_, at, _) => vec![*at],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Answers may be any number, and the difference of two may be infinite.
    #[test]
    fn what_is_too_large_to_be_drawn_is_not_drawn() {
        let drawn = |length: f64, t: f64| {
            let line = Stroke::Line(Ink::Shape, [[-length, 0.0], [length, 1.0]]);
            let mut sketch = Sketch::new(vec![line], "a line", Layout::Shape);
            sketch.axis = Some(TAxis {
                range: [0.0, f64::INFINITY],
                expected: vec![1.0],
                yours: vec![t, -t],
            });
            sketch.is_finite()
        };
        assert!(drawn(1.0, 2.0) && drawn(1e300, 1e300));
        assert!(!drawn(1e308, 2.0) && !drawn(1.0, 1e308) && !drawn(f64::NAN, 1.0));
    }
}
