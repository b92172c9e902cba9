//! The steps of a run: load, build, render, write, report.

use crate::budget::{Budget, SAMPLES_PER_PASS};
use crate::explain;
use crate::export;
use crate::failure::Failure;
use crate::outputs::Outputs;
use crate::progress::Progress;
use crate::{pixel, summary, view, window};
use kit::hole;
use kit::{Emitter, LitScene};
use pathtracer::args::{Args, Shade};
use pathtracer::{
    Accel, DirectSampling, Job, LightSettings, Picture, layers::channels, layers::features,
    render_lit, render_normals,
};
use std::path::Path;
use std::process::{self, ExitCode};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Exit code after Ctrl-C, as in shells.
const INTERRUPTED: u8 = 130;

/// Renders the scene of `args`. Invalid input is reported before rendering.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let light = args.light()?;
    if let Some([renderer, path]) = args.export.as_deref() {
        note_unused(&args.unused_without_picture(), "--export writes no picture");
        return export::run(args, &light, renderer, Path::new(path));
    }
    if args.pixel.is_some() {
        note_unused(&args.unused_without_picture(), "--pixel writes no picture");
        return pixel::run(args, &light);
    }
    let Some(path) = &args.file else {
        return window::open(args);
    };
    let start = Instant::now();
    let scene = view::load_scene(&args.scene)?;
    let loading = start.elapsed();
    println!("{}", summary::scene(&args.scene, &scene, loading));
    let (camera, film) = view::camera_and_film(args, &scene)?;
    let cell = args.cell_of(film)?;
    let outputs = Outputs::create(args, path)?;
    let environment = view::load_environment(args)?;
    let picture = Picture::new(args.shade, scene, environment);
    match &picture {
        Picture::Normals(_) => note_unused_by_normals(args),
        Picture::Lit(lit) => {
            note_missing_lights(lit, light.direct_sampling);
            note_single_batch(light.adaptive, args.samples);
        }
    }
    let scene = picture.scene();
    let textures = view::load_textures(&args.scene, scene);

    let start = Instant::now();
    let accel = Accel::build(args.accel.into(), scene);
    let building = start.elapsed();
    println!("{}", summary::accel(&accel, building));

    let budget = match &picture {
        Picture::Lit(_) => Budget::new(args),
        Picture::Normals(_) => None,
    };
    let samples = match budget {
        Some(_) if args.samples == 1 => SAMPLES_PER_PASS,
        _ => args.samples,
    };
    let job = Job {
        camera,
        film,
        cell,
        samples,
        sampling: args.sampling(samples),
    };
    let stop = stop_on_ctrl_c();
    let threads = rayon::ThreadPoolBuilder::new()
        .num_threads(args.threads)
        .build()
        .map_err(|why| Failure::Input(format!("cannot start {} threads: {why}", args.threads)))?;
    let progress = Progress::new(cell.area());
    let start = Instant::now();
    let pass = |job: &Job| {
        progress.next_pass();
        let tile_done = &|tile, rays| progress.tile_done(tile, rays);
        threads.install(|| match &picture {
            Picture::Normals(scene) => render_normals(scene, &accel, job, &stop, tile_done),
            Picture::Lit(lit) => render_lit(lit, &textures, &accel, job, &light, &stop, tile_done),
        })
    };
    let rendered = match &budget {
        None => pass(&job),
        Some(budget) => budget.render(&job, &stop, pass),
    };
    let time = start.elapsed();
    progress.finish();
    println!(
        "{}",
        summary::rendering(&job, &rendered, args.threads, time)
    );
    outputs.picture.file.write(&rendered.film, cell)?;
    println!("Wrote       {}", path.display());
    if let (Some(rate), Picture::Lit(_)) = (outputs.rate, &picture) {
        rate.file.write_rate(&rendered.film, cell, args.samples)?;
        println!("Wrote       {}", rate.path.display());
    }
    if let Some(layers) = outputs.layers {
        let features = threads.install(|| features(scene, &textures, &accel, &job));
        let channels = channels(&rendered, &features, &job);
        let (w, h) = (cell.x1 - cell.x0, cell.y1 - cell.y0);
        layers.file.write_channels(channels, w, h)?;
        println!("Wrote       {}", layers.path.display());
    }
    if args.stats {
        println!("{}", summary::stats(&rendered, loading, building, time));
    }
    if args.explain {
        match &picture {
            Picture::Normals(_) => {
                println!("Effects     none: normals are shown, no light is simulated")
            }
            Picture::Lit(lit) => {
                let forced = if light.force_effects {
                    rendered.effects
                } else {
                    let all = LightSettings {
                        force_effects: true,
                        ..light
                    };
                    let whole = Job {
                        samples: match budget {
                            Some(_) => (rendered.samples() / cell.area()) as u32,
                            None => job.samples,
                        },
                        ..job
                    };
                    let hook = &|_, _| ();
                    threads
                        .install(|| render_lit(lit, &textures, &accel, &whole, &all, &stop, hook))
                        .effects
                };
                // The counts of an incomplete picture cannot be compared.
                let forced = (!stop.load(Ordering::Relaxed)).then_some(&forced);
                println!(
                    "{}",
                    explain::table(&light.effects(lit), &rendered.effects, forced)
                );
            }
        }
    }

    let mut untouched = threads.broadcast(|_| hole::take_marks()).concat();
    untouched.extend(hole::take_marks());
    untouched.sort_unstable();
    untouched.dedup_by_key(|start| start.task);
    for start in untouched {
        let task = start.task;
        eprintln!("note: {task} is not written yet: the given code is correct, but slow");
    }
    if stop.load(Ordering::Relaxed) {
        eprintln!("note: interrupted: the remaining pixels are black");
        return Ok(ExitCode::from(INTERRUPTED));
    }
    Ok(ExitCode::SUCCESS)
}

