//! Compares the golden and the actual answers of one case.

use super::box_tests;
use super::delta;
use super::exact;
use super::picture::{self, Picture, Pixels};
use crate::bless;
use ::pictures::cause::Cause;
use grader::error::GraderError;
use grader::runner::Worker;
use grader::workspace::Workspace;
use judge::Tier;
use judge::cases::Spec;
use judge::snapshot::{self, Changes, Fields, Line, Snapshot, changes};
use judge::tally::{Aspect, Finding};
use judge::whole::{Counts, Whole, judge_whole};
use pages::picture::{compose, read_png};
use pictures::Image;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use wire::Answer;

/// The comparison of one case.
#[derive(Clone, Debug)]
pub struct Case {
    /// Key of the task.
    pub task: &'static str,
    /// The name of the case, as in `course.toml`.
    pub name: &'static str,
    /// What it checks.
    pub about: &'static str,
    /// The result of the comparison.
    pub state: State,
    /// The first calls that differ.
    pub rows: Vec<Row>,
    /// What the exact oracle finds about the actual answers, judged whole; empty if nothing
    /// differs.
    pub whole: Whole,
    /// The picture that it makes, if it makes one.
    pub picture: Option<Picture>,
}

/// The result of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub enum State {
    /// Nothing differs.
    Same,
    /// Something differs.
    Differs {
        /// The differences.
        changes: Changes,
        /// On how many calls the answers are known to differ.
        calls: usize,
        /// How many pixels have another colour.
        pixels: usize,
        /// How many of the case's actual answers the exact oracle confirms, refuses or does not
        /// judge. All of them count: a row does not show every field of its answer.
        counts: Counts,
        /// What the exact oracle finds wrong about the actual answers.
        wrong: Vec<String>,
        /// What it does not judge.
        not_judged: Vec<String>,
        /// Which answers are nearer to the exact ones.
        nearer: Nearer,
    },
    /// There is no answer, for this reason.
    Silent(String),
}

/// Of the calls that differ and have a golden row: how many actual answers are nearer to the exact
/// oracle's than the golden ones, and how many are farther. Those that it does not know, and those
/// that are equally far, count as neither.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nearer {
    /// Nearer to the truth than the golden.
    pub nearer: usize,
    /// Farther from it.
    pub farther: usize,
}

/// A call whose answers differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Number of the call.
    pub call: u32,
    /// Why they differ.
    pub cause: Cause,
    /// The golden answer; `None` if the golden has no row for the call and its picture does not
    /// show a miss.
    pub golden: Option<Line>,
    /// The answer of the code under review, as much of it as the golden has.
    pub actual: Option<Line>,
    /// Whether the golden is a hit, where only its colour is known.
    pub golden_hits: Option<bool>,
    /// The exact oracle's answer, if it knows this kind of work.
    pub exact: Option<Line>,
    /// The fields of the question, as text.
    pub question: String,
}

/// The largest number of calls in [`Case::rows`].
pub const ROWS: usize = 40;

impl Case {
    /// A case without an answer.
    pub fn silent(spec: &Spec, why: impl Into<String>) -> Case {
        Case {
            task: spec.task,
            name: spec.name,
            about: spec.about,
            state: State::Silent(why.into()),
            rows: Vec::new(),
            whole: Whole::default(),
            picture: None,
        }
    }

