//! The questions of a chapter. Their text is in the chapter, their choices are in
//! `predictions.toml`.

use crate::course::chapter;
use base::{GraderError, Workspace};
use std::fs;
use std::path::Path;

/// The file with the choices.
pub const FILE: &str = "stages/book/src/predictions.toml";

/// A question with its choices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Question {
    /// The text, in one line.
    pub text: String,
    /// The choices. The first one is right.
    pub choices: Vec<Choice>,
}

/// A possible answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// What it says.
    pub text: String,
    /// Why it is wrong; nothing for the right one.
    pub why_not: Option<String>,
}

/// The two questions about the task `key`.
pub fn of(workspace: &Workspace, key: &str) -> Result<Vec<Question>, GraderError> {
    let chapter = chapter::chapter(key)
        .ok_or_else(|| GraderError::new(format!("the task `{key}` has no chapter")))?;
    let path = workspace.root().join(chapter);
    let read =
        |path: &Path| fs::read_to_string(path).map_err(|e| GraderError::file("read", path, e));
    let texts = texts(&read(&path)?);
    let file = workspace.root().join(FILE);
    let choices =
        choices(&read(&file)?, key).map_err(|why| GraderError::new(format!("{FILE}: {why}")))?;
    if texts.len() != choices.len() {
        return Err(GraderError::new(format!(
            "{} asks {} questions, {FILE} has choices for {}",
            path.display(),
            texts.len(),
            choices.len()
        )));
    }
    let both = texts.into_iter().zip(choices);
    Ok(both
        .map(|(text, choices)| Question { text, choices })
        .collect())
}

/// The questions of the section "Predict" in a chapter: the items of its list, without the marks of
/// Markdown.
pub fn texts(chapter: &str) -> Vec<String> {
    let section = chapter::under(chapter, "Predict")
        .split("<details>")
        .next()
        .unwrap_or_default();
    let mut found: Vec<String> = Vec::new();
    for line in section.lines() {
        let number = format!("{}. ", found.len() + 1);
        if let Some(start) = line.strip_prefix(&number) {
            found.push(start.into());
        } else if let (Some(last), true) = (found.last_mut(), line.starts_with("   ")) {
            last.push(' ');
            last.push_str(line.trim());
        }
    }
    found
        .into_iter()
        .map(|text| text.replace(['*', '`'], ""))
        .collect()
}

/// The choices of the questions of a task.
fn choices(text: &str, key: &str) -> Result<Vec<Vec<Choice>>, String> {
    let table: toml::Table = text.parse().map_err(|e: toml::de::Error| e.to_string())?;
    let of_task = key
        .split_once('.')
        .and_then(|(part, task)| table.get(part)?.get(task)?.as_table())
        .ok_or_else(|| format!("it has no choices for `{key}`"))?;
    let choice = |entry: &toml::Value| {
        let parts: Option<Vec<String>> = entry
            .as_array()?
            .iter()
            .map(|part| part.as_str().map(String::from))
            .collect();
        let mut parts = parts?.into_iter();
        let text = parts.next()?;
        Some(Choice {
            text,
            why_not: parts.next(),
        })
    };
    let mut found = Vec::new();
    for number in 1..=of_task.len() {
        let list = of_task
            .get(&number.to_string())
            .and_then(toml::Value::as_array);
        let list: Option<Vec<Choice>> = list.and_then(|list| list.iter().map(choice).collect());
        let is_sound = |list: &Vec<Choice>| {
            list.len() >= 2
                && list
                    .iter()
                    .enumerate()
                    .all(|(i, choice)| choice.why_not.is_none() == (i == 0))
        };
        let list = list.filter(is_sound).ok_or_else(|| {
            format!("expected {number} = [[\"the right choice\"], [\"another one\", \"why not\"], ...] in [{key}]")
        })?;
        found.push(list);
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course;

    #[test]
    fn each_task_has_two_questions_with_choices() {
        let (workspace, course) = course::of_this_checkout();
        for task in course.tasks() {
            let questions = of(&workspace, &task.key).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(questions.len(), 2, "{}", task.key);
            assert!(
                questions
                    .iter()
                    .all(|question| question.text.ends_with('?')),
                "{}: {questions:?}",
                task.key
            );
        }
    }

    #[test]
    fn a_question_without_a_right_choice_is_an_error() {
        let error = choices(
            "[part1.task1]\n1 = [[\"a\", \"no\"], [\"b\"]]\n",
            "part1.task1",
        )
        .unwrap_err();
        assert!(
            error.contains("expected 1 = [[\"the right choice\"]"),
            "{error}"
        );
        let error = choices("", "part1.task1").unwrap_err();
        assert!(error.contains("no choices for `part1.task1`"), "{error}");
    }
}
