//! Removes the solutions from one file and inserts stubs in their place ("carving").
//!
//! A solution is between two markers that name its task:
//!
//! ```text
//!     // BEGIN SOLUTION(part1.task3)
//!     ...reference...
//!     // STUB: kit::hole!("part1.task3", tri, ray)
//!     // END SOLUTION(part1.task3)
//! ```
//!
//! If the task is carved, the `STUB` lines replace the whole block, with the indentation of its
//! first marker. A block without `STUB` lines (a helper, an import, a unit test) is removed. If the
//! task is kept, the solution stays and the markers are removed. So students see no markers in
//! either case.
//!
//! A file that students do not hand in may be a solution from its first line to its last. It has no
//! markers: `whole_solutions` in `course.toml` lists such files.

use base::GraderError;
use std::collections::BTreeSet;

/// Carves files: removes the solutions of some tasks.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Carver {
    /// The keys of all tasks.
    pub all_keys: BTreeSet<String>,
    /// The keys of the tasks whose solutions to remove.
    pub carved_keys: BTreeSet<String>,
}

/// The result of carving one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Carved {
    /// The text for the student; empty if only comments and blank lines are left.
    pub text: String,
    /// The removed blocks, each with the key of its task.
    pub removed: Vec<(String, String)>,
}

/// The kinds of lines in a file with markers.
enum Line<'a> {
    Begin(&'a str),
    End(&'a str),
    Stub(&'a str),
    Code,
}

/// A block whose end marker was not read yet.
struct Block<'a> {
    key: &'a str,
    line: usize,
    indent: &'a str,
    body: Vec<&'a str>,
    stub: Vec<&'a str>,
}

impl Carver {
    /// Carves `text`, the contents of the file `name` (which messages contain).
    ///
    /// Unpaired markers, nested blocks, keys that the course does not list, stub lines outside a
    /// block and misspelt markers are errors: any of them could put a solution into a handout.
    pub fn carve(&self, name: &str, text: &str) -> Result<Carved, GraderError> {
        let mut out: Vec<String> = Vec::new();
        let mut removed = Vec::new();
        let mut open: Option<Block> = None;
        let mut skip_blank_line = false;
        for (number, line) in (1..).zip(text.lines()) {
            let at = |sentence: String| GraderError::new(format!("{name}:{number}: {sentence}"));
            match (read(line).map_err(at)?, &mut open) {
                (Line::Begin(key), None) => {
                    if !self.all_keys.contains(key) {
                        return Err(at(format!(
                            "the course has no task `{key}`: correct the key, or add the task to course.toml"
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
                        "the solution of `{key}` begins inside the solution of `{}` (line {}): end that one first",
                        block.key, block.line
                    )));
                }
                (Line::End(key), Some(block)) if block.key == key => {
                    let Some(block) = open.take() else {
                        unreachable!("a block is open")
                    };
                    if !self.carved_keys.contains(key) {
                        out.extend(block.body.iter().map(ToString::to_string));
                    } else if block.stub.is_empty() {
                        // Removing the block would leave two blank lines: remove one of them.
                        skip_blank_line = out
                            .last()
                            .is_none_or(|last| last.trim().is_empty() || last.ends_with('{'));
                        removed.push((key.to_string(), block.body.join("\n")));
                    } else {
                        out.extend(block.stub.iter().map(|stub| indented(block.indent, stub)));
                        removed.push((key.to_string(), block.body.join("\n")));
                    }
                    continue;
                }
                (Line::End(key), Some(block)) => {
                    return Err(at(format!(
                        "expected the end of the solution of `{}` (line {}), found the end of one of `{key}`",
                        block.key, block.line
                    )));
                }
                (Line::End(key), None) => {
                    return Err(at(format!(
                        "found the end of a solution of `{key}` that has no beginning"
                    )));
                }
                (Line::Stub(stub), Some(block)) => block.stub.push(stub),
                (Line::Stub(_), None) => {
                    return Err(at("found a stub line outside of a solution".into()));
                }
                (Line::Code, Some(block)) => block.body.push(line),
                (Line::Code, None) => {
                    if !(skip_blank_line && line.trim().is_empty()) {
                        out.push(line.to_string());
                    }
                }
            }
            skip_blank_line = false;
        }
        if let Some(block) = open {
            return Err(GraderError::new(format!(
                "{name}:{}: the solution of `{}` has no end",
                block.line, block.key
            )));
        }
        Ok(Carved {
            text: join_lines(out, !removed.is_empty()),
            removed,
        })
    }

    /// Carves the file `name`, all of whose `text` is the solution of the task `key`. A marker is
    /// an error: it contradicts the list of such files.
    pub fn carve_whole(&self, name: &str, key: &str, text: String) -> Result<Carved, GraderError> {
        for (number, line) in (1..).zip(text.lines()) {
            if !matches!(read(line), Ok(Line::Code)) {
                return Err(GraderError::new(format!(
                    "{name}:{number}: course.toml lists the file as a solution from the first line to the last: remove this marker, or the file from the list"
                )));
            }
        }
        Ok(match self.carved_keys.contains(key) {
            true => Carved {
                text: String::new(),
                removed: vec![(key.to_string(), text)],
            },
            false => Carved {
                text,
                removed: Vec::new(),
            },
        })
    }
}

/// Reads one line. A comment that begins like a marker but is none is an error.
fn read(line: &str) -> Result<Line<'_>, String> {
    let Some(comment) = line.trim().strip_prefix("//") else {
        return Ok(Line::Code);
    };
    for (prefix, kind) in [
        (" BEGIN SOLUTION(", Line::Begin as fn(_) -> _),
        (" END SOLUTION(", Line::End),
    ] {
        if let Some(key) = comment
            .strip_prefix(prefix)
            .and_then(|rest| rest.strip_suffix(')'))
        {
            return Ok(kind(key));
        }
    }
    if let Some(stub) = comment.strip_prefix(" STUB:") {
        return Ok(Line::Stub(stub.strip_prefix(' ').unwrap_or(stub)));
    }
    let upper_case = comment.trim_start().to_ascii_uppercase();
    let is_misspelt = ["BEGIN SOLUTION", "END SOLUTION", "STUB:"]
        .iter()
        .any(|marker| upper_case.starts_with(marker));
    if is_misspelt {
        return Err(format!(
            "`{}` is a misspelt marker: expected `// BEGIN SOLUTION(key)`, `// STUB: line` or `// END SOLUTION(key)`",
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

/// Joins the lines to a text that ends in one newline. The text is empty if carving left no code.
fn join_lines(mut lines: Vec<String>, was_carved: bool) -> String {
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

    fn carver(carved: &[&str]) -> Carver {
        let keys = |keys: &[&str]| keys.iter().map(ToString::to_string).collect();
        Carver {
            all_keys: keys(&["part1.task1", "part1.task2", "part2.task1"]),
            carved_keys: keys(carved),
        }
    }

    fn carve(text: &str) -> Result<String, String> {
        let carved = carver(&["part1.task1"]).carve("f.rs", text);
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
    fn stub_lines_replace_the_solution_and_keep_their_indentation() {
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
    fn a_kept_task_only_loses_its_markers_and_stubs() {
        let kept = carver(&["part2.task1"]).carve("f.rs", FUNCTION).unwrap();
        let expected = "fn f(x: u32) -> u32 {\n    let y = x;\n\n    y + 1\n}\n";
        assert_eq!(kept.text, expected);
        assert!(kept.removed.is_empty());
    }

    #[test]
    fn removed_solutions_are_returned() {
        let carved = carver(&["part1.task1"]).carve("f.rs", FUNCTION).unwrap();
        let body = "    let y = x;\n\n    y + 1".to_string();
        assert_eq!(carved.removed, [("part1.task1".to_string(), body)]);
    }

    #[test]
    fn carving_again_changes_nothing() {
        let once = carve(FUNCTION).unwrap();
        assert_eq!(carve(&once), Ok(once.clone()));
    }

    #[test]
    fn an_item_is_removed_with_one_of_its_blank_lines() {
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
            "no double blank line, and none at the end"
        );
    }

    #[test]
    fn removing_an_item_does_not_join_its_neighbours_with_a_blank_line() {
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
    fn a_file_that_contains_only_a_solution_becomes_empty() {
        let text = "//! Tests.\n\n// BEGIN SOLUTION(part1.task1)\nfn t() {}\n// END SOLUTION(part1.task1)\n";
        assert_eq!(carve(text).as_deref(), Ok(""));
    }

    #[test]
    fn a_file_without_markers_is_unchanged() {
        let text = "//! Only words.\n";
        assert_eq!(carve(text).as_deref(), Ok(text));
        assert_eq!(carve("fn f() {}\r\n").as_deref(), Ok("fn f() {}\n"));
    }

    #[test]
    fn a_whole_file_is_left_out_with_its_task() {
        let of = |text: &str| {
            let carver = carver(&["part1.task1"]);
            ["part1.task1", "part2.task1"].map(|key| {
                let carved = carver.carve_whole("f.rs", key, text.to_string());
                carved
                    .map(|carved| (carved.text, carved.removed.len()))
                    .map_err(|error| error.to_string())
            })
        };
        let [carved, kept] = of("fn f() {}\n");
        assert_eq!(carved, Ok((String::new(), 1)));
        assert_eq!(kept, Ok(("fn f() {}\n".to_string(), 0)));
        for marked in of("a\n// BEGIN SOLUTION(part1.task1)\n") {
            let error = marked.expect_err("it is marked, too");
            assert!(error.starts_with("f.rs:2: course.toml lists"), "{error}");
        }
    }

    #[test]
    fn wrong_markers_are_errors_with_their_line() {
        let begin = "// BEGIN SOLUTION(part1.task1)\n";
        let end = "// END SOLUTION(part1.task1)\n";
        let mistakes = [
            (
                format!("a\n{begin}b\n"),
                "f.rs:2: the solution of `part1.task1` has no end",
            ),
            (
                format!("a\n{end}"),
                "f.rs:2: found the end of a solution of `part1.task1` that has no beginning",
            ),
            (
                format!("{begin}{begin}{end}"),
                "f.rs:2: the solution of `part1.task1` begins inside",
            ),
            (
                format!("{begin}// END SOLUTION(part1.task2)\n"),
                "f.rs:2: expected the end of the solution of `part1.task1` (line 1), found the end of one of `part1.task2`",
            ),
            (
                "// BEGIN SOLUTION(part1.taks1)\n".into(),
                "f.rs:1: the course has no task `part1.taks1`",
            ),
            (
                "x\n// STUB: a\n".into(),
                "f.rs:2: found a stub line outside of a solution",
            ),
            (
                "//BEGIN SOLUTION(part1.task1)\n".into(),
                "f.rs:1: `//BEGIN SOLUTION(part1.task1)` is a misspelt",
            ),
            (
                "// begin solution(part1.task1)\n".into(),
                "f.rs:1: `// begin solution(part1.task1)` is a misspelt",
            ),
            (
                "// BEGIN SOLUTION (part1.task1)\n".into(),
                "f.rs:1: `// BEGIN SOLUTION (part1.task1)` is a misspelt",
            ),
            ("//STUB: x\n".into(), "f.rs:1: `//STUB: x` is a misspelt"),
        ];
        for (text, beginning) in mistakes {
            let error = carve(&text).unwrap_err();
            assert!(error.starts_with(beginning), "{text:?}: {error}");
        }
    }
}
