//! `<newparam>` and `<setparam>`: the parameters of an effect.

use super::document::{Element, child, children, tag};

/// The `<newparam sid="...">` of an effect.
pub(super) fn declaration<'a>(effect: Element<'a>, sid: &str) -> Option<Element<'a>> {
    let profile = child(effect, "profile_COMMON")?;
    let technique = child(profile, "technique");
    [Some(effect), Some(profile), technique]
        .into_iter()
        .flatten()
        .flat_map(children)
        .find(|param| tag(*param) == "newparam" && param.attribute("sid") == Some(sid))
}

/// The `<float3>` or `<float4>` of the parameter that a `<param ref="...">` refers to. The
/// `<setparam>` of an `<instance_effect>` takes precedence over the default of the effect.
pub(super) fn color<'a>(
    instance: Element<'a>,
    effect: Element<'a>,
    param: Element<'a>,
) -> Option<Element<'a>> {
    let sid = param.attribute("ref")?;
    let value = |param: Element<'a>| child(param, "float4").or(child(param, "float3"));
    children(instance)
        .find(|set| tag(*set) == "setparam" && set.attribute("ref") == Some(sid))
        .and_then(value)
        .or_else(|| declaration(effect, sid).and_then(value))
}
