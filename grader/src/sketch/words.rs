//! Where the words of an SVG stand: beside their points, and none on another one.

/// Left, top, right, bottom.
type Rect = [f64; 4];

/// How far letters of 14 pixels reach above and below their base line.
const ABOVE: f64 = 13.0;
const BELOW: f64 = 4.0;

/// The width of a digit of 14 pixels in DejaVu Sans, whose letters are the widest among the usual
/// fonts of systems, and what a word may be wider than so many digits.
const LETTER: f64 = 8.9;
const SLACK: f64 = 4.0;

/// The end of a word that is at its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A place for a word: the point of its base line, and which end of the word is there.
pub(super) type Place = ([f64; 2], Anchor);

/// The words that are placed so far, in a rectangle that all are inside of.
pub(super) struct Words {
    inside: Rect,
    taken: Vec<Rect>,
    marks: Vec<Rect>,
}

impl Words {
    pub(super) fn new(inside: Rect) -> Words {
        Words {
            inside,
            taken: Vec::new(),
            marks: Vec::new(),
        }
    }

    /// Keeps words away from a mark, where there is another place for them.
    pub(super) fn avoid(&mut self, [x, y]: [f64; 2], radius: f64) {
        self.marks
            .push([x - radius, y - radius, x + radius, y + radius]);
    }

    /// The first of `places` where a word covers neither a word nor a mark, or else no word; `None`
    /// if there is no such place. A word that would leave the rectangle is moved into it.
    pub(super) fn place(&mut self, word: &str, places: &[Place]) -> Option<Place> {
        let moved: Vec<(Place, Rect)> = places
            .iter()
            .filter_map(|place| self.moved_inside(word, *place))
            .collect();
        let is_free = |rects: &[Rect], rect: &Rect| !rects.iter().any(|one| overlap(one, rect));
        let free = moved.iter().filter(|(_, rect)| is_free(&self.taken, rect));
        let best = free.clone().find(|(_, rect)| is_free(&self.marks, rect));
        let (place, rect) = *best.or_else(|| free.clone().next())?;
        self.taken.push(rect);
        Some(place)
    }

    /// A place, moved to the side until the word is inside; `None` above and below.
    fn moved_inside(&self, word: &str, ([x, y], anchor): Place) -> Option<(Place, Rect)> {
        let [left, top, right, bottom] = self.inside;
        let rect = rect(word, ([x, y], anchor));
        let by = (left - rect[0]).max(0.0) + (right - rect[2]).min(0.0);
        let is_inside = top <= rect[1] && rect[3] <= bottom;
        is_inside.then_some((
            ([x + by, y], anchor),
            [rect[0] + by, rect[1], rect[2] + by, rect[3]],
        ))
    }
}

/// The rectangle that a word takes.
pub(super) fn rect(word: &str, ([x, y], anchor): Place) -> Rect {
    let width = LETTER * word.chars().count() as f64 + SLACK;
    let left = match anchor {
        Anchor::Start => x,
        Anchor::Middle => x - 0.5 * width,
        Anchor::End => x - width,
    };
    [left, y - ABOVE, left + width, y + BELOW]
}

pub(super) fn overlap(a: &Rect, b: &Rect) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// The places around a point, the wanted one first: on its side, on the other one, above and below,
/// and farther away.
pub(super) fn around([x, y]: [f64; 2], wanted: Anchor) -> Vec<Place> {
    let beside = |anchor: Anchor, dy: f64| match anchor {
        Anchor::Start => ([x + 8.0, y + dy], anchor),
        Anchor::Middle => ([x, y + if dy < 0.0 { dy - 1.0 } else { dy + 2.0 }], anchor),
        Anchor::End => ([x - 8.0, y + dy], anchor),
    };
    let order = match wanted {
        Anchor::Start => [Anchor::Start, Anchor::End, Anchor::Middle],
        Anchor::Middle => [Anchor::Middle, Anchor::Start, Anchor::End],
        Anchor::End => [Anchor::End, Anchor::Start, Anchor::Middle],
    };
    let heights = [[-6.0, 16.0], [-23.0, 33.0], [-40.0, 50.0], [-57.0, 67.0]];
    let places = heights.into_iter().flat_map(|heights| {
        let of = move |anchor| heights.map(|dy| beside(anchor, dy));
        order.into_iter().flat_map(of)
    });
    places.collect()
}

/// The places above a row, the nearest first.
pub(super) fn above_row([x, y]: [f64; 2]) -> Vec<Place> {
    let steps = (0..10).flat_map(|step| [-12.0, 12.0].map(|dx| dx * f64::from(step)));
    let places = steps.map(|dx| ([x + dx, y - 7.0], Anchor::Middle));
    places.collect()
}

/// A number with at most six digits that count.
pub(super) fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    let is_plain = rounded == 0.0 || (1e-3..1e6).contains(&rounded.abs());
    let text = match is_plain {
        true => format!("{rounded}"),
        false => format!("{rounded:e}"),
    };
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_at_most_six_digits_that_count() {
        let ordinary = [1.0000000000000009, -0.25, 2.0 / 3.0, 0.0].map(short);
        assert_eq!(ordinary, ["1", "−0.25", "0.666667", "0"]);
        let others = [1234567.0, 1e300, 2.0_f64.powi(-10)].map(short);
        assert_eq!(others, ["1.23457e6", "1e300", "9.76562e−4"]);
    }

    #[test]
    fn words_of_one_point_stay_apart_and_inside() {
        let inside = [0.0, 0.0, 428.0, 238.0];
        let mut words = Words::new(inside);
        words.avoid([420.0, 120.0], 7.0);
        let places = around([420.0, 120.0], Anchor::Start);
        let placed: Vec<Rect> = (0..6)
            .filter_map(|_| words.place("your normal", &places))
            .map(|place| rect("your normal", place))
            .collect();
        assert_eq!(placed.len(), 6);
        for (i, one) in placed.iter().enumerate() {
            assert!(one[0] >= 0.0 && one[2] <= 428.0, "{one:?}");
            assert!(!placed[..i].iter().any(|other| overlap(one, other)));
        }
        // No place above the drawing: nothing is written there.
        assert_eq!(words.place("up", &above_row([9.0, 9.0])), None);
    }
}
