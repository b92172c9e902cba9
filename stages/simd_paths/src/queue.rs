//! The paths of a batch, one array per field, so that eight of them load into lanes.

use crate::BATCH_SIZE;
use crate::beam::{RangeEnds, RayBundle};
use crate::caustic_guide::MAX_CAUSTIC_RAYS;
use crate::vec3x8::{LANES, Vec3x8};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::PixelSampler;
use kit::sampler::PixelSamplers;

type Field = Vec<f64>;

/// The paths that still continue, in the order in which they started.
#[derive(Clone, Debug)]
pub(crate) struct PathQueue {
    pub(crate) count: usize,
    pub(crate) samplers: Vec<PixelSampler>,
    fields: Fields,
}

#[derive(Clone, Debug)]
struct Fields {
    o: [Field; 3],
    d: [Field; 3],
    throughput: [Field; 3],
    skip: Field,
    emission_counts: Field,
    index: Field,
}

/// Eight paths.
#[derive(Clone, Copy)]
pub(crate) struct PathLanes<S: Simd> {
    /// Origins and directions of the next rays.
    pub(crate) o: Vec3x8<S>,
    pub(crate) d: Vec3x8<S>,
    pub(crate) throughput: Vec3x8<S>,
    /// The number of the primitive that the ray leaves and cannot hit again, or `NONE`.
    pub(crate) skip: f64x8<S>,
    /// How much of the emission at the next hit counts: nothing if it is not positive, because
    /// direct light has counted it. Behind a mirror or smooth glass the part is then 1 if this is
    /// 0, and else the one of the direction's density `-emission_counts` and the guide's.
    pub(crate) emission_counts: f64x8<S>,
    /// The number of the path: of its radiance.
    pub(crate) index: f64x8<S>,
}

impl Default for PathQueue {
    fn default() -> PathQueue {
        let capacity = BATCH_SIZE * MAX_CAUSTIC_RAYS;
        let field = || vec![0.0; capacity];
        let vector = || [field(), field(), field()];
        PathQueue {
            count: 0,
            samplers: vec![PixelSampler::new(0, 0, 0); capacity],
            fields: Fields {
                o: vector(),
                d: vector(),
                throughput: vector(),
                skip: field(),
                emission_counts: field(),
                index: field(),
            },
        }
    }
}

impl PathQueue {
    /// Loads eight paths from number `first`, a multiple of eight.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, simd: S, first: usize) -> PathLanes<S> {
        PathLanes {
            o: load_vector(simd, &self.fields.o, first),
            d: load_vector(simd, &self.fields.d, first),
            throughput: load_vector(simd, &self.fields.throughput, first),
            skip: load(simd, &self.fields.skip, first),
            emission_counts: load(simd, &self.fields.emission_counts, first),
            index: load(simd, &self.fields.index, first),
        }
    }

    /// The next rays of the paths from number `first`, at most `most`, in `range`.
    #[inline(always)]
    pub(crate) fn rays(&self, first: usize, most: usize, range: [f64; 2]) -> RayBundle<'_> {
        RayBundle {
            count: (self.count - first).min(most),
            o: self.fields.o.each_ref().map(|o| &o[first..]),
            d: self.fields.d.each_ref().map(|d| &d[first..]),
            min_t: range[0],
            max_t: RangeEnds::All(range[1]),
            skip: &self.fields.skip[first..],
        }
    }

    /// The numbers of the paths whose last surface was neither a mirror nor smooth glass.
    pub(crate) fn scattered(&self) -> impl Iterator<Item = usize> {
        let index = &self.fields.index;
        let paths = self
            .fields
            .emission_counts
            .iter()
            .zip(index)
            .take(self.count);
        let scattered = paths.filter(|(emission_counts, _)| **emission_counts <= 0.0);
        scattered.map(|(_, index)| *index as usize)
    }

    /// The samplers of these paths.
    #[inline(always)]
    pub(crate) fn samplers(&self, first: usize) -> PixelSamplers<LANES> {
        let samplers: &[PixelSampler; LANES] = self.samplers[first..first + LANES]
            .try_into()
            .expect("eight samplers");
        PixelSamplers::of(samplers)
    }

    /// Stores the paths in the lanes of `mask` one after the other, from number `first`. Overwrites
    /// eight paths.
    #[inline(always)]
    pub(crate) fn store<S: Simd>(&mut self, first: usize, paths: &PathLanes<S>, mask: mask64x8<S>) {
        store_vector(&mut self.fields.o, first, paths.o, mask);
        store_vector(&mut self.fields.d, first, paths.d, mask);
        store_vector(&mut self.fields.throughput, first, paths.throughput, mask);
        store(&mut self.fields.skip, first, paths.skip, mask);
        store(
            &mut self.fields.emission_counts,
            first,
            paths.emission_counts,
            mask,
        );
        store(&mut self.fields.index, first, paths.index, mask);
    }
}

// Functions, because closures would not be compiled for the instruction set.

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
