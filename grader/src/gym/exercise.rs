//! The exercises of a task, from the section "Mistakes" of its chapter.

use super::mistake_sheet::{self, TILE};
use crate::course::packed;
use crate::course::{Task, chapter};
use crate::diagnosis::{self, Known};
use crate::report::message;
use crate::report::wrap::{one_line, shorten_numbers};
use crate::signature::WrongCall;
use base::{GraderError, Workspace};
use judge::cases::Spec;
use judge::findings::{Aspect, Class};
use judge::snapshot;
use pictures::image::Image;
use pictures::png;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// Columns of an input or an answer.
const ROOM: usize = 200;

/// The significant digits of a number: a mistake is recognized without the others.
const DIGITS: usize = 3;

/// The most calls that an exercise shows.
const CALLS: usize = 3;

/// A mistake to recognize.
#[derive(Clone, Debug)]
pub struct Exercise {
    /// The task's key.
    pub task: String,
    /// The names of all mistakes of the chapter, each with what one sees in a picture. The first
    /// name is that of the mistake to recognize.
    pub names: Vec<[String; 2]>,
    /// The file with its picture.
    pub sheet: PathBuf,
    /// The place of its picture in the file, from the left. The right picture is at 0.
    pub panel: u32,
    /// Calls that the mistake makes wrong: input, expected answer, what is wrong.
    pub calls: Vec<String>,
    /// Where in the code to look for the mistake.
    pub hint: String,
    /// The chapter, below the root.
    pub chapter: String,
}

impl Exercise {
    /// The name of the exercise in the list of missed ones.
    pub fn id(&self) -> String {
        format!("{}: {}", self.task, self.names[0][0])
    }

    /// The question: what one sees in the picture of the mistake.
    pub fn text(&self) -> String {
        let seen = &self.names[0][1];
        format!("{}: one sees: {seen}. Which code does that?", self.task)
    }

    /// The right picture beside that of the mistake.
    pub fn picture(&self) -> Result<Image, GraderError> {
        let failed =
            |why: String| GraderError::new(format!("cannot read {}: {why}", self.sheet.display()));
        let sheet = png::read(&self.sheet).map_err(failed)?;
        let [width, height] = TILE;
        let tile = |number: u32| {
            mistake_sheet::picture(&sheet, number).ok_or_else(|| {
                failed(format!(
                    "expected panel {} of {width} by {height} pixels",
                    self.panel
                ))
            })
        };
        let second = mistake_sheet::left(1);
        let mut both = Image::filled([second + width, height], [255; 3]);
        both.paste(&tile(0)?, 0, 0);
        both.paste(&tile(self.panel)?, second, 0);
        Ok(both)
    }
}

/// The exercises of `task`: the mistakes that its chapter has pictures of.
pub fn of(
    workspace: &Workspace,
    task: &Task,
    specs: &[Spec],
) -> Result<Vec<Exercise>, GraderError> {
    let Some(chapter) = chapter::chapter(&task.key) else {
        return Ok(Vec::new());
    };
    let path = workspace.root().join(&chapter);
    let text = std::fs::read_to_string(&path).map_err(|e| GraderError::file("read", &path, e))?;
    let all_known = diagnosis::known(workspace, &task.key)?;
    let table = names(&text);
    let mut shown = BTreeSet::new();
    let mut found = Vec::new();
    for (i, name) in pictured(&text).into_iter().enumerate() {
        let Some(row) = table.iter().position(|row| row[0] == name) else {
            continue;
        };
        let mut names = table.clone();
        names.swap(0, row);
        let known = all_known
            .iter()
            .find(|known| known.descriptions == [name.as_str()]);
        let mut calls =
            known.map_or(Ok(Vec::new()), |known| calls(workspace, task, specs, known))?;
        // What other mistakes do as well comes last.
        calls.sort_by_key(|call| shown.contains(call));
        calls.truncate(CALLS);
        shown.extend(calls.iter().cloned());
        found.push(Exercise {
            task: task.key.clone(),
            names,
            sheet: mistake_sheet::file(workspace, &task.key),
            panel: i as u32 + 1,
            calls,
            hint: known
                .and_then(|known| known.hints.first().cloned())
                .unwrap_or_default(),
            chapter: chapter.clone(),
        });
    }
    Ok(found)
}

/// Calls that the mistake makes wrong, each of another case, with short numbers.
fn calls(
    workspace: &Workspace,
    task: &Task,
    specs: &[Spec],
    known: &Known,
) -> Result<Vec<String>, GraderError> {
    let spec_of = |case: &str| specs.iter().find(|spec| spec.is(&task.key, case));
    let wrong = known
        .signature
        .wrong_calls(&|case| spec_of(case).map(Spec::calls));
    // Of each case the call that is shortest to read, and of these the shortest.
    let mut shortest: BTreeMap<String, (usize, WrongCall, String)> = BTreeMap::new();
    for wrong in wrong {
        let spec = spec_of(&wrong.case);
        let Some(input) = spec.and_then(|spec| spec.input(wrong.call as usize)) else {
            continue;
        };
        let length = digits(&input);
        let known = shortest.get(&wrong.case);
        if known.is_none_or(|(known, ..)| length < *known) {
            shortest.insert(wrong.case.clone(), (length, wrong, input));
        }
    }
    let mut shortest: Vec<_> = shortest.into_values().collect();
    shortest.sort_by_key(|(length, ..)| *length);
    let mut texts = Vec::new();
    for (_, wrong, input) in shortest {
        let golden = packed::read_snapshot(workspace, &task.key, &wrong.case)?
            .and_then(|text| snapshot::parse(&text).ok());
        let answer = golden
            .as_ref()
            .and_then(|golden| Some(golden.row(wrong.call)?.answer_text()));
        if let Some(answer) = answer {
            let instead = instead(&wrong, &answer);
            let (input, answer) = (short(&input), short(&answer));
            texts.push(format!(
                "{input}. Right: {answer}. With the mistake: {instead}."
            ));
        }
    }
    Ok(texts)
}

