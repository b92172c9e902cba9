//! `--export`: writes the scene for another renderer.

use crate::failure::Failure;
use crate::{outputs, view};
use base::{errln, outln};
use kit::LitScene;
use pathtracer::args::Args;
use pathtracer::{Job, LightSettings, PartFile, to_mitsuba};
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

/// Exports the scene of `args` for `renderer` to `path`, with its meshes in the same folder.
pub(crate) fn run(
    args: &Args,
    light: &LightSettings,
    renderer: &str,
    path: &Path,
) -> Result<ExitCode, Failure> {
    if renderer != "mitsuba" || path.extension().is_none_or(|e| e != "xml") {
        return Err(Failure::Input(format!(
            "--export {renderer} {}: use --export mitsuba and a name that ends in .xml",
            path.display()
        )));
    }
    outputs::refuse_taken("--export", path, &outputs::inputs(args))?;
    let scene = view::load_scene(args)?;
    let (camera, film) = view::camera_and_film(args, &scene)?;
    let job = Job {
        camera,
        film,
        cell: film.whole(),
        samples: args.samples,
        sampling: args.sampling(args.samples),
    };
    let lit = LitScene::new(scene, None);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let exported = to_mitsuba(&lit, &job, light, &stem).map_err(|problems| {
        Failure::Input(format!(
            "the scene cannot be exported exactly:\n  {}",
            problems.join("\n  ")
        ))
    })?;
    for warning in &exported.warnings {
        errln!("warning: {warning}");
    }
    // Write all files before any is renamed, so that an old scene is never combined with new
    // meshes.
    let mut written = Vec::new();
    for file in exported.files {
        let path = path.with_file_name(format!("{stem}{}", file.suffix));
        let part = PartFile::create(&path)
            .and_then(|part| part.file().write_all(file.text.as_bytes()).map(|()| part))
            .map_err(|why| cannot_write(&path, &why))?;
        written.push(part);
    }
    // The scene last: a mesh that cannot be written leaves no new scene.
    for part in written.into_iter().rev() {
        part.finish()
            .map_err(|why| cannot_write(part.path(), &why))?;
        outln!("Wrote       {}", part.path().display());
    }
    Ok(ExitCode::SUCCESS)
}

fn cannot_write(path: &Path, why: &io::Error) -> Failure {
    Failure::Input(format!(
        "cannot write {}: {why}: choose an existing folder with write permission",
        path.display()
    ))
}
