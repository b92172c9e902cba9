//! Formats the report for people as one screen: a line for each task, then what helps most with the
//! first task that is not complete.

mod detail;
pub(super) use detail::WHOLE;
#[cfg(test)]
mod tests;

use super::links::book_command;
use super::table::{number, summary};
use super::terminal::{GREEN, Page, style_of};
use super::wrap::{columns, one_line, shorten_numbers, wrap_to};
use super::{HintLevel, Report, Reveal, TaskReport};
use super::{functions, message};
use crate::course::given;
use crate::course::sources::Place;
use crate::score::{CaseResult, Status, TaskResult};
use crate::workers::printed::Printed;
use judge::cases::checked;
use judge::{Tier, plural};
use std::path::PathBuf;

/// What a screen says besides the report.
#[derive(Clone, Debug, Default)]
pub struct Context {
    /// What was graded: `all`, a part or a task, or several of these with commas between them.
    pub what: String,
    /// Where the graded tasks are written, in their order.
    pub places: Vec<Place>,
    /// The open task that comes next.
    pub next: Option<Place>,
    /// The compiler's messages, if they were not printed while building.
    pub compiler: Option<String>,
    /// The first error of the compiler in a line, if its messages were printed and are longer than
    /// the page: so they begin out of sight.
    pub first_error: Option<String>,
    /// The file of the compiler's first error, from the workspace's root.
    pub broken_file: Option<String>,
    /// The file of the picture with light, if there is one.
    pub lit: Option<PathBuf>,
    /// What the student's code printed.
    pub printed: Vec<Printed>,
    /// The given files that were changed: [`crate::course::given::changed`].
    pub changed_given: Vec<String>,
}

/// Some lines that stay together.
struct Block {
    /// The block with the highest number is left out first if there is too little room.
    rank: u32,
    lines: Vec<String>,
}

/// More tasks than these do not have a line each: a part of which all tasks are alike has one.
const MANY_TASKS: usize = 8;

/// How many pages a report may have: whoever asks for more gets all that less shows, the drawing
/// too.
fn pages(hint: HintLevel) -> usize {
    match hint {
        HintLevel::Cases | HintLevel::Findings => 1,
        HintLevel::Mistake | HintLevel::Remedy => 2,
    }
}

/// Formats the report in one page of at most `page.height` lines of at most `page.width` columns,
/// or in two if the likely mistake is named.
pub fn format_screen(report: &Report, context: &Context, reveal: Reveal, page: Page) -> String {
    let mut blocks = vec![Block {
        rank: 0,
        lines: task_lines(report, page),
    }];
    match first_to_mend(report, reveal.extra) {
        Some(task) => {
            blocks.extend(detail::blocks(task, context, reveal, page));
            blocks.push(score(report, context, page));
            // Without answers there is no more to say.
            let has_run = !matches!(
                task.result.status,
                Status::NotAttempted | Status::DoesNotCompile
            );
            if has_run {
                blocks.push(more(task, reveal, page));
            }
        }
        None => {
            blocks.extend(success(report, context, page));
            blocks.push(score(report, context, page));
        }
    }
    if let Some(sentence) = given::sentence(&context.changed_given) {
        blocks.push(Block {
            rank: 0,
            lines: wrap_to(&sentence, 2, page.width, 4),
        });
    }
    if let Some(sentence) = uncalled_gaps(report, context) {
        blocks.push(Block {
            rank: 0,
            lines: wrap_to(&sentence, 2, page.width, 4),
        });
    }
    fit(&mut blocks, pages(reveal.hint) * page.height);
    let lines = blocks.iter().flat_map(|block| &block.lines);
    lines.flat_map(|line| [line.as_str(), "\n"]).collect()
}

/// The functions of complete tasks that still are gaps: no case calls them. `None` if there are
/// none.
fn uncalled_gaps(report: &Report, context: &Context) -> Option<String> {
    let is_complete = |key: &str| {
        let mut tasks = report.tasks.iter().map(|task| &task.result);
        tasks.any(|task| task.key == key && task.is_complete())
    };
    let open = context.places.iter();
    let open = open.filter(|place| place.has_hole && is_complete(&place.key));
    let names: Vec<&str> = open
        .flat_map(|place| &place.open)
        .map(String::as_str)
        .collect();
    (!names.is_empty()).then(|| {
        format!(
            "Still a gap: {}. No case calls it the way your code is, so the points say nothing about it; \
             later parts call it.",
            names.join(", ")
        )
    })
}

