//! The COLLADA 1.4.1 reader.
//!
//! # What is read
//!
//! - Meshes: `triangles`, `polylist`, `polygons`, `tristrips`, `trifans`. Polygons are cut into triangles, concave
//!   ones too. `NORMAL`s of the file, else the mean of the faces around a vertex, weighted by their areas. Texture
//!   coordinates where a material has a picture: the first set.
//! - The course's own shapes, materials and lights in `<extra><technique profile="CGL">`, or `CMU462`, which
//!   means the same: `sphere{radius}`, `area{color}`, `emission{radiance}`, `mirror{reflectance}`,
//!   `glossy{reflectance, shininess}`, `glass{reflectance, transmittance, roughness, ior}`,
//!   `refraction{transmittance, roughness, ior}`. Without one of them, the diffuse colour, or the picture
//!   (`<texture>`, an image file beside the scene), of `phong`, `lambert` or `blinn`. The pixels are not read here.
//! - Lights: `area` (the unit square in x and y, shining to -z), `point`, `spot`, `directional`, and `ambient` as
//!   an even sky. Attenuations are passed over: light falls off with the square of the distance by itself.
//! - Perspective cameras: `xfov`, `yfov`, `aspect_ratio`, `znear`, `zfar`.
//! - Nodes in nodes and instances of nodes, under `matrix`, `translate`, `rotate`, `scale` and `lookat`. Everything
//!   is placed in world space: y is up, whatever `up_axis` says. `unit` is passed over, as by the original course
//!   program: lengths are those of the file.
//!
//! # What is mended, with a warning
//!
//! | in the file | taken as |
//! |---|---|
//! | a `matrix` with 12 to 15 numbers | the rest of its last row is 0 0 0 1 |
//! | no `count` at an array or a primitive | what is there |
//! | a missing or unbound material, no diffuse colour, a `<texture>` that names no image | grey, 0.5 |
//! | a symbol that is not bound, beside one that is | the one that is bound |
//! | a reflectance or transmittance above 1; none at all | 1 |
//! | `emission` in the common profile | no light: the course's `emission` is meant for that |
//! | polygons of fewer than 3 corners, with holes, without area | left out |
//! | a polygon that crosses itself | triangles that may overlap |
//! | lines, splines, controllers, unknown lights and shapes | left out |
//! | a light or a camera that its transform flattens | left out |
//! | a second camera; a camera that is not perspective | left out; without any camera the scene is framed |
//! | no `<scene>` | the only visual scene |
//!
//! # What is an error
//!
//! Everything else: malformed XML, missing elements and references, counts that do not agree, indices out of range,
//! numbers that are none, NaN or infinite, negative radii and colours, uneven scale on a sphere, `skew`, nodes that
//! contain themselves or nest too deep, instances that multiply beyond measure, empty scenes. No file makes the
//! reader panic, hang or take memory without end: `limits` has the bounds.
//!
//! # How it is built
//!
//! Read in this order: `screen` and `document` (ids, references, errors with their place), `numbers`,
//! `source` and `vertices` (lists of numbers), `primitives`, `polygon`, `mesh_part`, `normals` and `mesh`
//! (index lists become triangles), `geometry`, `material`, `texture`, `light` and `optics` (what nodes place),
//! `transform`, `binding` and `library` (what a node holds), `bake` and `nodes` (the tree, placed in the
//! world).

mod bake;
mod binding;
mod document;
mod geometry;
mod library;
mod light;
pub(crate) mod limits;
mod material;
mod mesh;
mod mesh_part;
mod nodes;
mod normals;
mod numbers;
mod optics;
mod polygon;
mod primitives;
mod screen;
mod source;
mod texture;
mod transform;
mod vertices;

use crate::diagnostic::{Diagnostic, SceneError, Warning};
use document::{Document, Element, child, children, tag};
use kit::Scene;
use std::io::Read;
use std::path::Path;

/// A scene and what was mended to get it.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene. Its camera is the file's own, with the frame the file asks for: see
    /// [`crate::placement`] for how to look at the scene.
    pub scene: Scene,
    /// What was mended, in the order of the file's scene.
    pub warnings: Vec<Warning>,
}

/// Reads a COLLADA file.
pub fn load(path: impl AsRef<Path>) -> Result<Loaded, SceneError> {
    let path = path.as_ref();
    let name = path.display().to_string();
    parse(&name, &read_text(path, &name)?)
}

