//! The shadow rays of a bounce: collected from all packets, so that they fill the lanes and the
//! rays to one light are traced together; and what the light adds to the paths.

use crate::beam::{BEAM_SIZE, RangeEnds, RayBundle};
use crate::bsdf_rays::BsdfRays;
use crate::intersection::TracedRays;
use crate::lane_mask::lanes;
use crate::primitive_list::NearbyPrimitives;
use crate::ray_packet::RayPacket;
use crate::vec3x8::{LANES, Vec3x8};
use crate::{PathMemory, PathScene, PathSettings, ScalarFallback};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{Emitter, Spectrum, Vec3};

/// The direct light at the diffuse surfaces that the paths of a batch have hit.
#[derive(Clone, Debug, Default)]
pub(crate) struct ShadowQueue {
    /// The shadow rays to each emitter.
    rays: Vec<ShadowRays>,
    /// With multiple importance sampling, rays in directions that the BSDF has sampled.
    pub(crate) bsdf_rays: BsdfRays,
    packets: Vec<LitPacket>,
    /// For each packet all samples of the first emitter, then those of the second one, and so on;
    /// with multiple importance sampling then those of the BSDF.
    samples: Vec<LightSamples>,
}

/// Shadow rays to one emitter, in structure-of-arrays layout.
#[derive(Clone, Debug, Default)]
struct ShadowRays {
    count: usize,
    o: [Vec<f64>; 3],
    d: [Vec<f64>; 3],
    max_t: Vec<f64>,
    skip: Vec<f64>,
    /// The number of the light sample: eight for each element of `samples`.
    sample: Vec<f64>,
}

/// Eight paths that have hit surfaces.
#[derive(Clone, Debug)]
struct LitPacket {
    /// Before the bounce.
    throughput: [[f64; LANES]; 3],
    /// The numbers of the paths.
    index: [f64; LANES],
    /// The lanes with a diffuse surface, one bit each.
    diffuse: u64,
}

/// One sample of a light for each lane of a packet.
#[derive(Clone, Debug)]
struct LightSamples {
    /// What the light adds where nothing is in its way, divided by the throughput.
    light: [[f64; LANES]; 3],
    /// The lanes, one bit each, that light reaches; before the rays are traced those that it may
    /// reach.
    lit: u64,
}

/// How many samples `emitter` gets at each surface.
#[inline(always)]
pub(crate) fn sample_count(emitter: &Emitter, settings: &PathSettings) -> u32 {
    if emitter.is_delta() {
        1
    } else {
        settings.light_samples
    }
}

impl ShadowQueue {
    /// Removes everything.
    pub(crate) fn clear(&mut self, emitters: usize) {
        self.rays.resize_with(emitters, ShadowRays::default);
        for rays in &mut self.rays {
            rays.count = 0;
        }
        self.bsdf_rays.clear();
        self.packets.clear();
        self.samples.clear();
    }

    /// Adds eight paths. Samples of all emitters have to be added next.
    #[inline(always)]
    pub(crate) fn push_packet<S: Simd>(
        &mut self,
        throughput: Vec3x8<S>,
        index: f64x8<S>,
        diffuse: u64,
    ) {
        let mut packet = LitPacket {
            throughput: store_vector(throughput),
            index: [0.0; LANES],
            diffuse,
        };
        index.store_array(&mut packet.index);
        self.packets.push(packet);
    }

    /// Adds light samples in which no lane can be lit.
    #[inline(always)]
    pub(crate) fn push_unlit(&mut self) {
        self.samples.push(LightSamples {
            light: [[0.0; LANES]; 3],
            lit: 0,
        });
    }

    /// Adds samples of the BSDF, whose rays [`ShadowQueue::bsdf_rays`] holds. Returns their
    /// numbers.
    #[inline(always)]
    pub(crate) fn push_undecided<S: Simd>(&mut self, simd: S) -> f64x8<S> {
        let first = (self.samples.len() * LANES) as f64;
        self.push_unlit();
        f64x8::load_array(simd, LANE_NUMBERS) + first
    }

