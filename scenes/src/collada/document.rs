//! The XML document: ids, references, and diagnostics with positions in the file.

use crate::diagnostic::{Diagnostic, SceneError, Warning};
use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::ops::Range;

/// An element of the document.
pub(super) type Element<'a> = roxmltree::Node<'a, 'a>;

/// Maximum number of warnings. If there are more, one additional warning contains their number.
const MAX_WARNINGS: usize = 50;

/// Maximum length of names from the file, in characters.
const MAX_NAME: usize = 80;

/// A parsed document with its ids and the warnings so far.
pub(super) struct Document<'a> {
    file: &'a str,
    xml: &'a roxmltree::Document<'a>,
    /// Elements by tag and id. For a duplicate id, the first element.
    by_id: HashMap<(&'a str, &'a str), Element<'a>>,
    has_textures: bool,
    warnings: RefCell<Vec<Warning>>,
    omitted_warnings: Cell<usize>,
}

impl<'a> Document<'a> {
    pub(super) fn new(file: &'a str, xml: &'a roxmltree::Document<'a>) -> Document<'a> {
        let mut by_id = HashMap::new();
        let mut has_textures = false;
        for element in xml.descendants().filter(|node| node.is_element()) {
            has_textures |= tag(element) == "texture";
            if let Some(id) = element.attribute("id") {
                by_id.entry((tag(element), id)).or_insert(element);
            }
        }
        Document {
            file,
            xml,
            by_id,
            has_textures,
            warnings: RefCell::default(),
            omitted_warnings: Cell::new(0),
        }
    }

    /// Whether any material has a texture. Otherwise texture coordinates are not needed.
    pub(super) fn has_textures(&self) -> bool {
        self.has_textures
    }

    pub(super) fn root(&self) -> Element<'a> {
        self.xml.root_element()
    }

    pub(super) fn source(&self) -> &'a str {
        self.xml.input_text()
    }

    /// A diagnostic at the bytes `mark`, with a title and a label that describes what was expected.
    pub(super) fn at(
        &self,
        mark: Range<usize>,
        title: impl Into<String>,
        expected: impl Into<String>,
    ) -> Diagnostic {
        Diagnostic::about_file(self.file, title).at(self.source(), mark, expected)
    }

    /// A diagnostic at the start tag of `element`.
    pub(super) fn on(
        &self,
        element: Element<'a>,
        title: impl Into<String>,
        expected: impl Into<String>,
    ) -> Diagnostic {
        let start = element.range().start;
        let length = self.source()[start..]
            .find(|c: char| c.is_whitespace() || c == '>' || c == '/')
            .unwrap_or(1);
        self.at(start..start + length, title, expected)
    }

    /// A diagnostic at an attribute of `element`.
    pub(super) fn on_attribute(
        &self,
        element: Element<'a>,
        name: &str,
        title: impl Into<String>,
        expected: impl Into<String>,
    ) -> Diagnostic {
        match element.attribute_node(name) {
            Some(attribute) => self.at(attribute.range(), title, expected),
            None => self.on(element, title, expected),
        }
    }

    /// Adds a warning. Calls `diagnostic` only if the warning is kept, because computing the line
    /// takes time.
    pub(super) fn warn(&self, diagnostic: impl FnOnce() -> Diagnostic) {
        let mut warnings = self.warnings.borrow_mut();
        if warnings.len() < MAX_WARNINGS {
            let warning = Warning(diagnostic());
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        } else {
            self.omitted_warnings.set(self.omitted_warnings.get() + 1);
        }
    }

    pub(super) fn into_warnings(self) -> Vec<Warning> {
        let mut warnings = self.warnings.into_inner();
        let more = self.omitted_warnings.get();
        if more > 0 {
            let title = format!("{more} more warnings are not shown");
            warnings.push(Warning(Diagnostic::about_file(self.file, title)));
        }
        warnings
    }

    /// The first child with the tag `name`; an error if there is none.
    pub(super) fn child(&self, parent: Element<'a>, name: &str) -> Result<Element<'a>, SceneError> {
        child(parent, name).ok_or_else(|| {
            self.on(
                parent,
                format!("{} has no <{name}>", describe(parent)),
                format!("expected a <{name}> inside"),
            )
            .help(format!("add a <{name}> element, or export the file again"))
            .into()
        })
    }

    /// The value of an attribute; an error if it is missing.
    pub(super) fn attribute(
        &self,
        element: Element<'a>,
        name: &str,
    ) -> Result<&'a str, SceneError> {
        element.attribute(name).ok_or_else(|| {
            self.on(
                element,
                format!("{} has no attribute `{name}`", describe(element)),
                format!("expected {name}=\"...\""),
            )
            .help(format!("add the attribute `{name}`"))
            .into()
        })
    }

    /// The element with the tag `tag` that a reference such as `url="#id"` refers to, if it exists.
    pub(super) fn find(&self, reference: &str, tag: &'a str) -> Option<Element<'a>> {
        let id = reference.trim().strip_prefix('#')?;
        self.by_id.get(&(tag, id)).copied()
    }

    /// The element with the tag `tag` that attribute `name` of `element` refers to; an error if it
    /// does not exist.
    pub(super) fn target(
        &self,
        element: Element<'a>,
        name: &str,
        tag: &'a str,
    ) -> Result<Element<'a>, SceneError> {
        let reference = self.attribute(element, name)?;
        self.find(reference, tag)
            .ok_or_else(|| self.unresolved(element, name, tag).into())
    }

    /// The diagnostic for a reference that does not refer to an element with the tag `tag`.
    pub(super) fn unresolved(&self, element: Element<'a>, name: &str, tag: &str) -> Diagnostic {
        let reference = element.attribute(name).unwrap_or_default().trim();
        let shown = truncated(reference);
        let diagnostic =
            |title: String, expected: String| self.on_attribute(element, name, title, expected);
        let Some(id) = reference.strip_prefix('#') else {
            let expected = format!("expected `#` and the id of a <{tag}> in this file");
            return if reference.contains('#') {
                diagnostic(format!("`{shown}` is in another file"), expected)
                    .help("only this file is read: export everything into it")
            } else {
                diagnostic(format!("`{shown}` is not a reference"), expected)
                    .help(format!("write {name}=\"#{shown}\" if that is the id"))
            };
        };
        let same_id = self.by_id.keys().filter(|(_, other)| *other == id);
        if let Some((other_tag, _)) = same_id.min() {
            return diagnostic(
                format!("`{shown}` is the id of a <{other_tag}>"),
                format!("expected the id of a <{tag}>"),
            )
            .help(self.known_ids(tag));
        }
        diagnostic(
            format!("there is no <{tag}> with the id `{}`", truncated(id)),
            format!("refers to a <{tag}> that is not in the file"),
        )
        .help(self.known_ids(tag))
    }

    fn known_ids(&self, tag: &str) -> String {
        let mut ids: Vec<&str> = self
            .by_id
            .keys()
            .filter(|key| key.0 == tag)
            .map(|key| key.1)
            .collect();
        ids.sort_unstable();
        if ids.is_empty() {
            return format!(
                "the file has no <{tag}> with an id: add one, or export the file again"
            );
        }
        let shown: Vec<String> = ids
            .iter()
            .take(5)
            .map(|id| format!("#{}", truncated(id)))
            .collect();
        let more = if ids.len() > 5 { ", ..." } else { "" };
        format!("the file has {}{more}", shown.join(", "))
    }
}

