//! Compares the golden and the actual answers of one case.

use super::box_tests;
use super::calls::{Nearer, Row, differing, nearer, rows};
use super::picture::{self, Picture, Pixels};
use ::pictures::cause::{Cause, difference};
use base::{GraderError, Workspace};
use grader::course::packed;
use grader::workers::runner::Worker;
use judge::Tier;
use judge::cases::Spec;
use judge::findings::{Aspect, Finding};
use judge::snapshot::{self, Changes, Snapshot, changes};
use judge::whole::{Counts, Whole, judge_whole};
use pages::picture::{compose, read_png};
use pictures::Image;
use std::collections::BTreeMap;
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
        changes: Box<Changes>,
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
        let golden = golden_snapshot(workspace, spec.task, spec.name)?;
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
        let calls: Vec<u32> = differing(snapshots, &changes, pixels_of, whole.wrong_calls())
            .into_iter()
            .collect();
        let first = &calls[..calls.len().min(ROWS)];
        let hits = pixels_of.and_then(|pixels| pixels.golden_hits.as_deref());
        let causes = pixels_of.map(|pixels| pixels.causes.as_slice());
        case.rows = rows(spec, snapshots, hits, causes, first);
        case.state = State::Differs {
            nearer: nearer(spec, &golden, &full, &changes.differing),
            changes: Box::new(changes),
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
                changes: Box::default(),
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

/// Reads the golden snapshot of a case.
pub fn golden_snapshot(
    workspace: &Workspace,
    task: &str,
    case: &str,
) -> Result<Snapshot, GraderError> {
    let path = workspace.snapshot(task, case);
    let text = packed::read_snapshot(workspace, task, case)?
        .ok_or_else(|| GraderError::file("read", &path, "it does not exist"))?;
    snapshot::parse(&text).map_err(|e| GraderError::file("understand", &path, e))
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
            difference: difference(&new, &causes),
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
