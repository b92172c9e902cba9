//! Ids, and the references to them.

use super::document::{Document, Element, tag, truncated};
use super::finding::Finding;
use super::uri::{last_segment, percent_decoded};
use crate::diagnostic::SceneError;
use std::collections::{HashMap, HashSet};

/// Elements by tag and id. For a duplicate id, the first element.
pub(super) struct Ids<'a> {
    by_id: HashMap<(&'a str, &'a str), Element<'a>>,
    /// The tags and ids that several elements have.
    ambiguous: HashSet<(&'a str, &'a str)>,
}

impl<'a> Ids<'a> {
    pub(super) fn of(xml: &'a roxmltree::Document<'a>) -> Ids<'a> {
        let mut by_id = HashMap::new();
        let mut ambiguous = HashSet::new();
        for element in xml.descendants().filter(|node| node.is_element()) {
            if let Some(id) = element.attribute("id") {
                let key = (tag(element), id);
                if *by_id.entry(key).or_insert(element) != element {
                    ambiguous.insert(key);
                }
            }
        }
        Ids { by_id, ambiguous }
    }

    /// The element with this tag and id. An id in a URI may be percent-encoded.
    fn get(&self, tag: &'a str, id: &str) -> Option<Element<'a>> {
        let found = self.by_id.get(&(tag, id)).copied();
        found.or_else(|| self.by_id.get(&(tag, &*percent_decoded(id))).copied())
    }

    /// The tags of all elements with this id, the first in the alphabet.
    fn tag_of(&self, id: &str) -> Option<&'a str> {
        let keys = self.by_id.keys().filter(|(_, other)| *other == id);
        keys.map(|(tag, _)| *tag).min()
    }

    /// The ids that elements with this tag have, for messages.
    fn known(&self, tag: &str) -> String {
        let with_tag = self.by_id.keys().filter(|key| key.0 == tag);
        let mut ids: Vec<&str> = with_tag.map(|key| key.1).collect();
        ids.sort_unstable();
        if ids.is_empty() {
            return format!(
                "the file has no <{tag}> with an id: add one, or export the file again"
            );
        }
        let first = ids.iter().take(5);
        let shown: Vec<String> = first.map(|id| format!("#{}", truncated(id))).collect();
        let more = if ids.len() > 5 { ", ..." } else { "" };
        format!("the file has {}{more}", shown.join(", "))
    }
}

impl<'a> Document<'a> {
    /// The id in a reference such as `#id`, if it refers to this file. `scene.dae#id` does so in a
    /// file of this name.
    fn own_id<'t>(&self, reference: &'t str) -> Option<&'t str> {
        let (file, id) = reference.trim().split_once('#')?;
        let is_own =
            file.is_empty() || percent_decoded(last_segment(file)) == last_segment(self.file());
        is_own.then_some(id)
    }

    /// The element with the tag `tag` that a reference such as `url="#id"` refers to, if it exists.
    pub(super) fn find(&self, reference: &str, tag: &'a str) -> Option<Element<'a>> {
        self.ids().get(tag, self.own_id(reference)?)
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
        let id = self.own_id(reference).unwrap_or_default();
        if self.ids().ambiguous.contains(&(tag, id)) {
            let title = format!("several <{tag}> have the id `{}`", truncated(id));
            self.on_attribute(element, name, title, "using the first one")
                .warn();
        }
        self.find(reference, tag)
            .ok_or_else(|| self.unresolved(element, name, tag).into())
    }

    /// Why attribute `name` of `element` does not refer to an element with the tag `tag`.
    pub(super) fn unresolved(
        &self,
        element: Element<'a>,
        name: &str,
        tag: &str,
    ) -> Finding<'_, 'a> {
        let reference = element.attribute(name).unwrap_or_default().trim();
        let shown = truncated(reference);
        let finding =
            |title: String, expected: String| self.on_attribute(element, name, title, expected);
        let Some(id) = self.own_id(reference) else {
            let expected = format!("expected `#` and the id of a <{tag}> in this file");
            return if reference.contains('#') {
                finding(format!("`{shown}` is in another file"), expected)
                    .help("only this file is read: export everything into it")
            } else {
                finding(format!("`{shown}` is not a reference"), expected)
                    .help(format!("write {name}=\"#{shown}\" if that is the id"))
            };
        };
        let finding = match self.ids().tag_of(id) {
            Some(other) => finding(
                format!("`{shown}` is the id of a <{other}>"),
                format!("expected the id of a <{tag}>"),
            ),
            None => finding(
                format!("there is no <{tag}> with the id `{}`", truncated(id)),
                format!("refers to a <{tag}> that is not in the file"),
            ),
        };
        finding.help(self.ids().known(tag))
    }
}
