//! The steps of a run: load, build, render, write, report.

use crate::brightness;
use crate::budget::{Budget, SAMPLES_PER_PASS};
use crate::explain;
use crate::export;
use crate::failure::Failure;
use crate::outputs::{Outputs, PictureFile, is_sums};
use crate::progress::Progress;
use crate::{part, pixel, summary, view, window};
use base::{errln, outln};
use kit::hole;
use kit::{Emitter, LitScene};
use pathtracer::args::{Args, Shade};
use pathtracer::{
    DirectSampling, Job, LightSettings, Passes, Picture, PreparedScene, Rendered, darkness,
    layers::channels, layers::features, nearly_smooth, rate_picture,
};
use std::path::Path;
use std::process::{self, ExitCode};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

/// Exit code after Ctrl-C, as in shells.
const INTERRUPTED: u8 = 130;

/// Two signals that are closer together are one Ctrl-C: `timeout -s INT` sends its signal to the
/// program and to the program's process group, so it arrives twice.
const ONE_CTRL_C: Duration = Duration::from_millis(500);

/// Renders the scene of `args`. Invalid input is reported before rendering.
pub(crate) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let light = args.light()?;
    args.check_part()?;
    if let Some([renderer, path]) = args.export.as_deref() {
        note_unused(&args.unused_by_export(), "--export writes no picture");
        return export::run(args, &light, renderer, Path::new(path));
    }
    if args.pixel.is_some() {
        note_unused(&args.unused_without_picture(), "--pixel writes no picture");
        return pixel::run(args, &light);
    }
    let Some(path) = &args.file else {
        return window::open(args);
    };
    // A wrong name of the picture is reported before the scene is loaded. No file stays open
    // meanwhile: Ctrl-C would leave it behind.
    drop(Outputs::create(args, path)?);
    let start = Instant::now();
    let scene = view::load_scene(args)?;
    let loading = start.elapsed();
    let (camera, film) = view::camera_and_film(args, &scene)?;
    let cell = args.cell_of(film)?;
    let outputs = Outputs::create(args, path)?;
    if path
        .extension()
        .is_none_or(|e| !e.eq_ignore_ascii_case("png"))
    {
        note_unused(&args.unused_by_radiance(), "only a .png is tone-mapped");
    }
    if is_sums(path) {
        args.check_sums()?;
    }
    let environment = view::load_environment(args)?;
    let picture = view::picture(args, &light, scene, environment);
    // With the surfaces of lamps that are not in the file.
    outln!("{}", summary::scene(&args.scene, picture.scene(), loading));
    match &picture {
        Picture::Normals(_) => note_unused_by_normals(args),
        Picture::Lit(lit) => {
            note_missing_lights(lit, light.direct_sampling);
            note_single_batch(light.adaptive, args.samples);
            note_no_indirect_light(&light);
        }
    }
    let textures = view::load_textures(&args.scene, picture.scene());
    let start = Instant::now();
    let prepared = PreparedScene::new(picture, textures, args.accel.into());
    let building = start.elapsed();
    let stop = Stop::on_ctrl_c();
    outln!("{}", summary::accel(&prepared.accel, building));

    let budget = match &prepared.picture {
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
    if !prepared.has_packets_if_needed(&job, &light) {
        return Err(Failure::Input(
            "--reuse-paths and --guide-caustics: only paths in packets do this: use --accel simd, and write part6.task2 \
             if it is open"
                .to_owned(),
        ));
    }
    if matches!(prepared.picture, Picture::Lit(_))
        && light.guide_caustics
        && !prepared.guide.is_known()
    {
        let depth = light.max_depth;
        errln!(
            "note: no effect: --guide-caustics: with -m {depth} no mirror or smooth glass leads light of a lamp with \
             an area to a diffuse surface"
        );
    }
    let thread_count = args.thread_count();
    let threads = rayon::ThreadPoolBuilder::new()
        .num_threads(thread_count)
        .build()
        .map_err(|why| Failure::Input(format!("cannot start {thread_count} threads: {why}")))?;
    let progress = Progress::new(cell.area() * u64::from(samples));
    let passes = Passes {
        scene: &prepared,
        job,
        settings: light,
    };
    // `--explain` renders the picture again, which needs the same samples in all pixels.
    let tile_limit = budget.filter(|_| !args.explain);
    let tile_done = |tile| {
        progress.tile_done(tile);
        if tile_limit.is_some_and(|budget| budget.is_late(progress.elapsed())) {
            stop.set();
        }
    };
    let mut is_done = |so_far: &Rendered| {
        progress.next_round();
        budget.is_none_or(|budget| budget.is_spent(so_far, progress.elapsed()))
    };
    let rendered = threads.install(|| match is_sums(path) {
        true => passes.render_part(&stop.flag, &tile_done),
        false => passes.render(&stop.flag, &tile_done, &mut is_done),
    });
    let time = progress.elapsed();
    progress.finish();
    outln!(
        "{}",
        summary::rendering(&job, &rendered, thread_count, time)
    );
    let why_black = match &prepared.picture {
        Picture::Lit(lit) => Some(|| darkness(lit, &prepared.accel, &job, &light)),
        Picture::Normals(_) => None,
    };
    if let Some(note) = brightness::note(&rendered, args.tone(), why_black) {
        errln!("{note}");
    }
    match outputs.picture {
        PictureFile::Picture(file) => file.write(&rendered.film, cell)?,
        PictureFile::Sums(file) => {
            let is_lit = matches!(prepared.picture, Picture::Lit(_));
            let (taken, note) = match light.adaptive.is_some() && is_lit {
                true => (job, part::note_interrupted_adaptive(rendered.samples())),
                false => {
                    let samples = (rendered.samples() / cell.area()) as u32;
                    let note = part::note_interrupted(&job, samples);
                    (Job { samples, ..job }, note)
                }
            };
            part::write(&file, args, &taken, &light, &prepared, &rendered)?;
            if stop.is_interrupted() {
                outln!("Wrote       {}", path.display());
                errln!("{note}");
                return Ok(ExitCode::from(INTERRUPTED));
            }
        }
    }
    outln!("Wrote       {}", path.display());
    if let (Some(rate), Picture::Lit(_)) = (outputs.rate, &prepared.picture) {
        let scale = args.rate_scale.into();
        let picture = rate_picture(&rendered.film, cell, args.samples, scale);
        rate.file.write_bytes(&picture)?;
        outln!("Wrote       {}", rate.path.display());
    }
    if let Some(layers) = outputs.layers {
        let PreparedScene {
            textures, accel, ..
        } = &prepared;
        let features = threads.install(|| features(prepared.scene(), textures, accel, &job));
        let channels = channels(&rendered, &features, &job);
        let (w, h) = (cell.x1 - cell.x0, cell.y1 - cell.y0);
        layers.file.write_channels(channels, w, h)?;
        outln!("Wrote       {}", layers.path.display());
    }
    if args.stats {
        outln!("{}", summary::stats(&rendered, loading, building, time));
    }
    if args.explain {
        match &prepared.picture {
            Picture::Normals(_) => {
                outln!("Effects     none: normals are shown, no light is simulated")
            }
            Picture::Lit(lit) => {
                let samples = match budget {
                    Some(_) => (rendered.samples() / cell.area()) as u32,
                    None => job.samples,
                };
                let whole = Job { samples, ..job };
                let all = LightSettings {
                    force_effects: true,
                    ..light
                };
                let forced = match light.force_effects {
                    true => rendered.effects,
                    false => {
                        let again = || render_again(&prepared, whole, all, &stop);
                        threads.install(again).effects
                    }
                };
                // The counts of an incomplete picture cannot be compared.
                let forced = (!stop.is_interrupted()).then_some(&forced);
                outln!(
                    "{}",
                    explain::table(&light.effects(lit), &rendered.effects, forced)
                );
                let mean = rendered.mean_luminance();
                if let (Some(limit), Some(removed)) = (light.clamp, rendered.removed_luminance()) {
                    outln!("{}", summary::clamped(limit, mean, removed));
                }
                if light.soft_terminator && !stop.is_interrupted() {
                    let hard = LightSettings {
                        soft_terminator: false,
                        ..light
                    };
                    let start = Instant::now();
                    let again = threads.install(|| render_again(&prepared, whole, hard, &stop));
                    if !stop.is_interrupted() {
                        let again = (again.mean_luminance(), start.elapsed());
                        outln!("{}", summary::terminator((mean, time), again));
                    }
                }
            }
        }
    }

    let mut untouched = threads.broadcast(|_| hole::take_marks()).concat();
    untouched.extend(hole::take_marks());
    untouched.sort_unstable();
    untouched.dedup_by_key(|start| start.task);
    for start in untouched {
        let task = start.task;
        errln!("note: {task} is not written yet: the given code is correct, but slow");
    }
    if stop.is_interrupted() {
        errln!("note: interrupted: the picture is whole, but has more noise than a finished one");
        return Ok(ExitCode::from(INTERRUPTED));
    }
    Ok(ExitCode::SUCCESS)
}

