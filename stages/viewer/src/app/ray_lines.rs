//! The lines of rays: a camera's pyramid, the rays of a replay, the boxes of their walk.

use super::colors::{self, Pattern, pattern};
use super::lines::{Hidden, Lines};
use crate::inspector::{Inspected, Inspector};
use crate::lobe::Lobe;
use crate::session::Session;
use crate::task::guarded;
use crate::topology::corners;
use egui::{Color32, Stroke, Ui};
use kit::{Camera, FilmSize, Vec2, Vec3};
use pathtracer::RayRole;
use pathtracer::replay::{MAX_RECORDED_SAMPLES, Outcome, RayRecord, Test, Visit};
use raygen::generate_ray;

/// A camera: its pyramid of view up to `depth`, and the grid of its pixels if there are few. Its
/// edges are rays of `generate_ray`; until that is written, nothing is drawn.
pub(super) fn frustum(
    lines: &Lines<'_>,
    camera: &Camera,
    film: FilmSize,
    depth: f64,
    color: Color32,
    pixel: Option<(u32, u32)>,
) {
    // The first call ends it, so that no half is drawn.
    let _ = guarded(|| {
        let at = |x: f64, y: f64| {
            let ray = generate_ray(camera, Vec2::new(x, y));
            ray.at(depth / ray.d.dot(-camera.c2w.z_axis))
        };
        let stroke = Stroke::new(1.5, color);
        let corners = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
        for corner in corners {
            lines.line(camera.pos, corner, stroke, Hidden::Faint);
        }
        lines.outline(&corners, stroke, Hidden::Faint, Pattern::Solid);
        let (w, h) = (f64::from(film.w), f64::from(film.h));
        // The grid: every pixel of a small film, else every tenth of a film's edge.
        let (columns, rows) = (w.min(10.0), h.min(10.0));
        let thin = Stroke::new(0.7, color.gamma_multiply(0.45));
        for i in 1..columns as u32 {
            let x = f64::from(i) / columns;
            lines.line(at(x, 0.0), at(x, 1.0), thin, Hidden::Faint);
        }
        for i in 1..rows as u32 {
            let y = f64::from(i) / rows;
            lines.line(at(0.0, y), at(1.0, y), thin, Hidden::Faint);
        }
        if let Some((x, y)) = pixel {
            let (x, y) = (f64::from(x), f64::from(y));
            let stroke = Stroke::new(2.0, lines.palette.selected);
            let around = [(x, y), (x + 1.0, y), (x + 1.0, y + 1.0), (x, y + 1.0)];
            let corners = around.map(|(x, y)| at(x / w, y / h));
            lines.outline(&corners, stroke, Hidden::Shown, Pattern::Solid);
        }
    });
}

/// The rays of the replay, the selected one with the boxes of its walk.
pub(super) fn replay(lines: &Lines<'_>, inspector: &Inspector) {
    let Some(inspected) = inspector.inspected() else {
        return;
    };
    let (sample, ray, step) = inspector.position();
    let size = inspected.scene.bounds.extent().length();
    for (s, record) in inspected.replay.samples.iter().enumerate() {
        if inspector.filter.one_sample && s != sample {
            continue;
        }
        for (r, record) in record.rays.iter().enumerate() {
            let is_selected = (s, r) == (sample, ray);
            if inspector.filter.shows(record) || is_selected {
                draw_ray(lines, record, size, is_selected);
            }
        }
    }
    if let Some(record) = inspector.ray() {
        draw_walk(lines, record, step, inspected.scene.scene());
    }
    sample_positions(lines, inspected, sample);
    roulettes(lines, inspector);
    if let Some(record) = inspector.ray().filter(|_| inspector.filter.lobe) {
        // Until a stage is written there is no lobe.
        let picture = &inspected.scene.prepared.picture;
        let of_ray = guarded(|| Lobe::of(picture, &inspected.replay, record));
        if let (Ok(Some(lobe)), Outcome::Hit(hit)) = (of_ray, record.outcome) {
            draw_lobe(lines, &lobe, hit.p, LOBE_SIZE * size);
        }
    }
    if let Some((s, r, truth)) = &inspected.truth.first_wrong
        && (*s, *r) == (sample, ray)
        && let (Some((_, t)), Some(record)) = (truth.right, inspector.ray())
    {
        lines.ring(record.ray.at(t), lines.palette.right);
    }
}

/// The length of a lobe, relative to the size of the scene.
const LOBE_SIZE: f64 = 0.12;
/// The distance of the film from the camera, relative to the size of the scene.
pub(super) const FILM_DISTANCE: f64 = 0.12;

/// Where the samples of the replay cross the film.
fn sample_positions(lines: &Lines<'_>, inspected: &Inspected, selected: usize) {
    let camera = inspected.job.camera;
    let depth = FILM_DISTANCE * inspected.scene.bounds.extent().length();
    let samples = inspected.replay.samples.iter();
    let _ = guarded(|| {
        for (i, sample) in samples.enumerate().take(MAX_RECORDED_SAMPLES) {
            let ray = generate_ray(&camera, sample.sensor);
            let at = ray.at(depth / ray.d.dot(-camera.c2w.z_axis));
            let (radius, color) = match i == selected {
                true => (3.0, lines.palette.selected),
                false => (1.2, lines.palette.ray(RayRole::Camera)),
            };
            lines.disc(at, radius, color);
        }
    });
}