/// The wrong answer in place of the right one, as far as the stored signature tells it.
fn instead(wrong: &WrongCall, right: &str) -> String {
    let label = wrong.aspect.label();
    let what = match wrong.class {
        Some(Class::Zero) => "is 0",
        Some(Class::NotANumber) => "is NaN",
        Some(Class::Infinite) => "is infinite",
        Some(Class::Negated) => "has the opposite sign",
        Some(Class::OtherSide) => "is on the other side",
        Some(Class::WrongLength) => "has another length",
        Some(Class::TooShort) => "is too short",
        Some(Class::TooLong) => "is too long",
        Some(Class::Swapped) => "has its numbers swapped",
        Some(Class::Ratio(1)) => "is about twice the right one",
        Some(Class::Ratio(-1)) => "is about half the right one",
        Some(Class::Ratio(2)) => "is about four times the right one",
        Some(Class::Ratio(-2)) => "is about a quarter of the right one",
        _ => "",
    };
    match wrong.aspect {
        Aspect::HitOrMiss if right.starts_with("miss") => "a hit".into(),
        Aspect::HitOrMiss => "a miss".into(),
        other if other.is_plural() => format!("other {label}"),
        _ if what.is_empty() => format!("another {label}"),
        _ => format!("{label} {what}"),
    }
}

/// The digits of a text.
fn digits(text: &str) -> usize {
    text.bytes().filter(u8::is_ascii_digit).count()
}

/// The text with short numbers, in one line.
fn short(text: &str) -> String {
    let all = message::on_paper(text);
    let short = shorten_numbers(&all, DIGITS);
    let rounded = if short == all { "" } else { " (rounded)" };
    format!("{}{rounded}", one_line(&short, ROOM))
}

/// The rows of the table of mistakes: the name, and what one sees.
fn names(chapter: &str) -> Vec<[String; 2]> {
    let row = |line: &str| {
        let mut cells = line.strip_prefix("| ")?.split(" | ");
        let seen = cells.next()?;
        let name = cells.next()?.strip_prefix('*')?.strip_suffix('*')?;
        Some([
            name.to_string(),
            seen.trim_end_matches(" (extra)").to_string(),
        ])
    };
    let section = chapter::under(chapter, "Mistakes");
    section.lines().filter_map(row).collect()
}

/// The names of the mistakes on the chapter's sheet, from the left.
fn pictured(chapter: &str) -> Vec<String> {
    let flat = chapter.split_whitespace().collect::<Vec<_>>().join(" ");
    let list = flat
        .split("then the pictures of code that *")
        .nth(1)
        .unwrap_or_default();
    let list = list.split("*.").next().unwrap_or_default();
    let names = list.split("*; *").map(String::from);
    names.filter(|name| !name.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course;

    #[test]
    fn each_task_has_exercises_with_a_picture_names_and_calls() {
        let (workspace, course) = course::of_this_checkout();
        let specs = judge::cases::all(0);
        let (mut all, mut with_calls) = (0, 0);
        for task in course.tasks() {
            let exercises = of(&workspace, task, &specs).unwrap_or_else(|error| panic!("{error}"));
            assert!(exercises.len() >= 2, "{}: {}", task.key, exercises.len());
            let texts: BTreeSet<String> = exercises.iter().map(Exercise::text).collect();
            assert_eq!(texts.len(), exercises.len(), "{}: {texts:?}", task.key);
            for exercise in exercises {
                assert!(exercise.names.len() >= 4, "{}", exercise.id());
                assert!(!exercise.hint.is_empty(), "{} is not known", exercise.id());
                let picture = exercise.picture().unwrap_or_else(|error| panic!("{error}"));
                let [width, height] = TILE;
                let differs = (0..width * height).any(|i| {
                    let (x, y) = (i % width, i / width);
                    picture.get(x, y) != picture.get(mistake_sheet::left(1) + x, y)
                });
                assert!(differs, "{}: both pictures are the same", exercise.id());
                for call in &exercise.calls {
                    let numbers = call.split(|c: char| !c.is_ascii_digit() && c != '.');
                    let decimal = numbers.filter(|number| number.contains('.'));
                    let longest =
                        decimal.map(|number| digits(number.trim_start_matches(['0', '.'])));
                    assert!(longest.max() <= Some(DIGITS), "{call}");
                }
                all += 1;
                with_calls += usize::from(!exercise.calls.is_empty());
            }
        }
        assert!(
            all >= 40 && with_calls >= 25,
            "{with_calls} of {all} have calls"
        );
    }

    /// The golden contradicts the mistake in each call that is shown.
    #[test]
    fn the_calls_of_a_culled_face_are_hits() {
        let (workspace, course) = course::of_this_checkout();
        let specs = judge::cases::of("part1.task3", 0);
        let task = course
            .tasks()
            .find(|task| task.key == "part1.task3")
            .expect("the task");
        let all = of(&workspace, task, &specs).expect("exercises");
        let culls = all
            .iter()
            .find(|exercise| exercise.names[0][0] == "culls back faces")
            .expect("it is pictured");
        assert!(!culls.calls.is_empty());
        for call in &culls.calls {
            assert!(
                call.contains("ray o = ") && call.contains("Right: t="),
                "{call}"
            );
            assert!(call.contains("With the mistake: a miss"), "{call}");
        }
    }
}