    /// Compares `answer` with the golden. The oracle judges it at `tier`. `together` is the
    /// worker that returns the box tests.
    pub fn of(
        workspace: &Workspace,
        spec: &Spec,
        tier: Tier,
        answer: &Answer,
        together: &Result<Worker, String>,
    ) -> Result<Case, GraderError> {
        let golden = bless::golden_snapshot(workspace, spec.task, spec.name)?;
        let stored = snapshot::write(&spec.work, answer).map(|text| snapshot::parse(&text));
        let (Some(Ok(actual)), Some(full)) = (stored, snapshot::full(&spec.work, answer)) else {
            return Ok(Case::silent(spec, "its answers make no snapshot"));
        };
        let changes = changes(&golden, &actual);
        let pictures = pictures(workspace, spec, answer)?;
        let pixels = pictures.as_ref().map_or(0, recoloured);
        let differs = !changes.is_empty() || pixels > 0;
        let whole = match differs {
            true => judge_whole(spec, tier, answer),
            false => Whole::default(),
        };
        let snapshots = [&golden, &actual, &full];
        let mut case = Case {
            task: spec.task,
            name: spec.name,
            about: spec.about,
            state: State::Same,
            rows: Vec::new(),
            whole: Whole::default(),
            picture: None,
        };
        if !differs {
            return Ok(case);
        }
        case.picture = match pictures {
            None => None,
            Some(pictures) => Some(picture(
                spec,
                snapshots,
                pictures,
                whole.wrong_calls(),
                answer,
                together,
            )?),
        };
        let pixels_of = case
            .picture
            .as_ref()
            .and_then(|picture| picture.pixels.as_ref());
        let calls = differing(snapshots, &changes, pixels_of, whole.wrong_calls());
        let calls: Vec<u32> = calls.into_iter().collect();
        let first = &calls[..calls.len().min(ROWS)];
        let hits = pixels_of.and_then(|pixels| pixels.golden_hits.as_deref());
        let causes = pixels_of.map(|pixels| pixels.causes.as_slice());
        case.rows = rows(spec, snapshots, hits, causes, first);
        case.state = State::Differs {
            nearer: nearer(spec, &golden, &full, &changes.differing),
            changes,
            calls: calls.len(),
            pixels,
            counts: whole.count(0..full.calls as u32),
            wrong: whole.wrong.iter().map(Finding::to_string).collect(),
            not_judged: whole.not_judged_sentences(),
        };
        case.whole = whole;
        Ok(case)
    }

    /// The comparison of the picture of a task.
    pub fn of_task_picture(task: &'static str, golden: Image, actual: Image) -> Case {
        let pixels = recoloured(&[golden.clone(), actual.clone()]);
        let state = match pixels {
            0 => State::Same,
            pixels => State::Differs {
                changes: Changes::default(),
                calls: 0,
                pixels,
                counts: Counts::default(),
                wrong: Vec::new(),
                not_judged: vec!["the picture: look at it yourself".into()],
                nearer: Nearer::default(),
            },
        };
        Case {
            task,
            name: judge::pictures::NAME,
            about: "The picture of the task, as students see it beside theirs.",
            picture: (pixels > 0).then_some(Picture {
                golden,
                actual,
                pixels: None,
            }),
            state,
            rows: Vec::new(),
            whole: Whole::default(),
        }
    }

    /// The path of the case on the page and below `golden/`.
    pub fn path(&self) -> String {
        format!("{}/{}", self.task, self.name)
    }
}

/// The golden picture and the one that `answer` makes; `None` for a case without pictures.
fn pictures(
    workspace: &Workspace,
    spec: &Spec,
    answer: &Answer,
) -> Result<Option<[Image; 2]>, GraderError> {
    let Some(actual) = spec
        .picture
        .and_then(|size| compose(size, &spec.work, answer))
    else {
        return Ok(None);
    };
    let golden = read_png(&workspace.golden_picture(spec.task, spec.name))?;
    Ok(Some([golden, actual]))
}

/// The number of pixels with different colours; all if the sizes differ.
fn recoloured([golden, actual]: &[Image; 2]) -> usize {
    if golden.size() != actual.size() {
        return actual.pixels().len();
    }
    let pairs = golden.pixels().iter().zip(actual.pixels());
    pairs.filter(|(golden, actual)| golden != actual).count()
}

fn picture(
    spec: &Spec,
    [golden, actual, full]: [&Snapshot; 3],
    [old, new]: [Image; 2],
    wrong: &BTreeMap<u32, Vec<Aspect>>,
    answer: &Answer,
    together: &Result<Worker, String>,
) -> Result<Picture, GraderError> {
    let comparable = old.size() == new.size()
        && [golden, actual].map(|snapshot| snapshot.calls) == [old.pixels().len(); 2];
    let pixels = if comparable {
        let pictures = [(golden, &old), (actual, &new)];
        let (causes, golden_hits) = picture::causes(spec, pictures[0], pictures[1], full, wrong);
        let differ = (0..)
            .zip(&causes)
            .filter(|(_, cause)| **cause != Cause::Same);
        let differ: Vec<u32> = differ.map(|(call, _)| call).collect();
        let calls = picture::spread(&differ, picture::RECORDS);
        let snapshots = [golden, actual, full];
        let rows = rows(
            spec,
            snapshots,
            golden_hits.as_deref(),
            Some(&causes),
            &calls,
        );
        let hits: Vec<Option<f64>> = rows.iter().map(Row::expected_t).collect();
        Some(Pixels {
            difference: picture::difference(&new, &causes),
            boxes: box_tests::of_case(spec, answer, together, &calls, &hits)?,
            corners: picture::corners(new.size(), full),
            causes,
            golden_hits,
            rows,
        })
    } else {
        None
    };
    Ok(Picture {
        golden: old,
        actual: new,
        pixels,
    })
}

