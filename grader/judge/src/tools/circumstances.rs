//! Circumstances of a call: properties of its question of which mistakes often depend.
//!
//! If all wrong answers have one in common that most right answers do not have, it tells where to
//! look, even if the mistake is not known.

use crate::tools::convert;
use kit::{Triangle, Vec3};
use wire::Work;
use wire::direct::LambertProbe;
use wire::global::{SpecularCall, Step};
use wire::work::{Camera, CameraWork, PixelWork, Ray, Xyz};

/// The circumstances of call number `call` of `work`.
///
/// Each ends the sentence "wrong only where ...".
pub fn of(work: &Work, call: usize) -> Vec<&'static str> {
    let circumstances = match work {
        Work::Pixels(work) => work.pixels.get(call).map(|at| of_pixel(work, *at)),
        Work::CameraRays(work) => of_camera_ray(work, call),
        Work::Triangles(work) => work.probes.get(call).map(|probe| {
            let triangle = convert::triangle(&work.triangles[probe.shape as usize]);
            [of_ray(&probe.ray), of_triangle(&triangle, &probe.ray)].concat()
        }),
        Work::Spheres(work) => work.probes.get(call).map(|probe| {
            let (center, radius) = work.spheres[probe.shape as usize];
            let sphere = of_sphere(center.into(), radius, &probe.ray);
            [of_ray(&probe.ray), sphere].concat()
        }),
        Work::Boxes(work) => work.probes.get(call).map(|probe| {
            let corners = work.boxes[probe.shape as usize].map(Vec3::from);
            [of_ray(&probe.ray), of_box(corners, &probe.ray)].concat()
        }),
        Work::BruteForce(work) => work.rays.get(call).map(of_ray),
        Work::Traverse(work) => work.rays.get(call).map(|scripted| {
            let function = [
                (work.any_hit, "any hit is looked for"),
                (!work.any_hit, "the closest hit is looked for"),
            ];
            [holding(&function), of_range(&scripted.ray)].concat()
        }),
        Work::SceneHits(work) => work.rays.get(call).map(of_ray),
        Work::Lambert(probes) => probes.get(call).map(of_lambert),
        Work::Specular(calls) => calls.get(call).map(of_specular),
        Work::Paths(paths) => paths
            .get(call)
            .map(|path| of_path(&path.steps, path.max_depth)),
        _ => None,
    };
    circumstances.unwrap_or_default()
}

/// The sentences whose conditions hold.
fn holding(all: &[(bool, &'static str)]) -> Vec<&'static str> {
    let holding = all.iter().filter(|(holds, _)| *holds);
    holding.map(|(_, sentence)| *sentence).collect()
}

fn of_pixel(work: &PixelWork, [x, y]: [u32; 2]) -> Vec<&'static str> {
    let [w, h] = work.film;
    holding(&[
        (work.ns_aa == 1, "ns_aa is 1"),
        (work.ns_aa > 1, "ns_aa is above 1"),
        (w != h, "the film is not a square"),
        (x > 0, "the pixel is not in the first column"),
        (y > 0, "the pixel is not in the first row"),
        (x != y, "x and y differ"),
    ])
}

fn of_camera_ray(work: &CameraWork, call: usize) -> Option<Vec<&'static str>> {
    let camera = work.cameras.get(call.checked_div(work.sensor.len())?)?;
    let [u, v] = work.sensor[call % work.sensor.len()];
    let Camera {
        c2w,
        pos,
        h_fov,
        v_fov,
        ..
    } = camera;
    let straight = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Some(holding(&[
        (*c2w != straight, "the camera is turned"),
        (*pos != [0.0; 3], "the camera is not at the world's origin"),
        (h_fov != v_fov, "h_fov and v_fov differ"),
        (u < 0.5, "the sensor point is left of the middle"),
        (u > 0.5, "the sensor point is right of the middle"),
        (v < 0.5, "the sensor point is below the middle"),
        (v > 0.5, "the sensor point is above the middle"),
        (u != 0.5 || v != 0.5, "the sensor point is not the middle"),
        (
            u != 0.5 && v != 0.5,
            "the sensor point is off the middle along both axes",
        ),
    ]))
}

fn of_ray(ray: &Ray) -> Vec<&'static str> {
    let [x, y, z] = ray.d;
    let length = Vec3::from(ray.d).length();
    let direction = holding(&[
        (x < 0.0, "the ray's direction has a negative x"),
        (y < 0.0, "the ray's direction has a negative y"),
        (z < 0.0, "the ray's direction has a negative z"),
        (x > 0.0, "the ray's direction has a positive x"),
        (y > 0.0, "the ray's direction has a positive y"),
        (z > 0.0, "the ray's direction has a positive z"),
        (
            ray.d.contains(&0.0),
            "a coordinate of the ray's direction is 0",
        ),
        (
            (length - 1.0).abs() > 1e-9,
            "the ray's direction does not have length 1",
        ),
        (
            ray.o != [0.0; 3],
            "the ray does not start at the world's origin",
        ),
    ]);
    [direction, of_range(ray)].concat()
}

fn of_range(ray: &Ray) -> Vec<&'static str> {
    holding(&[
        (ray.min_t > 0.0, "min_t is above 0"),
        (ray.min_t < 0.0, "min_t is below 0"),
        (ray.max_t < f64::INFINITY, "max_t is finite"),
    ])
}