/// The first task to show in detail: the first that was attempted and is not complete, else the
/// first that is not complete. With `extra` a task is only complete with all of its extra credit.
pub fn first_to_mend(report: &Report, extra: bool) -> Option<&TaskReport> {
    let is_open = |task: &&TaskReport| {
        let result = &task.result;
        result.score < result.max_score || extra && result.robust_score < result.robust_max_score
    };
    let attempted = |task: &&TaskReport| task.result.status != Status::NotAttempted;
    let mut open = report.tasks.iter().filter(is_open);
    open.clone().find(attempted).or_else(|| open.next())
}

/// Leaves out blocks until the others have at most `height` lines; at last, tasks.
fn fit(blocks: &mut Vec<Block>, height: usize) {
    let count = |blocks: &[Block]| blocks.iter().map(|block| block.lines.len()).sum::<usize>();
    while count(blocks) > height {
        let ranks = blocks
            .iter()
            .enumerate()
            .map(|(at, block)| (block.rank, at));
        let Some((rank, at)) = ranks.max() else {
            return;
        };
        if rank == 0 {
            let surplus = count(blocks) - height + 1;
            let tasks = &mut blocks[0].lines;
            let kept = tasks.len().saturating_sub(surplus);
            let left_out = tasks.len() - kept;
            tasks.truncate(kept);
            tasks.push(format!("and {left_out} more"));
            return;
        }
        blocks.remove(at);
    }
}

/// A line for each task: key, title, points, status. If there are many tasks, a line for each part
/// of which all tasks are complete or none is attempted.
fn task_lines(report: &Report, page: Page) -> Vec<String> {
    let mut lines = Vec::new();
    let tasks: Vec<&TaskResult> = report.tasks.iter().map(|task| &task.result).collect();
    let mut parts = tasks.chunk_by(|a, b| part(&a.key) == part(&b.key));
    if tasks.len() <= MANY_TASKS {
        return tasks.iter().map(|task| task_line(task, page)).collect();
    }
    let alike =
        |tasks: &[&TaskResult], is: fn(&TaskResult) -> bool| tasks.iter().all(|task| is(task));
    for tasks in parts.by_ref() {
        let [first, ..] = tasks else { continue };
        let is_complete = alike(tasks, TaskResult::is_complete);
        if is_complete || alike(tasks, |task| task.status == Status::NotAttempted) {
            let sum = |points: fn(&TaskResult) -> f64| tasks.iter().map(|task| points(task)).sum();
            let whole = TaskResult {
                key: part(&first.key).to_owned(),
                title: format!("{} tasks", tasks.len()),
                score: sum(|task| task.score),
                max_score: sum(|task| task.max_score),
                status: match is_complete {
                    true => Status::Passed,
                    false => Status::NotAttempted,
                },
                cases: Vec::new(),
                ..(*first).clone()
            };
            lines.push(task_line(&whole, page));
        } else {
            lines.extend(tasks.iter().map(|task| task_line(task, page)));
        }
    }
    lines
}

/// The key of the part of a task.
fn part(key: &str) -> &str {
    key.split('.').next().unwrap_or(key)
}

/// Columns of a task's title.
fn title_width(page: Page) -> usize {
    page.width.saturating_sub(43).min(37)
}

/// Columns of a task's points.
const POINTS: usize = 9;

fn task_line(task: &TaskResult, page: Page) -> String {
    let title = one_line(&task.title, title_width(page));
    let points = format!("{}/{}", number(task.score), number(task.max_score));
    let padding = " ".repeat(title_width(page).saturating_sub(columns(&title)));
    let before = format!("{}  {title}{padding} {points:>POINTS$}  ", task.key);
    let room = page.width.saturating_sub(columns(&before));
    let state = state(task);
    // What does not fit is said below, in detail.
    let fitting = match state.split_once(", ") {
        Some((first, _)) if columns(&state) > room => first,
        _ => &state,
    };
    let status = one_line(fitting, room);
    match page.colours {
        true => {
            let style = style_of(task);
            format!("{before}{style}{status}{style:#}")
        }
        false => format!("{before}{status}"),
    }
}

