//! Errors and warnings about a file.
//!
//! A [`Diagnostic`] contains the file, the line, what was found, what was expected, and what to do.
//! It keeps a copy of the line, so it can outlive the text of the file.

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use std::ops::Range;

/// Longest part of a line that is shown. The lines of a mesh can have a megabyte.
const EXCERPT_BYTES: usize = 160;

/// A message about a file. [`SceneError`] and [`Warning`] contain one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    file: String,
    title: String,
    location: Option<Location>,
    help: Option<String>,
    /// Where else the same was found.
    note: Option<String>,
}

/// A position in the file, and what was expected there.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Location {
    /// The byte of the file at which the mark starts.
    start: usize,
    line: usize,
    column: usize,
    excerpt: String,
    is_whole_line: bool,
    mark: Range<usize>,
    label: String,
}

/// Why a file could not be read. Its [`Display`](std::fmt::Display) is the whole report without
/// colours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError(pub Box<Diagnostic>);

/// Something in a file that was repaired or ignored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning(pub Diagnostic);

impl Diagnostic {
    /// A message about the file as a whole.
    pub(crate) fn about_file(file: &str, title: impl Into<String>) -> Diagnostic {
        Diagnostic {
            file: file.to_owned(),
            title: title.into(),
            location: None,
            help: None,
            note: None,
        }
    }

    /// Sets the location to the bytes `mark` of `source`. `label` describes what was expected
    /// there.
    pub(crate) fn at(mut self, source: &str, mark: Range<usize>, label: impl Into<String>) -> Self {
        self.location = Some(Location::new(source, mark, label.into()));
        self
    }

    /// Sets the advice on what to do.
    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Sets the note on where else the same was found.
    pub(crate) fn note(mut self, note: impl Into<String>) -> Self {
        self.note = Some(note.into());
        self
    }

    /// Sets the note to what was found before in the file, if anything was.
    pub(crate) fn note_of<'w>(self, found: impl Iterator<Item = &'w Diagnostic>) -> Self {
        let titles: Vec<&str> = found.map(Diagnostic::title).collect();
        match titles[..] {
            [] => self,
            _ => self.note(format!("found in it: {}", titles.join("; "))),
        }
    }

    /// The byte of the file at which the location starts.
    pub(crate) fn start(&self) -> Option<usize> {
        self.location.as_ref().map(|location| location.start)
    }

    /// The name of the file, as it was given.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The main message, in one line.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Line and column in the file, both from 1; the column counts characters. `None` if the
    /// message is about the file as a whole.
    pub fn line_and_column(&self) -> Option<(usize, usize)> {
        self.location
            .as_ref()
            .map(|location| (location.line, location.column))
    }

    /// What was expected at the location.
    pub fn expected(&self) -> Option<&str> {
        self.location
            .as_ref()
            .map(|location| location.label.as_str())
    }

    /// Advice on what to do.
    pub fn what_to_do(&self) -> Option<&str> {
        self.help.as_deref()
    }

    /// Where else the same was found, if a warning stands for several places.
    pub fn elsewhere(&self) -> Option<&str> {
        self.note.as_deref()
    }

    fn render(&self, level: Level<'static>, renderer: &Renderer) -> String {
        let mut group = Group::with_title(level.primary_title(&self.title));
        match &self.location {
            Some(location) => {
                let mark = AnnotationKind::Primary
                    .span(location.mark.clone())
                    .label(&location.label);
                let snippet = Snippet::source(&location.excerpt)
                    .line_start(location.line)
                    .annotation(mark);
                group = if location.is_whole_line {
                    group.element(snippet.path(&self.file))
                } else {
                    // The columns of the snippet would count from the start of the excerpt.
                    let position = format!("{}:{}:{}", self.file, location.line, location.column);
                    group
                        .element(snippet)
                        .element(Level::NOTE.message(format!("this is at {position}")))
                };
            }
            None => group = group.element(Origin::path(&self.file)),
        }
        if let Some(help) = &self.help {
            group = group.element(Level::HELP.message(help));
        }
        if let Some(note) = &self.note {
            group = group.element(Level::NOTE.message(note));
        }
        renderer.render(&[group])
    }
}

/// The start of the character that contains byte `at`, or the end of `source` if that comes first.
fn char_start(source: &str, at: usize) -> usize {
    let mut at = at.min(source.len());
    while !source.is_char_boundary(at) {
        at -= 1;
    }
    at
}

impl Location {
    fn new(source: &str, mark: Range<usize>, label: String) -> Location {
        let start = char_start(source, mark.start);
        let line_start = source[..start].rfind('\n').map_or(0, |newline| newline + 1);
        let line_end = source[start..]
            .find(['\n', '\r'])
            .map_or(source.len(), |length| start + length);
        let end = char_start(source, mark.end).clamp(start, line_end.max(start));
        // The excerpt contains up to half of its length before the start of the mark, and as much
        // from there on.
        let from = char_start(
            source,
            line_start.max(start.saturating_sub(EXCERPT_BYTES / 2)),
        );
        let to = char_start(source, line_end.min(start + EXCERPT_BYTES / 2)).max(start);
        let before = if from > line_start { "… " } else { "" };
        let after = if to < line_end { " …" } else { "" };
        let excerpt = format!("{before}{}{after}", &source[from..to]);
        let shift = |byte: usize| byte.min(to) - from + before.len();
        Location {
            start,
            line: source[..start].matches('\n').count() + 1,
            column: source[line_start..start].chars().count() + 1,
            mark: shift(start)..shift(end),
            is_whole_line: before.is_empty() && after.is_empty(),
            excerpt,
            label,
        }
    }
}

impl SceneError {
    /// The report with colours for a terminal.
    pub fn styled(&self) -> String {
        self.0.render(Level::ERROR, &Renderer::styled())
    }
}

impl Warning {
    /// The report with colours for a terminal.
    pub fn styled(&self) -> String {
        self.0.render(Level::WARNING, &Renderer::styled())
    }
}

impl std::fmt::Display for SceneError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0.render(Level::ERROR, &Renderer::plain()))
    }
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0.render(Level::WARNING, &Renderer::plain()))
    }
}

impl std::error::Error for SceneError {}

impl From<Diagnostic> for SceneError {
    fn from(diagnostic: Diagnostic) -> SceneError {
        SceneError(Box::new(diagnostic))
    }
}

impl From<Diagnostic> for Warning {
    fn from(diagnostic: Diagnostic) -> Warning {
        Warning(diagnostic)
    }
}
