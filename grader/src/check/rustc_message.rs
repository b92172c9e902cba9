//! Messages in the form in which rustc and cargo print them for editors.
//!
//! Cargo prints a line of JSON for each message of the compiler: an [`Envelope`] around rustc's
//! [`Diagnostic`]. The format is described in the book of rustc ("JSON output") and in that of
//! cargo ("External tools").

use annotate_snippets::{AnnotationKind, Group, Level as Title, Renderer, Snippet};
use serde::Serialize;
use serde_json::Value;
use std::ops::Range;

/// A crate as cargo names it in its messages.
#[derive(Clone, Debug, PartialEq)]
pub struct CrateName {
    /// The identifier of its package.
    pub package_id: Value,
    /// The path of its manifest.
    pub manifest_path: Value,
    /// Its target: kind, name, path and edition.
    pub target: Value,
}

/// A message about a crate: one line of cargo's output.
#[derive(Clone, Debug, Serialize)]
pub struct Envelope<'a> {
    reason: &'static str,
    package_id: &'a Value,
    manifest_path: &'a Value,
    target: &'a Value,
    message: &'a Diagnostic,
}

impl<'a> Envelope<'a> {
    /// `message` about the crate `of`.
    pub fn new(of: &'a CrateName, message: &'a Diagnostic) -> Envelope<'a> {
        Envelope {
            reason: "compiler-message",
            package_id: &of.package_id,
            manifest_path: &of.manifest_path,
            target: &of.target,
            message,
        }
    }
}

/// How urgent a message is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    /// Something is wrong.
    Warning,
    /// What else there is to say about a warning.
    Note,
    /// Advice. Alone, editors show it as a hint.
    Help,
}

/// The name of what a message is about: for rustc an error code or a lint, here a task.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Code {
    code: String,
    explanation: Option<String>,
}

/// A message, as rustc writes it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Diagnostic {
    #[serde(rename = "$message_type")]
    message_type: &'static str,
    /// The message in a line.
    pub message: String,
    /// The task.
    pub code: Option<Code>,
    /// How urgent it is.
    pub level: Level,
    /// The code that it is about; none for notes.
    pub spans: Vec<Span>,
    /// Notes and advice.
    pub children: Vec<Diagnostic>,
    /// The whole message as a terminal shows it.
    pub rendered: Option<String>,
}

/// A range of code in a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Span {
    file_name: String,
    byte_start: usize,
    byte_end: usize,
    /// The line, counted from 1.
    pub line_start: usize,
    line_end: usize,
    column_start: usize,
    column_end: usize,
    is_primary: bool,
    text: Vec<SpanLine>,
    label: Option<String>,
    suggested_replacement: Option<String>,
    suggestion_applicability: Option<String>,
    expansion: Option<Value>,
}

/// A line of a span, and which columns belong to it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
struct SpanLine {
    text: String,
    highlight_start: usize,
    highlight_end: usize,
}

/// A place in a source file: bytes of one of its lines.
#[derive(Clone, Copy, Debug)]
pub struct Mark<'a> {
    /// The path of the file below the workspace's root folder.
    pub path: &'a str,
    /// The text of the file.
    pub text: &'a str,
    /// The first byte.
    pub start: usize,
    /// The byte after the last one, in the same line.
    pub end: usize,
}

impl<'a> Mark<'a> {
    /// The line number `number` (from 1 on) of a file, without the space around its code. The last
    /// line of a shorter file.
    pub fn line(path: &'a str, text: &'a str, number: usize) -> Mark<'a> {
        let mut start = 0;
        let mut code = "";
        for line in text.split_inclusive('\n').take(number.max(1)) {
            start = line.as_ptr() as usize - text.as_ptr() as usize;
            code = line;
        }
        let indent = code.len() - code.trim_start().len();
        let start = start + indent;
        let end = start + code.trim().len();
        Mark {
            path,
            text,
            start,
            end,
        }
    }

    /// The bytes of its line, without the end of the line.
    fn line_range(&self) -> Range<usize> {
        let start = self.text[..self.start].rfind('\n').map_or(0, |at| at + 1);
        let rest = &self.text[start..];
        let end = rest.find('\n').unwrap_or(rest.len());
        start..start + end
    }

    fn span(&self) -> Span {
        let line = self.line_range();
        let number = self.text[..self.start].matches('\n').count() + 1;
        // Columns count characters, from 1 on.
        let column = |byte: usize| self.text[line.start..byte].chars().count() + 1;
        let (from, to) = (column(self.start), column(self.end));
        Span {
            file_name: self.path.into(),
            byte_start: self.start,
            byte_end: self.end,
            line_start: number,
            line_end: number,
            column_start: from,
            column_end: to,
            is_primary: true,
            text: vec![SpanLine {
                text: self.text[line].trim_end_matches('\r').into(),
                highlight_start: from,
                highlight_end: to,
            }],
            label: None,
            suggested_replacement: None,
            suggestion_applicability: None,
            expansion: None,
        }
    }
}