/// The status of a task in a few words.
fn state(task: &TaskResult) -> String {
    match &task.status {
        Status::NotAttempted => "not written yet".into(),
        Status::Crashed(_) => "every case crashes".into(),
        _ if task.is_complete() => "complete".into(),
        Status::Failed => {
            let is_core = |case: &&CaseResult| case.tier == Tier::Core;
            let failed = match task.failed_cases().filter(is_core).count() {
                0 => return right_so_far(task),
                1 => "1 case fails".into(),
                count => format!("{count} cases fail"),
            };
            let reduced = task.cases.iter().filter(is_core);
            match reduced.filter(|case| case.lacks_only_the_idea()).count() {
                0 => failed,
                count => format!("{failed}, {count} more count a quarter"),
            }
        }
        _ => summary(task),
    }
}

/// The status of a task without a failed core case.
fn right_so_far(task: &TaskResult) -> String {
    if let Some(waiting) = super::table::waiting(task) {
        return format!("right so far; {waiting}");
    }
    match functions::unwritten(task).len() {
        0 => summary(task),
        count => format!(
            "right so far, {} code that is not written",
            plural(count, "case reaches", "cases reach")
        ),
    }
}

/// The points, and one line about extra credit.
fn score(report: &Report, context: &Context, page: Page) -> Block {
    let points = |score: f64, max: f64| format!("{} of {}", number(score), number(max));
    // Without an argument, whatever is open of a stage is graded with the first open task.
    let of = match report.tasks.len() {
        graded @ 2.. if context.what.contains(".task") && !context.what.contains(',') => {
            format!(" of these {graded} tasks: ")
        }
        _ => " ".to_owned(),
    };
    let mut text = format!("score{of}{}", points(report.score, report.max_score));
    if report.robust_max_score > 0.0 {
        let extra = points(report.robust_score, report.robust_max_score);
        text.push_str(&format!("; extra credit {extra}"));
    }
    let mut lines = vec![String::new()];
    lines.extend(wrap_to(&text, 2, page.width, 2));
    for TaskReport { result, .. } in &report.tasks {
        let of_examples = result.cases.iter().filter(|case| case.is_of_examples());
        lines.extend(of_examples.flat_map(|case| {
            let points = points(case.score, case.max_score);
            let why: String = case
                .reductions
                .iter()
                .map(|why| format!("; {why}"))
                .collect();
            let text = format!("your examples of {}: {points}{why}", result.key);
            wrap_to(&text, 2, page.width, 2)
        }));
        let undecided = message::undecided(result);
        lines.extend(undecided.flat_map(|text| wrap_to(&text, 2, page.width, 3)));
    }
    lines.extend(super::not_judged(report).flat_map(|text| wrap_to(&text, 2, page.width, 2)));
    Block { rank: 0, lines }
}

/// The command for more.
fn more(task: &TaskReport, reveal: Reveal, page: Page) -> Block {
    let mut more = Vec::new();
    let failed = detail::first_failed(&task.result, reveal.extra);
    // The levels are about the wrong answers that the screen shows; without any there is no more to
    // say.
    let has_answers = failed.is_some()
        && task
            .result
            .cases
            .iter()
            .any(|case| !case.findings.is_empty());
    if let Some(next) = reveal.hint.next().filter(|_| has_answers) {
        more.push(format!(
            "`--hint {}` for more ({})",
            next.number(),
            next.adds()
        ));
    }
    more.push("`--long` for more cases".to_owned());
    let of_call = task.simplest.as_ref().map(|call| &call.case);
    if let Some(case) = of_call.or(failed.map(|case| &case.name)) {
        more.push(format!("`cargo grader explain {}/{case}`", task.result.key));
    }
    let text = format!("cargo grader {}: {}", task.result.key, more.join(", "));
    Block {
        rank: 1,
        lines: wrap_to(&text, 2, page.width, 3),
    }
}