/// Renders the picture with other `settings`.
fn render_again(scene: &PreparedScene, job: Job, settings: LightSettings, stop: &Stop) -> Rendered {
    let passes = Passes {
        scene,
        job,
        settings,
    };
    passes.render(&stop.flag, &|_| (), &mut |_| true)
}

/// Prints which of the given flags have no effect on a picture of normals.
fn note_unused_by_normals(args: &Args) {
    let why = match args.shade {
        Shade::Normals => "normals are shown",
        Shade::Auto | Shade::Lit => "normals are shown, not light",
    };
    note_unused(&args.unused_by_normals(), why);
}

/// Prints that `flags` have no effect, and why.
fn note_unused(flags: &[&str], why: &str) {
    if !flags.is_empty() {
        errln!("note: no effect: {}: {why}", flags.join(" "));
    }
}

/// Prints a note if the scene has lights that `-H` cannot sample, or shows lamps in surfaces that
/// are hard to sample without `--mis`.
fn note_missing_lights(lit: &LitScene, sampling: DirectSampling) {
    let has_lamps = !lit.emitters.iter().all(Emitter::is_delta);
    let instead = match sampling {
        DirectSampling::Hemisphere => " instead of -H",
        _ => "",
    };
    if sampling != DirectSampling::Mis
        && has_lamps
        && let Some(object) = nearly_smooth(&lit.scene)
    {
        errln!(
            "note: `{object}` is nearly smooth: without --mis few samples meet the lamps that it shows, and a picture of few samples is too dark: use --mis{instead}"
        );
    }
    if sampling == DirectSampling::Hemisphere && lit.emitters.iter().any(Emitter::is_delta) {
        errln!(
            "note: point, spot and directional lights have no area, so -H never hits them: omit -H to include their light"
        );
    }
}

