//! Writes the README of a handout from the template `student.md`.

use base::GraderError;
use files::file_tree::Files;
use grader::course::sources::{defines_function, holes};
use grader::course::{Course, Part, Task, stages_of};
use grader::grade::picture::file_stem;
use judge::Tier;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;

const TEMPLATE: &str = include_str!("student.md");

/// Formats the README of the handout of `part`, whose code is in `files`.
pub fn write(course: &Course, part: u32, files: &Files) -> Result<String, GraderError> {
    let here = course
        .parts
        .iter()
        .find(|p| p.number == part)
        .ok_or_else(|| GraderError::new(format!("the course has no part {part}")))?;
    let mut tasks = String::new();
    let to_write = course.parts.iter().filter(|p| p.number >= part);
    for part in to_write.clone() {
        tasks.push_str(&section(part, files)?);
        tasks.push('\n');
    }
    let stages = match stages_of(to_write.flat_map(|part| &part.tasks)).as_slice() {
        [one] => (*one).to_string(),
        several => format!("{{{}}}", several.join(",")),
    };
    let conventions: String = course
        .conventions
        .iter()
        .flat_map(|line| ["- ", line, "\n"])
        .collect();
    let first_task = here.tasks.first().map_or("all", |task| &task.key);
    Ok(TEMPLATE
        .replace("{term}", &term(course))
        .replace("{version}", base::VERSION)
        .replace("{part}", &part.to_string())
        .replace("{given}", &given(course, part))
        .replace("{first_task}", first_task)
        .replace("{first_stem}", &file_stem(first_task))
        .replace("{tasks}", &tasks)
        .replace("{ungraded}", &ungraded(course, part, files))
        .replace("{conventions}", &conventions)
        .replace("{stages}", &stages))
}

/// The name and the dates of a teacher's course.
fn term(course: &Course) -> String {
    let Some(term) = &course.term else {
        return String::new();
    };
    match term.table().as_str() {
        "" => format!("**{}**\n\n", term.title()),
        table => format!("**{}**\n\n{table}\n", term.title()),
    }
}

/// A sentence about the parts that the handout contains already.
fn given(course: &Course, part: u32) -> String {
    let before: Vec<String> = course
        .parts
        .iter()
        .filter(|p| p.number < part)
        .map(|p| p.number.to_string())
        .collect();
    match before.as_slice() {
        [] => "The code that all stages share is given.".into(),
        [one] => format!("Part {one} is already complete: it contains the course's own solution."),
        [many @ .., last] => format!(
            "Parts {} and {last} are already complete: they contain the course's own solutions.",
            many.join(", ")
        ),
    }
}

/// Formats the tasks of one part as a table.
fn section(part: &Part, files: &Files) -> Result<String, GraderError> {
    let mut text = format!("### Part {}: {}\n\n", part.number, part.title);
    text.push_str(
        "| task | title | functions | file | core | extra |\n|---|---|---|---|--:|--:|\n",
    );
    for task in &part.tasks {
        let mut found = BTreeSet::new();
        for hole in &task.holes {
            found.insert(defining_file(task, hole, files)?);
        }
        let holes: Vec<String> = task.holes.iter().map(|hole| format!("`{hole}`")).collect();
        let found: Vec<String> = found.iter().map(|path| format!("`{path}`")).collect();
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} |",
            task.key,
            linked_title(task, files),
            holes.join(", "),
            found.join(", "),
            task.points(Tier::Core),
            task.points(Tier::Robust),
        );
    }
    Ok(text)
}

/// A sentence about each function with a hole that no task lists: it is not graded, but the
/// renderer needs it.
fn ungraded(course: &Course, part: u32, files: &Files) -> String {
    let mut text = String::new();
    for task in course
        .parts
        .iter()
        .filter(|p| p.number >= part)
        .flat_map(|p| &p.tasks)
    {
        let folder = Path::new("stages").join(&task.stage).join("src");
        for (path, contents) in files.iter().filter(|(path, _)| path.starts_with(&folder)) {
            let code = String::from_utf8_lossy(contents);
            for before in holes(&code, &task.key) {
                let Some((name, about)) = last_function(before) else {
                    continue;
                };
                if !task.holes.iter().any(|hole| hole == name) {
                    let path = path.display();
                    let _ = writeln!(text, "- `{name}` in `{path}`, with {}: {about}", task.key);
                }
            }
        }
    }
    match text.as_str() {
        "" => text,
        _ => format!("These functions are not graded, but the renderer needs them:\n\n{text}\n"),
    }
}

/// The last function that begins in `code`: its name and the first paragraph of its doc
/// comment.
fn last_function(code: &str) -> Option<(&str, String)> {
    let start = code.rfind("fn ")?;
    let name = code[start + 3..].split(['(', '<']).next()?;
    let lines = code[..start].lines().rev().skip_while(|line| {
        let line = line.trim();
        !line.starts_with("///")
    });
    let mut doc: Vec<&str> = lines
        .map_while(|line| line.trim().strip_prefix("///"))
        .map(str::trim)
        .collect();
    doc.reverse();
    let first = doc.split(|line| line.is_empty()).next().unwrap_or_default();
    Some((name, first.join(" ")))
}

/// The path of the file that defines the function `hole`.
fn defining_file(task: &Task, hole: &str, files: &Files) -> Result<String, GraderError> {
    let folder = Path::new("stages").join(&task.stage).join("src");
    let defines = |text: &[u8]| defines_function(&String::from_utf8_lossy(text), hole);
    let found = files
        .iter()
        .find(|(path, text)| path.starts_with(&folder) && defines(text));
    let (path, _) = found.ok_or_else(|| {
        GraderError::new(format!(
            "course.toml lists the function `{hole}` for {}, but no file below {} has a `pub fn {hole}`",
            task.key,
            folder.display()
        ))
    })?;
    Ok(path.display().to_string())
}

/// The title of the task, with a link to its chapter of the book if there is one.
fn linked_title(task: &Task, files: &Files) -> String {
    let chapter = format!("stages/book/src/{}.md", task.key.replace('.', "/"));
    if files.contains_key(Path::new(&chapter)) {
        format!("[{}]({chapter})", task.title)
    } else {
        task.title.clone()
    }
}
