//! Explains a stage that compiles, but whose functions the worker cannot call: a signature changed.

use crate::build::compile_errors;
use crate::course::sources::{self, SourceFile};
use std::fmt::Write;
use std::path::Path;

/// The signatures that the workers expect, each in a line that ends with `;`.
const EXPECTED: &str = include_str!("stage_signatures.txt");

/// The most lines of the compiler's message, where no signature differs.
const LINES: usize = 10;

/// Says which functions of `stage`, in the workspace `root`, do not have the signature that the
/// worker expects. If all have it (a type of them changed, for example), the text is the first of
/// the compiler's `messages` about the worker.
pub(crate) fn explain(root: &Path, stage: &str, messages: &str) -> String {
    let files = sources::read(root, stage).unwrap_or_default();
    let changed = changed(stage, &files, messages);
    if !changed.is_empty() {
        return changed.concat();
    }
    let (first, _) = compile_errors::first(messages);
    let lines = first.lines().take(LINES);
    let mut text = format!(
        "error: stages/{stage} compiles, but the grader cannot call its functions. The compiler says:\n"
    );
    lines.for_each(|line| {
        let _ = writeln!(text, "{line}");
    });
    text
}

/// A paragraph for each function that differs. A function that `files` do not have only counts if
/// the compiler mentions it.
fn changed(stage: &str, files: &[SourceFile], messages: &str) -> Vec<String> {
    let expected = EXPECTED.lines().filter(|line| line.starts_with("pub fn "));
    let paragraphs = expected.filter_map(|line| {
        let expected = line.trim_end_matches(';');
        let name = name(expected)?;
        let found = files.iter().find_map(|file| {
            let found = sources::body(&file.text, name)?.split('{').next()?;
            Some((file, in_one_line(found)))
        });
        match found {
            Some((_, found)) if types(&found) == types(expected) => None,
            Some((file, found)) => Some(format!(
                "error: {}: `{name}` must have the signature\n    {expected}\n  found\n    {found}\n\n",
                file.path
            )),
            None if messages.contains(&format!("`{name}`")) => Some(format!(
                "error: stages/{stage}/src has no public function `{name}`; expected\n    {expected}\n\n"
            )),
            None => None,
        }
    });
    paragraphs.collect()
}

/// The name of the function.
fn name(signature: &str) -> Option<&str> {
    let rest = signature.strip_prefix("pub fn ")?;
    rest.split(['(', '<']).next()
}

/// The text with single spaces and without the comma after the last argument.
fn in_one_line(signature: &str) -> String {
    let words: Vec<&str> = signature.split_whitespace().collect();
    let line = words.join(" ").replace("( ", "(");
    line.replace(", )", ")").replace(",)", ")")
}

/// The types of the arguments and of the result: what stays if the arguments are renamed.
fn types(signature: &str) -> Vec<String> {
    let (head, result) = match end_of_arguments(signature) {
        Some(end) => signature.split_at(end),
        None => (signature, ""),
    };
    let mut types = vec![result.trim().to_owned()];
    let arguments = head.split_once('(').map_or("", |(_, arguments)| arguments);
    let mut depth = 0_i32;
    let mut argument = String::new();
    for c in arguments.chars().chain([',']) {
        depth += match c {
            '(' | '<' | '[' => 1,
            ')' | ']' => -1,
            // Not the arrow of a function's result.
            '>' if !argument.ends_with('-') => -1,
            _ => 0,
        };
        if c == ',' && depth <= 0 {
            let text = std::mem::take(&mut argument);
            let of_type = text
                .split_once(": ")
                .map_or(text.as_str(), |(_, of_type)| of_type);
            types.push(of_type.trim().to_owned());
        } else {
            argument.push(c);
        }
    }
    types
}

/// Where the list of arguments ends: behind the bracket that closes the first one.
fn end_of_arguments(signature: &str) -> Option<usize> {
    let start = signature.find('(')?;
    let mut depth = 0_i32;
    for (at, c) in signature[start..].char_indices() {
        depth += match c {
            '(' => 1,
            ')' => -1,
            _ => 0,
        };
        if depth == 0 {
            return Some(start + at);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::of_this_checkout;

    fn explained(text: &str, messages: &str) -> Vec<String> {
        let file = SourceFile {
            path: "stages/intersect/src/sphere.rs".into(),
            text: text.into(),
        };
        changed("intersect", &[file], messages)
    }

    #[test]
    fn the_expected_signatures_are_those_of_the_reference() {
        let (workspace, course) = of_this_checkout();
        for task in course.tasks() {
            let files = sources::read(workspace.root(), &task.stage).unwrap();
            for hole in &task.holes {
                let mut expected = EXPECTED
                    .lines()
                    .filter(|line| name(line) == Some(hole.as_str()));
                assert!(expected.next().is_some(), "no signature of `{hole}`");
            }
            let names = |paragraph: &String| {
                task.holes
                    .iter()
                    .any(|hole| paragraph.contains(&format!("`{hole}`")))
            };
            let differing: Vec<String> = changed(&task.stage, &files, "")
                .into_iter()
                .filter(names)
                .collect();
            assert_eq!(differing, [""; 0]);
        }
    }

    #[test]
    fn another_type_is_told_and_another_name_of_an_argument_is_not() {
        let same =
            "pub fn test_sphere(\n    ball: &Sphere,\n    mut ray: &Ray,\n) -> Option<f64> {\n}\n";
        assert_eq!(explained(same, ""), [""; 0]);
        let other = "pub fn test_sphere(s: &Sphere, ray: &mut Ray) -> Option<f64> {\n}\n";
        assert_eq!(
            explained(other, ""),
            [
                "error: stages/intersect/src/sphere.rs: `test_sphere` must have the signature\n    pub fn test_sphere(s: &Sphere, ray: &Ray) -> Option<f64>\n  found\n    pub fn test_sphere(s: &Sphere, ray: &mut Ray) -> Option<f64>\n\n"
            ]
        );
        for other in [
            "pub fn test_sphere(s: &Sphere, ray: &Ray) -> f64 {\n}\n",
            "pub fn test_sphere(s: &Sphere) -> Option<f64> {\n}\n",
            "pub fn test_sphere(ray: &Ray, s: &Sphere) -> Option<f64> {\n}\n",
        ] {
            assert_eq!(explained(other, "").len(), 1, "{other}");
        }
    }

    #[test]
    fn a_function_that_is_gone_is_told_if_the_compiler_misses_it() {
        let message = "error[E0425]: cannot find function `test_sphere` in crate `intersect`";
        let told = explained("fn test_sphere() {}\n", message);
        assert!(told[0].contains("stages/intersect/src has no public function `test_sphere`"));
        assert_eq!(told.len(), 1);
    }
}
