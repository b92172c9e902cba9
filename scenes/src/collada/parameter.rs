//! `<newparam>` and `<setparam>`: the parameters of an effect.

use super::document::{Element, child, children, tag};

/// An effect, as a material uses it.
#[derive(Clone, Copy)]
pub(super) struct EffectInstance<'a> {
    pub(super) effect: Element<'a>,
    /// The `<instance_effect>`, which may set parameters.
    pub(super) instance: Element<'a>,
}

impl<'a> EffectInstance<'a> {
    /// The value of the parameter `sid`, an element with one of these `tags`. The `<setparam>` of
    /// the `<instance_effect>` takes precedence over the `<newparam>` of the effect.
    pub(super) fn parameter(&self, sid: &str, tags: &[&str]) -> Option<Element<'a>> {
        let value = |param: Element<'a>| tags.iter().find_map(|tag| child(param, tag));
        children(self.instance)
            .find(|set| tag(*set) == "setparam" && set.attribute("ref") == Some(sid))
            .and_then(value)
            .or_else(|| self.declaration(sid).and_then(value))
    }

    /// The `<newparam sid="...">` of the effect.
    fn declaration(&self, sid: &str) -> Option<Element<'a>> {
        let profile = child(self.effect, "profile_COMMON")?;
        let technique = child(profile, "technique");
        [Some(self.effect), Some(profile), technique]
            .into_iter()
            .flatten()
            .flat_map(children)
            .find(|param| tag(*param) == "newparam" && param.attribute("sid") == Some(sid))
    }

    /// The child of `property` with one of these `tags`, or the parameter of this kind that its
    /// `<param ref="...">` refers to.
    pub(super) fn value(&self, property: Element<'a>, tags: &[&str]) -> Option<Element<'a>> {
        let own = tags.iter().find_map(|tag| child(property, tag));
        own.or_else(|| self.parameter(child(property, "param")?.attribute("ref")?, tags))
    }
}