/// An element's name without its namespace.
pub(super) fn tag<'a>(element: Element<'a>) -> &'a str {
    element.tag_name().name()
}

/// The first child with the tag `name`.
pub(super) fn child<'a>(parent: Element<'a>, name: &str) -> Option<Element<'a>> {
    children(parent).find(|element| tag(*element) == name)
}

/// The child elements of `parent`.
pub(super) fn children<'a>(parent: Element<'a>) -> impl Iterator<Item = Element<'a>> {
    parent.children().filter(|node| node.is_element())
}

/// Follows a path of tags, each time to the first child with that tag.
pub(super) fn descendant<'a>(parent: Element<'a>, path: &[&str]) -> Option<Element<'a>> {
    path.iter()
        .try_fold(parent, |element, name| child(element, name))
}

/// The course's extension of COLLADA: the content of `<extra><technique profile="CGL">` (or
/// `CMU462`).
pub(super) fn course_technique<'a>(parent: Element<'a>) -> Option<Element<'a>> {
    children(parent)
        .filter(|element| tag(*element) == "extra")
        .flat_map(children)
        .find(|element| {
            tag(*element) == "technique"
                && matches!(element.attribute("profile"), Some("CGL" | "CMU462"))
        })
}

/// `<tag id="...">`, for messages.
pub(super) fn describe(element: Element<'_>) -> String {
    match element.attribute("id") {
        Some(id) => format!("<{} id=\"{}\">", tag(element), truncated(id)),
        None => format!("<{}>", tag(element)),
    }
}

/// The name of an element: its attribute `name`, else its id, else its tag.
pub(super) fn name_of(element: Element<'_>) -> String {
    let name = element.attribute("name").or(element.attribute("id"));
    truncated(name.unwrap_or(tag(element)))
}

/// A text, truncated for messages and names.
pub(super) fn truncated(text: &str) -> String {
    let mut chars = text.chars();
    let start: String = chars.by_ref().take(MAX_NAME).collect();
    if chars.next().is_some() {
        start + "..."
    } else {
        start
    }
}
