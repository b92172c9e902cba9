//! What blessing would change.

use super::{meaning, not_judged_list, read};
use base::{GraderError, Workspace};
use grader::course::{Task, packed};
use judge::cases::Spec;
use judge::findings::Finding;
use judge::pictures::{self as task_pictures, TaskPicture};
use judge::snapshot::{self, changes, parse};
use judge::whole::judge_whole;
use judge::{Tier, plural};
use pages::picture::{compose, read_png};
use pictures::{Image, png};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use wire::Answer;

/// The first lines of a snapshot file, as insta writes them.
pub const SNAPSHOT_HEADER: &str = "---\nsource: golden/tests/goldens.rs\n---\n";

/// The largest file of a task's picture, in bytes: a handout contains all of them.
const LARGEST_PICTURE: usize = 60_000;

/// A golden that would change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// The key of the task.
    pub task: String,
    /// The golden.
    pub golden: PathBuf,
    /// Its new content.
    pub content: Vec<u8>,
    /// A description of the change.
    pub meaning: String,
    /// The aspects of the new answers that the oracle does not judge, with the reasons.
    pub not_judged: Vec<String>,
    /// What the new content is.
    pub kind: ChangeKind,
}

/// The kinds of goldens, by what confirms them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChangeKind {
    /// The answers of a case, which the exact oracle judges.
    Answers,
    /// The picture of a task, which nothing judges.
    Picture,
    /// The list of what is not judged.
    List,
}

impl Change {
    /// The file beside the golden in which `cargo insta review` looks for the new content.
    pub fn pending(&self) -> PathBuf {
        let mut name = self.golden.clone().into_os_string();
        name.push(".new");
        name.into()
    }
}

/// What blessing would change, and why it may not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Proposal {
    /// The goldens that would change.
    pub changes: Vec<Change>,
    /// What forbids it: answers that are wrong or missing, as lines.
    pub refused: Vec<String>,
}

/// The lines of a case in the list of what is not judged.
#[derive(Clone, Debug)]
pub struct JudgedCase {
    name: &'static str,
    lines: String,
    is_refused: bool,
}

impl Proposal {
    /// Whether every golden is what the code answers, and none is wrong.
    pub fn is_empty(&self) -> bool {
        self.changes.is_empty() && self.refused.is_empty()
    }

    /// The number of cases whose answers are wrong or missing. A case may have several reasons.
    pub fn refused_cases(&self) -> usize {
        let case = |line: &str| line.split(": ").next().map(str::to_owned);
        let cases = self.refused.iter().map(|line| case(line));
        cases.collect::<BTreeSet<_>>().len()
    }

    /// Adds all of another proposal.
    pub fn append(&mut self, mut other: Proposal) {
        self.changes.append(&mut other.changes);
        self.refused.append(&mut other.refused);
    }

    /// Adds a reason that forbids blessing `task`.
    pub fn refuse(&mut self, task: &str, case: &str, why: &str) {
        self.refused.push(format!("{task}/{case}: {why}"));
    }

    /// Judges `answer` and adds the goldens of the case that differ from it.
    pub fn add_case(
        &mut self,
        workspace: &Workspace,
        spec: &Spec,
        answer: &Answer,
    ) -> Result<JudgedCase, GraderError> {
        let whole = judge_whole(spec, Tier::Robust, answer);
        if whole.is_refused() {
            for finding in &whole.wrong {
                self.refuse(spec.task, spec.name, &refutation(finding));
            }
        }
        let change = |golden: PathBuf, content: Vec<u8>, meaning: String| Change {
            task: spec.task.into(),
            golden,
            content,
            meaning,
            not_judged: whole.not_judged_sentences(),
            kind: ChangeKind::Answers,
        };
        if let Some(text) = snapshot::write(&spec.work, answer) {
            let stored = packed::read_snapshot(workspace, spec.task, spec.name)?;
            let path = workspace.snapshot(spec.task, spec.name);
            let same = stored
                .as_deref()
                .is_some_and(|stored| without_header(stored).trim_end() == text.trim_end());
            if !same {
                let meaning = match &stored {
                    None => "is new".into(),
                    Some(stored) => {
                        let parse = |text: &str| {
                            parse(text).map_err(|e| GraderError::file("understand", &path, e))
                        };
                        changes(&parse(stored)?, &parse(&text)?).to_string()
                    }
                };
                let content = format!("{SNAPSHOT_HEADER}{text}");
                self.changes
                    .push(change(path, content.into_bytes(), meaning));
            }
        }
        if let Some(size) = spec.picture {
            match compose(size, &spec.work, answer) {
                None => self.refuse(spec.task, spec.name, "its answers make no picture"),
                Some(actual) => {
                    let path = workspace.golden_picture(spec.task, spec.name);
                    if let Some(meaning) = picture_change(&path, &actual)? {
                        self.changes
                            .push(change(path, png::encode_smallest(&actual), meaning));
                    }
                }
            }
        }
        Ok(JudgedCase {
            name: spec.name,
            lines: whole.not_judged_lines(spec.name),
            is_refused: whole.is_refused(),
        })
    }

