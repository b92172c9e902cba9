//! The command `grader status`: what is written, what is left, what comes next. It builds nothing.

use crate::course::Course;
use crate::progress::next_task::{self, Known};
use crate::report::links;
use crate::report::screen;
use crate::report::table::{number, status_text};
use crate::report::terminal::{GREEN, Page};
use crate::report::wrap::{columns, wrap, wrap_to};
use crate::score::Status;
use base::program::Exit;
use base::{GraderError, Workspace, out};
use clap::Command;
use std::path::Path;

pub(super) fn command() -> Command {
    Command::new("status").about(
        "Shows which tasks are written, their last points and what comes next; builds nothing",
    )
}

pub(super) fn run() -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let known = next_task::known(&workspace, &course)?;
    let text = format_status(&known, Page::of_stdout());
    out!("{}", links::for_stdout(text, &workspace));
    Ok(Exit::Passed)
}

/// A line for each task, the points of each part, and the next step.
fn format_status(all: &[Known], page: Page) -> String {
    let mut lines = Vec::new();
    let titles = all.iter().map(|known| columns(&known.place.title));
    let widest = titles.max().unwrap_or(0);
    for known in all {
        let is_given = next_task::is_given(all, known.part_key());
        lines.extend(task_lines(known, is_given, widest, page));
    }
    lines.push(String::new());
    let parts = all
        .chunk_by(|a, b| a.part_key() == b.part_key())
        .map(|part_tasks| {
            let last = || part_tasks.iter().filter_map(|known| known.last.as_ref());
            let name = part_tasks[0].part_key();
            match last().count() {
                0 if next_task::is_given(all, name) => format!("{name} given"),
                0 => format!("{name} not graded yet"),
                graded => {
                    let sum = |points: fn(f64, f64) -> f64| -> String {
                        number(last().map(|last| points(last.score, last.max_score)).sum())
                    };
                    let whole = graded == part_tasks.len();
                    let more = if whole { "" } else { " so far" };
                    format!(
                        "{name} {} of {}{more}",
                        sum(|score, _| score),
                        sum(|_, max| max)
                    )
                }
            }
        });
    let parts: Vec<String> = parts.collect();
    lines.extend(wrap_to(&parts.join(", "), 2, page.width, 2));
    let next = match next_task::first_open(all, &[]) {
        Some(place) => format!("Next: {}; run `cargo grader`", screen::heading(place)),
        None => "Every task is complete.".into(),
    };
    lines.extend(wrap_to(&next, 2, page.width, 2));
    if let Some(place) = next_task::first_open(all, &[]) {
        let chapter = links::book_command(&place.key, "");
        let line = format!("Its chapter: {chapter}");
        lines.extend(wrap_to(&line, 2, page.width, 2));
    }
    lines
        .iter()
        .flat_map(|line| [line.as_str(), "\n"])
        .collect()
}

/// Columns of whether a task is written.
const WRITTEN: usize = 12;

/// The key and the title of a task, and its state: in one line, or in two if the page is too
/// narrow. The title is never cut. `widest` is the width of the widest title.
fn task_lines(known: &Known, is_given: bool, widest: usize, page: Page) -> Vec<String> {
    let Known { place, .. } = known;
    let before = format!("{}  {}", place.key, place.title);
    let state = state(known, is_given);
    let coloured = match page.colours && known.is_complete() {
        true => format!("{GREEN}{state}{GREEN:#}"),
        false => state.clone(),
    };
    let padding = widest - columns(&place.title) + 1;
    match columns(&before) + padding + columns(&state) <= page.width {
        true => vec![format!("{before}{}{coloured}", " ".repeat(padding))],
        false => {
            let below_title = columns(&place.key) + 2;
            let mut lines = wrap(&before, below_title, page.width);
            let indent = match below_title + columns(&state) <= page.width {
                true => below_title,
                false => 2,
            };
            lines.push(format!("{}{coloured}", " ".repeat(indent)));
            lines
        }
    }
}

/// Whether a task is written, and its points.
fn state(known: &Known, is_given: bool) -> String {
    let Known {
        place,
        last,
        changed,
    } = known;
    // A hole in a function that is not graded does not count.
    let written = match place.open.as_slice() {
        [] => "written",
        [_] => "1 gap left",
        _ => "gaps left",
    };
    let points = match last {
        None if is_given => "given".to_owned(),
        None => "not graded yet".to_owned(),
        // Its points are 0 for the fault of any file of the stage.
        Some(last) if last.status == status_text(&Status::DoesNotCompile) => last.status.clone(),
        Some(last) => {
            let points = format!("{}/{}", number(last.score), number(last.max_score));
            let changed = if *changed && last.attempted {
                " before edit"
            } else {
                ""
            };
            format!("{points}{changed}")
        }
    };
    format!("{written:<WRITTEN$}{points}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::sources::Place;
    use crate::progress::results::TaskScore;

    fn known(key: &str, open: &[&str], score: Option<f64>, changed: bool) -> Known {
        Known {
            place: Place {
                key: key.into(),
                title: "Direct light by hemisphere sampling".into(),
                file: Some("stages/intersect/src/lib.rs".into()),
                open: open.iter().map(ToString::to_string).collect(),
                has_hole: !open.is_empty(),
            },
            last: score.map(|score| TaskScore::of(score, 20.0)),
            changed,
        }
    }

    #[test]
    fn the_status_says_what_is_written_and_what_comes_next() {
        let tasks = [
            known("part1.task1", &[], Some(20.0), false),
            known("part1.task2", &[], Some(3.5), true),
            known("part2.task1", &["build", "split"], None, false),
        ];
        let text = format_status(&tasks, Page::default());
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines[0].ends_with("written     20/20"), "{text}");
        assert!(
            lines[1].ends_with("written     3.5/20 before edit"),
            "{text}"
        );
        assert!(lines[2].ends_with("gaps left   not graded yet"), "{text}");
        assert!(
            text.contains("part1 23.5 of 40, part2 not graded yet"),
            "{text}"
        );
        assert!(text.contains("Next: part1.task2"), "{text}");
        assert!(
            text.contains("\nIts chapter: cargo grader book part1.task2\n"),
            "{text}"
        );
        assert!(lines.iter().all(|line| columns(line) <= 80), "{text}");
    }

    #[test]
    fn a_stage_that_does_not_compile_is_told_instead_of_no_points() {
        let mut task = known("part1.task1", &[], Some(0.0), false);
        if let Some(last) = &mut task.last {
            last.status = status_text(&Status::DoesNotCompile);
        }
        let text = format_status(&[task], Page::default());
        assert!(text.contains("written     does not compile"), "{text}");
    }

    #[test]
    fn no_title_is_cut_on_a_narrow_page() {
        let tasks = [known("part1.task2", &[], Some(3.5), true)];
        for width in [40, 60, 80] {
            let page = Page {
                width,
                ..Page::default()
            };
            let text = format_status(&tasks, page);
            let words: Vec<&str> = text.split_whitespace().collect();
            let words = words.join(" ");
            let whole = "Direct light by hemisphere sampling written 3.5/20 before edit";
            assert!(words.contains(whole), "{width}: {text}");
            assert!(
                text.lines().all(|line| columns(line) <= width),
                "{width}: {text}"
            );
        }
    }
}
