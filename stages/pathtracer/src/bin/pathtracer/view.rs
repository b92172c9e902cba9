//! Loads the scene, its textures and the camera.

use crate::args::Args;
use crate::failure::Failure;
use kit::{Camera, FilmSize, Scene};
use pathtracer::Textures;
use scenes::{CameraFile, placement};
use std::io::{IsTerminal, stderr};
use std::path::Path;

/// Reads the scene and prints its warnings.
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

/// Reads the textures of the scene in `file` and prints a warning for each that cannot be read.
pub(crate) fn load_textures(file: &Path, scene: &Scene) -> Textures {
    let (textures, missing) = Textures::load(scene, file.parent().unwrap_or(Path::new("")));
    for texture in missing {
        eprintln!("warning: {texture}");
    }
    textures
}

/// The camera and the size of the picture: those of the camera file `-c` with its angles unchanged,
/// else those of the scene.
pub(crate) fn camera_and_film(args: &Args, scene: &Scene) -> Result<(Camera, FilmSize), Failure> {
    let Some(path) = &args.camera else {
        let film = args.film(None)?;
        if placement::is_edge_on(scene) {
            eprintln!(
                "note: with the scene's camera half of the picture would be empty, so the camera frames the whole \
                 scene instead: use -c for another camera"
            );
        }
        return Ok((placement::place(scene, film).camera, film));
    };
    let file = CameraFile::load(path)?;
    let film = args.film(Some(file.film))?;
    Ok((file.view.camera, film))
}