impl Row {
    /// The `t` of the golden hit, or of the exact one where the golden's is not known.
    fn expected_t(&self) -> Option<f64> {
        let known = self.golden.as_ref().or(self.exact.as_ref());
        known.and_then(|line| line.number("t"))
    }
}

/// Which of the `differing` answers are nearer to the truth.
fn nearer(spec: &Spec, golden: &Snapshot, full: &Snapshot, differing: &[u32]) -> Nearer {
    let mut counts = Nearer::default();
    let Some(exact) = exact::records(spec, differing) else {
        return counts;
    };
    for (call, exact) in differing.iter().zip(&exact) {
        let (Some(old), Some(new)) = (golden.row(*call), full.row(*call)) else {
            continue;
        };
        match delta::nearer(old, new, exact) {
            Some(Ordering::Less) => counts.farther += 1,
            Some(Ordering::Greater) => counts.nearer += 1,
            _ => {}
        }
    }
    counts
}

/// The calls that are known to differ: those whose rows differ. If the golden does not have all
/// rows, also those whose pixels differ or, without a picture, that are wrong.
fn differing(
    [golden, actual, _]: [&Snapshot; 3],
    changes: &Changes,
    pixels: Option<&Pixels>,
    wrong: &BTreeMap<u32, Vec<Aspect>>,
) -> BTreeSet<u32> {
    let mut calls: BTreeSet<u32> = changes.differing.iter().copied().collect();
    if golden.is_whole() {
        let [short, long] = [
            golden.calls.min(actual.calls),
            golden.calls.max(actual.calls),
        ];
        calls.extend((short as u32)..(long as u32));
        return calls;
    }
    match pixels {
        Some(pixels) => {
            let causes = (0..).zip(&pixels.causes);
            let differ = causes.filter(|(_, cause)| **cause != Cause::Same);
            calls.extend(differ.map(|(call, _)| call));
        }
        None => calls.extend(wrong.keys()),
    }
    calls
}

/// The golden, actual and exact answers of `calls`. `hits` says of each call whether the golden
/// picture shows a hit, `causes` why its pixel differs.
fn rows(
    spec: &Spec,
    [golden, actual, full]: [&Snapshot; 3],
    hits: Option<&[bool]>,
    causes: Option<&[Cause]>,
    calls: &[u32],
) -> Vec<Row> {
    let is_known = |call: &u32| (*call as usize) < full.calls;
    let known: Vec<u32> = calls.iter().copied().filter(is_known).collect();
    let exact = exact::records(spec, &known).unwrap_or_default();
    let exact: BTreeMap<u32, Fields> = known.into_iter().zip(exact).collect();
    let row = |call: u32| {
        let hits = hits.map(|hits| hits[call as usize]);
        let line = |answer: &Fields| Line {
            call,
            answer: answer.clone(),
            ..Line::default()
        };
        let old = golden.row(call).cloned();
        let old = old.or_else(|| (hits == Some(false)).then(|| line(&Fields::new())));
        let new = actual.row(call).or_else(|| full.row(call)).cloned();
        let cause = match (&old, &new) {
            (Some(old), Some(new)) => Cause::of(old, new, true),
            _ => Cause::Value,
        };
        Row {
            call,
            cause: causes.map_or(cause, |causes| causes[call as usize]),
            question: full
                .row(call)
                .or(old.as_ref())
                .map(Line::asked)
                .unwrap_or_default(),
            exact: exact.get(&call).map(line),
            golden_hits: hits.filter(|_| old.is_none()),
            golden: old,
            actual: new,
        }
    };
    calls.iter().map(|call| row(*call)).collect()
}
