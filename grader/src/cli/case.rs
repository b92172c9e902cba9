//! The command `grader part1.task3 --case range --call 2`: runs one case and prints its calls.

use crate::build::BuildRoot;
use crate::course::{CaseEntry, Course, Task};
use crate::grade::{self, GradeRequest};
use crate::report::message;
use crate::report::table::status_text;
use crate::report::terminal::Page;
use crate::report::wrap::{columns, numbers_to_fit, shorten_numbers, wrap, wrap_to};
use crate::score::{CaseResult, Status};
use crate::workers::printed;
use crate::workers::worker_set::WorkerSet;
use base::program::Exit;
use base::{GraderError, Workspace, out, outln};
use judge::cases::Spec;
use judge::findings::WrongAnswer;
use judge::repro;
use judge::snapshot::{self, Line, Snapshot};
use std::collections::BTreeMap;
use std::fmt::Write;
use wire::Answer;

/// Columns of the name of a field of a call.
const FIELD: usize = 11;

/// The most kinds of wrong calls that are listed.
const LISTED: usize = 20;

/// The most numbers of calls in a line.
const NUMBERS: usize = 8;

/// Digits of the numbers in a line that does not fit with all of them.
const DIGITS: usize = 4;

/// Runs the case `name` of the task in `request` and prints it, or its call number `call`.
pub(super) fn run(
    workspace: &Workspace,
    request: &GradeRequest,
    name: &str,
    call: Option<u32>,
) -> Result<Exit, GraderError> {
    let course = Course::read(workspace)?;
    let (task, entry) = find(&course, &request.what, name)?;
    let specs = grade::specs(&[task], request.seed)?;
    let spec = grade::chosen(&[task], &specs)?;
    let spec = spec
        .into_iter()
        .find(|spec| spec.name == name)
        .ok_or_else(|| no_case(task, name))?;
    if let Some(call) = call.filter(|call| *call as usize >= spec.calls()) {
        return Err(GraderError::new(format!(
            "{}/{name} has {}, numbered from 0: it has no call {call}",
            task.key,
            judge::plural(spec.calls(), "call", "calls")
        )));
    }
    // Alone, the call prints nothing that belongs to others.
    let alone = call.and_then(|call| spec.only_call(call as usize));
    let mut runs = vec![spec.clone()];
    runs.extend(alone.clone());
    let stages = [task.stage.as_str()];
    let build_root = BuildRoot::of(workspace);
    let workers = WorkerSet::build(&build_root, &stages, spec.needs_all_stages())?;
    let Some(workers) = workers.workers(&task.stage) else {
        outln!("{}: stages/{} does not compile", task.key, task.stage);
        return Ok(Exit::Failed);
    };
    let mut ran = Vec::new();
    for spec in &runs {
        let mut printed = Vec::new();
        let endings = workers.run(&[spec], &mut printed)?;
        let ending = endings
            .into_iter()
            .next()
            .ok_or_else(|| GraderError::new("the worker returned no result"))?;
        let answer = grade::answered(&task.key, &ending, &course)?;
        ran.push((answer.cloned(), grade::holes(&ending).to_vec(), printed));
    }
    let (whole, holes, printed) = ran.remove(0);
    let (of_call, _, printed) = ran
        .pop()
        .unwrap_or_else(|| (whole.clone(), Vec::new(), printed));
    let not_written: Vec<String> = holes.iter().map(|hole| hole.called.clone()).collect();
    let (findings, wrong) = match (&whole, &alone, &of_call) {
        (Ok(answer), ..) => judge::judge_each(spec, entry.tier, answer, &not_written),
        // Another call ended the case.
        (Err(_), Some(alone), Ok(answer)) => {
            let (_, mut wrong) = judge::judge_each(alone, entry.tier, answer, &not_written);
            wrong
                .iter_mut()
                .for_each(|wrong| wrong.fault.call = call.unwrap_or(0));
            (Vec::new(), wrong)
        }
        _ => (Vec::new(), Vec::new()),
    };
    let status = whole.as_ref().err().cloned().unwrap_or(Status::Passed);
    let result = CaseResult::new(entry, spec.about, status, findings, &holes);
    let shown = Case {
        task,
        entry,
        spec,
        wrong: &wrong,
        result: &result,
        golden: golden(workspace, spec, request.seed),
    };
    let page = Page::of_stdout();
    match call {
        None => out!("{}", shown.list(page)),
        Some(call) => {
            let answers = (whole.as_ref().ok(), of_call.as_ref());
            out!("{}", shown.one(call, answers, alone.as_ref(), page));
        }
    }
    if !printed.is_empty() {
        outln!("\n{}", printed::format(&printed).trim_end());
    }
    Ok(match result.status {
        Status::Passed => Exit::Passed,
        _ => Exit::Failed,
    })
}

/// The task `what` and its case `name`.
pub(super) fn find<'a>(
    course: &'a Course,
    what: &str,
    name: &str,
) -> Result<(&'a Task, &'a CaseEntry), GraderError> {
    let tasks = course.select(what)?;
    let [task] = tasks.as_slice() else {
        return Err(GraderError::new(format!(
            "expected the task of the case, such as `{}`, found `{what}`",
            tasks[0].key
        )));
    };
    let entry = task.cases.iter().find(|entry| entry.name == name);
    Ok((task, entry.ok_or_else(|| no_case(task, name))?))
}

