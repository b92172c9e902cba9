//! What a call got: for reports on calls that have no answer to show it with.

use crate::tools::aspects::hits::show_ray;
use crate::tools::plural;
use kit::Vec3;
use wire::Work;
use wire::adaptive::StopCall;
use wire::work::{Ray, Xyz};

/// The input of call number `call` of `work`, as text; `None` for work whose input is long.
pub fn of(work: &Work, call: usize) -> Option<String> {
    match work {
        Work::Pixels(work) => {
            let ([x, y], seed) = work.calls().nth(call)?;
            let [w, h] = work.film;
            Some(format!(
                "x = {x}, y = {y}, film = {w} x {h}, ns_aa = {}, seed {seed}",
                work.ns_aa
            ))
        }
        Work::CameraRays(work) => {
            let camera = work.cameras.get(call / work.sensor.len().max(1))?;
            let [x, y] = work.sensor.get(call % work.sensor.len().max(1))?;
            Some(format!(
                "sensor = ({x:?}, {y:?}), camera at {}, h_fov = {:?}, v_fov = {:?}",
                point(camera.pos),
                camera.h_fov,
                camera.v_fov
            ))
        }
        Work::Triangles(work) => {
            let probe = work.probes.get(call)?;
            let [p0, p1, p2, ..] = work.triangles.get(probe.shape as usize)?.map(point);
            let triangle = format!("triangle p0 = {p0}, p1 = {p1}, p2 = {p2}");
            Some(ray_and(&probe.ray, &triangle))
        }
        Work::Spheres(work) => {
            let probe = work.probes.get(call)?;
            let (center, radius) = work.spheres.get(probe.shape as usize)?;
            let sphere = format!("sphere center = {}, radius = {radius:?}", point(*center));
            Some(ray_and(&probe.ray, &sphere))
        }
        Work::Boxes(work) => {
            let probe = work.probes.get(call)?;
            let [min, max] = work.boxes.get(probe.shape as usize)?.map(point);
            Some(ray_and(
                &probe.ray,
                &format!("box min = {min}, max = {max}"),
            ))
        }
        Work::BruteForce(work) => {
            let shapes = work.triangles.len() + work.spheres.len();
            let shapes = plural(shapes, "shape", "shapes");
            Some(ray_and(work.rays.get(call)?, &shapes))
        }
        Work::Traverse(work) => {
            let nodes = format!(
                "a tree of {}",
                plural(work.tree.nodes.len(), "node", "nodes")
            );
            Some(ray_and(&work.rays.get(call)?.ray, &nodes))
        }
        Work::SceneHits(work) => {
            let nodes = format!(
                "a tree of {}",
                plural(work.tree.nodes.len(), "node", "nodes")
            );
            Some(ray_and(work.rays.get(call)?, &nodes))
        }
        Work::Build(work) => Some(format!(
            "{}, max_leaf_size = {}",
            plural(work.bounds.len(), "box", "boxes"),
            work.max_leaf_size
        )),
        Work::Lambert(probes) => probes.get(call).map(|probe| {
            let [wo, wi] = [probe.wo, probe.wi].map(point);
            format!("wo = {wo}, wi = {wi}, u = {:?}", probe.u)
        }),
        Work::Direct(work) => work.points.get(call).map(|at| {
            let [p, n, wo] = [at.p, at.n, at.wo].map(point);
            format!("p = {p}, n = {n}, wo = {wo}, samples = {}", work.samples)
        }),
        Work::Specular(calls) => calls.get(call).map(|call| format!("{call:?}")),
        Work::Paths(paths) => paths.get(call).map(|path| {
            let depth = format!("max_depth = {}", path.max_depth);
            ray_and(&path.ray, &depth)
        }),
        Work::Roulette(work) => {
            let (throughput, bounces) = work.paths.get(call / work.numbers.len().max(1))?;
            let u = work.numbers.get(call % work.numbers.len().max(1))?;
            Some(format!(
                "throughput = {}, bounces = {bounces}, u = {u:?}",
                point(*throughput)
            ))
        }
        Work::Stop(calls) | Work::SureStop(calls) => calls.get(call).map(stop),
        Work::AdaptivePixels(pixels) => pixels.get(call).map(|pixel| {
            let [x, y] = pixel.pixel;
            format!(
                "x = {x}, y = {y}, ns_aa = {}, batch = {}, tolerance = {:?}",
                pixel.ns_aa, pixel.batch, pixel.tolerance
            )
        }),
        // Measurements, pictures, and kinds whose calls nobody describes.
        _ => None,
    }
}

fn point(xyz: Xyz) -> String {
    // As `Debug` writes it, so that it can be pasted.
    let [x, y, z] = Vec3::from(xyz).to_array();
    format!("({x:?}, {y:?}, {z:?})")
}

fn ray_and(ray: &Ray, shape: &str) -> String {
    format!("{}; {shape}", show_ray(ray))
}

fn stop(call: &StopCall) -> String {
    let samples: u64 = call.runs.iter().map(|(count, _)| u64::from(*count)).sum();
    format!("samples: {samples}, tolerance = {:?}", call.tolerance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;

    #[test]
    fn every_call_of_a_graded_case_has_an_input() {
        for spec in cases::all(0) {
            let calls = spec.calls();
            let last = of(&spec.work, calls - 1);
            let is_timed = matches!(spec.work, Work::BuildGrowth(_));
            assert_eq!(last.is_some(), !is_timed, "{} {}", spec.task, spec.name);
            assert_eq!(
                of(&spec.work, usize::MAX - 1).is_some(),
                matches!(spec.work, Work::Build(_))
            );
        }
    }
}