/// What roulette did along the path of the selected sample: where it ends, or how much more the
/// rest counts.
fn roulettes(lines: &Lines<'_>, inspector: &Inspector) {
    let Some(sample) = inspector.sample() else {
        return;
    };
    for played in &sample.roulettes {
        let Some(Outcome::Hit(hit)) = sample.rays.get(played.ray).map(|ray| ray.outcome) else {
            continue;
        };
        match played.survivor {
            None => roulette(lines, hit.p, None),
            Some(after) if after != played.throughput => {
                let factor = after.max_channel() / played.throughput.max_channel();
                roulette(lines, hit.p, Some(factor));
            }
            Some(_) => {}
        }
    }
}

/// Roulette at a surface of a path: the factor of the throughput, or the end of the path.
pub(super) fn roulette(lines: &Lines<'_>, p: Vec3, factor: Option<f64>) {
    let color = lines.palette.attention;
    match factor {
        None => {
            lines.cross(p, color);
            lines.name_at(p, color, "roulette ends it");
        }
        Some(factor) => lines.name_at(p, color, &format!("roulette: x {factor:.2}")),
    }
}

/// The density of directions as curves, mirrors as arrows, sampled directions as dots.
fn draw_lobe(lines: &Lines<'_>, lobe: &Lobe, p: Vec3, size: f64) {
    let color = lines.palette.ray(RayRole::Bounce);
    let thin = Stroke::new(1.0, color.gamma_multiply(0.7));
    for curve in &lobe.curves {
        let curve: Vec<Vec3> = curve.iter().map(|q| p + size * *q).collect();
        lines.path(&curve, thin, Hidden::Faint, Pattern::Solid);
    }
    for arrow in &lobe.arrows {
        lines.arrow(p, *arrow, size, color, "");
    }
    for sample in &lobe.samples {
        lines.disc(p + size * *sample, 2.0, lines.palette.ray(RayRole::Light));
    }
}

fn draw_ray(lines: &Lines<'_>, record: &RayRecord, size: f64, is_selected: bool) {
    let color = lines.palette.ray(record.role);
    let end = record
        .ray
        .at(record.end().unwrap_or(size / record.ray.d.length()));
    let width = if is_selected { 3.0 } else { 1.2 };
    let stroke = Stroke::new(width, color);
    lines.patterned(
        record.ray.o,
        end,
        stroke,
        Hidden::Faint,
        pattern(record.role),
    );
    if record.role == RayRole::Shadow && record.outcome == Outcome::Blocked {
        lines.disc(end, 3.0, color);
    }
    if let Outcome::Hit(hit) = record.outcome
        && is_selected
    {
        lines.disc(hit.p, 4.0, color);
        lines.arrow(hit.p, hit.n, 0.08 * size, lines.palette.right, "n");
        if hit.n.distance(hit.ng) > 1e-6 {
            lines.arrow(hit.p, hit.ng, 0.08 * size, lines.palette.attention, "ng");
        }
    }
}

/// The boxes and primitives of the first `step` tests, the last one in bold.
pub(super) fn draw_walk(lines: &Lines<'_>, record: &RayRecord, step: usize, scene: &kit::Scene) {
    for (i, test) in record.tests.iter().take(step).enumerate() {
        let is_last = i + 1 == step;
        match test {
            Test::Box { bounds, visit, .. } => {
                let (color, pattern) = match visit {
                    Visit::Entered { .. } => (lines.palette.right, Pattern::Solid),
                    Visit::Missed => (lines.palette.line, Pattern::Dotted),
                    Visit::Behind { .. } | Visit::Pruned { .. } => {
                        (lines.palette.attention, Pattern::Dashed)
                    }
                };
                let entered = matches!(visit, Visit::Entered { .. });
                if is_last || entered {
                    let width = if is_last { 2.5 } else { 1.0 };
                    let stroke = Stroke::new(width, color);
                    lines.patterned_box(bounds, stroke, Hidden::Faint, pattern);
                }
            }
            // Where only the results of tests are given there are no shapes.
            Test::Primitive { prim, .. } if is_last && (prim.0 as usize) < scene.len() => {
                let stroke = Stroke::new(2.5, lines.palette.attention);
                match scene.primitive(*prim) {
                    kit::Primitive::Triangle(triangle) => {
                        let fill = lines.palette.attention.gamma_multiply(0.3);
                        lines.triangle(corners(triangle), fill, stroke);
                    }
                    kit::Primitive::Sphere(sphere) => {
                        lines.aabb(&sphere.bounds(), stroke, Hidden::Faint)
                    }
                }
            }
            Test::Primitive { .. } => {}
        }
    }
}

/// The camera rays of a render that failed.
pub(super) fn camera_rays(lines: &Lines<'_>, ui: &Ui, session: &Session) {
    let (Some(render), [first, ..]) = (session.render(), session.camera_rays()) else {
        return;
    };
    let scene = render.scene();
    let depth = 0.3 * scene.bounds.extent().length();
    let job = render.job();
    frustum(lines, &job.camera, job.film, depth, colors::line(ui), None);
    let stroke = Stroke::new(1.2, lines.palette.ray(RayRole::Camera));
    for ray in session.camera_rays() {
        lines.line(ray.o, ray.at(4.0 * depth), stroke, Hidden::Shown);
    }
    lines.disc(first.o, 4.0, stroke.color);
}