    /// Adds samples of emitter number `emitter`, whose `light` arrives in the lanes of `active`
    /// where nothing is in the way of `rays`, which cannot hit the primitives `skip`.
    #[inline(always)]
    pub(crate) fn push<S: Simd>(
        &mut self,
        emitter: usize,
        rays: &RayPacket<S>,
        skip: f64x8<S>,
        active: u64,
        light: Vec3x8<S>,
    ) {
        let simd = skip.simd;
        let first = (self.samples.len() * LANES) as f64;
        self.samples.push(LightSamples {
            light: store_vector(light),
            lit: active,
        });
        let mask = mask64x8::from_bitmask(simd, active);
        let sample = f64x8::load_array(simd, LANE_NUMBERS) + first;
        let queue = &mut self.rays[emitter];
        let start = queue.count;
        queue.reserve();
        store(&mut queue.o[0], start, rays.o.x, mask);
        store(&mut queue.o[1], start, rays.o.y, mask);
        store(&mut queue.o[2], start, rays.o.z, mask);
        store(&mut queue.d[0], start, rays.d.x, mask);
        store(&mut queue.d[1], start, rays.d.y, mask);
        store(&mut queue.d[2], start, rays.d.z, mask);
        store(&mut queue.max_t, start, rays.max_t, mask);
        store(&mut queue.skip, start, skip, mask);
        store(&mut queue.sample, start, sample, mask);
        queue.count += active.count_ones() as usize;
    }

    /// The first channel of the light of sample number `i`, and the lanes that it reaches.
    pub(crate) fn sample(&self, i: usize) -> (&[f64; LANES], u64) {
        (&self.samples[i].light[0], self.samples[i].lit)
    }

    /// Traces all shadow rays. If `are_coherent`, rays to one emitter are likely to be close to
    /// each other.
    #[inline(never)]
    #[expect(clippy::too_many_arguments, reason = "inlined where it is used")]
    pub(crate) fn trace<S: Simd>(
        &mut self,
        simd: S,
        scene: &PathScene<'_>,
        are_coherent: bool,
        nearby: &mut NearbyPrimitives,
        traced: &mut TracedRays,
        memory: &mut PathMemory,
        fallback: &mut dyn ScalarFallback,
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                for queue in &self.rays {
                    memory.counts.rays += queue.count as u64;
                    memory.counts.light_rays += queue.count as u64;
                    let chunk = if are_coherent {
                        BEAM_SIZE
                    } else {
                        queue.count.max(1)
                    };
                    for start in (0..queue.count).step_by(chunk) {
                        let bundle = queue.bundle(start, chunk);
                        let mut list = scene.list.as_ref();
                        if are_coherent {
                            list = nearby.find(simd, scene, &bundle, fallback).or(list);
                        }
                        let Some(list) = list else {
                            let (scratch, counts) = (&mut memory.scratch, &mut memory.counts);
                            let samples = &mut self.samples;
                            let block = |ray: usize| block(samples, queue.sample[start + ray]);
                            traced.occluded(simd, scene, &bundle, scratch, counts, fallback, block);
                            continue;
                        };
                        for first in (0..bundle.count).step_by(LANES) {
                            let active = bundle.active(first);
                            let (rays, skip) = bundle.packet(simd, first);
                            let scratch = &mut memory.scratch;
                            let (blocked, tests) =
                                list.occluded(simd, &rays, active, skip, scratch, fallback);
                            memory.counts.prim_tests += tests;
                            for lane in lanes(blocked) {
                                block(&mut self.samples, queue.sample[start + first + lane]);
                            }
                        }
                    }
                }
            },
        )
    }

    /// Traces all rays of BSDF samples.
    #[inline(never)]
    pub(crate) fn trace_bsdf<S: Simd>(
        &mut self,
        simd: S,
        scene: &PathScene<'_>,
        traced: &mut TracedRays,
        memory: &mut PathMemory,
        fallback: &mut dyn ScalarFallback,
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                let samples = &mut self.samples;
                let add = |sample: usize, light: Spectrum| {
                    let (packet, lane) = (&mut samples[sample / LANES], sample % LANES);
                    packet.lit |= 1 << lane;
                    for (field, channel) in packet.light.iter_mut().zip(light.to_array()) {
                        field[lane] = channel;
                    }
                };
                self.bsdf_rays
                    .trace(simd, scene, traced, memory, fallback, add);
            },
        )
    }

    /// Adds the light of all samples to `radiance`, in the order of the stage `direct`.
    #[inline(never)]
    pub(crate) fn add_light<S: Simd>(
        &self,
        simd: S,
        scene: &PathScene<'_>,
        settings: &PathSettings,
        radiance: &mut [Spectrum],
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                let black = Vec3x8::splat(simd, Vec3::ZERO);
                let mut samples = self.samples.iter();
                for packet in &self.packets {
                    let mut direct = black;
                    let of_lights = scene.lit.emitters.iter();
                    let of_bsdf = scene
                        .samples_bsdf(settings)
                        .then_some(settings.light_samples);
                    for count in of_lights
                        .map(|emitter| sample_count(emitter, settings))
                        .chain(of_bsdf)
                    {
                        let mut sum = black;
                        for sample in samples.by_ref().take(count as usize) {
                            let with_sample = sum + load_vector(simd, &sample.light);
                            sum = with_sample
                                .masked_or(mask64x8::from_bitmask(simd, sample.lit), sum);
                        }
                        direct = direct + sum / f64x8::splat(simd, f64::from(count.max(1)));
                    }
                    let light = load_vector(simd, &packet.throughput) * direct;
                    for lane in lanes(packet.diffuse) {
                        let light = Spectrum::from(light.lane(lane).to_array());
                        radiance[packet.index[lane] as usize] += light;
                    }
                }
            },
        )
    }
}

