//! What a screen says about one task that is not complete.

use super::{Block, Context, DIGITS};
use crate::build::compile_errors;
use crate::course::chapter::Section;
use crate::course::sources::Place;
use crate::diagnosis::simplest::SimplestCall;
use crate::report::links::book_command;
use crate::report::table::status_text;
use crate::report::terminal::Page;
use crate::report::worst_test;
use crate::report::wrap::{columns, numbers_to_fit, one_line, shorten_numbers, wrap_to};
use crate::report::{HintLevel, Reveal, TaskReport};
use crate::report::{functions, message};
use crate::score::regularity::{self, Regularity};
use crate::score::{CaseResult, Status, TaskResult, order};
use crate::sketch::Sketch;
use crate::workers::printed;
use judge::Tier;
use judge::cases::checked;
use judge::findings::{Finding, Worst};

/// The most lines of each kind of text.
const NAMES: usize = 2;
const SENTENCES: usize = 3;
const MESSAGE: usize = 9;
const RESULT: usize = 4;
/// The likely mistake, what wrong answers have in common, the simplest call and what was found
/// there are not cut: other blocks are left out before.
pub(in crate::report) const WHOLE: usize = 12;

/// How many failed cases are described at the level that shows nothing else.
const DESCRIBED: usize = 4;

/// The blocks about `task`.
pub(super) fn blocks(
    task: &TaskReport,
    context: &Context,
    reveal: Reveal,
    page: Page,
) -> Vec<Block> {
    let result = &task.result;
    let mut out = Lines {
        page,
        blocks: vec![Block {
            rank: 0,
            lines: vec![String::new()],
        }],
    };
    match &result.status {
        Status::NotAttempted => not_written(&mut out, result, context),
        Status::DoesNotCompile => does_not_compile(&mut out, result, context),
        _ => wrong(&mut out, task, reveal),
    }
    if let Some(picture) = &task.picture {
        out.add(4, 1, &format!("  picture: {}", picture.display()));
    }
    if let Some(printed) = printed::summary(&context.printed) {
        let how = "`--long` shows them, `--case NAME --call N` those of one call";
        out.add(3, 2, &format!("  {printed}: {how}"));
    }
    // Without text there is no blank line before it either.
    match out.blocks.len() {
        1 => Vec::new(),
        _ => out.blocks,
    }
}

/// Collects blocks of wrapped text.
struct Lines {
    page: Page,
    blocks: Vec<Block>,
}

impl Lines {
    fn add(&mut self, rank: u32, most: usize, text: &str) {
        let lines = wrap_to(text, 4, self.page.width, most);
        self.blocks.push(Block { rank, lines });
    }
}

fn not_written(out: &mut Lines, task: &TaskResult, context: &Context) {
    let place = context.places.iter().find(|place| place.key == task.key);
    out.add(0, 3, &format!("{} {}", task.key, task.title));
    out.add(0, SENTENCES, &format!("  {}", super::to_write(place)));
    let chapter = book_command(&task.key, "");
    out.add(1, 2, &format!("  Its chapter: {chapter}"));
    let run = format!(
        "  Then run `cargo grader {}`, or keep `cargo grader watch` running.",
        task.key
    );
    out.add(1, 2, &run);
}

/// The chapter of the book about Rust, and its section about the compiler's messages.
const RUST: [&str; 2] = ["rust", "errors-and-warnings-that-come-up-here"];

fn does_not_compile(out: &mut Lines, task: &TaskResult, context: &Context) {
    let mut what = format!("{}: stages/{} does not compile", task.key, task.stage);
    if let Some(file) = &context.broken_file {
        // A task that was complete is told so, too: nothing of it can run.
        what += &format!(", because of {file}");
        let of_file = |place: &&Place| place.file.as_ref() == Some(file);
        if let Some(other) = context.places.iter().find(of_file)
            && other.key != task.key
        {
            what += &format!(", the file of {}", other.key);
        }
    }
    let [chapter, section] = RUST;
    let means = format!(
        "  What such errors mean, and what to do: {}",
        book_command(chapter, section)
    );
    let Some(messages) = &context.compiler else {
        let text = format!("{what}: the compiler's messages are above.");
        out.add(0, 2, &text);
        if let Some(first) = &context.first_error {
            out.add(0, SENTENCES, &format!("  The first: {first}"));
        }
        out.add(1, 2, &means);
        return;
    };
    out.add(0, 2, &format!("{what}."));
    let (first, count) = compile_errors::first(messages);
    let lines = first.lines().filter(|line| !line.trim().is_empty());
    let lines = lines.take(MESSAGE).flat_map(|line| {
        let line = format!("  {}", compile_errors::plain(line));
        // Where the compiler points with signs below the code, the columns must stay.
        match columns(&line) <= out.page.width {
            true => vec![line],
            false => wrap_to(&line, 4, out.page.width, 2),
        }
    });
    let mut lines: Vec<String> = lines.collect();
    lines.truncate(MESSAGE);
    out.blocks.push(Block { rank: 1, lines });
    if count > 1 {
        let others = judge::plural(count - 1, "other message", "other messages");
        out.add(2, 1, &format!("  and {others} of the compiler"));
    }
    out.add(1, 2, &means);
}

