//! `<texture>`: from the name in a material to an image file.
//!
//! The way is long: `<texture texture="sampler">` names a `<newparam>` of the effect with a `<sampler2D>`, whose
//! `<source>` names another with a `<surface>`, whose `<init_from>` names an `<image>`, whose `<init_from>` is the file.
//! COLLADA 1.5 leaves out the surface (`<instance_image>`); many exporters write the image's id right away.

use super::document::{Document, Element, child, children, descend, short, tag};
use crate::diagnostic::SceneError;

/// The file of the picture that `texture`, in `effect`, asks for, as the file names it; `None`, with a warning, if it
/// names none.
pub(super) fn file<'a>(
    doc: &Document<'a>,
    effect: Element<'a>,
    texture: Element<'a>,
) -> Result<Option<String>, SceneError> {
    let name = doc.attribute(texture, "texture")?;
    let file = image(doc, effect, name).and_then(init_from);
    if file.is_none() {
        doc.warn(|| {
            let title = format!("the texture `{}` leads to no image file", short(name));
            let expected = "expected a sampler, or an <image> with <init_from>";
            doc.on_attribute(texture, "texture", title, expected)
                .help("the surface is taken as grey, 0.5 0.5 0.5")
        });
    }
    Ok(file.map(path))
}

/// The `<image>` that `name` leads to.
fn image<'a>(doc: &Document<'a>, effect: Element<'a>, name: &str) -> Option<Element<'a>> {
    let Some(sampler) = parameter(effect, name).and_then(|param| child(param, "sampler2D")) else {
        return doc.find(&format!("#{name}"), "image");
    };
    if let Some(instance) = child(sampler, "instance_image") {
        return doc.find(instance.attribute("url")?, "image");
    }
    let surface = parameter(effect, child(sampler, "source")?.text()?.trim())?;
    let id = descend(surface, &["surface", "init_from"])?.text()?.trim();
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

/// What an `<image>` is read from; in COLLADA 1.5 one element deeper.
fn init_from<'a>(image: Element<'a>) -> Option<&'a str> {
    let from = child(image, "init_from")?;
    let text = child(from, "ref").unwrap_or(from).text()?.trim();
    (!text.is_empty()).then_some(text)
}

/// A URI as a path: without `file://`, with `%20` and its like written out.
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