    /// Adds the list of what is not judged, if the lines of the `judged` cases differ. A list of
    /// wrong answers is not proposed. The cases of the task are listed in the order of `specs`.
    pub fn add_not_judged(
        &mut self,
        workspace: &Workspace,
        task: &Task,
        specs: &[Spec],
        judged: &[JudgedCase],
    ) -> Result<(), GraderError> {
        if judged.is_empty() || judged.iter().any(|case| case.is_refused) {
            return Ok(());
        }
        let path = workspace.not_judged(&task.key);
        let stored = match path.is_file() {
            true => read(&path)?,
            false => String::new(),
        };
        let is_listed = |spec: &&Spec| {
            let mut cases = task.cases.iter();
            cases.any(|case| spec.is(&task.key, &case.name))
        };
        let order: Vec<&str> = specs
            .iter()
            .filter(is_listed)
            .map(|spec| spec.name)
            .collect();
        let judged: Vec<(&str, String)> = judged
            .iter()
            .map(|case| (case.name, case.lines.clone()))
            .collect();
        let new = not_judged_list::updated(&stored, &order, &judged);
        if new != stored {
            self.changes.push(Change {
                task: task.key.clone(),
                golden: path,
                meaning: meaning::lines(&stored, &new),
                content: new.into_bytes(),
                not_judged: Vec::new(),
                kind: ChangeKind::List,
            });
        }
        Ok(())
    }

    /// Adds the picture of a task, if it differs.
    pub fn add_picture(
        &mut self,
        workspace: &Workspace,
        kind: &TaskPicture,
        actual: &Image,
    ) -> Result<(), GraderError> {
        let path = workspace.golden_picture(kind.task, task_pictures::NAME);
        let Some(meaning) = picture_change(&path, actual)? else {
            return Ok(());
        };
        let content = png::encode_smallest(actual);
        if content.len() > LARGEST_PICTURE {
            let why = format!(
                "the picture has {} bytes, expected at most {LARGEST_PICTURE}: give its panels fewer steps or more samples",
                content.len()
            );
            self.refuse(kind.task, task_pictures::NAME, &why);
        }
        self.changes.push(Change {
            task: kind.task.into(),
            golden: path,
            content,
            meaning,
            not_judged: Vec::new(),
            kind: ChangeKind::Picture,
        });
        Ok(())
    }
}

/// Why the answers are wrong in an aspect, in a line with three numbers at most: the call to look
/// at says more.
fn refutation(finding: &Finding) -> String {
    let label = finding.aspect.label();
    let of = plural(
        finding.judged.max(finding.expected) as usize,
        "call",
        "calls",
    );
    let what = match (&finding.worst, finding.wrong) {
        _ if finding.aspect.is_of_all_calls() => format!("{label} is wrong"),
        (_, 0) => format!("no answer has {label}"),
        (Some(worst), wrong) => {
            format!(
                "{label} is wrong on {wrong} of {of}, worst in call {}",
                worst.call
            )
        }
        (None, wrong) => format!("{label} is wrong on {wrong} of {of}"),
    };
    format!("the exact oracle refutes it: {what}")
}

/// How `actual` differs from the golden picture; `None` if it does not.
fn picture_change(golden: &Path, actual: &Image) -> Result<Option<String>, GraderError> {
    if !golden.is_file() {
        return Ok(Some("is new".into()));
    }
    let old = read_png(golden)?;
    Ok((old != *actual).then(|| meaning::pixels(&old, actual)))
}

/// The rows of a snapshot file, without the lines that insta writes first.
fn without_header(text: &str) -> &str {
    let after = text
        .strip_prefix("---\n")
        .and_then(|rest| rest.split_once("\n---\n"));
    after.map_or(text, |(_, rows)| rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use judge::findings::{Aspect, Findings};

    #[test]
    fn a_refutation_is_a_line_with_three_numbers_at_most() {
        let mut findings = Findings::default();
        findings.expect(Aspect::Normal);
        for call in 0..8 {
            let badness = f64::from(call as u32);
            let right = call < 5;
            findings.judge(Aspect::T, call, right, badness, || "1.5 ".repeat(100));
            findings.judge(Aspect::Work, call, right, badness, || "900 tests");
        }
        let lines: Vec<String> = findings.into_vec().iter().map(refutation).collect();
        assert_eq!(
            lines,
            [
                "the exact oracle refutes it: no answer has normal",
                "the exact oracle refutes it: t is wrong on 3 of 8 calls, worst in call 5",
                "the exact oracle refutes it: number of tests is wrong",
            ]
        );
    }
}