/// Prints which of the given flags have no effect on a picture of normals.
fn note_unused_by_normals(args: &Args) {
    let why = match args.shade {
        Shade::Normals => "normals are shown",
        Shade::Auto | Shade::Lit => "the scene has no light, so normals are shown",
    };
    note_unused(&args.unused_by_normals(), why);
}

/// Prints that `flags` have no effect, and why.
fn note_unused(flags: &[&str], why: &str) {
    if !flags.is_empty() {
        eprintln!("note: no effect: {}: {why}", flags.join(" "));
    }
}

/// Prints a note if the scene has lights that `-H` cannot sample.
fn note_missing_lights(lit: &LitScene, sampling: DirectSampling) {
    if sampling == DirectSampling::Hemisphere && lit.emitters.iter().any(Emitter::is_delta) {
        eprintln!(
            "note: point, spot and directional lights have no area, so -H never hits them: omit -H to include their light"
        );
    }
}

/// Prints a note if the first batch of `-a` has all samples of `-s`, so that no pixel can stop
/// early.
fn note_single_batch(adaptive: Option<(u32, f64)>, samples: u32) {
    if let Some((batch, tolerance)) = adaptive.filter(|&(batch, _)| batch >= samples) {
        eprintln!(
            "note: no effect: -a {batch} {tolerance}: a batch has all -s {samples} samples of a pixel: use a larger \
             -s, such as -s {}",
            batch.saturating_mul(16)
        );
    }
}

/// A flag that the first Ctrl-C sets, so that the picture so far is written. The second one ends
/// the program.
fn stop_on_ctrl_c() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let pressed = Arc::clone(&stop);
    let handler = move || {
        if pressed.swap(true, Ordering::Relaxed) {
            process::exit(i32::from(INTERRUPTED));
        }
    };
    if let Err(why) = ctrlc::set_handler(handler) {
        eprintln!("note: Ctrl-C will end the program without a picture: {why}");
    }
    stop
}