/// What follows full core points: what is complete, the picture, the next task, extra credit.
fn success(report: &Report, context: &Context, page: Page) -> Vec<Block> {
    let block = |rank: u32, text: String| Block {
        rank,
        lines: wrap_to(&text, 2, page.width, 2),
    };
    let what = match context.what.strip_prefix("part") {
        Some(number) if !number.contains('.') => format!("Part {number} is complete."),
        _ if context.what == "all" => "Every part is complete.".into(),
        _ => match context.what.rsplit_once(',') {
            Some((most, last)) => {
                format!("{} and {last} are complete.", most.replace(',', ", "))
            }
            None => format!("{} is complete.", context.what),
        },
    };
    let what = match page.colours {
        true => format!("{GREEN}{what}{GREEN:#}"),
        false => what,
    };
    let mut blocks = vec![Block {
        rank: 0,
        lines: vec![String::new(), what],
    }];
    let mut tasks = report.tasks.iter().rev();
    if let Some(picture) = tasks.find_map(|task| task.picture.as_ref()) {
        blocks.push(block(1, format!("picture: {}", picture.display())));
    }
    if let Some(lit) = &context.lit {
        let text = format!("Your picture with light, to show around: {}", lit.display());
        blocks.push(block(1, text));
    }
    if let Some(line) = speedup(report) {
        blocks.push(block(2, line));
    }
    if let Some(next) = &context.next {
        blocks.push(block(1, format!("Next: {}", heading(next))));
        let chapter = book_command(&next.key, "");
        blocks.push(block(1, format!("Its chapter: {chapter}")));
    }
    if report.robust_score < report.robust_max_score {
        let text = format!(
            "extra credit {} of {}: `cargo grader {} --extra`",
            number(report.robust_score),
            number(report.robust_max_score),
            context.what
        );
        blocks.push(block(1, text));
        blocks.extend(invitation(report, page));
    }
    blocks
}

/// Digits of a question that is there to think about. `--extra` shows all.
const DIGITS: usize = 4;

/// The simplest call that extra credit asks for and the code gets wrong, or the worst if none is
/// simple: what there is to think about after the last core point.
fn invitation(report: &Report, page: Page) -> Option<Block> {
    let mut tasks = report.tasks.iter();
    let (case, input, found) = tasks.find_map(|task| match &task.simplest {
        Some(call) if task.result.robust_score < task.result.robust_max_score => {
            Some((&call.case, message::input(call), message::found(call)))
        }
        _ => worst_of_extra(&task.result),
    })?;
    let asks = format!("  it asks for {case}: {input}");
    let mut lines = wrap_to(&asks, 4, page.width, 4);
    lines.extend(wrap_to(&format!("    {found}"), 4, page.width, 3));
    Some(Block { rank: 1, lines })
}

/// The first failed case of extra credit, with the question of its worst answer, or else what it
/// checks, and this answer.
fn worst_of_extra(task: &TaskResult) -> Option<(&String, String, String)> {
    let mut extra = task.failed_cases().filter(|case| case.tier == Tier::Robust);
    extra.find_map(|case| {
        let (_, worst) = case.worst()?;
        let question = match worst.message.question.as_str() {
            "" => checked(&case.about),
            question => question,
        };
        let found = message::with_telling_digits(&worst.message);
        Some((&case.name, shorten_numbers(question, DIGITS), found))
    })
}

/// The speedup on the largest mesh.
fn speedup(report: &Report) -> Option<String> {
    let rows = &report.speedups.as_ref()?.rows;
    let row = rows.iter().max_by_key(|row| row.triangles)?;
    Some(format!(
        "Your BVH is {:.0} times as fast as your brute force on {} triangles (table: `--long`).",
        row.speedup, row.triangles
    ))
}

/// What to write of a task that is at this place: "Open stages/raygen/src/pixel.rs and write
/// `raytrace_pixel`."
pub fn to_write(place: Option<&Place>) -> String {
    let file = place.and_then(|place| place.file.as_deref());
    let names: Vec<String> = place.map_or_else(Vec::new, |place| {
        place.open.iter().map(|name| format!("`{name}`")).collect()
    });
    match (file, names.join(", ")) {
        (Some(file), names) if !names.is_empty() => format!("Open {file} and write {names}."),
        (Some(file), _) => format!("Open {file}."),
        (None, _) => "Its functions are still those of the handout.".into(),
    }
}

/// A task with its file: "part2.task1 Constructing the BVH, in stages/bvh/src/construct.rs".
pub fn heading(place: &Place) -> String {
    let mut text = format!("{} {}", place.key, place.title);
    if let Some(file) = &place.file {
        text.push_str(&format!(", in {file}"));
    }
    text
}
