//! What changed in one case.

use super::box_tests;
use super::cause::Cause;
use super::picture::{Picture, Pixels};
use crate::bless;
use grader::error::GraderError;
use grader::runner::Worker;
use grader::workspace::Workspace;
use judge;
use judge::Tier;
use judge::cases::Spec;
use judge::snapshot::{self, Changes, Line, Snapshot, changes};
use judge::tally::Finding;
use pages::picture::{compose, read_png};
use std::collections::BTreeMap;
use wire::Answer;

/// One case, golden against actual.
#[derive(Clone, Debug)]
pub struct Case {
    /// Key of the task.
    pub task: &'static str,
    /// As in `course.toml`.
    pub name: &'static str,
    /// What it checks.
    pub about: &'static str,
    /// How golden and actual compare.
    pub state: State,
    /// The first calls that differ.
    pub rows: Vec<Row>,
    /// What the exact oracle finds wrong about actual answers, call by call.
    pub wrong: BTreeMap<u32, Vec<&'static str>>,
    /// The picture that it makes, if it makes one.
    pub picture: Option<Picture>,
}

/// How golden and actual compare.
#[derive(Clone, Debug, PartialEq)]
pub enum State {
    /// Nothing differs.
    Same,
    /// Something differs.
    Differs {
        /// What.
        changes: Changes,
        /// How many pixels have another colour.
        pixels: usize,
        /// What the exact oracle finds wrong about the actual answers; none if it confirms them all.
        wrong: Vec<String>,
    },
    /// There is no answer: why.
    Silent(String),
}

/// A call whose answers differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Number of the call.
    pub call: u32,
    /// Why they differ.
    pub cause: Cause,
    /// The golden answer; none if the golden is shorter.
    pub golden: Option<Line>,
    /// The answer of the code under review, as much of it as the golden says.
    pub actual: Option<Line>,
    /// What was asked.
    pub question: String,
}

/// How many rows of a case are shown.
pub const ROWS: usize = 100;

impl Case {
    /// A case without an answer.
    pub fn silent(spec: &Spec, why: impl Into<String>) -> Case {
        Case {
            task: spec.task,
            name: spec.name,
            about: spec.about,
            state: State::Silent(why.into()),
            rows: Vec::new(),
            wrong: BTreeMap::new(),
            picture: None,
        }
    }

    /// Compares `answer` with the golden. `tier` says what the oracle asks of it, `together` is asked for the boxes.
    pub fn of(
        workspace: &Workspace,
        spec: &Spec,
        tier: Tier,
        answer: &Answer,
        together: &Result<Worker, String>,
    ) -> Result<Case, GraderError> {
        let path = workspace.snapshot(spec.task, spec.name);
        let golden = bless::snapshot(&path)?;
        let stored = snapshot::write(&spec.work, answer).map(|text| snapshot::parse(&text));
        let (Some(Ok(actual)), Some(full)) = (stored, snapshot::full(&spec.work, answer)) else {
            return Ok(Case::silent(spec, "its answers make no snapshot"));
        };
        let changes = changes(&golden, &actual);
        let picture = picture(workspace, spec, [&golden, &actual, &full], answer, together)?;
        let pixels = picture.as_ref().map_or(0, Picture::recoloured);
        let mut case = Case {
            task: spec.task,
            name: spec.name,
            about: spec.about,
            state: State::Same,
            rows: Vec::new(),
            wrong: BTreeMap::new(),
            picture,
        };
        if !changes.is_empty() || pixels > 0 {
            let mut findings = judge::judge(spec, tier, answer);
            findings.retain(|finding| !finding.passed());
            case.rows = rows(&golden, &actual, &full);
            case.wrong = wrong(&findings);
            case.state = State::Differs {
                changes,
                pixels,
                wrong: findings.iter().map(Finding::to_string).collect(),
            };
        }
        Ok(case)
    }

    /// Where it is found on the page, and in `golden/`.
    pub fn path(&self) -> String {
        format!("{}/{}", self.task, self.name)
    }
}

impl Picture {
    /// How many pixels have another colour; all if the sizes differ.
    fn recoloured(&self) -> usize {
        if self.golden.dimensions() != self.actual.dimensions() {
            return self.actual.pixels().len();
        }
        let pairs = self.golden.pixels().zip(self.actual.pixels());
        pairs.filter(|(golden, actual)| golden != actual).count()
    }
}

fn picture(
    workspace: &Workspace,
    spec: &Spec,
    [golden, actual, full]: [&Snapshot; 3],
    answer: &Answer,
    together: &Result<Worker, String>,
) -> Result<Option<Picture>, GraderError> {
    let Some(size) = spec.picture else {
        return Ok(None);
    };
    let Some(new) = compose(size, &spec.work, answer) else {
        return Ok(None);
    };
    let old = read_png(&workspace.golden_picture(spec.task, spec.name))?;
    let comparable = old.dimensions() == new.dimensions()
        && [golden, actual].map(|s| s.lines.len()) == [old.pixels().len(); 2];
    let pixels = if comparable {
        let boxes = box_tests::of_case(spec, answer, together)?;
        Some(Pixels::of(
            spec,
            (golden, &old),
            (actual, &new),
            full,
            boxes,
        ))
    } else {
        None
    };
    Ok(Some(Picture {
        golden: old,
        actual: new,
        pixels,
    }))
}

/// What is wrong, call by call.
fn wrong(findings: &[Finding]) -> BTreeMap<u32, Vec<&'static str>> {
    let mut wrong: BTreeMap<u32, Vec<&'static str>> = BTreeMap::new();
    for finding in findings {
        for fault in &finding.faults {
            let aspects = wrong.entry(fault.call).or_default();
            if !aspects.contains(&finding.aspect.label()) {
                aspects.push(finding.aspect.label());
            }
        }
    }
    wrong
}

/// The first calls that differ.
fn rows(golden: &Snapshot, actual: &Snapshot, full: &Snapshot) -> Vec<Row> {
    let calls = 0..golden.lines.len().max(actual.lines.len());
    let differing = calls.filter(|&i| golden.lines.get(i) != actual.lines.get(i));
    let row = |i: usize| {
        let [old, new] = [golden, actual].map(|snapshot| snapshot.lines.get(i).cloned());
        let call = u32::try_from(i).unwrap_or(u32::MAX);
        let asked = full.lines.get(i).or(old.as_ref());
        Row {
            call,
            cause: match (&old, &new) {
                (Some(old), Some(new)) => Cause::of(old, new, true),
                _ => Cause::Value,
            },
            question: asked.map(Line::asked).unwrap_or_default(),
            golden: old,
            actual: new,
        }
    };
    differing.take(ROWS).map(row).collect()
}
