//! Compares a golden picture with the actual one, pixel by pixel.

use super::box_tests::BoxTests;
use super::cause::Cause;
use super::columns::{Column, columns};
use super::exact;
use judge::cases::Spec;
use judge::snapshot::{Fields, Line, Snapshot};
use judge::tally::Aspect;
use pictures::image::Rgb;
use pictures::{Image, palette};
use std::collections::BTreeMap;
use wire::Work;

/// The pictures of a case.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The picture that students are graded against.
    pub golden: Image,
    /// The picture of the code under review.
    pub actual: Image,
    /// The data of the pixels; `None` if the two pictures differ in size.
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
    /// The fields of the questions.
    pub question: Vec<Column>,
    /// The golden's answers, as far as they are known.
    pub golden: GoldenAnswers,
    /// The answers of the code under review.
    pub actual: Vec<Column>,
    /// The answers of the exact oracle.
    pub exact: Option<Exact>,
    /// The boxes that were tested.
    pub boxes: Option<BoxTests>,
}

/// The golden's answers, as far as they are known. If the hash shows that they equal the actual
/// answers, those of all calls; otherwise the rows of the golden snapshot, most of which have only
/// `t` and the primitive.
#[derive(Clone, Debug)]
pub struct GoldenAnswers {
    /// The calls with a record, in order; `None` if all have one.
    pub calls: Option<Vec<u32>>,
    /// A record for each of those.
    pub records: Vec<Column>,
    /// Whether each call hits something, by its colour in the golden picture; `None` where
    /// colours do not show it.
    pub hits: Option<Vec<bool>>,
}

/// The exact oracle's answers where golden and actual differ, and where the golden's answer is not
/// known.
#[derive(Clone, Debug)]
pub struct Exact {
    /// The calls, in order.
    pub calls: Vec<u32>,
    /// A record for each.
    pub records: Vec<Column>,
}

impl Pixels {
    /// Compares pixel by pixel. `golden` and `actual` are snapshots as they are stored, `full` is
    /// `actual` with a row for every call, in full; the pictures have a pixel for each call.
    /// `wrong` is what the exact oracle finds wrong.
    pub fn of(
        spec: &Spec,
        golden: (&Snapshot, &Image),
        actual: (&Snapshot, &Image),
        full: &Snapshot,
        wrong: &BTreeMap<u32, Vec<Aspect>>,
        boxes: Option<BoxTests>,
    ) -> Pixels {
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
        let causes: Vec<Cause> = full
            .lines
            .iter()
            .zip(colours)
            .map(|(line, (old, new))| cause(line, old == new))
            .collect();
        let unknown = |call: u32| !same_answers && golden.0.row(call).is_none();
        let calls: Vec<u32> = (0..)
            .zip(&causes)
            .filter(|(call, cause)| **cause != Cause::Same || unknown(*call))
            .map(|(call, _)| call)
            .collect();
        let exact = exact::records(spec, &calls).map(|records| Exact {
            records: columns(&records.iter().collect::<Vec<_>>()),
            calls,
        });
        let known = if same_answers { full } else { golden.0 };
        let calls = known.lines.iter().map(|line| line.call);
        let questions: Vec<&Fields> = full.lines.iter().map(|line| &line.question).collect();
        Pixels {
            difference: difference(actual.1, &causes),
            causes,
            question: columns(&questions),
            golden: GoldenAnswers {
                calls: (!known.is_whole()).then(|| calls.collect()),
                records: answers(known),
                hits: golden_hits,
            },
            actual: answers(full),
            exact,
            boxes,
        }
    }

    /// The number of pixels for each cause that occurs.
    pub fn counts(&self) -> Vec<(Cause, usize)> {
        let count = |cause| self.causes.iter().filter(|c| **c == cause).count();
        let counts = Cause::DIFFERENCES.map(|cause| (cause, count(cause)));
        counts.into_iter().filter(|(_, count)| *count > 0).collect()
    }
}

fn answers(snapshot: &Snapshot) -> Vec<Column> {
    let answers: Vec<&Fields> = snapshot.lines.iter().map(|line| &line.answer).collect();
    columns(&answers)
}

/// Whether black is the colour of a miss, and of nothing else: no unit normal is black, and no box
/// near the camera.
fn misses_are_black(work: &Work) -> bool {
    match work {
        Work::Boxes(_) | Work::BruteForce(_) => true,
        Work::SceneHits(work) => !work.any_hit,
        _ => false,
    }
}

/// The pixels in the order of calls: row by row from the bottom left.
fn from_the_bottom(picture: &Image) -> impl Iterator<Item = Rgb> {
    let [w, h] = picture.size();
    (0..h)
        .rev()
        .flat_map(move |y| (0..w).map(move |x| picture.get(x, y)))
}

fn difference(actual: &Image, causes: &[Cause]) -> Image {
    let [w, h] = actual.size();
    Image::from_fn([w, h], |x, y| {
        match causes[((h - 1 - y) * w + x) as usize] {
            Cause::Same => palette::dimmed(actual.get(x, y)),
            cause => cause.colour(),
        }
    })
}
