// BEGIN SOLUTION(part6.task2)
//! Paths on their way, field by field, so that eight of them fill lanes.

use crate::BATCH;
use crate::vec3x8::{LANES, Vec3x8};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::PixelSampler;
use kit::sampler::PixelSamplers;

type Field = [f64; BATCH];

/// The paths that are not over yet come first, in the order in which they started.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    pub(crate) count: usize,
    pub(crate) samplers: Vec<PixelSampler>,
    fields: Fields,
}

#[derive(Clone, Debug)]
struct Fields {
    o: [Field; 3],
    d: [Field; 3],
    throughput: [Field; 3],
    radiance: [Field; 3],
    left: Field,
    sees_light: Field,
    slot: Field,
}

/// Eight of them.
#[derive(Clone, Copy)]
pub(crate) struct Paths<S: Simd> {
    /// Where the next ray starts and goes.
    pub(crate) o: Vec3x8<S>,
    pub(crate) d: Vec3x8<S>,
    pub(crate) throughput: Vec3x8<S>,
    pub(crate) radiance: Vec3x8<S>,
    /// The number of the primitive that the ray leaves for good.
    pub(crate) left: f64x8<S>,
    /// 1 where emission counts at the next hit, 0 where it has been counted.
    pub(crate) sees_light: f64x8<S>,
    /// The number of the path.
    pub(crate) slot: f64x8<S>,
}

impl Default for Batch {
    fn default() -> Batch {
        let field = [0.0; BATCH];
        Batch {
            count: 0,
            samplers: vec![PixelSampler::new(0, 0, 0); BATCH],
            fields: Fields {
                o: [field; 3],
                d: [field; 3],
                throughput: [field; 3],
                radiance: [field; 3],
                left: field,
                sees_light: field,
                slot: field,
            },
        }
    }
}

impl Batch {
    /// The paths from number `first`, a multiple of eight.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, simd: S, first: usize) -> Paths<S> {
        Paths {
            o: load_vector(simd, &self.fields.o, first),
            d: load_vector(simd, &self.fields.d, first),
            throughput: load_vector(simd, &self.fields.throughput, first),
            radiance: load_vector(simd, &self.fields.radiance, first),
            left: load(simd, &self.fields.left, first),
            sees_light: load(simd, &self.fields.sees_light, first),
            slot: load(simd, &self.fields.slot, first),
        }
    }

    /// Their samplers.
    #[inline(always)]
    pub(crate) fn samplers(&self, first: usize) -> PixelSamplers<LANES> {
        let eight: &[PixelSampler; LANES] = self.samplers[first..first + LANES]
            .try_into()
            .expect("eight samplers");
        PixelSamplers::of(eight)
    }

    /// Puts those of `paths` that are in `mask` at place `first`, one after the other; what came after is lost.
    #[inline(always)]
    pub(crate) fn store<S: Simd>(&mut self, first: usize, paths: &Paths<S>, mask: mask64x8<S>) {
        store_vector(&mut self.fields.o, first, paths.o, mask);
        store_vector(&mut self.fields.d, first, paths.d, mask);
        store_vector(&mut self.fields.throughput, first, paths.throughput, mask);
        store_vector(&mut self.fields.radiance, first, paths.radiance, mask);
        store(&mut self.fields.left, first, paths.left, mask);
        store(&mut self.fields.sees_light, first, paths.sees_light, mask);
        store(&mut self.fields.slot, first, paths.slot, mask);
    }
}

// Functions, not closures: those would not be compiled for the instruction set.

#[inline(always)]
fn load<S: Simd>(simd: S, field: &Field, first: usize) -> f64x8<S> {
    f64x8::from_slice(simd, &field[first..first + LANES])
}

#[inline(always)]
fn load_vector<S: Simd>(simd: S, fields: &[Field; 3], first: usize) -> Vec3x8<S> {
    Vec3x8 {
        x: load(simd, &fields[0], first),
        y: load(simd, &fields[1], first),
        z: load(simd, &fields[2], first),
    }
}

#[inline(always)]
fn store<S: Simd>(field: &mut Field, first: usize, lanes: f64x8<S>, mask: mask64x8<S>) {
    lanes
        .compress(mask)
        .store_slice(&mut field[first..first + LANES]);
}

#[inline(always)]
fn store_vector<S: Simd>(
    fields: &mut [Field; 3],
    first: usize,
    lanes: Vec3x8<S>,
    mask: mask64x8<S>,
) {
    store(&mut fields[0], first, lanes.x, mask);
    store(&mut fields[1], first, lanes.y, mask);
    store(&mut fields[2], first, lanes.z, mask);
}
// END SOLUTION(part6.task2)
