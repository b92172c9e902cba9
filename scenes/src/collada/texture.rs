//! `<texture>`: finds the image file of a texture.
//!
//! The chain of references is long. `<texture texture="sampler">` refers to a `<newparam>` of the
//! effect with a `<sampler2D>`. Its `<source>` refers to another one with a `<surface>`. Its
//! `<init_from>` refers to an `<image>`, whose `<init_from>` is the file. COLLADA 1.5 has no
//! surface (`<instance_image>`). Many exporters write the id of the image directly.

use super::document::{Document, Element, child, children, descendant, tag, truncated};
use crate::diagnostic::SceneError;

/// The image file of `texture` in `effect`, as named in the file. `None`, with a warning, if there
/// is none.
pub(super) fn file<'a>(
    doc: &Document<'a>,
    effect: Element<'a>,
    texture: Element<'a>,
) -> Result<Option<String>, SceneError> {
    let name = doc.attribute(texture, "texture")?;
    let file = image(doc, effect, name).and_then(init_from);
    if file.is_none() {
        doc.warn(|| {
            let title = format!("the texture `{}` has no image file", truncated(name));
            let expected = "expected a sampler, or an <image> with <init_from>";
            doc.on_attribute(texture, "texture", title, expected)
                .help("the surface uses grey, 0.5 0.5 0.5")
        });
    }
    Ok(file.map(path))
}

/// The `<image>` that `name` refers to.
fn image<'a>(doc: &Document<'a>, effect: Element<'a>, name: &str) -> Option<Element<'a>> {
    let Some(sampler) = parameter(effect, name).and_then(|param| child(param, "sampler2D")) else {
        return doc.find(&format!("#{name}"), "image");
    };
    if let Some(instance) = child(sampler, "instance_image") {
        return doc.find(instance.attribute("url")?, "image");
    }
    let surface = parameter(effect, child(sampler, "source")?.text()?.trim())?;
    let id = descendant(surface, &["surface", "init_from"])?
        .text()?
        .trim();
    doc.find(&format!("#{id}"), "image")
}

/// The `<newparam sid="...">` of an effect.
fn parameter<'a>(effect: Element<'a>, sid: &str) -> Option<Element<'a>> {
    let profile = child(effect, "profile_COMMON")?;
    let technique = child(profile, "technique");
    [Some(effect), Some(profile), technique]
        .into_iter()
        .flatten()
        .flat_map(children)
        .find(|param| tag(*param) == "newparam" && param.attribute("sid") == Some(sid))
}

/// The file of an `<image>`. In COLLADA 1.5 it is one element deeper.
fn init_from<'a>(image: Element<'a>) -> Option<&'a str> {
    let from = child(image, "init_from")?;
    let text = child(from, "ref").unwrap_or(from).text()?.trim();
    (!text.is_empty()).then_some(text)
}

/// Converts a URI to a path: removes `file://` and decodes `%20` and the like.
fn path(uri: &str) -> String {
    let uri = uri.strip_prefix("file://").unwrap_or(uri);
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, tail @ ..] = rest {
        let escaped = (*first == b'%')
            .then(|| tail.get(..2))
            .flatten()
            .and_then(|digits| u8::from_str_radix(str::from_utf8(digits).ok()?, 16).ok());
        bytes.push(escaped.unwrap_or(*first));
        rest = if escaped.is_some() { &tail[2..] } else { tail };
    }
    String::from_utf8(bytes).unwrap_or_else(|_| uri.to_owned())
}

#[cfg(test)]
mod tests {
    use super::path;

    #[test]
    fn uris_become_paths() {
        assert_eq!(path("tiles.png"), "tiles.png");
        assert_eq!(
            path("file:///home/me/my%20tiles.png"),
            "/home/me/my tiles.png"
        );
        assert_eq!(path("100%.png"), "100%.png");
        assert_eq!(path("a%2"), "a%2");
        assert_eq!(path("%ff.png"), "%ff.png");
    }
}