/// Reads a file of text; its errors say what to do.
pub(crate) fn read_text(path: &Path, name: &str) -> Result<String, SceneError> {
    let unreadable = |error: std::io::Error| {
        let help = match error.kind() {
            std::io::ErrorKind::NotFound => "check the path: it counts from the current folder",
            std::io::ErrorKind::PermissionDenied => "allow yourself to read it",
            _ => "give the path of a file",
        };
        Diagnostic::about_file(name, format!("the file cannot be read: {error}")).help(help)
    };
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(unreadable)?;
    file.take(limits::MAX_FILE_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    if bytes.len() as u64 > limits::MAX_FILE_BYTES {
        let title = format!("the file has more than {} bytes", limits::MAX_FILE_BYTES);
        let finding =
            Diagnostic::about_file(name, title).help("simplify the meshes before you export");
        return Err(finding.into());
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let title = format!("the file is not text in UTF-8: byte {at} is none of it");
        Diagnostic::about_file(name, title)
            .help("save it as UTF-8; a compressed .zae must be unpacked first")
            .into()
    })
}

/// Reads a COLLADA file from its text. `name` stands for the file in errors.
pub fn parse(name: &str, text: &str) -> Result<Loaded, SceneError> {
    screen::screen(name, text)?;
    let xml = roxmltree::Document::parse(text).map_err(|error| malformed(name, text, &error))?;
    let doc = Document::new(name, &xml);
    let scene = build(&doc)?;
    Ok(Loaded {
        scene,
        warnings: doc.into_warnings(),
    })
}

fn build<'a>(doc: &Document<'a>) -> Result<Scene, SceneError> {
    let root = doc.root();
    if tag(root) != "COLLADA" {
        return Err(doc
            .on(
                root,
                format!("the file is not COLLADA but <{}>", tag(root)),
                "expected <COLLADA>",
            )
            .help("export the scene as COLLADA (.dae)")
            .into());
    }
    let to_world = transform::up_axis(doc, root)?;
    let visual_scene = visual_scene(doc, root)?;
    let scene = nodes::Builder::new(doc).build(visual_scene, &to_world)?;
    if scene.is_empty() {
        return Err(doc
            .on(
                visual_scene,
                "the scene is empty",
                "expected nodes with an <instance_geometry>",
            )
            .help("there is nothing to draw: place a mesh or a sphere")
            .into());
    }
    Ok(scene)
}

/// The visual scene that `<scene>` names; without one, the only one there is, with a warning.
fn visual_scene<'a>(doc: &Document<'a>, root: Element<'a>) -> Result<Element<'a>, SceneError> {
    if let Some(instance) =
        child(root, "scene").and_then(|scene| child(scene, "instance_visual_scene"))
    {
        return doc.target(instance, "url", "visual_scene");
    }
    let libraries = children(root).filter(|element| tag(*element) == "library_visual_scenes");
    let mut scenes = libraries
        .flat_map(children)
        .filter(|element| tag(*element) == "visual_scene");
    match (scenes.next(), scenes.next()) {
        (Some(only), None) => {
            doc.warn(|| {
                let title = "no <scene> says what to show";
                doc.on(only, title, "the only visual scene is taken")
            });
            Ok(only)
        }
        _ => Err(doc
            .on(
                root,
                "no <scene> says what to show",
                "expected <scene> with <instance_visual_scene url=\"#...\"/>",
            )
            .help("export the file again, with a scene")
            .into()),
    }
}

/// The XML itself is broken.
fn malformed(name: &str, text: &str, error: &roxmltree::Error) -> SceneError {
    let pos = error.pos();
    let line_start = text
        .split_inclusive('\n')
        .take(pos.row.saturating_sub(1) as usize)
        .map(str::len)
        .sum::<usize>();
    let column = text[line_start..]
        .chars()
        .take(pos.col.saturating_sub(1) as usize);
    let at = line_start + column.map(char::len_utf8).sum::<usize>();
    let help = match error {
        roxmltree::Error::DtdDetected => "remove the <!DOCTYPE ...>: COLLADA needs none",
        _ => "mend the XML here, or export the file again; a cut-off download is a common cause",
    };
    Diagnostic::about_file(name, format!("the file is not well-formed XML: {error}"))
        .at(text, at..at + 1, "here")
        .help(help)
        .into()
}
