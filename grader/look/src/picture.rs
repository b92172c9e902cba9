//! Compares a golden picture with the actual one, pixel by pixel.

use super::box_tests::BoxTests;
use super::calls::Row;
use ::pictures::cause::{self, Cause};
use ::pictures::tone::misses_are_black;
use judge::cases::Spec;
use judge::findings::Aspect;
use judge::snapshot::{Line, Snapshot};
use pictures::Image;
use pictures::image::Rgb;
use std::collections::BTreeMap;

/// The pictures of a case or of a task.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The picture that students are graded against.
    pub golden: Image,
    /// The picture of the code under review.
    pub actual: Image,
    /// The data of the pixels; `None` if the two pictures differ in size, or if a pixel is not the
    /// answer to one call.
    pub pixels: Option<Pixels>,
}

/// The data of the pixels. Call number `i` is the pixel in column `i % width` and row `i /
/// width` from the bottom.
#[derive(Clone, Debug)]
pub struct Pixels {
    /// Why each pixel differs.
    pub causes: Vec<Cause>,
    /// The actual picture in grey, coloured where it differs.
    pub difference: Image,
    /// Whether each call hits something, by its colour in the golden picture; `None` where
    /// colours do not show it.
    pub golden_hits: Option<Vec<bool>>,
    /// The records of pixels that differ: of all, or of at most [`RECORDS`], evenly spread.
    pub rows: Vec<Row>,
    /// The boxes that are tested in the calls of `rows`.
    pub boxes: Option<BoxTests>,
    /// The rays of the four corner pixels, row by row from the bottom left, if the question has
    /// rays: origins and directions.
    pub corners: Option<[[Vec<f64>; 2]; 4]>,
}

/// The largest number of pixels of a picture that have records. With more, a page with a few
/// pictures would have more than a megabyte.
pub const RECORDS: usize = 250;

/// Why each pixel differs, and what its colour says about the golden: [`Pixels::causes`] and
/// [`Pixels::golden_hits`]. `golden` and `actual` are snapshots as they are stored, `full` is
/// `actual` with a row for every call, in full; the pictures have a pixel for each call. `wrong` is
/// what the exact oracle finds wrong.
pub fn causes(
    spec: &Spec,
    golden: (&Snapshot, &Image),
    actual: (&Snapshot, &Image),
    full: &Snapshot,
    wrong: &BTreeMap<u32, Vec<Aspect>>,
) -> (Vec<Cause>, Option<Vec<bool>>) {
    let colours = from_the_bottom(golden.1).zip(from_the_bottom(actual.1));
    let same_answers = golden.0.hash == full.hash;
    let golden_hits: Option<Vec<bool>> = misses_are_black(&spec.work).then(|| {
        let colours = from_the_bottom(golden.1);
        colours.map(|colour| colour != [0; 3]).collect()
    });
    let cause = |line: &Line, same_colour: bool| {
        let call = line.call;
        let rows = golden.0.row(call).zip(actual.0.row(call));
        match rows.or(same_answers.then_some((line, line))) {
            Some((golden, actual)) => Cause::of(golden, actual, same_colour),
            None => {
                let hits = golden_hits.as_ref().map(|hits| hits[call as usize]);
                let wrong = wrong.get(&call).map_or(&[][..], Vec::as_slice);
                Cause::without_row(hits, line, wrong, same_colour)
            }
        }
    };
    let each = full.lines.iter().zip(colours);
    let causes = each.map(|(line, (old, new))| cause(line, old == new));
    (causes.collect(), golden_hits)
}

/// At most `count` of `calls`, evenly spread.
pub fn spread(calls: &[u32], count: usize) -> Vec<u32> {
    let stride = calls.len().div_ceil(count.max(1)).max(1);
    calls.iter().copied().step_by(stride).collect()
}

/// The rays of the corner pixels of a picture of this size.
pub fn corners([w, h]: [u32; 2], full: &Snapshot) -> Option<[[Vec<f64>; 2]; 4]> {
    let ray = |x: u32, y: u32| {
        let line = full.row(y * w + x)?;
        let field = |name: &str| {
            let mut fields = line.question.iter();
            fields
                .find(|(field, _)| field == name)
                .map(|(_, value)| value.numbers())
        };
        Some([field("o")?, field("d")?])
    };
    let (right, top) = (w.checked_sub(1)?, h.checked_sub(1)?);
    Some([ray(0, 0)?, ray(right, 0)?, ray(0, top)?, ray(right, top)?])
}

impl Pixels {
    /// The number of pixels for each cause that occurs.
    pub fn counts(&self) -> Vec<(Cause, usize)> {
        cause::counts(&self.causes)
    }
}

/// The pixels in the order of calls: row by row from the bottom left.
fn from_the_bottom(picture: &Image) -> impl Iterator<Item = Rgb> {
    let [w, h] = picture.size();
    (0..h)
        .rev()
        .flat_map(move |y| (0..w).map(move |x| picture.get(x, y)))
}
