//! Carving one file: solutions out, holes in.
//!
//! A solution stands between two markers that name its task:
//!
//! ```text
//!     // BEGIN SOLUTION(part1.task3)
//!     ...reference...
//!     // STUB: kit::hole!("part1.task3", tri, ray)
//!     // END SOLUTION(part1.task3)
//! ```
//!
//! Where a task is carved, the `STUB` lines take the place of the whole block, indented as its first marker is;
//! a block without them (a helper, an import, a unit test) goes without a trace. Where a task is kept, the
//! reference stays and the markers go: a student reads plain code in either case.

use grader::error::GraderError;
use std::collections::BTreeSet;

/// What carving reads of the course.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Knife {
    /// Keys of all tasks.
    pub known: BTreeSet<String>,
    /// Keys of the tasks to carve.
    pub carved: BTreeSet<String>,
}

/// What one file became.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Carved {
    /// The text for the student; empty if nothing but comments and blank lines was left of the file.
    pub text: String,
    /// The solutions that were taken out, block by block, with their tasks.
    pub taken: Vec<(String, String)>,
}

/// What a line of a marked file is.
enum Line<'a> {
    Begin(&'a str),
    End(&'a str),
    Stub(&'a str),
    Code,
}

/// A block that is open.
struct Block<'a> {
    key: &'a str,
    line: usize,
    indent: &'a str,
    body: Vec<&'a str>,
    stub: Vec<&'a str>,
}

impl Knife {
    /// Carves `text`, which stands in the file `name` (for messages).
    ///
    /// Markers that do not pair up, blocks in blocks, keys that the course does not list, stub lines outside a
    /// block and comments that almost are markers are errors: a slip here would hand out a solution.
    pub fn carve(&self, name: &str, text: &str) -> Result<Carved, GraderError> {
        let mut out: Vec<String> = Vec::new();
        let mut taken = Vec::new();
        let mut open: Option<Block> = None;
        let mut swallow_blank = false;
        for (number, line) in (1..).zip(text.lines()) {
            let at = |sentence: String| GraderError::new(format!("{name}:{number}: {sentence}"));
            match (read(line).map_err(at)?, &mut open) {
                (Line::Begin(key), None) => {
                    if !self.known.contains(key) {
                        return Err(at(format!(
                            "the course has no task `{key}`: is the key right, and is the task in course.toml?"
                        )));
                    }
                    let indent = &line[..line.len() - line.trim_start().len()];
                    let (body, stub) = (Vec::new(), Vec::new());
                    open = Some(Block {
                        key,
                        line: number,
                        indent,
                        body,
                        stub,
                    });
                }
                (Line::Begin(key), Some(block)) => {
                    return Err(at(format!(
                        "the solution of `{key}` begins inside that of `{}` (line {}): end that one first",
                        block.key, block.line
                    )));
                }
                (Line::End(key), Some(block)) if block.key == key => {
                    let Some(block) = open.take() else {
                        unreachable!("a block is open")
                    };
                    if !self.carved.contains(key) {
                        out.extend(block.body.iter().map(ToString::to_string));
                    } else if block.stub.is_empty() {
                        // With the block goes one of the two blank lines that it would leave.
                        swallow_blank = out
                            .last()
                            .is_none_or(|last| last.trim().is_empty() || last.ends_with('{'));
                        taken.push((key.to_string(), block.body.join("\n")));
                    } else {
                        out.extend(block.stub.iter().map(|stub| indented(block.indent, stub)));
                        taken.push((key.to_string(), block.body.join("\n")));
                    }
                    continue;
                }
                (Line::End(key), Some(block)) => {
                    return Err(at(format!(
                        "this ends the solution of `{key}`, but the open one is of `{}` (line {})",
                        block.key, block.line
                    )));
                }
                (Line::End(key), None) => {
                    return Err(at(format!(
                        "this ends a solution of `{key}` that never began"
                    )));
                }
                (Line::Stub(stub), Some(block)) => block.stub.push(stub),
                (Line::Stub(_), None) => {
                    return Err(at("a stub line stands outside every solution".into()));
                }
                (Line::Code, Some(block)) => block.body.push(line),
                (Line::Code, None) => {
                    if !(swallow_blank && line.trim().is_empty()) {
                        out.push(line.to_string());
                    }
                }
            }
            swallow_blank = false;
        }
        if let Some(block) = open {
            return Err(GraderError::new(format!(
                "{name}:{}: the solution of `{}` never ends",
                block.line, block.key
            )));
        }
        Ok(Carved {
            text: finished(out, !taken.is_empty()),
            taken,
        })
    }
}

/// Reads one line. A comment that speaks of solutions or stubs without being a marker is an error.
fn read(line: &str) -> Result<Line<'_>, String> {
    let Some(comment) = line.trim().strip_prefix("//") else {
        return Ok(Line::Code);
    };
    for (words, kind) in [
        (" BEGIN SOLUTION(", Line::Begin as fn(_) -> _),
        (" END SOLUTION(", Line::End),
    ] {
        if let Some(key) = comment
            .strip_prefix(words)
            .and_then(|rest| rest.strip_suffix(')'))
        {
            return Ok(kind(key));
        }
    }
    if let Some(stub) = comment.strip_prefix(" STUB:") {
        return Ok(Line::Stub(stub.strip_prefix(' ').unwrap_or(stub)));
    }
    let word = comment.trim_start().to_ascii_uppercase();
    let almost = ["BEGIN SOLUTION", "END SOLUTION", "STUB:"]
        .iter()
        .any(|marker| word.starts_with(marker));
    if almost {
        return Err(format!(
            "`{}` is almost a marker: write `// BEGIN SOLUTION(key)`, `// STUB: line` or `// END SOLUTION(key)`",
            line.trim()
        ));
    }
    Ok(Line::Code)
}

