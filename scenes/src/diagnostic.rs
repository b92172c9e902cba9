//! What is wrong with a file, said to the person who holds it.
//!
//! A [`Diagnostic`] names the file, the line, the element, what stands there, what was expected and
//! what to do. It keeps its own copy of the line, so it outlives the text of the file.

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use std::ops::Range;

/// Longest piece of a line that is shown: lines of a mesh can be a megabyte long.
const EXCERPT_BYTES: usize = 160;

/// A finding about a file. [`SceneError`] and [`Warning`] wrap one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    file: String,
    title: String,
    place: Option<Place>,
    help: Option<String>,
}

/// Where in the file, and what was expected there.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Place {
    line: usize,
    column: usize,
    excerpt: String,
    is_whole_line: bool,
    mark: Range<usize>,
    label: String,
}

/// Why a file could not be read. Its [`Display`](std::fmt::Display) is the whole report without colours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError(pub Box<Diagnostic>);

/// Something in a file that was mended, and how.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning(pub Diagnostic);

impl Diagnostic {
    /// A finding about the file as a whole.
    pub(crate) fn about_file(file: &str, title: impl Into<String>) -> Diagnostic {
        Diagnostic {
            file: file.to_owned(),
            title: title.into(),
            place: None,
            help: None,
        }
    }

    /// Points at bytes `mark` of `source`; `label` says what was expected there.
    pub(crate) fn at(mut self, source: &str, mark: Range<usize>, label: impl Into<String>) -> Self {
        self.place = Some(Place::new(source, mark, label.into()));
        self
    }

    /// Says something else at the place than what was expected.
    pub(crate) fn relabel(mut self, label: impl Into<String>) -> Self {
        if let Some(place) = &mut self.place {
            place.label = label.into();
        }
        self
    }

    /// Says what to do.
    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The file's name as it was given.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The sentence at the head of the report.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Line and column in the file, both from 1, the column in characters. `None` if the finding is
    /// about the file as a whole.
    pub fn line_and_column(&self) -> Option<(usize, usize)> {
        self.place.as_ref().map(|place| (place.line, place.column))
    }

    /// What was expected at that place.
    pub fn expected(&self) -> Option<&str> {
        self.place.as_ref().map(|place| place.label.as_str())
    }

    /// What to do about it.
    pub fn what_to_do(&self) -> Option<&str> {
        self.help.as_deref()
    }

    fn render(&self, level: Level<'static>, renderer: &Renderer) -> String {
        let mut group = Group::with_title(level.primary_title(&self.title));
        match &self.place {
            Some(place) => {
                let mark = AnnotationKind::Primary
                    .span(place.mark.clone())
                    .label(&place.label);
                let snippet = Snippet::source(&place.excerpt)
                    .line_start(place.line)
                    .annotation(mark);
                group = if place.is_whole_line {
                    group.element(snippet.path(&self.file))
                } else {
                    // The snippet would count its columns from the start of the excerpt.
                    let at = format!("{}:{}:{}", self.file, place.line, place.column);
                    group
                        .element(snippet)
                        .element(Level::NOTE.message(format!("this is at {at}")))
                };
            }
            None => group = group.element(Origin::path(&self.file)),
        }
        if let Some(help) = &self.help {
            group = group.element(Level::HELP.message(help));
        }
        renderer.render(&[group])
    }
}

/// The start of the character that byte `at` belongs to; the end of `source` if it is too short.
fn char_start(source: &str, at: usize) -> usize {
    let mut at = at.min(source.len());
    while !source.is_char_boundary(at) {
        at -= 1;
    }
    at
}

impl Place {
    fn new(source: &str, mark: Range<usize>, label: String) -> Place {
        let start = char_start(source, mark.start);
        let line_start = source[..start].rfind('\n').map_or(0, |newline| newline + 1);
        let line_end = source[start..]
            .find(['\n', '\r'])
            .map_or(source.len(), |length| start + length);
        let end = char_start(source, mark.end).clamp(start, line_end.max(start));
        // The window: half of it before the mark, and at least the start of the mark.
        let from = char_start(
            source,
            line_start.max(start.saturating_sub(EXCERPT_BYTES / 2)),
        );
        let to = char_start(source, line_end.min(start + EXCERPT_BYTES / 2)).max(start);
        let before = if from > line_start { "… " } else { "" };
        let after = if to < line_end { " …" } else { "" };
        let excerpt = format!("{before}{}{after}", &source[from..to]);
        let shift = |byte: usize| byte.min(to) - from + before.len();
        Place {
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
    /// The report with colours, for a terminal.
    pub fn styled(&self) -> String {
        self.0.render(Level::ERROR, &Renderer::styled())
    }
}

impl Warning {
    /// The report with colours, for a terminal.
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
