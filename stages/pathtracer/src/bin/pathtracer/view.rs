//! The scene, and from where it is seen.

use crate::args::Args;
use crate::failure::Failure;
use kit::{Camera, FilmSize, Scene};
use pathtracer::Textures;
use scenes::{CameraFile, placement};
use std::io::{IsTerminal, stderr};
use std::path::Path;

/// Reads the scene and tells what was mended in it.
pub(crate) fn load_scene(path: &Path) -> Result<Scene, Failure> {
    let loaded = scenes::load(path)?;
    for warning in &loaded.warnings {
        if stderr().is_terminal() {
            eprintln!("{}", warning.styled());
        } else {
            eprintln!("{warning}");
        }
    }
    Ok(loaded.scene)
}

/// Reads the pictures that surfaces of the scene in `file` carry, and tells which are missing.
pub(crate) fn load_textures(file: &Path, scene: &Scene) -> Textures {
    let (textures, missing) = Textures::load(scene, file.parent().unwrap_or(Path::new("")));
    for texture in missing {
        eprintln!("warning: {texture}");
    }
    textures
}

/// The camera of `-c` with its angles as they are, else the scene's; and the picture's size.
pub(crate) fn camera_and_film(args: &Args, scene: &Scene) -> Result<(Camera, FilmSize), Failure> {
    let Some(path) = &args.camera else {
        let film = args.film(None)?;
        if placement::is_edge_on(scene) {
            eprintln!(
                "note: the scene's camera looks along the edge of the scene, so that half of the picture would be empty: \
                 the whole scene is framed instead (-c gives another camera)"
            );
        }
        return Ok((placement::place(scene, film).camera, film));
    };
    let file = CameraFile::load(path)?;
    let film = args.film(Some(file.film))?;
    Ok((file.view.camera, film))
}
