//! The lines that the program prints, with the numbers of the assignment's program.

use kit::effects::Effect;
use kit::{Bvh, Scene};
use pathtracer::{Accel, Counters, Job, Rendered};
use std::path::Path;
use std::time::Duration;

/// The scene and its size.
pub(crate) fn scene(path: &Path, scene: &Scene, load: Duration) -> String {
    format!(
        "Scene       {}: {} primitives ({} triangles, {} spheres), loaded in {}",
        path.display(),
        scene.len(),
        scene.triangles.len(),
        scene.spheres.len(),
        seconds(load)
    )
}

/// The acceleration structure.
pub(crate) fn accel(accel: &Accel, build: Duration) -> String {
    match accel {
        Accel::Brute => "Hits        brute force: every ray tests every primitive".to_owned(),
        Accel::Bvh(Bvh { nodes, order }) => format!(
            "BVH         {} nodes over {} primitives, built in {}",
            nodes.len(),
            order.len(),
            seconds(build)
        ),
        Accel::Simd(tree) => format!(
            "Wide BVH    {} nodes of 8 over {} blocks of up to 8 primitives, built in {}\n\
             Code        Part 6; --accel bvh traces with the stages of Parts 1 to 5",
            tree.node_count(),
            tree.block_count(),
            seconds(build)
        ),
    }
}

/// Rays, tests, time and noise of the rendering. Counts are exact, rates are rounded.
pub(crate) fn rendering(job: &Job, rendered: &Rendered, threads: usize, time: Duration) -> String {
    let Counters {
        rays,
        box_tests,
        prim_tests,
        ..
    } = rendered.counters;
    let each = |tests: u64| tests as f64 / rays.max(1) as f64;
    let mut text = format!(
        "Rendering   {} x {} pixels, -s {} -t {threads}: {}\n\
         Rays        {rays}, {:.2} million per second\n\
         Tests       {:.2} per ray: {:.2} of boxes ({box_tests}), {:.2} of primitives ({prim_tests})",
        job.cell.x1 - job.cell.x0,
        job.cell.y1 - job.cell.y0,
        job.samples,
        seconds(time),
        rays as f64 / time.as_secs_f64().max(1e-9) / 1e6,
        each(box_tests + prim_tests),
        each(box_tests),
        each(prim_tests),
    );
    if let Some(noise) = rendered.noise(job.sampling.pattern) {
        text += &format!(
            "\nNoise       {noise} of the mean in a pixel, {:.1} samples each",
            rendered.samples() as f64 / rendered.rendered_pixels().max(1) as f64
        );
    }
    let nan = rendered.nan_pixels();
    if nan > 0 {
        text += &format!("\nNaN         {nan} pixels, shown in magenta");
    }
    text
}

/// How the time was spent, and the rays by kind.
pub(crate) fn stats(
    rendered: &Rendered,
    loading: Duration,
    building: Duration,
    time: Duration,
) -> String {
    let each_second = |n: u64| n as f64 / time.as_secs_f64().max(1e-9) / 1e6;
    let Counters {
        rays,
        lamp_rays,
        reuse_rays,
        ..
    } = rendered.counters;
    let samples = rendered.samples();
    let direct = rendered.effects.of(Effect::DirectLight);
    let total = (loading + building + time).as_secs_f64().max(1e-9);
    let share = |part: Duration| 100.0 * part.as_secs_f64() / total;
    format!(
        "Time        {:.1} % loading, {:.1} % building, {:.1} % rendering\n\
         Rates       {:.3} million samples per second, {:.2} million rays per second\n\
         Rays        {samples} camera rays, {direct} light rays, {} bounce rays, {lamp_rays} at edges of lamps, \
         {reuse_rays} between paths",
        share(loading),
        share(building),
        share(time),
        each_second(samples),
        each_second(rays),
        rays.saturating_sub(samples + direct + lamp_rays + reuse_rays),
    )
}

/// What `--clamp` has removed: `kept` and `removed` are mean luminances.
pub(crate) fn clamped(limit: f64, kept: f64, removed: f64) -> String {
    let whole = kept + removed;
    format!(
        "Clamp       --clamp {limit} removed a luminance of {removed:.6} from the mean of {whole:.6}: {:.3} %",
        100.0 * removed / whole.max(f64::MIN_POSITIVE)
    )
}

/// What a soft terminator costs: the mean luminance and the time with it and without.
pub(crate) fn terminator(soft: (f64, Duration), hard: (f64, Duration)) -> String {
    format!(
        "Terminator  soft: mean luminance {:.6}, hard: {:.6}: {:.3} % of the light is missing; {} instead of {}",
        soft.0,
        hard.0,
        100.0 * (1.0 - soft.0 / hard.0.max(f64::MIN_POSITIVE)),
        seconds(soft.1),
        seconds(hard.1)
    )
}

fn seconds(time: Duration) -> String {
    format!("{:.4} s", time.as_secs_f64())
}
