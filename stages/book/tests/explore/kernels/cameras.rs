//! Angles, camera rays and the random numbers of a pixel.

use super::{Records, records};
use crate::explore::inputs::Inputs;
use kit::sampler::{Pattern, Sampling};
use kit::{Camera, Mat3, PixelSampler, Vec2, Vec3, math};

pub(super) fn all() -> Vec<Records> {
    vec![
        trigonometry("sin", math::sin),
        trigonometry("cos", math::cos),
        trigonometry("tan", math::tan),
        camera(),
        sampler("sampler", false),
        sampler("strata", true),
    ]
}

fn trigonometry(name: &'static str, function: fn(f64) -> f64) -> Records {
    records(name, 1, move |inputs| {
        let x = angle(inputs);
        vec![x, function(x)]
    })
}

/// An angle in radians: of a turn, of many turns, near a multiple of a quarter turn, or tiny.
fn angle(inputs: &mut Inputs) -> f64 {
    use std::f64::consts::{FRAC_PI_4, TAU};
    match inputs.below(5) {
        0 => inputs.between(-TAU, TAU),
        1 => inputs.between(-1e6, 1e6),
        2 => {
            let near = f64::from(inputs.below(4000)) * FRAC_PI_4;
            let ulps = u64::from(inputs.below(5));
            f64::from_bits(near.to_bits() + ulps) * if inputs.unit() < 0.5 { -1.0 } else { 1.0 }
        }
        3 => inputs.wild(40.0).rem_euclid(1e6),
        _ => inputs.wild(1020.0).rem_euclid(1.0),
    }
}

/// The second sample of a pixel: its position, and the next two numbers. Of independent samples, or
/// of up to 1024 strata.
fn sampler(name: &'static str, in_strata: bool) -> Records {
    records(name, 4, move |inputs| {
        let [x, y, seed] = [(); 3].map(|()| inputs.below(u32::MAX));
        let samples = if in_strata { 1 + inputs.below(1024) } else { 0 };
        let pattern = match samples {
            0 => Pattern::Independent,
            samples => Pattern::Stratified { samples },
        };
        let sampling = Sampling {
            pattern,
            seed: u64::from(seed),
            first_sample: 0,
        };
        let mut sampler = PixelSampler::new(x, y, sampling);
        sampler.get_sample();
        let numbers = [sampler.get_sample(), sampler.next_2d()];
        let inputs = [x, y, seed, samples].map(f64::from);
        [&inputs[..], &numbers[0].to_array(), &numbers[1].to_array()].concat()
    })
}

/// The reference's camera ray: its direction. Angles up to 180 degrees, tiny ones among them, any
/// rotation, points on the film and beyond.
fn camera() -> Records {
    records("camera", 13, |inputs| {
        let mut fov = || match inputs.below(4) {
            0 => f64::from(inputs.below(181)),
            1 => 180.0 - inputs.wild(40.0).abs().min(180.0),
            2 => inputs.wild(40.0).abs().min(180.0),
            _ => inputs.between(0.0, 180.0),
        };
        let (h_fov, v_fov) = (fov(), fov());
        let eye = inputs.vec3(1);
        let turned = Camera::look_at(eye, Vec3::ZERO, Vec3::Y);
        let c2w = match inputs.below(3) {
            0 => Mat3::from_cols(Vec3::Z, Vec3::Y, -Vec3::X),
            _ => turned.unwrap_or(Mat3::IDENTITY),
        };
        let sensor = match inputs.below(2) {
            0 => Vec2::new(f64::from(inputs.below(9)), f64::from(inputs.below(9))) / 8.0,
            _ => Vec2::new(inputs.between(-1.0, 2.0), inputs.between(-1.0, 2.0)),
        };
        let camera = Camera {
            pos: eye,
            c2w,
            h_fov,
            v_fov,
            n_clip: 0.0,
            f_clip: f64::INFINITY,
        };
        let d = raygen::generate_ray(&camera, sensor).d;
        [
            &[h_fov, v_fov][..],
            &c2w.to_cols_array(),
            &sensor.to_array(),
            &d.to_array(),
        ]
        .concat()
    })
}
