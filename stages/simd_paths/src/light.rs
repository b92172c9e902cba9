//! Samples a light for eight points at once.

use crate::lane_mask::lanes;
use crate::sin_cos::sin_cos;
use crate::vec3x8::{LANES, Vec3x8};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{Emitter, Lamps, Vec2};
use lanes::light::{self, LightSample};
use std::f64::consts::TAU;

/// Emitters with more triangles are sampled point by point.
const MAX_TRIANGLES: usize = 4;

/// The weights of further lamps are computed twice.
const KEPT_WEIGHTS: usize = 32;

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
            Emitter::Lamps(lamps) => sample_lamps(simd, lamps, p, u, active),
            _ => {
                let mut samples = [None; LANES];
                for i in lanes(active) {
                    samples[i] = emitter.sample(p.lane(i), Vec2::new(u[0][i], u[1][i]));
                }
                in_lanes(simd, &samples)
            }
        },
    )
}

/// Chooses a lamp for each point, as [`Lamps::sample`].
#[inline(always)]
fn sample_lamps<S: Simd>(
    simd: S,
    lamps: &Lamps,
    p: Vec3x8<S>,
    u: [f64x8<S>; 2],
    active: u64,
) -> LightSample<f64x8<S>> {
    let zero = f64x8::splat(simd, 0.0);
    let mut total = zero;
    let mut weights = [zero; KEPT_WEIGHTS];
    for (i, lamp) in lamps.lamps().iter().enumerate() {
        let weight = light::lamp_weight(lamp, p);
        if i < KEPT_WEIGHTS {
            weights[i] = weight;
        }
        total += weight;
    }
    let mut rest = u[0] * total;
    let (mut number, mut weight, mut place) = (zero, zero, zero);
    let mut open = mask64x8::from_bitmask(simd, active);
    for (i, lamp) in lamps.lamps().iter().enumerate() {
        let of_lamp = if i < KEPT_WEIGHTS {
            weights[i]
        } else {
            light::lamp_weight(lamp, p)
        };
        let here = open & rest.simd_lt(of_lamp);
        number = here.select(f64x8::splat(simd, i as f64), number);
        weight = here.select(of_lamp, weight);
        place = here.select(rest, place);
        open &= !here;
        if open.to_bitmask() == 0 {
            break;
        }
        rest -= of_lamp;
    }
    let (place, share, open) = (place / weight, weight / total, open.to_bitmask());
    let mut samples = [None; LANES];
    for i in lanes(active) {
        let (p, u) = (p.lane(i), Vec2::new(u[0][i], u[1][i]));
        samples[i] = if !total[i].is_finite() {
            lamps.sample(p, u)
        } else if open >> i & 1 == 1 {
            None
        } else {
            lamps.lamps()[number[i] as usize].sample(p, Vec2::new(place[i], u.y), share[i])
        };
    }
    in_lanes(simd, &samples)
}

/// The samples of the points, one in each lane.
#[inline(always)]
fn in_lanes<S: Simd>(
    simd: S,
    samples: &[Option<kit::LightSample>; LANES],
) -> LightSample<f64x8<S>> {
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
