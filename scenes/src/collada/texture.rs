//! `<texture>`: finds the image file of a texture.
//!
//! The chain of references is long. `<texture texture="sampler">` refers to a `<newparam>` of the
//! effect with a `<sampler2D>`. Its `<source>` refers to another one with a `<surface>`. Its
//! `<init_from>`, or the `<all>` of its `<init_planar>`, refers to an `<image>`, whose
//! `<init_from>` is the file. COLLADA 1.5 has no surface (`<instance_image>`), and its images may
//! have the file in `<create_2d>`. Many exporters write the id of the image directly. A
//! `<setparam>` of the `<instance_effect>` replaces the sampler or the surface.

use super::document::{Document, Element, child, children, descendant, tag, text, truncated};
use super::parameter::EffectInstance;
use super::uri;
use crate::diagnostic::SceneError;

/// The image of a texture.
pub(super) struct TextureImage<'a> {
    /// The path of its file.
    pub(super) file: String,
    /// The name by which `<bind_vertex_input>` chooses the texture coordinates.
    pub(super) texcoord: Option<&'a str>,
}

/// Why a texture has no image file: a cube map, for example.
struct Unsupported<'a> {
    element: Element<'a>,
    what: &'static str,
}

/// The image of `texture`. `None`, with a warning, if there is none.
pub(super) fn image<'a>(
    doc: &Document<'a>,
    effect: &EffectInstance<'a>,
    texture: Element<'a>,
) -> Result<Option<TextureImage<'a>>, SceneError> {
    let name = doc.attribute(texture, "texture")?;
    let shown = truncated(name);
    let finding = match find_file(doc, effect, name) {
        Ok(Some(file)) => {
            let texcoord = texture.attribute("texcoord");
            return Ok(Some(TextureImage { file, texcoord }));
        }
        Ok(None) => {
            let title = format!("the texture `{shown}` has no image file");
            let expected = "expected a sampler, or an <image> with <init_from>";
            doc.on_attribute(texture, "texture", title, expected)
        }
        Err(Unsupported { element, what }) => {
            let title = format!("the texture `{shown}` is {what}");
            doc.on(element, title, "expected a 2D image in a file")
        }
    };
    finding.help("the surface uses grey, 0.5 0.5 0.5").warn();
    Ok(None)
}

/// The path of the file of the texture `name`.
fn find_file<'a>(
    doc: &Document<'a>,
    effect: &EffectInstance<'a>,
    name: &str,
) -> Result<Option<String>, Unsupported<'a>> {
    let by_id = |id: &str| doc.find(&format!("#{id}"), "image");
    let sampler = effect.parameter(name, &["sampler2D", "samplerCUBE", "sampler3D"]);
    let image = match sampler {
        None => by_id(name),
        Some(sampler) => {
            check_kind(sampler)?;
            for name in ["wrap_s", "wrap_t"] {
                check_wrap(doc, sampler, name);
            }
            let instance = child(sampler, "instance_image");
            let url = instance.and_then(|instance| instance.attribute("url"));
            match (url, child(sampler, "source").map(text)) {
                (Some(url), _) => doc.find(url, "image"),
                (None, Some(source)) => match effect.parameter(&source, &["surface"]) {
                    Some(surface) => surface_image(surface)?.and_then(|id| by_id(&id)),
                    None => by_id(&source),
                },
                (None, None) => None,
            }
        }
    };
    image.map_or(Ok(None), image_file)
}

/// The id of the image that a `<surface>` is initialised from.
fn surface_image<'a>(surface: Element<'a>) -> Result<Option<String>, Unsupported<'a>> {
    let of_type = |what| {
        Err(Unsupported {
            element: surface,
            what,
        })
    };
    match surface.attribute("type") {
        Some("CUBE") => return of_type("a cube map"),
        Some("3D") => return of_type("a volume"),
        _ => {}
    }
    let planar = descendant(surface, &["init_planar", "all"]);
    let id = planar
        .and_then(|all| all.attribute("ref"))
        .map(str::to_owned);
    match id.or_else(|| child(surface, "init_from").map(text)) {
        None => children(surface).try_for_each(check_kind).map(|()| None),
        id => Ok(id),
    }
}

/// The path of the file of an `<image>`.
fn image_file<'a>(image: Element<'a>) -> Result<Option<String>, Unsupported<'a>> {
    let from = child(image, "init_from").or_else(|| descendant(image, &["create_2d", "init_from"]));
    let Some(from) = from else {
        return children(image).try_for_each(check_kind).map(|()| None);
    };
    children(from).try_for_each(check_kind)?;
    let from = child(from, "ref").unwrap_or(from);
    let uri = text(from);
    Ok((!uri.is_empty()).then(|| uri::path(from, &uri)))
}

/// An error for an element that stands for something else than a 2D image in a file.
fn check_kind(element: Element<'_>) -> Result<(), Unsupported<'_>> {
    let what = match tag(element) {
        "samplerCUBE" | "init_cube" | "create_cube" => "a cube map",
        "sampler3D" | "init_volume" | "create_3d" => "a volume",
        "init_as_target" | "renderable" => "the target of another rendering",
        "init_as_null" => "made by a program",
        "data" | "hex" => "inside of the scene file",
        _ => return Ok(()),
    };
    Err(Unsupported { element, what })
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
