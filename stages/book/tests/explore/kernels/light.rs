//! Directions, lamps, glass, and pixels that stop.

use super::{Records, records};
use crate::explore::inputs::Inputs;
use kit::{PixelSampler, Spectrum, Tally, Vec2, Vec3, math};

pub(super) fn all() -> Vec<Records> {
    vec![
        malley(),
        uniform(),
        lamp(),
        glass(),
        exact_glass(),
        stopping(),
    ]
}

/// The reference's sample of a diffuse surface.
fn malley() -> Records {
    records("malley", 2, |inputs| {
        let u = point_of_the_square(inputs);
        let sample = direct::lambert_sample(Spectrum::WHITE, Vec3::Z, u);
        direction_of(u, sample.map_or(Vec3::NAN, |sample| sample.wi))
    })
}

/// Uniform directions.
fn uniform() -> Records {
    records("uniform", 2, |inputs| {
        let u = point_of_the_square(inputs);
        direction_of(u, kit::warp::uniform_hemisphere(u))
    })
}

/// Also the corners and the edges of the square, just below 1 among them.
fn point_of_the_square(inputs: &mut Inputs) -> Vec2 {
    let mut number = || match inputs.below(4) {
        0 => f64::from(inputs.below(16)) / 16.0,
        1 => 1.0 - f64::EPSILON / 2.0 * f64::from(1 + inputs.below(4)),
        _ => inputs.unit(),
    };
    Vec2::new(number(), number())
}

fn direction_of(u: Vec2, direction: Vec3) -> Vec<f64> {
    [&u.to_array()[..], &direction.to_array()].concat()
}

/// The chapter's formulas, by angle and index: the two amplitudes and F; NaN beyond the critical
/// angle. (The reference's `fresnel_dielectric` rearranges them, which no script shows.)
fn glass() -> Records {
    records("glass", 3, |inputs| {
        let angle = match inputs.below(3) {
            0 => f64::from(inputs.below(91)).to_radians(),
            1 => inputs.wild(40.0).abs().min(1.5),
            _ => inputs.between(0.0, std::f64::consts::FRAC_PI_2),
        };
        let (sine, cosine) = math::sin_cos(angle);
        let eta = match inputs.below(2) {
            0 => 1.0 + f64::from(inputs.below(25)) / 16.0,
            _ => 1.0 / inputs.between(1.0, 2.5),
        };
        let transmitted = (1.0 - eta * sine * (eta * sine)).sqrt();
        let parallel = (cosine - eta * transmitted) / (cosine + eta * transmitted);
        let across = (eta * cosine - transmitted) / (eta * cosine + transmitted);
        let fraction = (parallel * parallel + across * across) / 2.0;
        vec![cosine, sine, eta, parallel, across, fraction]
    })
}

/// The reference's reflected fraction and refracted direction, or NaN, as inputs: the script's
/// exact answer is within some roundings of them, or a direction is so near the critical angle that
/// rounding decides. The result is 1.
fn exact_glass() -> Records {
    records("exact_glass", 6, |inputs| {
        let (x, z) = (
            f64::from(inputs.below(41)) / 16.0 - 1.25,
            f64::from(inputs.below(41)) / 16.0 - 1.25,
        );
        let (x, z) = if (x, z) == (0.0, 0.0) {
            (0.0, 1.0)
        } else {
            (x, z)
        };
        let ior = 1.0 + f64::from(inputs.below(25)) / 16.0;
        let wo = Vec3::new(x, 0.0, z).normalize();
        let eta = if z > 0.0 { 1.0 / ior } else { ior };
        let fraction = global::fresnel_dielectric(wo.z, eta);
        let wi = global::refract(wo, ior).unwrap_or(Vec3::NAN);
        vec![x, z, ior, fraction, wi.x, wi.z, 1.0]
    })
}

/// What one sample brings from a square lamp above a floor, by a uniform direction (`kit::warp`) and
/// by a point of the lamp, as the book's static figure computes it.
fn lamp() -> Records {
    use std::f64::consts::{FRAC_1_PI, TAU};
    records("lamp", 5, |inputs| {
        let (x, height, edge) = (
            inputs.small(),
            0.5 + inputs.unit() * 4.0,
            inputs.between(0.1, 8.0),
        );
        let u = point_of_the_square(inputs);
        let value = 0.8 * FRAC_1_PI;
        let w = kit::warp::uniform_hemisphere(u);
        let there = height / w.z * w;
        let meets = (there.x - x).abs() <= 0.5 * edge && there.y.abs() <= 0.5 * edge;
        let by_direction = if meets { value * 10.0 * w.z * TAU } else { 0.0 };

        let q = Vec3::new(x + edge * (u.x - 0.5), edge * (u.y - 0.5), height);
        let cos = height / q.length();
        let density = q.length_squared() / (edge * edge * cos);
        let by_point = value * 10.0 * cos / density;
        vec![x, height, edge, u.x, u.y, by_direction, by_point]
    })
}

/// A pixel whose samples are 1/p or 0, stopped by the reference's rules for tasks 1 and 2: the
/// number of samples and their mean.
fn stopping() -> Records {
    records("stopping", 6, |inputs| {
        let [x, y, seed] = [(); 3].map(|()| inputs.below(u32::MAX));
        // At most 512 samples, and rules that stop early, or the test takes minutes.
        let rare = 1 + inputs.below(3) + 2 * inputs.below(2);
        let is_sure = inputs.below(8) == 0;
        let p = 0.5_f64.powi(rare as i32);
        let draw = |sampler: &mut PixelSampler| {
            sampler.get_sample();
            if sampler.next_1d() < p { 1.0 / p } else { 0.0 }
        };
        let first = || PixelSampler::new(x, y, u64::from(seed));
        // Often a tolerance at which the first batch is just precise enough, or just not.
        let mut sampler = first();
        let batch: Tally = (0..32).map(|_| draw(&mut sampler)).collect();
        let near = 1.0 + (f64::from(inputs.below(3)) - 1.0) * 1e-5;
        let tolerance = match inputs.below(2) {
            0 if batch.mean() > 0.0 => near * (1.96 * batch.standard_error() / batch.mean()),
            _ => f64::from(2 + inputs.below(9)) * 0.05,
        };
        let mut sampler = first();
        let mut tally = Tally::default();
        loop {
            tally.push(draw(&mut sampler));
            let mut plain = adaptive::has_converged;
            let is_over = tally.count() == 512
                || tally.count().is_multiple_of(32)
                    && if is_sure {
                        adaptive::has_surely_converged(&tally, tolerance, &mut plain)
                    } else {
                        plain(&tally, tolerance)
                    };
            if is_over {
                break;
            }
        }
        let rule = f64::from(u8::from(is_sure));
        let numbers = [x, y, seed].map(f64::from);
        [
            &numbers[..],
            &[p, tolerance, rule],
            &[tally.count() as f64, tally.mean()],
        ]
        .concat()
    })
}
