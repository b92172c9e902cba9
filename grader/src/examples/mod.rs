//! Examples that students write before their code, in `stages/STAGE/examples.toml`: reads them, and
//! says which are right and which situations of the task they touch.

mod file;
mod points;
mod sample;

pub use file::parse;
pub use points::case_of;
pub use sample::sample;

use crate::course::Task;
use base::{GraderError, Workspace};
use judge::examples::{Example, situations_of, verdict};
use judge::plural;
use std::fmt::Write;

/// The name of the file with examples, in the folder of a stage.
pub const FILE: &str = "examples.toml";

/// The text of the file with the examples of a task; `None` if there is none.
pub fn read(workspace: &Workspace, task: &Task) -> Result<Option<String>, GraderError> {
    let path = workspace.root().join("stages").join(&task.stage).join(FILE);
    if !path.exists() {
        return Ok(None);
    }
    let text = std::fs::read_to_string(&path).map_err(|e| GraderError::file("read", &path, e))?;
    Ok(Some(text))
}

/// What the examples of a task are worth.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Review {
    /// For each example what is wrong with it; `None` if it is right.
    pub verdicts: Vec<Option<String>>,
    /// Each situation of the task, with the numbers of the right examples that touch it, from 1.
    pub situations: Vec<(&'static str, Vec<usize>)>,
}

/// Judges the examples of `task`, numbered in their order. An example that is wrong touches
/// nothing. `None` for a task whose examples cannot be judged.
pub fn review(task: &str, examples: &[Example]) -> Option<Review> {
    let of_task: Vec<&Example> = examples.iter().filter(|of| of.task() == task).collect();
    let verdicts: Vec<Option<String>> = of_task.iter().map(|of| verdict(of)).collect();
    let right = of_task
        .iter()
        .zip(&verdicts)
        .enumerate()
        .filter(|(_, (_, verdict))| verdict.is_none());
    let touched: Vec<(usize, Vec<&str>)> = right
        .map(|(at, (of, _))| (at + 1, of.situations()))
        .collect();
    let touching = |situation: &str| {
        let by = touched
            .iter()
            .filter(|(_, touches)| touches.contains(&situation));
        by.map(|(number, _)| *number).collect()
    };
    let situations = situations_of(task)?.iter();
    Some(Review {
        situations: situations.map(|of| (*of, touching(of))).collect(),
        verdicts,
    })
}

impl Review {
    /// Whether every example is right.
    pub fn is_right(&self) -> bool {
        self.wrong() == 0
    }

    /// How many examples are wrong.
    fn wrong(&self) -> usize {
        self.verdicts.iter().flatten().count()
    }

    /// How many situations are touched.
    fn touched(&self) -> usize {
        let touched = self.situations.iter().filter(|(_, by)| !by.is_empty());
        touched.count()
    }

    /// The verdicts, then a table of the situations: by which examples each is touched.
    pub fn text(&self, file: &str, task: &str) -> String {
        let count = self.verdicts.len();
        let right = count - self.wrong();
        let mut text = format!(
            "{file}: {} of {task}, {right} right\n",
            plural(count, "example", "examples")
        );
        for (at, verdict) in self.verdicts.iter().enumerate() {
            if let Some(why) = verdict {
                let _ = writeln!(text, "  {} is wrong: {why}", at + 1);
            }
        }
        let (touched, of) = (self.touched(), self.situations.len());
        let _ = writeln!(text, "\nsituations: {touched} of {of} touched");
        let widest = self.situations.iter().map(|(name, _)| name.len()).max();
        let width = widest.unwrap_or(0);
        for (name, by) in &self.situations {
            let by: Vec<String> = by.iter().map(usize::to_string).collect();
            let by = match by.is_empty() {
                true => "missing".to_owned(),
                false => format!("example {}", by.join(", ")),
            };
            let _ = writeln!(text, "  {name:width$}  {by}");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_samples_are_right_and_touch_a_situation() {
        for task in judge::examples::TASKS {
            let examples = parse(sample(task)).expect("it can be read");
            let review = review(task, &examples).expect("the task has situations");
            assert!(review.is_right() && !review.verdicts.is_empty(), "{task}");
            let touched = |number: usize| {
                let by = review.situations.iter().map(|(_, by)| by);
                by.filter(|by| by.contains(&number)).count()
            };
            for number in 1..=review.verdicts.len() {
                assert_eq!(touched(number), 1, "{task}, example {number}");
            }
        }
    }

    #[test]
    fn a_wrong_example_is_explained_and_touches_nothing() {
        let text = sample("part1.task3").replace("expected = 1 ", "expected = \"miss\" ");
        let examples = parse(&text).expect("it can be read");
        let review = review("part1.task3", &examples).expect("the task has situations");
        assert!(!review.is_right());
        let text = review.text("examples.toml", "part1.task3");
        for line in [
            "examples.toml: 1 example of part1.task3, 0 right\n",
            "  1 is wrong: it says a miss; the ray hits at t = 1: it meets the triangle inside\n",
            "situations: 0 of 13 touched\n",
            "  inside, from the front             missing\n",
        ] {
            assert!(text.contains(line), "no {line:?} in\n{text}");
        }
    }

    #[test]
    fn what_cannot_be_read_is_named_with_its_line() {
        let unknown = parse("[[triangle]]\nq0 = [0, 0, 0]\n")
            .expect_err("q0 is no field")
            .to_string();
        assert!(
            unknown.contains("line 2") && unknown.contains("q0"),
            "{unknown}"
        );
        let text = sample("part1.task4").replace("expected = 2 ", "expected = \"hit\" ");
        let word = parse(&text).expect_err("a hit needs its t").to_string();
        assert!(word.contains("expected \"miss\", the t of a hit"), "{word}");
        let most = sample("part1.task4").repeat(500);
        assert_eq!(parse(&most).map(|all| all.len()).ok(), Some(500));
        let many = parse(&(most + sample("part1.task3"))).expect_err("501");
        assert_eq!(
            many.to_string(),
            "501 examples: expected at most 500 in a file"
        );
        assert!(review("part2.task1", &[]).is_none());
    }
}