/// Prints a note if there is no indirect light to clamp or to share.
fn note_no_indirect_light(light: &LightSettings) {
    let depth @ ..=1 = light.max_depth else {
        return;
    };
    let clamp = light.clamp.map(|limit| format!("--clamp {limit}"));
    for flag in clamp
        .into_iter()
        .chain(light.reuse_paths.then(|| "--reuse-paths".to_owned()))
    {
        errln!("note: no effect: {flag}: -m {depth} has no indirect light: use -m 2 or more");
    }
}

/// Prints a note if the first batch of `-a` has all samples of `-s`, so that no pixel can stop
/// early.
fn note_single_batch(adaptive: Option<(u32, f64)>, samples: u32) {
    if let Some((batch, tolerance)) = adaptive.filter(|&(batch, _)| batch >= samples) {
        errln!(
            "note: no effect: -a {batch} {tolerance}: a batch has all -s {samples} samples of a pixel: use a larger \
             -s, such as -s {}",
            batch.saturating_mul(16)
        );
    }
}

/// When to end the rendering early.
struct Stop {
    /// Whether to end it.
    flag: Arc<AtomicBool>,
    /// When Ctrl-C was first pressed, if it was.
    interrupted: Arc<OnceLock<Instant>>,
}

impl Stop {
    /// Set by the first Ctrl-C, so that the picture so far is written. The second one ends the
    /// program.
    fn on_ctrl_c() -> Stop {
        let stop = Stop {
            flag: Arc::default(),
            interrupted: Arc::default(),
        };
        let (flag, interrupted) = (Arc::clone(&stop.flag), Arc::clone(&stop.interrupted));
        let handler = move || {
            flag.store(true, Ordering::Relaxed);
            if interrupted.get_or_init(Instant::now).elapsed() > ONE_CTRL_C {
                ::progress::clear();
                process::exit(i32::from(INTERRUPTED));
            }
        };
        if let Err(why) = ctrlc::set_handler(handler) {
            errln!("note: Ctrl-C will end the program without a picture: {why}");
        }
        stop
    }

    fn set(&self) {
        self.flag.store(true, Ordering::Relaxed);
    }

    fn is_interrupted(&self) -> bool {
        self.interrupted.get().is_some()
    }
}
