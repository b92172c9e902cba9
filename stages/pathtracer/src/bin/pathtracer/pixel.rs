//! `--pixel`: prints one pixel and the replay of its samples.

use crate::failure::Failure;
use crate::view;
use base::out;
use kit::film::Cell;
use pathtracer::args::Args;
use pathtracer::replay::text;
use pathtracer::{
    Accel, AccelKind, Job, LightSettings, PreparedScene, ProgressiveRender, replay_pixel,
};
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;

/// Prints the pixel of `--pixel`.
pub(crate) fn run(args: &Args, light: &LightSettings) -> Result<ExitCode, Failure> {
    let scene = view::load_scene(args)?;
    let (camera, film) = view::camera_and_film(args, &scene)?;
    let Some((x, y)) = args.pixel_of(film)? else {
        return Ok(ExitCode::SUCCESS);
    };
    let environment = view::load_environment(args)?;
    let picture = view::picture(args, light, scene, environment);
    let textures = view::load_textures(&args.scene, picture.scene());
    let prepared = PreparedScene::new(picture, textures, args.accel.into());
    let job = Job {
        camera,
        film,
        cell: Cell {
            x0: x,
            y0: y,
            x1: x + 1,
            y1: y + 1,
        },
        samples: args.samples,
        sampling: args.sampling(args.samples),
    };
    let mut render = ProgressiveRender::new(&prepared, job, *light);
    render.run(&prepared, 1, &AtomicBool::new(false));
    // The wide tree does not test through `World`: the binary tree finds the same hits.
    let recorded = match &prepared.accel {
        Accel::Simd(_) => &Accel::build(AccelKind::Bvh, prepared.scene()),
        accel => accel,
    };
    let PreparedScene {
        picture, textures, ..
    } = &prepared;
    let replay = replay_pixel(picture, textures, recorded, &job, light, 1, (x, y));
    let rendered = render.rendered().film.get(x, y);
    let text = text::replay(prepared.scene(), film, &replay, rendered);
    out!("{text}");
    Ok(ExitCode::SUCCESS)
}