fn no_case(task: &Task, name: &str) -> GraderError {
    let names: Vec<&str> = task.cases.iter().map(|case| case.name.as_str()).collect();
    GraderError::new(format!(
        "{} has no case `{name}`. Its cases are {}",
        task.key,
        names.join(", ")
    ))
}

/// The reference's answers, if they are stored for this seed.
pub(super) fn golden(workspace: &Workspace, spec: &Spec, seed: u64) -> Option<Snapshot> {
    if seed != 0 {
        return None;
    }
    let text = std::fs::read_to_string(workspace.snapshot(spec.task, spec.name)).ok()?;
    snapshot::parse(&text).ok()
}

/// One line whose numbers have as many digits as fit, or two: what is expected comes last, and must
/// not be cut off.
fn lines_to_fit(text: &str, width: usize) -> Vec<String> {
    let line = numbers_to_fit(text, width);
    match line.ends_with('…') {
        true => wrap_to(&shorten_numbers(text, DIGITS), 4, width, 2),
        false => vec![line],
    }
}

/// A case that ran.
struct Case<'a> {
    task: &'a Task,
    entry: &'a CaseEntry,
    spec: &'a Spec,
    wrong: &'a [WrongAnswer],
    result: &'a CaseResult,
    golden: Option<Snapshot>,
}

impl Case<'_> {
    fn heading(&self, page: Page) -> String {
        let mut text = format!("{}/{}", self.task.key, self.entry.name);
        let _ = writeln!(text, "  {}", status_text(&self.result.status));
        for line in wrap(&format!("  {}", self.spec.about), 2, page.width) {
            let _ = writeln!(text, "{line}");
        }
        text
    }

    /// The wrong calls. Those that are wrong in the same way, but for the numbers, have one line
    /// together, with the input of the first.
    fn list(&self, page: Page) -> String {
        let mut text = self.heading(page);
        let mut calls: BTreeMap<u32, &WrongAnswer> = BTreeMap::new();
        for wrong in self.wrong {
            calls.entry(wrong.fault.call).or_insert(wrong);
        }
        let of = judge::plural(self.spec.calls(), "call", "calls");
        if self.result.status != Status::NotAttempted {
            let _ = writeln!(text, "wrong: {} of {of}", calls.len());
        }
        let groups = alike(calls.values().copied());
        for group in groups.iter().take(LISTED) {
            let first = group[0];
            let question = &first.message.question;
            let start = format!("  {}: ", first.aspect.label());
            let room = page.width.saturating_sub(columns(&start));
            let result = message::to_fit(&first.message, room);
            for line in lines_to_fit(&format!("{start}{result}"), page.width) {
                let _ = writeln!(text, "{line}");
            }
            let mut of_group = format!("    call {}", numbers(group));
            if !question.is_empty() {
                let _ = write!(of_group, "; of call {}: {question}", first.fault.call);
            }
            let _ = writeln!(text, "{}", numbers_to_fit(&of_group, page.width));
        }
        if let Some(more) = groups.len().checked_sub(LISTED).filter(|more| *more > 0) {
            let _ = writeln!(text, "  and {more} more kinds");
        }
        if let Some(call) = calls.keys().next() {
            let (key, name) = (&self.task.key, &self.entry.name);
            let line = format!("one call: cargo grader {key} --case {name} --call {call}");
            let _ = writeln!(text, "{line}");
        }
        text
    }

    /// Call number `call`: input, answer, expected answer, verdict, test. `alone` is the case with
    /// this call only, whose answer is the second one.
    fn one(
        &self,
        call: u32,
        (whole, alone_answer): (Option<&Answer>, Result<&Answer, &Status>),
        alone: Option<&Spec>,
        page: Page,
    ) -> String {
        let mut text = self.heading(page);
        let _ = writeln!(text, "call {call} of {}", self.spec.calls());
        let line = match (alone, alone_answer, whole) {
            (Some(alone), Ok(answer), _) => row(alone, answer, 0),
            (_, _, Some(answer)) => row(self.spec, answer, call),
            _ => None,
        };
        let mut field = |name: &str, value: &str| {
            let lines = wrap(value, 0, page.width.saturating_sub(FIELD + 2));
            for (i, line) in lines.iter().enumerate() {
                let name = if i == 0 { name } else { "" };
                let _ = writeln!(text, "  {name:<FIELD$}{line}");
            }
        };
        let golden = self.golden.as_ref().and_then(|golden| golden.row(call));
        let asked = line
            .as_ref()
            .filter(|line| !line.question.is_empty())
            .or(golden);
        if let Some(asked) = asked.filter(|line| !line.question.is_empty()) {
            field("input", &asked.asked());
        }
        match (alone_answer, &line) {
            // Alone it is call 0, whatever its number in the case.
            (Err(status), _) => {
                let how = match status {
                    Status::Crashed(ended) => ended.how.clone(),
                    status => status_text(status),
                };
                field("yours", &how);
            }
            (Ok(_), Some(line)) => field("yours", &line.answer_text()),
            (Ok(_), None) => {}
        }
        if let Some(golden) = golden {
            field("reference", &golden.answer_text());
        }
        let wrong: Vec<&WrongAnswer> = self
            .wrong
            .iter()
            .filter(|wrong| wrong.fault.call == call)
            .collect();
        for wrong in &wrong {
            let label = wrong.aspect.label();
            let result = message::to_fit(&wrong.message, usize::MAX);
            field("verdict", &format!("wrong {label}: {result}"));
        }
        match wrong.is_empty() {
            true if alone_answer.is_ok() => field("verdict", &right(self.spec)),
            true => field("verdict", "no answer to judge"),
            false => {}
        }
        if let Some(test) = repro::test(self.spec, self.entry.tier, call as usize) {
            let _ = writeln!(text, "as a test:");
            test.lines().for_each(|line| {
                let _ = writeln!(text, "    {line}");
            });
        }
        text
    }
}