fn of_triangle(triangle: &Triangle, ray: &Ray) -> Vec<&'static str> {
    let normal = (triangle.p1 - triangle.p0).cross(triangle.p2 - triangle.p0);
    let along = normal.dot(Vec3::from(ray.d));
    let t = normal.dot(triangle.p0 - Vec3::from(ray.o)) / along;
    holding(&[
        (along > 0.0, "the ray comes from behind the triangle"),
        (along < 0.0, "the ray comes from in front of the triangle"),
        (t < 0.0, "the triangle's plane lies behind the ray's origin"),
        (triangle.p0 != Vec3::ZERO, "p0 is not at the world's origin"),
    ])
}

fn of_sphere(center: Vec3, radius: f64, ray: &Ray) -> Vec<&'static str> {
    let to_center = center - Vec3::from(ray.o);
    holding(&[
        (
            to_center.length() < radius,
            "the ray starts inside the sphere",
        ),
        (
            to_center.length() > radius,
            "the ray starts outside the sphere",
        ),
        (
            to_center.dot(Vec3::from(ray.d)) < 0.0,
            "the sphere's centre lies behind the ray's origin",
        ),
        (
            center != Vec3::ZERO,
            "the sphere's centre is not at the world's origin",
        ),
        (radius != 1.0, "the radius is not 1"),
    ])
}

fn of_box([min, max]: [Vec3; 2], ray: &Ray) -> Vec<&'static str> {
    let o = Vec3::from(ray.o);
    let inside = o.cmpge(min).all() && o.cmple(max).all();
    let center = 0.5 * (min + max) - o;
    holding(&[
        (inside, "the ray starts inside the box"),
        (!inside, "the ray starts outside the box"),
        (
            !inside && center.dot(Vec3::from(ray.d)) < 0.0,
            "the box lies behind the ray's origin",
        ),
        (min.cmpeq(max).any(), "the box is flat"),
    ])
}

fn of_lambert(probe: &LambertProbe) -> Vec<&'static str> {
    let (wo, wi) = (probe.wo[2], probe.wi[2]);
    holding(&[
        (wo < 0.0, "wo is below the surface"),
        (wo > 0.0, "wo is above the surface"),
        (wi < 0.0, "wi is below the surface"),
        (wo * wi < 0.0, "wo and wi are on different sides"),
        (wo * wi > 0.0, "wo and wi are on the same side"),
        (
            is_coloured(probe.reflectance),
            "the reflectance is coloured",
        ),
    ])
}

fn of_specular(call: &SpecularCall) -> Vec<&'static str> {
    let from_inside = |wo: &Xyz| {
        holding(&[
            (wo[2] < 0.0, "wo is on the inside"),
            (wo[2] > 0.0, "wo is on the outside"),
            (wo[2].abs() < 1.0, "wo is not along the normal"),
        ])
    };
    match call {
        SpecularCall::Fresnel { cos_i, eta } => holding(&[
            (*cos_i < 0.0, "cos_i is negative"),
            (*cos_i > 0.0, "cos_i is positive"),
            (*eta > 1.0, "light comes from the denser side"),
            (*eta < 1.0, "light comes from the thinner side"),
        ]),
        SpecularCall::Reflect { wo } | SpecularCall::Refract { wo, .. } => from_inside(wo),
        SpecularCall::Mirror { reflectance, wo } => [
            from_inside(wo),
            holding(&[(is_coloured(*reflectance), "the reflectance is coloured")]),
        ]
        .concat(),
        SpecularCall::Refraction { wo, .. } | SpecularCall::Glass { wo, .. } => from_inside(wo),
    }
}

fn of_path(steps: &[Step], max_depth: u32) -> Vec<&'static str> {
    let meets = |is: fn(&Step) -> bool| steps.iter().any(is);
    holding(&[
        (max_depth <= 1, "max_depth is at most 1"),
        (max_depth > 1, "max_depth is above 1"),
        (steps.is_empty(), "the first ray meets nothing"),
        (steps.len() > 1, "the path meets more than one surface"),
        (
            meets(|step| step.sample.is_some_and(|sample| sample.delta)),
            "the path meets a mirror or glass",
        ),
        (
            meets(|step| step.roulette.is_none()),
            "roulette ends the path",
        ),
        (
            meets(|step| step.sample.is_none()),
            "a surface gives no sample",
        ),
    ])
}

fn is_coloured([r, g, b]: Xyz) -> bool {
    r != g || g != b
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::work::{BoxWork, Probe};

    #[test]
    fn a_ray_that_starts_in_a_box_says_so() {
        let ray = Ray {
            o: [0.5; 3],
            d: [1.0, -2.0, 0.0],
            min_t: 0.0,
            max_t: f64::INFINITY,
        };
        let work = Work::Boxes(BoxWork {
            boxes: vec![[[0.0; 3], [1.0; 3]]],
            probes: vec![Probe { shape: 0, ray }],
        });
        let found = of(&work, 0);
        assert!(
            found.contains(&"the ray starts inside the box"),
            "{found:?}"
        );
        assert!(found.contains(&"a coordinate of the ray's direction is 0"));
        assert!(found.contains(&"the ray's direction has a negative y"));
        assert!(!found.contains(&"max_t is finite"));
        assert_eq!(of(&work, 1), Vec::<&str>::new());
    }
}
