//! Readers of models in other formats than COLLADA: glTF (`.glb`, `.gltf`), OBJ and PLY.
//!
//! Libraries parse the files (`gltf`, `ply-rs-bw`; OBJ is read here). Here their contents become a
//! [`kit::Scene`], and what has no place in it is named in a warning. Reading order: `builder`
//! (triangles, materials and warnings, for all formats), `accessor`, `gltf_material` and `gltf`,
//! `obj` and `mtl`, `ply`.
//!
//! Such files often have no light: then a sky and a sun are added, and [`Loaded::added_light`] is
//! set. One without a camera is framed, from the right and from above.

mod accessor;
mod builder;
mod gltf;
mod gltf_material;
mod mtl;
mod obj;
mod ply;

use crate::Loaded;
use crate::diagnostic::{Diagnostic, SceneError};
use crate::limited_file;
use crate::placement;
use kit::scene::NamedLight;
use kit::{FilmSize, Light, Material, Scene, Spectrum, Vec3};
use std::path::Path;

/// From where a model without a camera is seen: its front, from the right and from above.
const FROM: Vec3 = Vec3::new(0.6, 0.4, 1.0);

/// A format of files, by their extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Gltf,
    Obj,
    Ply,
}

/// Reads a model by the extension of its name. `None` if no reader of a model knows the extension.
pub(crate) fn load(path: &Path) -> Option<Result<Loaded, SceneError>> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    let format = match extension.as_str() {
        "glb" | "gltf" => Format::Gltf,
        "obj" => Format::Obj,
        "ply" => Format::Ply,
        _ => return None,
    };
    let name = path.display().to_string();
    Some(read(path, &name, format).and_then(|loaded| finished(loaded, &name)))
}

fn read(path: &Path, name: &str, format: Format) -> Result<Loaded, SceneError> {
    let bytes = limited_file::read_scene(path, name)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    match format {
        Format::Gltf => gltf::read(name, folder, &bytes),
        Format::Obj => obj::read(name, folder, &bytes),
        Format::Ply => ply::read(name, &bytes),
    }
}

/// An error if there is nothing to see; light if there is none.
fn finished(mut loaded: Loaded, name: &str) -> Result<Loaded, SceneError> {
    if loaded.scene.is_empty() {
        return Err(Diagnostic::about_file(name, "the scene is empty")
            .help("there is nothing to render: export a mesh with faces")
            .note_of(loaded.warnings.iter().map(|warning| &warning.0))
            .into());
    }
    if loaded.scene.camera.is_none() {
        let film = FilmSize { w: 4, h: 3 };
        let view = placement::frame(&loaded.scene, FROM, film);
        loaded.scene.camera = Some(view.camera);
    }
    if !has_light(&loaded.scene) {
        add_light(&mut loaded.scene);
        loaded.added_light = true;
    }
    Ok(loaded)
}

fn has_light(scene: &Scene) -> bool {
    let emits = |material: &Material| !material.emission().is_black();
    let used = scene.objects.iter().map(|object| object.material as usize);
    !scene.lights.is_empty()
        || used
            .into_iter()
            .any(|i| emits(&scene.materials[i].material))
}

/// Adds a sky, and a sun that shines over the left shoulder of a viewer who looks along -z.
fn add_light(scene: &mut Scene) {
    let lights = [
        (
            "sky",
            Light::Hemisphere {
                radiance: Spectrum::grey(0.4),
            },
        ),
        (
            "sun",
            Light::Directional {
                direction: Vec3::new(0.5, -1.0, -0.8).normalize(),
                irradiance: Spectrum::grey(1.5),
            },
        ),
    ];
    scene.lights.extend(lights.map(|(name, light)| NamedLight {
        name: name.to_owned(),
        light,
    }));
}
