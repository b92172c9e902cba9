//! Parts of a picture: what they have in common, and their files.

use crate::failure::Failure;
use kit::Scene;
use kit::sampler::Pattern;
use pathtracer::args::Args;
use pathtracer::sums_file::Fingerprint;
use pathtracer::{Job, LightSettings, PartFile, PreparedScene, Rendered, SumsFile, read_texture};
use std::fs;
use std::path::Path;

/// Writes the rendered sums of the part that `job` describes.
pub(crate) fn write(
    part: &PartFile,
    args: &Args,
    job: &Job,
    light: &LightSettings,
    scene: &PreparedScene,
    rendered: &Rendered,
) -> Result<(), Failure> {
    let picture = fingerprint(args, job, light, scene)?;
    let is_adaptive = light.adaptive.is_some() && scene.picture.is_lit();
    SumsFile::of_cell(rendered, job, is_adaptive, picture)
        .write(part)
        .map_err(|why| Failure::Input(format!("cannot write {}: {why}", part.path().display())))
}

/// What a part has that was interrupted after `taken` samples of each pixel, and how to render the
/// others.
pub(crate) fn note_interrupted(job: &Job, taken: u32) -> String {
    let (samples, first) = (job.samples, job.sampling.first_sample + taken);
    let rest = samples - taken;
    let had = format!("note: interrupted: the file has {taken} of {samples} samples of each pixel");
    match job.sampling.pattern {
        // The strata of a part depend on its number of samples.
        Pattern::Stratified { .. } => {
            format!("{had}, which cannot be merged with others: strata belong to all of them")
        }
        _ => format!(
            "{had}. Render the others to a file of their own with --first-sample {first} -s {rest}, and merge both"
        ),
    }
}

/// What an adaptive part has that was interrupted after `samples` samples of all pixels.
pub(crate) fn note_interrupted_adaptive(samples: u64) -> String {
    format!(
        "note: interrupted: the file has {samples} samples. With -a a pixel gets all of its samples at once; those that had none yet have the samples of a first pass, and cannot be rendered further"
    )
}

/// Identifies what the samples depend on: the scene as it was read from all of its files, the
/// camera, the size of the picture, the random numbers and the settings. Neither the part nor the
/// threads, nor how intersections are found.
fn fingerprint(
    args: &Args,
    job: &Job,
    light: &LightSettings,
    scene: &PreparedScene,
) -> Result<u64, Failure> {
    let mut picture = Fingerprint::default();
    if let Some(path) = &args.environment {
        let bytes = fs::read(path).map_err(|why| {
            Failure::Input(format!("cannot read {} again: {why}", path.display()))
        })?;
        add_file(&mut picture, &bytes);
    }
    add_scene(&mut picture, scene.scene());
    let folder = args.scene.parent().unwrap_or(Path::new(""));
    let textures = &scene.scene().textures;
    for file in &textures.files {
        match textures.embedded.get(file) {
            Some(bytes) => add_file(&mut picture, bytes),
            // One that cannot be read is grey, as if it were empty.
            None => {
                let (_, bytes) = read_texture(folder, file);
                add_file(&mut picture, &bytes.unwrap_or_default());
            }
        }
    }
    let settings = LightSettings {
        force_effects: false,
        ..*light
    };
    let sampling = &job.sampling;
    picture.add(
        format!(
            "{:?} {:?} {:?} {} {settings:?} lit {} centred {}",
            job.camera,
            job.film,
            sampling.pattern,
            sampling.seed,
            scene.picture.is_lit(),
            job.samples == 1
        )
        .as_bytes(),
    );
    Ok(picture.value())
}

/// Adds a scene without its camera (the picture's counts) and the bytes of its images.
fn add_scene(picture: &mut Fingerprint, scene: &Scene) {
    for t in &scene.triangles {
        for number in [t.p0, t.p1, t.p2, t.n0, t.n1, t.n2]
            .map(|v| v.to_array())
            .as_flattened()
        {
            picture.add(&number.to_bits().to_le_bytes());
        }
    }
    for object in &scene.object_of {
        picture.add(&object.to_le_bytes());
    }
    for number in scene.textures.coordinates.as_flattened() {
        picture.add(
            &[number.x, number.y]
                .map(|x| x.to_bits().to_le_bytes())
                .concat(),
        );
    }
    let textures: Vec<Option<u32>> = (0..scene.materials.len() as u32)
        .map(|material| scene.textures.of_material(material))
        .collect();
    let Scene {
        spheres,
        objects,
        materials,
        lights,
        ..
    } = scene;
    let rest = format!("{spheres:?} {objects:?} {materials:?} {lights:?} {textures:?}");
    picture.add(rest.as_bytes());
}

fn add_file(picture: &mut Fingerprint, bytes: &[u8]) {
    picture.add(&(bytes.len() as u64).to_le_bytes());
    picture.add(bytes);
}
