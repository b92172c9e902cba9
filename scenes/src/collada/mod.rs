//! The reader of COLLADA 1.4 and 1.5.
//!
//! # What is read
//!
//! - Meshes: `triangles`, `polylist`, `polygons`, `tristrips`, `trifans`. Polygons are
//!   triangulated, also concave ones and those with holes. `NORMAL`s of the file are used,
//!   otherwise the area-weighted mean of the face normals around each vertex. If a material has a
//!   texture: the set of texture coordinates that `<bind_vertex_input>` chooses for it.
//! - The shapes, materials and lights of the course's extension in
//!   `<extra><technique profile="CGL">`, or `CMU462` with the same meaning: `sphere{radius}`,
//!   `area{color}`, `emission{radiance}`, `mirror{reflectance}`, `glossy{reflectance, shininess}`,
//!   `glass{reflectance, transmittance, roughness, ior}`,
//!   `refraction{transmittance, roughness, ior}`. Otherwise `phong`, `lambert` or `blinn`: the
//!   diffuse colour or texture (an image file beside the scene, which is not read here); a mirror
//!   where `reflective` times `reflectivity` is stronger than the diffuse colour; a glossy surface
//!   where only `specular` reflects. Colours and numbers may be parameters of the effect.
//! - Lights: `area` (the unit square in x and y, emitting to -z), `point`, `spot`, `directional`,
//!   and `ambient` as a uniform sky. Attenuation elements are ignored: intensity falls with the
//!   squared distance anyway. Those of Blender 2.80 and later are as in Cycles.
//! - Perspective cameras: `xfov`, `yfov`, `aspect_ratio`, `znear`, `zfar`.
//! - Nested nodes and instances of nodes, with `matrix`, `translate`, `rotate`, `scale`, `skew` and
//!   `lookat`. Everything is transformed to world space with +y up, whatever `up_axis` is. `unit`
//!   is ignored, as by the original course program: lengths are those of the file.
//! - References to the same file: `#id`, percent-encoded or not, also after the file's own name.
//!   `xml:base` applies to image files.
//!
//! # What is repaired or left out, with a warning
//!
//! Warnings of one kind are counted together.
//!
//! | in the file | result |
//! |---|---|
//! | a `matrix` whose last row is cut off | the rest is that of 0 0 0 1 |
//! | a camera with an invalid transform, or without angle of view, or not in the file | left out |
//! | an invalid `znear`, `zfar`, `aspect_ratio`, or one of two angles of view | ignored |
//! | a second camera, or one that is not perspective | left out |
//! | a light that is not in the file, of an unknown type, or with a singular transform | left out |
//! | a missing or wrong `count` | what is there |
//! | a number with a decimal comma | read as with a point |
//! | a position that is not finite | its polygons are left out |
//! | a normal that is not finite, invalid or out of range | computed |
//! | texture coordinates that are not finite, invalid or out of range | 0, or ignored |
//! | no material or effect, no diffuse colour, a `<texture>` without an image | grey, 0.5 |
//! | an unbound symbol next to a bound one | the material of the bound one |
//! | an unknown material of the course's extension | the common profile |
//! | a reflectance or transmittance above 1, or a missing one | 1 |
//! | `emission` in the common profile | no light; the `emission` of the extension is used |
//! | `reflective`, `specular` weaker than the diffuse colour | ignored; up to 0.1, without a warning |
//! | `transparent` in the common profile | opaque |
//! | colours of vertices | ignored |
//! | several sets of texture coordinates, none chosen | the first |
//! | a texture that is a cube map, a volume or inside of the file | grey, 0.5 |
//! | a camera with an angle in radians, from a converter | left out |
//! | a camera that its transform mirrors | not mirrored |
//! | polygons with fewer than 3 corners or without area, holes outside | ignored |
//! | a polygon that intersects itself | triangles that may overlap |
//! | a skin | its mesh, placed by its first joint: right in the bind pose |
//! | a morph | its mesh without blend shapes |
//! | lines, splines, convex meshes, solid bodies, unknown shapes | left out |
//! | no `<scene>` | the first visual scene |
//!
//! If no camera is left, [`crate::placement`] frames the scene. Animations, physics and kinematics
//! are ignored.
//!
//! # What is an error
//!
//! Everything else: malformed XML, missing elements, references to shapes and nodes that are not in
//! the file, positions out of range, lists whose lengths do not agree, malformed numbers, NaN or
//! infinite ones in transforms and colours, negative radii and colours, non-uniform scale of a
//! sphere, nodes that contain themselves or are nested too deeply, too many instances, empty
//! scenes. No file makes the reader panic, hang or use unlimited memory: `limits` has the limits.
//!
//! # Modules
//!
//! Reading order: `precheck`, `malformed` and `document` with `references`, `uri`, `finding` and
//! `warnings` (elements, ids, diagnostics with positions), `numbers`, `source` and `vertices`
//! (lists of numbers), `index_lists`, `primitives`, `projection`, `polygon`, `holes`, `index_into`,
//! `mesh_part`, `normals` and `mesh` (from index lists to triangles), `geometry`, `controller`,
//! `material`, `parameter`, `texture`, `light` and `optics` (the contents of nodes), `transform`,
//! `binding` and `library` (nodes), `bake` and `nodes` (the node tree in world space).