/// The failed cases that count: the core cases, or with `extra` the robust ones if no core case
/// failed.
fn counted(task: &TaskResult, extra: bool) -> Vec<&CaseResult> {
    let mut cases = order::failed_cases_that_count(task);
    cases.retain(|case| extra || case.tier == Tier::Core);
    cases
}

/// The failed case that is shown first.
pub(super) fn first_failed(task: &TaskResult, extra: bool) -> Option<&CaseResult> {
    counted(task, extra).first().copied()
}

fn wrong(out: &mut Lines, report: &TaskReport, reveal: Reveal) {
    let task = &report.result;
    if let Some(functions) = functions::line(task) {
        out.add(0, SENTENCES, &format!("{}: {functions}", task.key));
    }
    let cases = counted(task, reveal.extra);
    let Some(first) = cases.first() else {
        return waiting(out, task);
    };
    let names: Vec<&str> = cases.iter().map(|case| case.name.as_str()).collect();
    let kind = match first.tier {
        Tier::Core => "",
        Tier::Robust => " of extra credit",
    };
    let of = cases.len();
    let verb = match of {
        1 => format!("1 case{kind} fails"),
        _ => format!("{of} cases{kind} fail"),
    };
    out.add(
        2,
        NAMES,
        &format!("{}: {verb}: {}", task.key, names.join(", ")),
    );
    reduced(out, task);
    if reveal.hint != HintLevel::Findings {
        for case in cases.iter().take(DESCRIBED) {
            let text = format!("  {} tests: {}", case.name, checked(&case.about));
            out.add(3, NAMES, &text);
        }
    }
    if reveal.hint == HintLevel::Cases {
        return;
    }
    explanation(out, report, reveal);
    if let Status::Crashed(how) = &first.status {
        out.add(0, SENTENCES, &format!("  {}: {how}", first.name));
    }
    match &report.simplest {
        Some(call) => simplest(out, task, call),
        None => worst_answer(out, &cases),
    }
    for reduction in first.reductions.iter().take(1) {
        out.add(1, 2, &format!("  {}: {reduction}", first.name));
    }
    if let Some([copy, test]) = worst_test::commands(report) {
        let simplest = report.simplest.as_ref();
        let of = match simplest.is_none_or(|call| call.test.is_some()) {
            true => "As a test",
            // That of the simplest call would be too long.
            false => "Worst as test",
        };
        let lines = [format!("  {of}: {copy}"), format!("    {test}")]
            .map(|line| one_line(&line, out.page.width));
        out.blocks.push(Block {
            rank: 2,
            lines: lines.into(),
        });
    }
}

/// The simplest call that shows what is wrong, and on how many calls of its case it is.
fn simplest(out: &mut Lines, task: &TaskResult, call: &SimplestCall) {
    let case = task.cases.iter().find(|case| case.name == call.case);
    let mut findings = case.iter().flat_map(|case| &case.findings);
    if let Some(finding) = findings.find(|finding| Some(finding.aspect) == call.aspect) {
        wrong_calls(out, &call.case, finding);
    }
    let input = message::input(call);
    out.add(0, WHOLE, &format!("  Simplest such call: {input}"));
    out.add(0, WHOLE, &format!("    {}", message::found(call)));
    if let Some(only) = &call.only {
        out.add(1, NAMES, &format!("    ({only})"));
    }
    if let Some(sketch) = call.shown.as_ref().and_then(Sketch::of) {
        // The commands for a test, which come later, are left out before it.
        out.blocks.push(Block {
            rank: 2,
            lines: sketch.text(out.page.width),
        });
    }
}

fn wrong_calls(out: &mut Lines, case: &str, finding: &Finding) {
    let label = finding.aspect.label();
    let (wrong, calls) = (
        finding.wrong,
        judge::plural(finding.judged, "call", "calls"),
    );
    let text = format!("  {case}: {label} wrong on {wrong} of {calls}");
    out.add(0, 2, &text);
}