/// Groups wrong calls whose messages differ in numbers alone, the largest group first.
fn alike<'a>(wrong: impl Iterator<Item = &'a WrongAnswer>) -> Vec<Vec<&'a WrongAnswer>> {
    let mut groups: BTreeMap<String, Vec<&WrongAnswer>> = BTreeMap::new();
    for one in wrong {
        let result = message::to_fit(&one.message, usize::MAX);
        let is_of_number = |c: char| c.is_ascii_digit() || ".-e".contains(c);
        let words = result
            .split_whitespace()
            .filter(|word| !word.starts_with(|c: char| is_of_number(c) || c == '('));
        let kind = format!(
            "{} {}",
            one.aspect.label(),
            words.collect::<Vec<_>>().join(" ")
        );
        groups.entry(kind).or_default().push(one);
    }
    let mut groups: Vec<_> = groups.into_values().collect();
    groups.sort_by_key(|group| (std::cmp::Reverse(group.len()), group[0].fault.call));
    groups
}

/// The numbers of the calls of a group, runs of them in short.
fn numbers(group: &[&WrongAnswer]) -> String {
    let mut runs: Vec<[u32; 2]> = Vec::new();
    for one in group {
        match runs.last_mut() {
            Some([_, end]) if *end + 1 == one.fault.call => *end = one.fault.call,
            _ => runs.push([one.fault.call; 2]),
        }
    }
    let short = runs
        .iter()
        .take(NUMBERS)
        .map(|[first, last]| match last - first {
            0 => first.to_string(),
            _ => format!("{first}-{last}"),
        });
    let short = short.collect::<Vec<String>>().join(", ");
    match runs.len() > NUMBERS {
        true => format!("{short}, … ({} in all)", group.len()),
        false => short,
    }
}

/// The verdict on a right answer. A case may judge only some aspects of it.
fn right(spec: &Spec) -> String {
    let aspects = spec.about_aspects.iter().map(|aspect| aspect.label());
    match aspects.collect::<Vec<_>>().join(", ") {
        all if all.is_empty() => "right".into(),
        some => format!("right in what this case is about: {some}"),
    }
}

/// The row of a call, with its question and all fields of its answer.
fn row(spec: &Spec, answer: &Answer, call: u32) -> Option<Line> {
    snapshot::full(&spec.work, answer)?.row(call).cloned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use judge::findings::{Aspect, Class, Fault, Message};

    #[test]
    fn what_is_expected_is_not_cut_off() {
        let normal = "(0.12345678, 0.23456789, 0.34567891)";
        let line = format!("  normal: your result: n = {normal}; expected: n = {normal}");
        assert_eq!(lines_to_fit(&line, 120), [line.as_str()]);
        let short = "(0.1235, 0.2346, 0.3457)";
        let two = [
            format!("  normal: your result: n = {short};"),
            format!("    expected: n = {short}"),
        ];
        assert_eq!(lines_to_fit(&line, 58), two);
    }

    #[test]
    fn calls_that_are_wrong_in_the_same_way_are_listed_together() {
        let message = |t: f64| {
            Message::new(format!("test: your result: hit at t = {t}; expected: miss"))
                .asked(format!("Ray: o = {t}"))
        };
        let wrong = |call: u32, message: Message| WrongAnswer {
            aspect: Aspect::HitOrMiss,
            fault: Fault {
                call,
                function: None,
                counts_for: None,
                class: Class::Wrong,
            },
            message,
        };
        let mut all: Vec<WrongAnswer> = (3..90)
            .map(|call| wrong(call, message(f64::from(call))))
            .collect();
        all.push(wrong(91, message(2.5)));
        all.insert(0, wrong(1, "test: your result: miss; expected: hit".into()));
        let groups = alike(all.iter());
        assert_eq!(groups.len(), 2);
        assert_eq!(numbers(&groups[0]), "3-89, 91");
        assert_eq!(numbers(&groups[1]), "1");
        let every_second: Vec<&WrongAnswer> = groups[0].iter().copied().step_by(2).collect();
        assert!(numbers(&every_second).ends_with("17, … (44 in all)"));
    }
}