pub(crate) mod bake;
mod binding;
mod controller;
mod document;
mod finding;
mod geometry;
mod holes;
mod index_into;
mod index_lists;
mod library;
mod light;
pub(crate) mod limits;
mod malformed;
mod material;
mod mesh;
mod mesh_part;
mod nodes;
pub(crate) mod normals;
mod numbers;
mod optics;
mod parameter;
pub(crate) mod polygon;
mod precheck;
mod primitives;
mod projection;
mod references;
mod source;
mod texture;
pub(crate) mod transform;
pub(crate) mod uri;
mod vertices;
mod warnings;

use crate::Loaded;
use crate::diagnostic::{SceneError, Warning};
use crate::text_file;
pub(crate) use document::truncated;
use document::{Document, Element, children, descendant, tag};
use kit::Scene;
use std::path::Path;

/// Reads a COLLADA file.
pub fn load(path: &Path) -> Result<Loaded, SceneError> {
    let name = path.display().to_string();
    let decoded = text_file::read(path, &name)?;
    let mut loaded = parse(&name, &decoded.text)?;
    loaded.warnings.splice(0..0, decoded.warning.map(Warning));
    Ok(loaded)
}

/// Parses the text of a COLLADA file. `name` is the file name for messages.
pub fn parse(name: &str, text: &str) -> Result<Loaded, SceneError> {
    precheck::check(name, text)?;
    let options = roxmltree::ParsingOptions {
        // A few entities that contain each other can expand to any size.
        allow_dtd: !text.contains("<!ENTITY"),
        ..roxmltree::ParsingOptions::default()
    };
    let xml = roxmltree::Document::parse_with_options(text, options)
        .map_err(|error| malformed::error(name, text, &error))?;
    let doc = Document::new(name, &xml);
    let scene = build(&doc)?;
    Ok(doc.into_loaded(scene))
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
        let error = SceneError::from(
            doc.on(
                visual_scene,
                "the scene is empty",
                "expected nodes with an <instance_geometry>",
            )
            .help("there is nothing to render: add a mesh or a sphere"),
        );
        return Err(error.0.note_of(doc.warnings().found()).into());
    }
    Ok(scene)
}

/// The visual scene that `<scene>` refers to. Without one: the first visual scene, with a warning.
fn visual_scene<'a>(doc: &Document<'a>, root: Element<'a>) -> Result<Element<'a>, SceneError> {
    if let Some(instance) = descendant(root, &["scene", "instance_visual_scene"]) {
        return doc.target(instance, "url", "visual_scene");
    }
    let title = "no <scene> selects a visual scene";
    let libraries = children(root).filter(|element| tag(*element) == "library_visual_scenes");
    let mut scenes = libraries
        .flat_map(children)
        .filter(|element| tag(*element) == "visual_scene");
    if let Some(first) = scenes.next() {
        let used = match scenes.next() {
            None => "using the only visual scene",
            Some(_) => "using the first visual scene",
        };
        doc.on(first, title, used).warn();
        return Ok(first);
    }
    let help = match root.attribute("version") {
        Some(old)
            if ["1.0", "1.1", "1.2", "1.3"]
                .iter()
                .any(|v| old.trim().starts_with(v)) =>
        {
            "versions before 1.4 are not supported: import it into a modelling program and export \
             it as COLLADA 1.4.1"
        }
        _ => "export the file again, with a scene",
    };
    let expected = "expected <scene> with <instance_visual_scene url=\"#...\"/>";
    Err(doc.on(root, title, expected).help(help).into())
}
