//! The choices of the section "Predict", for the page.
//!
//! They stand in `src/predictions.toml`, which `cargo grader predict` reads, too. The page asks
//! with the script `predict.js`: without it the form stays hidden, and the questions of the chapter
//! can be read.

use crate::page::escaped;
use std::fmt::Write;
use std::path::Path;

/// The form of the chapter at `path`, or nothing for a chapter without choices.
pub(crate) fn form(path: &Path) -> Result<Option<String>, String> {
    let file = crate::folder().join("src/predictions.toml");
    let failed = |why: String| format!("{}: {why}", file.display());
    let text = std::fs::read_to_string(&file).map_err(|error| failed(error.to_string()))?;
    let table: toml::Table = text
        .parse()
        .map_err(|error: toml::de::Error| failed(error.to_string()))?;
    let name = path.with_extension("").display().to_string();
    let questions = name
        .split_once('/')
        .and_then(|(part, task)| table.get(part)?.get(task)?.as_table());
    let Some(questions) = questions else {
        return Ok(None);
    };
    let mut html = format!(
        "<form class=\"predict\" data-predict=\"{}\" hidden>\n",
        name.replace('/', ".")
    );
    for (number, choices) in questions {
        let _ = writeln!(
            html,
            "<fieldset data-question=\"{number}\"><legend>Question {number}: what do you expect?</legend>"
        );
        for choice in choices.as_array().into_iter().flatten() {
            let part = |i: usize| choice.get(i).and_then(toml::Value::as_str).map(escaped);
            let text = part(0).ok_or_else(|| {
                failed(format!("{name}, question {number}: expected lists of text"))
            })?;
            let why = part(1).map_or(String::new(), |why| format!(" data-why=\"{why}\""));
            let _ = writeln!(html, "<button type=\"button\"{why}>{text}</button>");
        }
        html.push_str("<p role=\"status\"></p>\n</fieldset>\n");
    }
    html.push_str("</form>\n");
    Ok(Some(html))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_task_has_a_form_and_a_part_has_none() {
        let form = form(Path::new("part1/task3.md"))
            .expect("the file is right")
            .expect("a form");
        assert_eq!(form.matches("<fieldset ").count(), 2, "{form}");
        assert!(
            form.contains("data-predict=\"part1.task3\" hidden"),
            "{form}"
        );
        // One choice of each question is right, and gives no reason why not.
        assert_eq!(
            form.matches("<button ").count() - form.matches("data-why=").count(),
            2,
            "{form}"
        );
        // A blank line would end the block of HTML.
        assert!(!form.contains("\n\n"), "{form}");
        assert_eq!(super::form(Path::new("part1/README.md")), Ok(None));
    }
}
