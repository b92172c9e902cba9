//! A round of exercises: chooses and asks them, and repeats those that were missed.

use super::exercise::Exercise;
use crate::predict::draw::Draw;
use crate::predict::questions::{Choice, Question};
use crate::predict::session::Session;
use base::{GraderError, Workspace, write_whole};
use std::collections::{BTreeSet, VecDeque};
use std::fs;
use std::path::PathBuf;

/// The number of exercises of a round.
const ROUND: usize = 8;

/// The number of names to choose from.
const NAMES: usize = 4;

/// The result of a round.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Outcome {
    /// The exercises that were recognized at once.
    pub at_once: usize,
    /// The exercises that were asked.
    pub asked: usize,
    /// The names of the exercises that the next round begins with.
    pub missed: BTreeSet<String>,
}

/// Chooses the exercises of a round: first those that were missed before.
pub fn chosen(mut all: Vec<Exercise>, missed: &BTreeSet<String>, seed: u64) -> Vec<Exercise> {
    Draw::of([0, 0], seed).shuffle(&mut all);
    all.sort_by_key(|exercise| !missed.contains(&exercise.id()));
    all.truncate(ROUND);
    all
}

/// Asks until each exercise was recognized once, or the input ends. `show` shows the picture of an
/// exercise.
pub fn run(
    session: &mut Session,
    exercises: Vec<Exercise>,
    show: &mut dyn FnMut(&Exercise) -> Result<(), GraderError>,
    seed: u64,
) -> Result<Outcome, GraderError> {
    let mut outcome = Outcome::default();
    let mut waiting: VecDeque<Exercise> = exercises.into();
    let mut number = 0;
    while let Some(exercise) = waiting.pop_front() {
        number += 1;
        show(&exercise)?;
        for call in &exercise.calls {
            session.say(&format!("  {call}"));
        }
        let question = question(&exercise, seed);
        let Some(answer) = session.choice(number, &question, seed)? else {
            outcome.missed.insert(exercise.id());
            outcome.missed.extend(waiting.iter().map(Exercise::id));
            return Ok(outcome);
        };
        session.say(&format!(
            "   {} {}#the-derivation",
            exercise.hint, exercise.chapter
        ));
        let is_first = !outcome.missed.contains(&exercise.id());
        outcome.asked += usize::from(is_first);
        if answer.is_right {
            outcome.at_once += usize::from(is_first);
            continue;
        }
        outcome.missed.insert(exercise.id());
        // A skipped exercise comes in the next round.
        if !answer.typed.is_empty() {
            waiting.push_back(exercise);
        }
    }
    Ok(outcome)
}

/// A question with [`NAMES`] names, the right one first. Each wrong one says what one would see.
fn question(exercise: &Exercise, seed: u64) -> Question {
    let (right, others) = exercise.names.split_at(1);
    let mut others = others.to_vec();
    let mut draw = Draw::of([exercise.panel, 1], seed);
    while others.len() >= NAMES {
        others.swap_remove(draw.below(others.len()));
    }
    let choice = |[name, seen]: &[String; 2], is_right: bool| Choice {
        text: name.clone(),
        why_not: (!is_right).then(|| format!("With that, one sees: {seen}.")),
    };
    let choices = right.iter().map(|row| choice(row, true));
    Question {
        text: exercise.text(),
        choices: choices
            .chain(others.iter().map(|row| choice(row, false)))
            .collect(),
    }
}

fn file(workspace: &Workspace) -> PathBuf {
    workspace.outputs().join("gym.json")
}

/// Reads the names of the exercises that were missed in earlier rounds.
pub fn missed(workspace: &Workspace) -> BTreeSet<String> {
    let text = fs::read_to_string(file(workspace)).unwrap_or_default();
    // A damaged list is as good as none: it only decides the order.
    serde_json::from_str(&text).unwrap_or_default()
}

/// Stores the names of the missed exercises.
pub fn store(workspace: &Workspace, missed: &BTreeSet<String>) -> Result<(), GraderError> {
    workspace.create_outputs()?;
    let text = serde_json::to_string_pretty(missed).map_err(|e| GraderError::new(e.to_string()))?;
    write_whole(&file(workspace), text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exercise(name: &str) -> Exercise {
        let names =
            [name, "b", "c", "d", "e"].map(|name| [name.to_string(), format!("what {name} does")]);
        Exercise {
            task: "part1.task1".into(),
            names: names.to_vec(),
            sheet: PathBuf::new(),
            panel: 1,
            calls: vec!["a call".into()],
            hint: "Look.".into(),
            chapter: "a.md".into(),
        }
    }

    /// The letters of the names in the questions of a round, in order, and the outcome.
    fn play(mut pick: impl FnMut(usize) -> &'static str, names: &[&str]) -> (String, Outcome) {
        let mut input: Vec<u8> = Vec::new();
        for i in 0..12 {
            input.extend(pick(i).bytes());
            input.push(b'\n');
        }
        let mut text = String::new();
        let mut shown = 0;
        let mut input = input.as_slice();
        let mut session = Session {
            has_quit: false,
            input: &mut input,
            print: &mut |more| text.push_str(more),
            echoes: false,
            width: 200,
        };
        let exercises = names.iter().map(|name| exercise(name)).collect();
        let show = &mut |_: &Exercise| {
            shown += 1;
            Ok(())
        };
        let outcome = run(&mut session, exercises, show, 1).expect("the input can be read");
        assert!(shown >= outcome.asked);
        (text, outcome)
    }

    #[test]
    fn what_is_missed_comes_again_until_it_is_recognized() {
        let (text, outcome) = play(|i| ["a", "b", "c", "d"][i % 4], &["x"]);
        assert_eq!(outcome.asked, 1);
        assert!(text.contains("Right."), "{text}");
        let wrong = text.matches("With that, one sees: what ").count();
        assert_eq!(outcome.at_once, usize::from(wrong == 0));
        assert_eq!(outcome.missed.len(), usize::from(wrong > 0));
        assert!(text.contains("Look. a.md#the-derivation"), "{text}");
        assert_eq!(text.matches("a call").count(), wrong + 1);
    }

    #[test]
    fn skipped_exercises_come_in_the_next_round_first() {
        let (_, outcome) = play(|_| "", &["x", "y"]);
        assert_eq!(
            (outcome.asked, outcome.at_once, outcome.missed.len()),
            (2, 0, 2)
        );
        let all: Vec<Exercise> = ["p", "q", "r", "s", "t", "u", "v", "w", "x", "y"]
            .map(exercise)
            .to_vec();
        let next = chosen(all, &outcome.missed, 5);
        assert_eq!(next.len(), ROUND);
        assert!(
            next[..2]
                .iter()
                .all(|exercise| outcome.missed.contains(&exercise.id()))
        );
    }

    #[test]
    fn four_names_are_shown_and_one_is_right() {
        let question = question(&exercise("x"), 3);
        assert_eq!(question.choices.len(), NAMES);
        assert_eq!(question.choices[0].text, "x");
        assert_eq!(
            question
                .choices
                .iter()
                .filter(|choice| choice.why_not.is_none())
                .count(),
            1
        );
    }
}
