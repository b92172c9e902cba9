//! A golden picture and what takes its place, pixel by pixel.

use super::box_tests::BoxTests;
use super::cause::Cause;
use super::columns::{Column, columns};
use super::exact;
use image::{Rgb, RgbImage};
use judge::cases::Spec;
use judge::snapshot::{Fields, Snapshot};

/// The pictures of a case.
#[derive(Clone, Debug)]
pub struct Picture {
    /// As students are graded against.
    pub golden: RgbImage,
    /// As the code under review makes it.
    pub actual: RgbImage,
    /// What is known of each pixel; `None` if the two differ in size.
    pub pixels: Option<Pixels>,
}

/// What is known of the pixels. Call number `i` is the pixel in column `i % width` and row `i / width` from the bottom.
#[derive(Clone, Debug)]
pub struct Pixels {
    /// Why each differs.
    pub causes: Vec<Cause>,
    /// The actual picture in grey, coloured where it differs.
    pub difference: RgbImage,
    /// What was asked.
    pub question: Vec<Column>,
    /// What the golden snapshot says: of most pixels `t` and the primitive alone.
    pub golden: Vec<Column>,
    /// What the code under review answered.
    pub actual: Vec<Column>,
    /// What the exact oracle answers.
    pub exact: Option<Exact>,
    /// The boxes that were asked for.
    pub boxes: Option<BoxTests>,
}

/// What is right where golden and actual differ.
#[derive(Clone, Debug)]
pub struct Exact {
    /// The calls, in order.
    pub calls: Vec<u32>,
    /// A record for each.
    pub records: Vec<Column>,
}

/// How much of a pixel's light is left in grey, so that colours stand out.
const DIMMED: f64 = 0.5;

impl Pixels {
    /// Compares pixel by pixel. `golden` and `actual` are snapshots as they are stored, `full` is `actual` with every
    /// line in full; the pictures have a pixel for each line.
    pub fn of(
        spec: &Spec,
        golden: (&Snapshot, &RgbImage),
        actual: (&Snapshot, &RgbImage),
        full: &Snapshot,
        boxes: Option<BoxTests>,
    ) -> Pixels {
        let colours = from_the_bottom(golden.1).zip(from_the_bottom(actual.1));
        let lines = golden.0.lines.iter().zip(&actual.0.lines);
        let causes: Vec<Cause> = lines
            .zip(colours)
            .map(|((golden, actual), (old, new))| Cause::of(golden, actual, old == new))
            .collect();
        let calls: Vec<u32> = (0..)
            .zip(&causes)
            .filter_map(|(call, cause)| (*cause != Cause::Same).then_some(call))
            .collect();
        let exact = exact::records(spec, &calls).map(|records| Exact {
            records: columns(&records.iter().collect::<Vec<_>>()),
            calls,
        });
        let answers = |snapshot: &Snapshot| {
            let answers: Vec<&Fields> = snapshot.lines.iter().map(|line| &line.answer).collect();
            columns(&answers)
        };
        let questions: Vec<&Fields> = full.lines.iter().map(|line| &line.question).collect();
        Pixels {
            difference: difference(actual.1, &causes),
            causes,
            question: columns(&questions),
            golden: answers(golden.0),
            actual: answers(full),
            exact,
            boxes,
        }
    }

    /// How many pixels differ for each cause that there is.
    pub fn counts(&self) -> Vec<(Cause, usize)> {
        let count = |cause| self.causes.iter().filter(|c| **c == cause).count();
        let counts = Cause::DIFFERENCES.map(|cause| (cause, count(cause)));
        counts.into_iter().filter(|(_, count)| *count > 0).collect()
    }
}

/// The pixels in the order of calls: row by row from the bottom left.
fn from_the_bottom(picture: &RgbImage) -> impl Iterator<Item = &Rgb<u8>> {
    let (w, h) = picture.dimensions();
    (0..h)
        .rev()
        .flat_map(move |y| (0..w).map(move |x| picture.get_pixel(x, y)))
}

fn difference(actual: &RgbImage, causes: &[Cause]) -> RgbImage {
    let (w, h) = actual.dimensions();
    RgbImage::from_fn(w, h, |x, y| {
        let cause = causes[((h - 1 - y) * w + x) as usize];
        if cause != Cause::Same {
            return cause.colour();
        }
        let [r, g, b] = actual.get_pixel(x, y).0.map(f64::from);
        // Luma (Rec. 709).
        let grey = (DIMMED * (0.2126 * r + 0.7152 * g + 0.0722 * b)) as u8;
        Rgb([grey; 3])
    })
}