const LANE_NUMBERS: [f64; LANES] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

impl ShadowRays {
    /// Makes room for eight more rays.
    #[inline(always)]
    fn reserve(&mut self) {
        let size = (self.count / LANES + 2) * LANES;
        if self.max_t.len() < size {
            let fields = self.o.iter_mut().chain(&mut self.d);
            for field in fields.chain([&mut self.max_t, &mut self.skip, &mut self.sample]) {
                field.resize(2 * size, 0.0);
            }
        }
    }

    /// The rays from number `first`, at most `most`.
    #[inline(always)]
    fn bundle(&self, first: usize, most: usize) -> RayBundle<'_> {
        RayBundle {
            count: (self.count - first).min(most),
            o: self.o.each_ref().map(|o| &o[first..]),
            d: self.d.each_ref().map(|d| &d[first..]),
            min_t: 0.0,
            max_t: RangeEnds::Each(&self.max_t[first..]),
            skip: &self.skip[first..],
        }
    }
}

/// Removes the light of a sample: something is in its way.
#[inline(always)]
fn block(samples: &mut [LightSamples], sample: f64) {
    let sample = sample as usize;
    samples[sample / LANES].lit &= !(1 << (sample % LANES));
}

// Functions, because closures would not be compiled for the instruction set.

#[inline(always)]
fn store<S: Simd>(field: &mut [f64], first: usize, lanes: f64x8<S>, mask: mask64x8<S>) {
    lanes
        .compress(mask)
        .store_slice(&mut field[first..first + LANES]);
}

#[inline(always)]
fn load_vector<S: Simd>(simd: S, fields: &[[f64; LANES]; 3]) -> Vec3x8<S> {
    Vec3x8 {
        x: f64x8::load_array_ref(simd, &fields[0]),
        y: f64x8::load_array_ref(simd, &fields[1]),
        z: f64x8::load_array_ref(simd, &fields[2]),
    }
}

#[inline(always)]
fn store_vector<S: Simd>(v: Vec3x8<S>) -> [[f64; LANES]; 3] {
    let mut fields = [[0.0; LANES]; 3];
    v.x.store_array(&mut fields[0]);
    v.y.store_array(&mut fields[1]);
    v.z.store_array(&mut fields[2]);
    fields
}
