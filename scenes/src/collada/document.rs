//! The XML document: its elements and attributes, errors and warnings with positions in the file.

use super::finding::Finding;
use super::references::Ids;
use super::warnings::WarningList;
use crate::Loaded;
use crate::diagnostic::{Diagnostic, SceneError};
use kit::Scene;
use std::cell::{Ref, RefCell};
use std::ops::Range;

/// An element of the document.
pub(super) type Element<'a> = roxmltree::Node<'a, 'a>;

/// Maximum length of names from the file, in characters.
const MAX_NAME: usize = 80;

/// A parsed document with its ids and the warnings so far.
pub(super) struct Document<'a> {
    file: &'a str,
    xml: &'a roxmltree::Document<'a>,
    ids: Ids<'a>,
    has_textures: bool,
    warnings: RefCell<WarningList>,
    smoothed: RefCell<Vec<String>>,
}

impl<'a> Document<'a> {
    pub(super) fn new(file: &'a str, xml: &'a roxmltree::Document<'a>) -> Document<'a> {
        let mut elements = xml.descendants().filter(|node| node.is_element());
        Document {
            file,
            xml,
            ids: Ids::of(xml),
            has_textures: elements.any(|element| tag(element) == "texture"),
            warnings: RefCell::default(),
            smoothed: RefCell::default(),
        }
    }

    /// Whether any material has a texture. Otherwise texture coordinates are not needed.
    pub(super) fn has_textures(&self) -> bool {
        self.has_textures
    }

    pub(super) fn root(&self) -> Element<'a> {
        self.xml.root_element()
    }

    /// The name of the file.
    pub(super) fn file(&self) -> &'a str {
        self.file
    }

    pub(super) fn source(&self) -> &'a str {
        self.xml.input_text()
    }

    pub(super) fn ids(&self) -> &Ids<'a> {
        &self.ids
    }

    /// A finding at the bytes `mark`, with a title and a label that describes what was expected.
    pub(super) fn at(
        &self,
        mark: Range<usize>,
        title: impl Into<String>,
        expected: impl Into<String>,
    ) -> Finding<'_, 'a> {
        Finding::new(self, mark, title, expected)
    }

    /// A finding at the start tag of `element`.
    pub(super) fn on(
        &self,
        element: Element<'a>,
        title: impl Into<String>,
        expected: impl Into<String>,
    ) -> Finding<'_, 'a> {
        let start = element.range().start;
        let length = self.source()[start..]
            .find(|c: char| c.is_whitespace() || c == '>' || c == '/')
            .unwrap_or(1);
        self.at(start..start + length, title, expected)
    }

    /// A finding at an attribute of `element`.
    pub(super) fn on_attribute(
        &self,
        element: Element<'a>,
        name: &str,
        title: impl Into<String>,
        expected: impl Into<String>,
    ) -> Finding<'_, 'a> {
        match element.attribute_node(name) {
            Some(attribute) => self.at(attribute.range(), title, expected),
            None => self.on(element, title, expected),
        }
    }

    /// Adds a warning: see [`WarningList::add`].
    pub(super) fn add_warning(
        &self,
        title: &str,
        start: usize,
        diagnostic: impl FnOnce() -> Diagnostic,
    ) {
        self.warnings.borrow_mut().add(title, start, diagnostic);
    }

    /// The warnings so far.
    pub(super) fn warnings(&self) -> Ref<'_, WarningList> {
        self.warnings.borrow()
    }

    /// Makes an error a warning. `result` is what the reader does instead.
    pub(super) fn warn_of(&self, error: SceneError, result: &str) {
        let diagnostic = *error.0;
        let title = diagnostic.title().to_owned();
        let start = diagnostic.start().unwrap_or_default();
        self.add_warning(&title, start, || diagnostic.help(result));
    }

    /// Adds a mesh without normals whose edges are smoothed.
    pub(super) fn add_smoothed(&self, mesh: String) {
        self.smoothed.borrow_mut().push(mesh);
    }

    /// The scene and what is to be said about it.
    pub(super) fn into_loaded(self, scene: Scene) -> Loaded {
        let source = self.source();
        Loaded {
            scene,
            warnings: self.warnings.into_inner().into_warnings(self.file, source),
            smoothed: self.smoothed.into_inner(),
            added_light: false,
        }
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

/// The text of an element without the comments inside, trimmed.
pub(super) fn text(element: Element<'_>) -> String {
    let texts = element.children().filter(|node| node.is_text());
    let whole: String = texts.filter_map(|node| node.text()).collect();
    whole.trim().to_owned()
}

/// Follows a path of tags, each time to the first child with that tag.
pub(super) fn descendant<'a>(parent: Element<'a>, path: &[&str]) -> Option<Element<'a>> {
    path.iter()
        .try_fold(parent, |element, name| child(element, name))
}

/// The course's extension of COLLADA: the content of `<extra><technique profile="CGL">` (or
/// `CMU462`).
pub(super) fn course_technique<'a>(parent: Element<'a>) -> Option<Element<'a>> {
    technique(parent, &["CGL", "CMU462"])
}

/// The content of `<extra><technique profile="...">` of one of `profiles`.
pub(super) fn technique<'a>(parent: Element<'a>, profiles: &[&str]) -> Option<Element<'a>> {
    children(parent)
        .filter(|element| tag(*element) == "extra")
        .flat_map(children)
        .find(|element| {
            let profile = element.attribute("profile").unwrap_or_default();
            tag(*element) == "technique" && profiles.contains(&profile)
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
pub(crate) fn truncated(text: &str) -> String {
    let mut chars = text.chars();
    let start: String = chars.by_ref().take(MAX_NAME).collect();
    if chars.next().is_some() {
        start + "..."
    } else {
        start
    }
}
