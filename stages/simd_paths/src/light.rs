// BEGIN SOLUTION(part6.task2)
//! Samples a light for eight points at once.

use crate::lanes::lanes;
use crate::vec3x8::{LANES, Vec3x8};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{Emitter, EmittingMesh, Vec2};

/// The results of [`Emitter::sample`], one per lane.
pub(crate) struct LightSamples<S: Simd> {
    /// The lanes with a sample.
    pub(crate) valid: mask64x8<S>,
    pub(crate) wi: Vec3x8<S>,
    pub(crate) distance: f64x8<S>,
    pub(crate) pdf: f64x8<S>,
    pub(crate) radiance: Vec3x8<S>,
}

/// Emitters with more triangles are sampled point by point.
const MAX_TRIANGLES: usize = 4;

/// Calls [`Emitter::sample`] for the points in the lanes of `active`.
#[inline(always)]
pub(crate) fn sample_light<S: Simd>(
    simd: S,
    emitter: &Emitter,
    p: Vec3x8<S>,
    u: [f64x8<S>; 2],
    active: u64,
) -> LightSamples<S> {
    match emitter {
        Emitter::Mesh(mesh) if mesh.len() <= MAX_TRIANGLES => sample_mesh(simd, mesh, p, u),
        _ => sample_each(simd, emitter, p, u, active),
    }
}

/// Repeats the arithmetic of [`Emitter::sample`] operation by operation.
#[inline(always)]
fn sample_mesh<S: Simd>(
    simd: S,
    mesh: &EmittingMesh,
    p: Vec3x8<S>,
    u: [f64x8<S>; 2],
) -> LightSamples<S> {
    let splat = |x| f64x8::splat(simd, x);
    let target = u[0] * mesh.area();
    let part = mesh.part(0);
    let mut before = splat(part.before);
    let mut inverse_area = splat(part.inverse_area);
    let mut p0 = Vec3x8::splat(simd, part.triangle.p0);
    let mut e1 = Vec3x8::splat(simd, part.triangle.e1);
    let mut e2 = Vec3x8::splat(simd, part.triangle.e2);
    let mut front = Vec3x8::splat(simd, part.triangle.front);
    for i in 1..mesh.len() {
        let part = mesh.part(i);
        let here = splat(part.before).simd_le(target);
        before = here.select(splat(part.before), before);
        inverse_area = here.select(splat(part.inverse_area), inverse_area);
        p0 = Vec3x8::splat(simd, part.triangle.p0).masked_or(here, p0);
        e1 = Vec3x8::splat(simd, part.triangle.e1).masked_or(here, e1);
        e2 = Vec3x8::splat(simd, part.triangle.e2).masked_or(here, e2);
        front = Vec3x8::splat(simd, part.triangle.front).masked_or(here, front);
    }
    let one = splat(1.0);
    let within = ((target - before) * inverse_area).min_precise(one);
    let s = within.sqrt();
    let (b1, b2) = (s * (one - u[1]), s * u[1]);
    let d = p0 + e1 * b1 + e2 * b2 - p;
    let height = -d.dot(front);
    let distance2 = d.dot(d);
    let distance = distance2.sqrt();
    let pdf = distance2 * distance / (height * mesh.area());
    let zero = splat(0.0);
    let valid = zero.simd_lt(height) & zero.simd_lt(pdf) & pdf.simd_lt(splat(f64::INFINITY));
    LightSamples {
        valid,
        wi: d / distance,
        distance,
        pdf,
        radiance: Vec3x8::splat(simd, mesh.radiance.to_array().into()),
    }
}

#[inline(always)]
fn sample_each<S: Simd>(
    simd: S,
    emitter: &Emitter,
    p: Vec3x8<S>,
    u: [f64x8<S>; 2],
    active: u64,
) -> LightSamples<S> {
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
    LightSamples {
        valid: mask64x8::from_bitmask(simd, bits.map(|i| 1 << i).sum()),
        wi: vector(|s| s.wi.to_array()),
        distance: number(|s| s.distance),
        pdf: number(|s| s.pdf),
        radiance: vector(|s| s.radiance.to_array()),
    }
}
// END SOLUTION(part6.task2)
