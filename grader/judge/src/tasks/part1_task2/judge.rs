//! Judges camera rays.

use super::truth::direction;
use crate::tools::Tier;
use crate::tools::aspects::hits::{TOO_WIDE, WIDE, show};
use crate::tools::findings::{Aspect, Class, Findings, Message, told_apart};
use kit::Vec3;
use kit::camera::half_tan;
use wire::work::{Camera, Ray, Xyz};

/// How far a component of a direction may be off for core points: π written with nine digits is
/// enough.
const DIRECTION_BOUND: f64 = 1e-9;

/// How far a component of a direction may be off for robust points: a dozen roundings of numbers up
/// to 1.
const ROBUST_DIRECTION_BOUND: f64 = 1e-14;

/// How far the length of a direction may be from 1: a few roundings of a square root and a
/// division.
const UNIT_BOUND: f64 = 1e-12;

/// How far the origin may be off, relative to the camera's distance from the world's origin.
const ORIGIN_BOUND: f64 = 1e-12;

/// Judges `generate_ray`, called for every camera and for each of them with every sensor point.
pub(crate) fn rays(
    findings: &mut Findings,
    tier: Tier,
    cameras: &[Camera],
    sensor: &[[f64; 2]],
    answers: &[Ray],
) {
    let calls = cameras
        .iter()
        .flat_map(|camera| sensor.iter().map(move |point| (camera, *point)));
    for (call, ((camera, point), ray)) in calls.zip(answers).enumerate() {
        one(findings, tier, call, camera, point, ray);
    }
}

fn one(
    findings: &mut Findings,
    tier: Tier,
    call: usize,
    camera: &Camera,
    point: [f64; 2],
    ray: &Ray,
) {
    for aspect in [
        Aspect::Origin,
        Aspect::Direction,
        Aspect::UnitLength,
        Aspect::Range,
    ] {
        findings.expect(aspect);
    }
    let input = || {
        format!(
            "Sensor point ({}, {}), h_fov = {}, v_fov = {}, pos = {}",
            point[0],
            point[1],
            camera.h_fov,
            camera.v_fov,
            show(camera.pos.into())
        )
    };
    let (o, pos) = (Vec3::from(ray.o), Vec3::from(camera.pos));
    let off = (o - pos).length();
    let bound = ORIGIN_BOUND * pos.length();
    findings.judge(Aspect::Origin, call, off <= bound, off, || {
        Message::new(format!(
            "your result: o = {}; expected: the camera's pos, {}",
            show(o),
            show(pos)
        ))
        .compares(o.to_array(), pos.to_array())
        .asked(input())
    });

    let (d, right) = (Vec3::from(ray.d), direction(camera, point));
    let length = d.length();
    let off = (d / length - right).length();
    let bound = match tier {
        Tier::Core => DIRECTION_BOUND,
        Tier::Robust => ROBUST_DIRECTION_BOUND,
    } + angle_rounding(camera.h_fov)
        + angle_rounding(camera.v_fov);
    if bound > WIDE {
        findings.not_judged(Aspect::Direction, call, TOO_WIDE);
    }
    let is_right = off <= bound;
    let class = (!is_right).then(|| Class::of_certain_direction(d, right));
    findings.judge_class(Aspect::Direction, call, class, off, || {
        let columns = columns(&camera.c2w);
        Message::new(format!(
            "your result: d = {}; expected: {} (angle between them {} degrees)",
            show(d),
            show(right),
            told_apart(d.angle_between(right).to_degrees(), 0.0, 3)[0]
        ))
        .compares(d.to_array(), right.to_array())
        .asked(format!("{}, {columns}", input()))
    });
    let off = (length - 1.0).abs();
    findings.judge(Aspect::UnitLength, call, off <= UNIT_BOUND, off, || {
        Message::new(format!(
            "your result: d = {} of length {length}; expected: length 1",
            show(d)
        ))
        .compares([length], [1.0])
        .asked(input())
    });
    for (name, given, right) in [
        ("min_t", ray.min_t, camera.n_clip),
        ("max_t", ray.max_t, camera.f_clip),
    ] {
        let is_right = given.to_bits() == right.to_bits();
        let class = (!is_right).then_some(Class::Named(name));
        findings.judge_class(Aspect::Range, call, class, 1.0, || {
            Message::new(format!(
                "your result: t in [{}, {}]; expected: n_clip to f_clip, [{}, {}]",
                ray.min_t, ray.max_t, camera.n_clip, camera.f_clip
            ))
            .compares([given], [right])
            .asked(input())
        });
    }
}

/// The error of the direction due to rounding of the angle before its tangent is taken: the
/// relative error of `tan θ` is that of `θ` times `θ (tan θ + cot θ)`, which is large near 90
/// degrees. `θ` is rounded 4 times.
fn angle_rounding(fov_degrees: f64) -> f64 {
    let half = fov_degrees.to_radians() * 0.5;
    let tan = half_tan(fov_degrees);
    4.0 * f64::EPSILON * half * (tan + 1.0 / tan)
}

fn columns(c2w: &[Xyz; 3]) -> String {
    let [right, up, backward] = c2w.map(|column| show(column.into()));
    format!("columns of c2w: right {right}, up {up}, backward {backward}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        let c2w = kit::Camera::look_at(Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO, Vec3::Y)
            .expect("not along +y");
        Camera {
            pos: [1.0, 2.0, 3.0],
            c2w: [c2w.x_axis, c2w.y_axis, c2w.z_axis].map(Vec3::into),
            h_fov: 60.0,
            v_fov: 40.0,
            n_clip: 0.5,
            f_clip: 90.0,
        }
    }

    /// The aspects that fail for the right ray after `spoil` has changed it.
    fn wrong(spoil: impl Fn(&mut Ray)) -> Vec<Aspect> {
        let (camera, point) = (camera(), [0.3, 0.8]);
        let mut ray = Ray {
            o: camera.pos,
            d: direction(&camera, point).into(),
            min_t: camera.n_clip,
            max_t: camera.f_clip,
        };
        spoil(&mut ray);
        let mut findings = Findings::default();
        rays(&mut findings, Tier::Core, &[camera], &[point], &[ray]);
        findings.wrong_aspects()
    }

    #[test]
    fn each_aspect_is_judged_separately() {
        assert_eq!(wrong(|_| {}), []);
        assert_eq!(wrong(|ray| ray.o[1] += 1e-6), [Aspect::Origin]);
        assert_eq!(
            wrong(|ray| ray.d[0] += 1e-6),
            [Aspect::Direction, Aspect::UnitLength]
        );
        let twice = |ray: &mut Ray| ray.d = ray.d.map(|x| 2.0 * x);
        assert_eq!(wrong(twice), [Aspect::UnitLength]);
        assert_eq!(wrong(|ray| ray.min_t = 0.0), [Aspect::Range]);
        assert_eq!(wrong(|ray| ray.max_t = f64::INFINITY), [Aspect::Range]);
    }

    #[test]
    fn nan_is_wrong() {
        assert_eq!(
            wrong(|ray| ray.d[2] = f64::NAN),
            [Aspect::Direction, Aspect::UnitLength]
        );
        assert_eq!(wrong(|ray| ray.o[0] = f64::NAN), [Aspect::Origin]);
    }
}