fn indented(indent: &str, stub: &str) -> String {
    if stub.is_empty() {
        String::new()
    } else {
        format!("{indent}{stub}")
    }
}

/// The lines as a text that ends in one newline. A file of which carving left no code becomes empty.
fn finished(mut lines: Vec<String>, was_carved: bool) -> String {
    while lines.last().is_some_and(|last| last.trim().is_empty()) {
        lines.pop();
    }
    let is_code = |line: &String| {
        let line = line.trim();
        !line.is_empty() && !line.starts_with("//")
    };
    if was_carved && !lines.iter().any(is_code) {
        return String::new();
    }
    lines
        .iter()
        .flat_map(|line| [line.as_str(), "\n"])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn knife(carved: &[&str]) -> Knife {
        let keys = |keys: &[&str]| keys.iter().map(ToString::to_string).collect();
        Knife {
            known: keys(&["part1.task1", "part1.task2", "part2.task1"]),
            carved: keys(carved),
        }
    }

    fn carve(text: &str) -> Result<String, String> {
        let carved = knife(&["part1.task1"]).carve("f.rs", text);
        carved.map(|c| c.text).map_err(|e| e.to_string())
    }

    const FUNCTION: &str = "\
fn f(x: u32) -> u32 {
    // BEGIN SOLUTION(part1.task1)
    let y = x;

    y + 1
    // STUB: kit::hole!(
    // STUB:     \"part1.task1\",
    // STUB:     x
    // STUB: )
    // END SOLUTION(part1.task1)
}
";

    #[test]
    fn stub_lines_take_the_place_of_the_solution_with_their_own_indentation() {
        let expected = "\
fn f(x: u32) -> u32 {
    kit::hole!(
        \"part1.task1\",
        x
    )
}
";
        assert_eq!(carve(FUNCTION).as_deref(), Ok(expected));
    }

    #[test]
    fn a_kept_task_loses_its_markers_and_stubs_only() {
        let kept = knife(&["part2.task1"]).carve("f.rs", FUNCTION).unwrap();
        let expected = "fn f(x: u32) -> u32 {\n    let y = x;\n\n    y + 1\n}\n";
        assert_eq!(kept.text, expected);
        assert!(kept.taken.is_empty());
    }

    #[test]
    fn what_was_taken_is_told() {
        let carved = knife(&["part1.task1"]).carve("f.rs", FUNCTION).unwrap();
        let body = "    let y = x;\n\n    y + 1".to_string();
        assert_eq!(carved.taken, [("part1.task1".to_string(), body)]);
    }

    #[test]
    fn carving_again_changes_nothing() {
        let once = carve(FUNCTION).unwrap();
        assert_eq!(carve(&once), Ok(once.clone()));
    }

    #[test]
    fn an_item_goes_with_one_of_its_blank_lines() {
        let text = "\
// BEGIN SOLUTION(part1.task1)
use a::b;
// END SOLUTION(part1.task1)
use c::d;

// BEGIN SOLUTION(part1.task1)
fn helper() {}
// END SOLUTION(part1.task1)

fn g() {}

// BEGIN SOLUTION(part1.task1)
fn last() {}
// END SOLUTION(part1.task1)
";
        assert_eq!(
            carve(text).as_deref(),
            Ok("use c::d;\n\nfn g() {}\n"),
            "no blank line doubled, none at the end"
        );
    }

    #[test]
    fn an_item_between_two_others_without_blank_lines_leaves_them_side_by_side() {
        let text = "use a;\n// BEGIN SOLUTION(part1.task1)\nuse b;\n// END SOLUTION(part1.task1)\n\nfn f() {}\n";
        assert_eq!(carve(text).as_deref(), Ok("use a;\n\nfn f() {}\n"));
    }

    #[test]
    fn a_blank_stub_line_has_no_trailing_space() {
        let text = "fn f() {\n    // BEGIN SOLUTION(part1.task1)\n    g();\n    // STUB: a();\n    // STUB:\n    // STUB: b();\n    // END SOLUTION(part1.task1)\n}\n";
        assert_eq!(
            carve(text).as_deref(),
            Ok("fn f() {\n    a();\n\n    b();\n}\n")
        );
    }

    #[test]
    fn a_file_that_was_all_solution_is_empty() {
        let text = "//! Tests.\n\n// BEGIN SOLUTION(part1.task1)\nfn t() {}\n// END SOLUTION(part1.task1)\n";
        assert_eq!(carve(text).as_deref(), Ok(""));
    }

    #[test]
    fn a_file_without_markers_stays_as_it_is() {
        let text = "//! Only words.\n";
        assert_eq!(carve(text).as_deref(), Ok(text));
        assert_eq!(carve("fn f() {}\r\n").as_deref(), Ok("fn f() {}\n"));
    }

    #[test]
    fn every_slip_is_an_error_with_its_place() {
        let begin = "// BEGIN SOLUTION(part1.task1)\n";
        let end = "// END SOLUTION(part1.task1)\n";
        let slips = [
            (
                format!("a\n{begin}b\n"),
                "f.rs:2: the solution of `part1.task1` never ends",
            ),
            (
                format!("a\n{end}"),
                "f.rs:2: this ends a solution of `part1.task1` that never began",
            ),
            (
                format!("{begin}{begin}{end}"),
                "f.rs:2: the solution of `part1.task1` begins inside",
            ),
            (
                format!("{begin}// END SOLUTION(part1.task2)\n"),
                "f.rs:2: this ends the solution of `part1.task2`, but the open one is of `part1.task1`",
            ),
            (
                "// BEGIN SOLUTION(part1.taks1)\n".into(),
                "f.rs:1: the course has no task `part1.taks1`",
            ),
            (
                "x\n// STUB: a\n".into(),
                "f.rs:2: a stub line stands outside every solution",
            ),
            (
                "//BEGIN SOLUTION(part1.task1)\n".into(),
                "f.rs:1: `//BEGIN SOLUTION(part1.task1)` is almost",
            ),
            (
                "// begin solution(part1.task1)\n".into(),
                "f.rs:1: `// begin solution(part1.task1)` is almost",
            ),
            (
                "// BEGIN SOLUTION (part1.task1)\n".into(),
                "f.rs:1: `// BEGIN SOLUTION (part1.task1)` is almost",
            ),
            ("//STUB: x\n".into(), "f.rs:1: `//STUB: x` is almost"),
        ];
        for (text, beginning) in slips {
            let error = carve(&text).unwrap_err();
            assert!(error.starts_with(beginning), "{text:?}: {error}");
        }
    }
}
