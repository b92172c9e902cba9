//! Loads the scene, its textures and the camera.

use crate::failure::Failure;
use base::errln;
use kit::{Camera, Environment, FilmSize, LitScene, Scene};
use pathtracer::args::{Args, NormalsName, Shade};
use pathtracer::trial::light_waits_for;
use pathtracer::{DirectSampling, LightSettings, Picture, Textures};
use scenes::placement;
use std::io::{IsTerminal, stderr};
use std::path::Path;

/// Reads the scene and prints its warnings.
pub(crate) fn load_scene(args: &Args) -> Result<Scene, Failure> {
    let loaded = scenes::load(&args.scene)?;
    for warning in &loaded.warnings {
        if stderr().is_terminal() {
            errln!("{}", warning.styled());
        } else {
            errln!("{warning}");
        }
    }
    let note = loaded.smoothed_note();
    let mut scene = loaded.scene;
    match args.normals {
        NormalsName::Flat => scene.flatten_normals(),
        NormalsName::File => {
            if let Some(note) = note {
                errln!("note: {note}: --normals flat keeps facets");
            }
        }
    }
    if loaded.added_light && args.environment.is_some() {
        scene.lights.clear();
    } else if loaded.added_light {
        errln!("note: the file has no light: a sky and a sun are added; -e FILE lights it instead");
    }
    Ok(scene)
}

/// Reads the textures of the scene in `file` and prints a warning for each that is not at
/// its path or cannot be read.
pub(crate) fn load_textures(file: &Path, scene: &Scene) -> Textures {
    let (textures, warnings) = Textures::load(scene, file.parent().unwrap_or(Path::new("")));
    for warning in warnings {
        errln!("warning: {warning}");
    }
    textures
}

/// Reads the environment map of `-e`, if there is one, and prints a warning about its file.
pub(crate) fn load_environment(args: &Args) -> Result<Option<Environment>, Failure> {
    let Some(path) = &args.environment else {
        return Ok(None);
    };
    let (environment, note) = pathtracer::load_environment(path)?;
    if let Some(note) = note {
        errln!("warning: {note}");
    }
    Ok(Some(environment))
}

/// The picture of the scene by the flag `--shade`. Its default shows light as soon as the stages
/// compute it; before that it shows normals, and a note names the task that light waits for.
pub(crate) fn picture(
    args: &Args,
    light: &LightSettings,
    scene: Scene,
    environment: Option<Environment>,
) -> Picture {
    let waits_for = match args.shade {
        Shade::Auto => light_waits_for(args.accel.into(), light),
        Shade::Normals | Shade::Lit => None,
    };
    let Some(hole) = waits_for else {
        return match Picture::new(args.shade, scene, environment) {
            Picture::Lit(lit) if light.direct_sampling == DirectSampling::Lights => {
                Picture::Lit(lit.with_chosen_lamps())
            }
            picture => picture,
        };
    };
    if LitScene::new(scene.clone(), environment.clone()).has_light() {
        errln!(
            "note: normals are shown: light waits for {} (`{}`), which is not written yet. From then on pictures \
             show light, unless `--shade normals` is given",
            hole.task,
            hole.function
        );
    }
    Picture::new(Shade::Normals, scene, environment)
}

/// The camera and the size of the picture ([`Args::view`]). Prints a note if the scene's camera is
/// not used.
pub(crate) fn camera_and_film(args: &Args, scene: &Scene) -> Result<(Camera, FilmSize), Failure> {
    let (view, film) = args.view(scene)?;
    if args.camera.is_none() && placement::is_edge_on(scene) {
        errln!(
            "note: with the scene's camera half of the picture would be empty, so the camera frames the whole \
             scene instead: use -c for another camera"
        );
    }
    Ok((view.camera, film))
}
