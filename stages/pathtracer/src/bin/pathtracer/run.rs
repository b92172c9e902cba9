//! The job itself, step by step.

use crate::args::Args;
use crate::failure::Failure;
use crate::{progress, summary, view};
use kit::film::Cell;
use kit::hole;
use pathtracer::{Accel, Job, Output, render_normals};
use std::process::{self, ExitCode};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Exit code after Ctrl-C, as shells have it.
const INTERRUPTED: u8 = 130;

/// Renders what `args` ask for. What cannot work is found out before the rendering.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    args.check_adaptive()?;
    args.check_environment()?;
    let Some(path) = &args.file else {
        let scene = args.scene.display();
        return Err(Failure::Input(format!(
            "there is no window yet: name the picture to write with -f, as in\n  pathtracer -f picture.png {scene}"
        )));
    };
    let idle = args.without_effect();
    if !idle.is_empty() {
        let flags = idle.join(" ");
        eprintln!(
            "note: no effect with --shade normals: {flags} (light is simulated from Part 3 on)"
        );
    }

    let start = Instant::now();
    let scene = view::load_scene(&args.scene)?;
    println!("{}", summary::scene(&args.scene, &scene, start.elapsed()));
    let (camera, film) = view::camera_and_film(args, &scene)?;
    let cell = args.cell_of(film)?;
    let output = Output::create(path)?;

    let start = Instant::now();
    let accel = Accel::build(args.accel.into(), &scene);
    println!("{}", summary::accel(&accel, start.elapsed()));

    let job = Job {
        camera,
        film,
        cell,
        samples: args.samples,
        seed: args.seed,
    };
    let stop = stop_on_ctrl_c();
    let threads = rayon::ThreadPoolBuilder::new()
        .num_threads(args.threads)
        .build()
        .map_err(|why| Failure::Input(format!("cannot start {} threads: {why}", args.threads)))?;
    let bar = progress::bar(cell.area());
    let start = Instant::now();
    let rendered = threads.install(|| {
        let tile_done = |tile: Cell| bar.inc(tile.area());
        render_normals(&scene, &accel, &job, &stop, tile_done)
    });
    let time = start.elapsed();
    bar.finish_and_clear();
    println!(
        "{}",
        summary::rendering(&job, &rendered, args.threads, time)
    );
    output.write(&rendered.film, cell)?;
    println!("Wrote       {}", path.display());

    let mut untouched = threads.broadcast(|_| hole::take_marks()).concat();
    untouched.extend(hole::take_marks());
    untouched.sort_unstable();
    untouched.dedup();
    for task in untouched {
        eprintln!("note: {task} is not written yet: its given start is right, but slow");
    }
    if stop.load(Ordering::Relaxed) {
        eprintln!("note: stopped early: pixels that were not rendered yet are black");
        return Ok(ExitCode::from(INTERRUPTED));
    }
    Ok(ExitCode::SUCCESS)
}

/// A flag that the first Ctrl-C sets, so that the picture so far is written. The second one ends the program.
fn stop_on_ctrl_c() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let pressed = Arc::clone(&stop);
    let handler = move || {
        if pressed.swap(true, Ordering::Relaxed) {
            process::exit(i32::from(INTERRUPTED));
        }
    };
    if let Err(why) = ctrlc::set_handler(handler) {
        eprintln!("note: Ctrl-C will lose the picture: {why}");
    }
    stop
}
