//! Samples a light for eight points at once.

use crate::lane_mask::lanes;
use crate::sin_cos::sin_cos;
use crate::vec3x8::{LANES, Vec3x8};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{Emitter, Vec2};
use lanes::light::{self, LightSample};
use std::f64::consts::TAU;

/// Emitters with more triangles are sampled point by point.
const MAX_TRIANGLES: usize = 4;

/// Calls [`Emitter::sample`] for the points in the lanes of `active`.
#[inline(never)]
pub(crate) fn sample_light<S: Simd>(
    simd: S,
    emitter: &Emitter,
    p: Vec3x8<S>,
    u: [f64x8<S>; 2],
    active: u64,
) -> LightSample<f64x8<S>> {
    simd.vectorize(
        #[inline(always)]
        || match emitter {
            Emitter::Mesh(mesh) if mesh.len() <= MAX_TRIANGLES => light::sample_mesh(mesh, p, u),
            Emitter::Sky { radiance } => {
                let radiance = radiance.to_array().into();
                light::sample_sky(radiance, u[0], sin_cos(u[1] * TAU))
            }
            _ => sample_each(simd, emitter, p, u, active),
        },
    )
}

#[inline(always)]
fn sample_each<S: Simd>(
    simd: S,
    emitter: &Emitter,
    p: Vec3x8<S>,
    u: [f64x8<S>; 2],
    active: u64,
) -> LightSample<f64x8<S>> {
    let mut samples = [None; LANES];
    for i in lanes(active) {
        samples[i] = emitter.sample(p.lane(i), Vec2::new(u[0][i], u[1][i]));
    }
    let number = |of: fn(&kit::LightSample) -> f64| {
        f64x8::from_fn(simd, |i| samples[i].as_ref().map_or(1.0, of))
    };
    let vector = |of: fn(&kit::LightSample) -> [f64; 3]| {
        Vec3x8::gather(simd, |i| samples[i].as_ref().map_or([0.0; 3], of))
    };
    let bits = (0..LANES).filter(|&i| samples[i].is_some());
    LightSample {
        exists: mask64x8::from_bitmask(simd, bits.map(|i| 1 << i).sum()),
        wi: vector(|s| s.wi.to_array()),
        distance: number(|s| s.distance),
        pdf: number(|s| s.pdf),
        radiance: vector(|s| s.radiance.to_array()),
    }
}