/// The worst answer of the first case that has one, where no simple call shows what is wrong.
fn worst_answer(out: &mut Lines, cases: &[&CaseResult]) {
    let mut found = cases
        .iter()
        .filter_map(|case| worst(case).map(|found| (case, found)));
    let Some((case, (finding, worst))) = found.next() else {
        return;
    };
    wrong_calls(out, &case.name, finding);
    let telling = message::with_telling_digits(&worst.message);
    let found = format!("    {}", message::without_signs_of_zeros(&telling));
    let mut lines = wrap_to(&found, 4, out.page.width, RESULT);
    if !worst.message.question.is_empty() {
        let question = format!("    {}", worst.message.question);
        let short = numbers_to_fit(&question, out.page.width);
        // The question is cut only where it would push the rest off the page.
        let room = (RESULT + 1).saturating_sub(lines.len());
        match short.ends_with('…') && room > 1 {
            true => {
                let short = shorten_numbers(&question, DIGITS);
                lines.extend(wrap_to(&short, 4, out.page.width, room));
            }
            false => lines.push(short),
        }
    }
    out.blocks.push(Block { rank: 0, lines });
}

/// The first wrong finding of a case, with its worst answer.
fn worst(case: &CaseResult) -> Option<(&Finding, &Worst)> {
    let wrong = case.findings.iter().filter(|finding| finding.wrong > 0);
    wrong
        .filter_map(|finding| Some((finding, finding.worst.as_ref()?)))
        .next()
}

/// The likely mistake at the levels that show it, else what the wrong answers have in common.
fn explanation(out: &mut Lines, report: &TaskReport, reveal: Reveal) {
    let lost_core = report.result.score < report.result.max_score;
    let has_crashed = report
        .result
        .failed_cases()
        .any(|case| matches!(case.status, Status::Crashed(_)));
    match &report.diagnosis {
        Some(found) if reveal.hint >= HintLevel::Mistake => {
            let label = found.certainty.label();
            out.add(0, WHOLE, &format!("  {label}: {}.", found.says));
            if reveal.hint >= HintLevel::Remedy {
                let before = found.certainty.before_hint();
                out.add(1, WHOLE, &format!("  {before}: {}", found.hint));
                read_more(out, &report.result.key, Section::Mistakes);
            }
        }
        None if reveal.hint >= HintLevel::Mistake && lost_core && !has_crashed => {
            let common = &report.regularities;
            if !common.iter().any(Regularity::is_of_few_digits) {
                out.add(
                    2,
                    1,
                    "  No known mistake can be named: none gives these answers, or several do.",
                );
            }
            if reveal.hint >= HintLevel::Remedy {
                read_more(out, &report.result.key, Section::Contract);
            }
        }
        None if reveal.hint >= HintLevel::Remedy && !lost_core => {
            read_more(out, &report.result.key, Section::Limits);
        }
        _ => {}
    }
    if !report.regularities.is_empty() {
        let common = regularity::joined(&report.regularities);
        out.add(1, WHOLE, &format!("  In common: {common}."));
    }
    if report.result.fails_only_with_neighbours() {
        out.add(1, SENTENCES, &format!("  {}.", message::WITH_NEIGHBOURS));
    }
}

/// Adds the place in the book about what went wrong.
fn read_more(out: &mut Lines, key: &str, about: Section) {
    let place = book_command(key, about.anchor());
    out.add(2, 2, &format!("  More in the book: {place}"));
}

/// A task none of whose cases failed by itself: it lacks points because of another task.
fn waiting(out: &mut Lines, task: &TaskResult) {
    let mut needs = task
        .cases
        .iter()
        .filter(|case| matches!(case.status, Status::Needs(_)));
    if let Some(case) = needs.next() {
        let status = status_text(&case.status);
        let text = match needs.count() {
            0 => format!(
                "{}: right so far. The case {} {status}",
                task.key, case.name
            ),
            others => format!(
                "{}: right so far. {} cases, such as {}: {status}",
                task.key,
                others + 1,
                case.name
            ),
        };
        return out.add(0, SENTENCES, &text);
    }
    if let Some(case) = functions::unwritten(task).first() {
        let text = format!(
            "{}: the case {case} reaches code that is not written yet",
            task.key
        );
        out.add(0, SENTENCES, &text);
    }
    reduced(out, task);
}

fn reduced(out: &mut Lines, task: &TaskResult) {
    if let Some(why) = functions::reduced(task) {
        out.add(1, NAMES, &format!("  {why}"));
    }
}
