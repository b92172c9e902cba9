//! Judges the positions of samples in a pixel.

use crate::plural;
use crate::tools::aspects::independence::PixelSamples;
use crate::tools::findings::{Aspect, Class, Findings};
use std::collections::HashSet;
use wire::adaptive::{AdaptiveAnswer, AdaptivePixel};

/// How far a point may be outside its pixel, in pixels.
const PLACE_BOUND: f64 = 1e-9;

/// Computes the position of a film point in the pixel at column `at` of a film of width `size`; 0
/// to 1 is inside. The same for rows and heights.
type Place = fn(point: f64, at: f64, size: f64) -> f64;

fn right(point: f64, at: f64, size: f64) -> f64 {
    point * size - at
}

/// The positions that common mistakes compute.
const KNOWN_MISTAKES: [(&str, Place); 4] = [
    ("half a pixel off", |point, at, size| {
        point * size - at + 0.5
    }),
    ("over the size less one", |point, at, size| {
        point * (size - 1.0).max(1.0) - at
    }),
    ("not divided", |point, at, _| point - at),
    ("a film from the corner on", |point, at, size| {
        point - at / size
    }),
];

/// The positions of all samples in their pixel.
pub(crate) fn samples(work: &AdaptivePixel, answer: &AdaptiveAnswer) -> PixelSamples {
    let [x, y] = work.pixel.map(f64::from);
    let [w, h] = work.film.map(f64::from);
    let points = answer.points.iter();
    PixelSamples {
        pixel: work.pixel,
        seed: work.seed,
        offsets: points
            .map(|point| [right(point[0], x, w), right(point[1], y, h)])
            .collect(),
    }
}

/// Judges that samples lie inside the pixel, at different points.
pub(crate) fn judge(
    findings: &mut Findings,
    call: usize,
    work: &AdaptivePixel,
    answer: &AdaptiveAnswer,
    about: &impl Fn() -> String,
) {
    if answer.points.is_empty() {
        return;
    }
    findings.expect(Aspect::Placement);
    let [x, y] = work.pixel.map(f64::from);
    let [w, h] = work.film.map(f64::from);
    let inside = |place: Place, [x, y]: [f64; 2], [w, h]: [f64; 2]| {
        let inside = |place: f64| (-PLACE_BOUND..=1.0 + PLACE_BOUND).contains(&place);
        let each = answer.points.iter();
        each.filter(|point| inside(place(point[0], x, w)) && inside(place(point[1], y, h)))
            .count()
    };
    let all = answer.points.len();
    let outside = all - inside(right, [x, y], [w, h]);
    let class = (outside > 0).then(|| {
        let mut known_mistakes = KNOWN_MISTAKES.iter();
        if inside(right, [x, y], [h, w]) == all {
            Class::Named("sizes swapped")
        } else if inside(right, [x, h - 1.0 - y], [w, h]) == all {
            Class::Named("rows from the top")
        } else if let Some((name, _)) =
            known_mistakes.find(|(_, place)| inside(*place, [x, y], [w, h]) == all)
        {
            Class::Named(name)
        } else {
            Class::of_size(outside as f64)
        }
    });
    let badness = outside as f64;
    findings.judge_class(Aspect::Placement, call, class, badness, || {
        format!(
            "{outside} of {} outside the pixel. {}",
            plural(all, "point lies", "points lie"),
            about()
        )
    });
    let different: HashSet<_> = answer.points.iter().map(|p| p.map(f64::to_bits)).collect();
    let different = different.len();
    findings.judge(Aspect::Placement, call, different == all, 1e3, || {
        let places = plural(different, "place", "places");
        format!("the {all} points are at only {places}. {}", about())
    });
}
