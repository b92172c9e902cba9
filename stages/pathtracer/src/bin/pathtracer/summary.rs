//! What is told on the way to a picture: the numbers that the assignment's program tells.

use kit::effects::Effect;
use kit::{Bvh, Scene};
use pathtracer::{Accel, Counters, Job, Rendered};
use std::path::Path;
use std::time::Duration;

/// What is rendered.
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

/// What hits are found with.
pub(crate) fn accel(accel: &Accel, build: Duration) -> String {
    match accel {
        Accel::Brute => "Hits        by asking every primitive".to_owned(),
        Accel::Bvh(Bvh { nodes, order }) => format!(
            "BVH         {} nodes over {} primitives, built in {}",
            nodes.len(),
            order.len(),
            seconds(build)
        ),
        Accel::Simd(tree) => format!(
            "Wide BVH    {} nodes of 8 over {} blocks of up to 8 primitives, built in {}",
            tree.node_count(),
            tree.block_count(),
            seconds(build)
        ),
    }
}

/// How the rendering went. Counts are exact, rates are rounded.
pub(crate) fn rendering(job: &Job, rendered: &Rendered, threads: usize, time: Duration) -> String {
    let Counters {
        rays,
        box_tests,
        prim_tests,
    } = rendered.counters;
    let each = |tests: u64| tests as f64 / rays.max(1) as f64;
    let mut told = format!(
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
    if let Some(noise) = rendered.relative_error() {
        told += &format!(
            "\nNoise       {:.2} % of the mean in a pixel, {:.1} samples each",
            100.0 * noise,
            rendered.samples() as f64 / job.cell.area() as f64
        );
    }
    let nan = rendered.nan_pixels();
    if nan > 0 {
        told += &format!("\nNaN         {nan} pixels, shown in magenta");
    }
    told
}

/// Where the time went, and what kind of rays there were.
pub(crate) fn stats(
    rendered: &Rendered,
    loading: Duration,
    building: Duration,
    time: Duration,
) -> String {
    let each_second = |n: u64| n as f64 / time.as_secs_f64().max(1e-9) / 1e6;
    let (rays, samples) = (rendered.counters.rays, rendered.samples());
    let direct = rendered.effects.of(Effect::DirectLight);
    let all = (loading + building + time).as_secs_f64().max(1e-9);
    let share = |part: Duration| 100.0 * part.as_secs_f64() / all;
    format!(
        "Time        {:.1} % loading, {:.1} % building, {:.1} % rendering\n\
         Rates       {:.3} million samples per second, {:.2} million rays per second\n\
         Rays        {samples} from the camera, {direct} towards light, {} further on",
        share(loading),
        share(building),
        share(time),
        each_second(samples),
        each_second(rays),
        rays.saturating_sub(samples + direct),
    )
}

fn seconds(time: Duration) -> String {
    format!("{:.4} s", time.as_secs_f64())
}
