//! Explains a stage that compiles, but whose functions the worker cannot call: a signature changed.
//! Lists the signatures that the worker expects ([`stage_functions`]).

use crate::build::compile_errors;
use crate::course::sources::{self, SourceFile};
use std::fmt::Write;
use std::path::Path;

/// The signatures that the workers expect, each in a line that ends with `;`.
const EXPECTED: &str = include_str!("stage_signatures.txt");

/// A function of a stage, as the workers call it.
#[derive(Clone, Debug)]
pub struct StageFunction {
    /// Its signature, from `pub fn` to the result.
    pub signature: &'static str,
    /// Its name.
    pub name: &'static str,
    /// The names of its arguments, in order; a pattern such as `(x, y)` is one.
    pub arguments: Vec<String>,
}

/// The functions of the stages that the workers call: what students write, and `rate_colour`.
pub fn stage_functions() -> impl Iterator<Item = StageFunction> {
    expected().filter_map(|signature| {
        let (arguments, _) = arguments_and_result(signature);
        let name_of = |argument: &String| argument.split(": ").next().map(str::to_owned);
        Some(StageFunction {
            signature,
            name: name(signature)?,
            arguments: arguments.iter().filter_map(name_of).collect(),
        })
    })
}

fn expected() -> impl Iterator<Item = &'static str> {
    let lines = EXPECTED.lines().filter(|line| line.starts_with("pub fn "));
    lines.map(|line| line.trim_end_matches(';'))
}

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
    let paragraphs = expected().filter_map(|expected| {
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
    let (arguments, result) = arguments_and_result(signature);
    let of_type = |text: &String| match text.split_once(": ") {
        Some((_, of_type)) => of_type.to_owned(),
        None => text.clone(),
    };
    let arguments = arguments.iter().map(of_type);
    [result].into_iter().chain(arguments).collect()
}

/// The arguments, each as `name: type`, and the result with its arrow.
fn arguments_and_result(signature: &str) -> (Vec<String>, String) {
    let (head, result) = match end_of_arguments(signature) {
        Some(end) => signature.split_at(end),
        None => (signature, ""),
    };
    let mut arguments = Vec::new();
    let list = head.split_once('(').map_or("", |(_, arguments)| arguments);
    let mut depth = 0_i32;
    let mut argument = String::new();
    for c in list.chars().chain([',']) {
        depth += match c {
            '(' | '<' | '[' => 1,
            ')' | ']' => -1,
            // Not the arrow of a function's result.
            '>' if !argument.ends_with('-') => -1,
            _ => 0,
        };
        if c == ',' && depth <= 0 {
            arguments.push(std::mem::take(&mut argument).trim().to_owned());
        } else {
            argument.push(c);
        }
    }
    (arguments, result.trim().to_owned())
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
    fn arguments_are_named() {
        let arguments = |name: &str| {
            let found = stage_functions().find(|function| function.name == name);
            found.expect("a function").arguments.join("; ")
        };
        assert_eq!(arguments("intersect_bvh"), "bvh; ray; world");
        assert_eq!(
            arguments("raytrace_pixel_adaptive"),
            "(x, y); film; budget; sampler; camera_ray; trace_ray; stop"
        );
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