impl Diagnostic {
    /// A message about the code at `mark` and about the task `key`, with its `children`: notes and
    /// advice. `colours` colours its rendered form.
    pub fn new(
        level: Level,
        key: &str,
        message: &str,
        mark: Mark,
        children: &[(Level, String)],
        colours: bool,
    ) -> Diagnostic {
        let children = children.iter().map(|(level, text)| Diagnostic {
            message_type: "diagnostic",
            message: text.clone(),
            code: None,
            level: *level,
            spans: Vec::new(),
            children: Vec::new(),
            rendered: None,
        });
        let mut diagnostic = Diagnostic {
            message_type: "diagnostic",
            message: message.into(),
            code: Some(Code {
                code: key.into(),
                explanation: None,
            }),
            level,
            spans: vec![mark.span()],
            children: children.collect(),
            rendered: None,
        };
        diagnostic.rendered = Some(diagnostic.render(mark, colours));
        diagnostic
    }

    /// The message as rustc prints it in a terminal.
    fn render(&self, mark: Mark, colours: bool) -> String {
        let line = mark.line_range();
        let code = &mark.text[line.clone()];
        let number = self.spans.first().map_or(1, |span| span.line_start);
        let snippet = Snippet::source(code)
            .line_start(number)
            .path(mark.path)
            .annotation(
                AnnotationKind::Primary.span(mark.start - line.start..mark.end - line.start),
            );
        let mut title = self.level.title().primary_title(&self.message);
        if let Some(code) = &self.code {
            title = title.id(&code.code);
        }
        let group = Group::with_title(title);
        let group = self
            .children
            .iter()
            .fold(group.element(snippet), |group, child| {
                group.element(child.level.title().message(&child.message))
            });
        let renderer = match colours {
            true => Renderer::styled(),
            false => Renderer::plain(),
        };
        format!("{}\n\n", renderer.render(&[group]))
    }
}

impl Level {
    fn title(self) -> Title<'static> {
        match self {
            Level::Warning => Title::WARNING,
            Level::Note => Title::NOTE,
            Level::Help => Title::HELP,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cargo_metadata::diagnostic::DiagnosticLevel;
    use serde_json::json;

    const TEXT: &str = "//! Map.\n\npub fn größe(a: u8) -> u8 {\n    a + 1\n}\n";

    fn message() -> Diagnostic {
        let mark = Mark::line("stages/intersect/src/lib.rs", TEXT, 4);
        let children = [(Level::Note, "simplest case: a = 255".to_owned())];
        Diagnostic::new(
            Level::Warning,
            "part1.task3",
            "too large",
            mark,
            &children,
            false,
        )
    }

    #[test]
    fn a_line_is_marked_without_its_indent() {
        let message = message();
        let span = &message.spans[0];
        assert_eq!(
            (span.line_start, span.column_start, span.column_end),
            (4, 5, 10)
        );
        assert_eq!(&TEXT[span.byte_start..span.byte_end], "a + 1");
        // Columns count characters, bytes do not.
        let at = TEXT.find("größe").expect("it is there");
        let mark = Mark {
            path: "a.rs",
            text: TEXT,
            start: at,
            end: at + "größe".len(),
        };
        let span = mark.span();
        assert_eq!((span.column_start, span.column_end), (8, 13));
        assert_eq!(Mark::line("a.rs", TEXT, 99).span().line_start, 5);
    }

    #[test]
    fn it_is_rendered_as_rustc_does() {
        let rendered = message().rendered.expect("it is rendered");
        let expected = "warning[part1.task3]: too large\n --> stages/intersect/src/lib.rs:4:5\n  |\n4 |     a + 1\n  |     ^^^^^\n  |\n  = note: simplest case: a = 255\n\n";
        assert_eq!(rendered, expected);
    }

    #[test]
    fn cargo_metadata_reads_it() {
        let of = CrateName {
            package_id: json!("path+file:///course/stages/intersect#0.1.0"),
            manifest_path: json!("/course/stages/intersect/Cargo.toml"),
            target: json!({
                "kind": ["lib"], "crate_types": ["lib"], "name": "intersect",
                "src_path": "/course/stages/intersect/src/lib.rs", "edition": "2024",
                "doc": true, "doctest": true, "test": true
            }),
        };
        let message = message();
        let line = serde_json::to_string(&Envelope::new(&of, &message)).expect("it is JSON");
        let mut read = cargo_metadata::Message::parse_stream(line.as_bytes());
        let Some(Ok(cargo_metadata::Message::CompilerMessage(read))) = read.next() else {
            panic!("{line}")
        };
        assert_eq!(read.target.name, "intersect");
        let read = read.message;
        assert_eq!(read.level, DiagnosticLevel::Warning);
        assert_eq!(
            read.code.map(|code| code.code).as_deref(),
            Some("part1.task3")
        );
        assert!(read.spans[0].is_primary);
        assert_eq!(read.children[0].message, "simplest case: a = 255");
    }
}
