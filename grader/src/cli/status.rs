//! The command `grader status`: what is written, what is left, what comes next. It builds nothing.

use super::Verdict;
use crate::course::Course;
use crate::error::GraderError;
use crate::next_task::{self, Known};
use crate::report::screen::{self, title_width};
use crate::report::table::number;
use crate::report::terminal::{GREEN, Page};
use crate::report::wrap::{columns, one_line, wrap_to};
use crate::workspace::Workspace;
use clap::Command;
use std::path::Path;

pub(super) fn command() -> Command {
    Command::new("status").about(
        "Shows which tasks are written, their last points and what comes next; builds nothing",
    )
}

pub(super) fn run() -> Result<Verdict, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let known = next_task::known(&workspace, &course)?;
    print!("{}", format_status(&known, Page::of_stdout()));
    Ok(Verdict::Passed)
}

/// A line for each task, the points of each part, and the next step.
fn format_status(all: &[Known], page: Page) -> String {
    let mut lines = Vec::new();
    for known in all {
        lines.push(line(
            known,
            next_task::is_given(all, known.part_key()),
            page,
        ));
    }
    lines.push(String::new());
    let parts = all.chunk_by(|a, b| a.part_key() == b.part_key());
    let parts = parts.map(|part_tasks| {
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
    lines
        .iter()
        .flat_map(|line| [line.as_str(), "\n"])
        .collect()
}

/// Columns of whether a task is written.
const WRITTEN: usize = 12;

fn line(known: &Known, is_given: bool, page: Page) -> String {
    let Known {
        place,
        last,
        changed,
    } = known;
    let title = one_line(&place.title, title_width(page));
    let padding = " ".repeat(title_width(page).saturating_sub(columns(&title)));
    let before = format!("{}  {title}{padding} ", place.key);
    // A hole in a function that is not graded does not count.
    let written = match place.open.as_slice() {
        [] => "written",
        [_] => "1 hole left",
        _ => "holes left",
    };
    let points = match last {
        None if is_given => "given".to_owned(),
        None => "not graded yet".to_owned(),
        Some(last) => {
            let points = format!("{}/{}", number(last.score), number(last.max_score));
            let changed = if *changed { " before your edit" } else { "" };
            format!("{points}{changed}")
        }
    };
    let points = one_line(
        &points,
        page.width.saturating_sub(columns(&before) + WRITTEN),
    );
    let state = format!("{written:<WRITTEN$}{points}");
    match page.colours && known.is_complete() {
        true => format!("{before}{GREEN}{state}{GREEN:#}"),
        false => format!("{before}{state}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::TaskScore;
    use crate::sources::Place;

    fn known(key: &str, open: &[&str], score: Option<f64>, changed: bool) -> Known {
        Known {
            place: Place {
                key: key.into(),
                title: "Intersecting things of every kind and shape".into(),
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
        assert!(lines[1].contains("written     3.5/20 before"), "{text}");
        assert!(lines[2].ends_with("holes left  not graded yet"), "{text}");
        assert!(
            text.contains("part1 23.5 of 40, part2 not graded yet"),
            "{text}"
        );
        assert!(text.contains("Next: part1.task2"), "{text}");
        assert!(lines.iter().all(|line| columns(line) <= 80), "{text}");
    }
}
