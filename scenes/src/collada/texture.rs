//! `<texture>`: finds the image file of a texture.
//!
//! The chain of references is long. `<texture texture="sampler">` refers to a `<newparam>` of the
//! effect with a `<sampler2D>`. Its `<source>` refers to another one with a `<surface>`. Its
//! `<init_from>` refers to an `<image>`, whose `<init_from>` is the file. COLLADA 1.5 has no
//! surface (`<instance_image>`). Many exporters write the id of the image directly.

use super::document::{Document, Element, child, descendant, text, truncated};
use super::parameter::declaration;
use super::uri;
use crate::diagnostic::SceneError;

/// The image file of `texture` in `effect`, as a path. `None`, with a warning, if there is none.
pub(super) fn file<'a>(
    doc: &Document<'a>,
    effect: Element<'a>,
    texture: Element<'a>,
) -> Result<Option<String>, SceneError> {
    let name = doc.attribute(texture, "texture")?;
    let file = image(doc, effect, name).and_then(init_from);
    if file.is_none() {
        let title = format!("the texture `{}` has no image file", truncated(name));
        let expected = "expected a sampler, or an <image> with <init_from>";
        doc.on_attribute(texture, "texture", title, expected)
            .help("the surface uses grey, 0.5 0.5 0.5")
            .warn();
    }
    Ok(file)
}

/// The `<image>` that `name` refers to.
fn image<'a>(doc: &Document<'a>, effect: Element<'a>, name: &str) -> Option<Element<'a>> {
    let Some(sampler) = declaration(effect, name).and_then(|param| child(param, "sampler2D"))
    else {
        return doc.find(&format!("#{name}"), "image");
    };
    for name in ["wrap_s", "wrap_t"] {
        check_wrap(doc, sampler, name);
    }
    if let Some(instance) = child(sampler, "instance_image") {
        return doc.find(instance.attribute("url")?, "image");
    }
    let surface = declaration(effect, &text(child(sampler, "source")?))?;
    let id = text(descendant(surface, &["surface", "init_from"])?);
    doc.find(&format!("#{id}"), "image")
}

/// Warns of a texture that is not to be repeated outside of its picture, since all are.
fn check_wrap(doc: &Document<'_>, sampler: Element<'_>, name: &str) {
    let Some(wrap) = child(sampler, name) else {
        return;
    };
    let mode = text(wrap);
    if mode != "WRAP" {
        let title = format!("<{name}> is `{}`", truncated(&mode));
        doc.on(wrap, title, "only WRAP is supported")
            .help("the texture is repeated")
            .warn();
    }
}

/// The file of an `<image>`. In COLLADA 1.5 it is one element deeper.
fn init_from(image: Element<'_>) -> Option<String> {
    let from = child(image, "init_from")?;
    let from = child(from, "ref").unwrap_or(from);
    let uri = text(from);
    (!uri.is_empty()).then(|| uri::path(from, &uri))
}
