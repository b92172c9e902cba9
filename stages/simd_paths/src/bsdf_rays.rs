//! Multiple importance sampling: the rays of a bounce in directions that the BSDF has sampled, and
//! the light that they find.
//!
//! In a scene without a background such a ray finds light only if it hits a surface that emits. If
//! these are few, the rays are first tested against them alone, and only the rays that hit one are
//! traced through the scene: most rays miss the lamps.

use crate::beam::{RangeEnds, RayBundle};
use crate::columns::Columns;
use crate::intersection::{HitSource, TracedRays, closest};
use crate::lane_mask::lanes;
use crate::material_class::MaterialClass;
use crate::packet::PathPacket;
use crate::ray_packet::{HitPacket, RayPacket};
use crate::shadow_queue::ShadowQueue;
use crate::surface_packet::SurfacePacket;
use crate::vec3x8::{LANES, Vec3x8};
use crate::{PathMemory, PathScene, ScalarFallback};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{Emitter, PrimId, Spectrum, Vec3};
use lanes::diffuse::{DiffuseSample, on_same_side};
use lanes::frame::Frame;
use lanes::light::mesh_pdf;
use lanes::mis::power_heuristic;

/// The numbers of a ray: see [`BsdfRay`].
const COLUMNS: usize = 15;

/// The number of the column [`BsdfRay::skip`].
const SKIP: usize = 13;

/// The rays of a bounce that may find light.
#[derive(Clone, Debug, Default)]
pub(crate) struct BsdfRays(Columns<COLUMNS>);

/// Eight such rays.
struct BsdfRay<S: Simd> {
    /// The origins and directions of the rays.
    o: Vec3x8<S>,
    d: Vec3x8<S>,
    /// The point on the surface, before the step off it.
    p: Vec3x8<S>,
    /// The weight of the light along the ray, `f · cos θ / pdf`.
    weight: Vec3x8<S>,
    /// The density of the direction.
    pdf: f64x8<S>,
    /// The primitive that the ray leaves, or `NONE`.
    skip: f64x8<S>,
    /// The number of the sample in the [`ShadowQueue`].
    sample: f64x8<S>,
}

impl<S: Simd> PathPacket<'_, S> {
    /// Samples the BSDF of the surfaces in the lanes of `diffuse`, as often as each area light, and
    /// adds the rays that may find light.
    #[inline(never)]
    pub(crate) fn sample_bsdf(
        &mut self,
        surfaces: &SurfacePacket<S>,
        wo_z: f64x8<S>,
        diffuse: u64,
        memory: &mut PathMemory,
        shadows: &mut ShadowQueue,
        fallback: &dyn ScalarFallback,
    ) {
        self.simd.vectorize(
            #[inline(always)]
            || {
                let simd = self.simd;
                let mask = mask64x8::from_bitmask(simd, diffuse);
                let in_front = mask & wo_z.simd_ne(f64x8::splat(simd, 0.0));
                let wo_ng = self.wo_ng(surfaces);
                for _ in 0..self.settings.light_samples {
                    let DiffuseSample { wi, pdf, weight } = self.sample_diffuse(surfaces, wo_z);
                    let sample = shadows.push_undecided(simd);
                    let d = Frame::around(surfaces.n).to_world(wi);
                    let same_side = on_same_side(wo_ng, d.dot(surfaces.departure.ng));
                    let exists = (in_front & same_side).to_bitmask();
                    memory.counts.rays += u64::from(exists.count_ones());
                    memory.counts.light_rays += u64::from(exists.count_ones());
                    let (o, skip) = surfaces.leave(simd, d);
                    let mut open = exists;
                    if let Some(lamps) = &self.scene.lamps {
                        let rays = unlimited(simd, o, d);
                        let scratch = &mut memory.scratch;
                        let tests;
                        (open, tests) =
                            lamps.occluded(simd, &rays, exists, skip, scratch, fallback);
                        memory.counts.prim_tests += tests;
                    }
                    if open != 0 {
                        let rays = BsdfRay {
                            o,
                            d,
                            p: surfaces.departure.p,
                            weight,
                            pdf,
                            skip,
                            sample,
                        };
                        let mask = mask64x8::from_bitmask(simd, open);
                        shadows.bsdf_rays.0.push(rays.columns(), mask);
                    }
                }
            },
        )
    }
}

impl BsdfRays {
    /// Removes everything.
    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// Traces the rays and calls `add` with the number of a sample and the weighted light of each
    /// ray that finds light.
    #[inline(always)]
    pub(crate) fn trace<S: Simd>(
        &self,
        simd: S,
        scene: &PathScene<'_>,
        traced: &mut TracedRays,
        memory: &mut PathMemory,
        fallback: &mut dyn ScalarFallback,
        mut add: impl FnMut(usize, Spectrum),
    ) {
        if scene.list.is_none() && self.0.count() > 0 {
            let (scratch, counts) = (&mut memory.scratch, &mut memory.counts);
            traced.trace(simd, scene, &self.bundle(), scratch, counts, fallback);
        }
        for first in (0..self.0.count()).step_by(LANES) {
            let active = (1 << (self.0.count() - first).min(LANES)) - 1;
            let bsdf_rays = BsdfRay::of(self.0.load(simd, first));
            let rays = unlimited(simd, bsdf_rays.o, bsdf_rays.d);
            let source = match &scene.list {
                Some(list) => HitSource::List(list),
                None => HitSource::Found(traced, first),
            };
            let hits = closest(
                simd,
                source,
                &rays,
                active,
                bsdf_rays.skip,
                memory,
                fallback,
            );
            let hit = active & !hits.is_none().to_bitmask();
            let (light, lit) = bsdf_rays.emission(simd, scene, &rays, &hits, hit, fallback);
            let light = light * bsdf_rays.weight;
            for lane in lanes(lit) {
                let light = Spectrum::from(light.lane(lane).to_array());
                add(bsdf_rays.sample[lane] as usize, light);
            }
            if scene.has_background {
                let missed = active & !hit;
                memory.counts.background += u64::from(missed.count_ones());
                for lane in lanes(missed) {
                    let background = weighted_background(
                        scene,
                        bsdf_rays.p.lane(lane),
                        bsdf_rays.d.lane(lane),
                        bsdf_rays.pdf[lane],
                    );
                    let weight = Spectrum::from(bsdf_rays.weight.lane(lane).to_array());
                    add(bsdf_rays.sample[lane] as usize, background * weight);
                }
            }
        }
    }

    /// All rays.
    fn bundle(&self) -> RayBundle<'_> {
        let vector = |i: usize| [i, i + 1, i + 2].map(|i| self.0.column(i));
        RayBundle {
            count: self.0.count(),
            o: vector(0),
            d: vector(3),
            min_t: 0.0,
            max_t: RangeEnds::All(f64::INFINITY),
            skip: self.0.column(SKIP),
        }
    }
}

impl<S: Simd> BsdfRay<S> {
    #[inline(always)]
    fn columns(&self) -> [f64x8<S>; COLUMNS] {
        let BsdfRay {
            o, d, p, weight, ..
        } = self;
        [
            o.x,
            o.y,
            o.z,
            d.x,
            d.y,
            d.z,
            p.x,
            p.y,
            p.z,
            weight.x,
            weight.y,
            weight.z,
            self.pdf,
            self.skip,
            self.sample,
        ]
    }

    /// The rays with these [`BsdfRay::columns`].
    #[inline(always)]
    fn of(columns: [f64x8<S>; COLUMNS]) -> BsdfRay<S> {
        let vector = |i: usize| Vec3x8 {
            x: columns[i],
            y: columns[i + 1],
            z: columns[i + 2],
        };
        BsdfRay {
            o: vector(0),
            d: vector(3),
            p: vector(6),
            weight: vector(9),
            pdf: columns[12],
            skip: columns[SKIP],
            sample: columns[14],
        }
    }

    /// The emission at `hits` in the lanes of `hit`, with the weight against light sampling, and
    /// the lanes where there is any.
    #[inline(never)]
    fn emission(
        &self,
        simd: S,
        scene: &PathScene<'_>,
        rays: &RayPacket<S>,
        hits: &HitPacket<S>,
        hit: u64,
        fallback: &dyn ScalarFallback,
    ) -> (Vec3x8<S>, u64) {
        simd.vectorize(
            #[inline(always)]
            || {
                let ids: [usize; LANES] =
                    std::array::from_fn(|lane| hits.prim[lane].max(0.0) as usize);
                let mut emissive = 0;
                for lane in lanes(hit) {
                    let is_emissive = scene.material_of(ids[lane]).0 == MaterialClass::Emission;
                    emissive |= u64::from(is_emissive) << lane;
                }
                if emissive == 0 {
                    return (self.weight, 0);
                }
                let color = Vec3x8::gather(simd, |lane| scene.material_of(ids[lane]).1.to_array());
                let surfaces =
                    SurfacePacket::at(simd, scene, rays, hits, &ids, emissive, color, fallback);
                let ng = surfaces.departure.ng;
                let in_front = f64x8::splat(simd, 0.0).simd_lt((-self.d).dot(ng));
                let lit = emissive & in_front.to_bitmask();

                // The density of the emitter that a surface belongs to: 0 if it belongs to none.
                let mut areas = [0.0; LANES];
                let mut others = [0.0; LANES];
                let mut is_mesh = 0;
                for lane in lanes(lit) {
                    match scene.lit.emitter_of(PrimId(ids[lane] as u32)) {
                        Some(Emitter::Mesh(mesh)) => {
                            areas[lane] = mesh.area();
                            is_mesh |= 1 << lane;
                        }
                        Some(emitter) => {
                            let (p, d) = (self.p.lane(lane), self.d.lane(lane));
                            others[lane] = emitter.pdf(p, d, hits.t[lane], ng.lane(lane));
                        }
                        None => {}
                    }
                }
                let of_meshes = mesh_pdf(f64x8::load_array(simd, areas), self.d, hits.t, ng);
                let other = mask64x8::from_bitmask(simd, is_mesh)
                    .select(of_meshes, f64x8::load_array(simd, others));
                (surfaces.color * power_heuristic(self.pdf, other), lit)
            },
        )
    }
}

/// Rays without an end.
#[inline(always)]
fn unlimited<S: Simd>(simd: S, o: Vec3x8<S>, d: Vec3x8<S>) -> RayPacket<S> {
    RayPacket {
        o,
        d,
        min_t: f64x8::splat(simd, 0.0),
        max_t: f64x8::splat(simd, f64::INFINITY),
    }
}

/// The radiance of skies and environment maps along `d` from `p`, each with the weight of a sample
/// with the density `own` against its own density.
fn weighted_background(scene: &PathScene<'_>, p: Vec3, d: Vec3, own: f64) -> Spectrum {
    let mut sum = Spectrum::BLACK;
    for emitter in &scene.lit.emitters {
        let radiance = match emitter {
            Emitter::Sky { radiance } if d.y >= 0.0 => *radiance,
            Emitter::Environment(environment) => environment.radiance(d),
            _ => continue,
        };
        sum += radiance * power_heuristic(own, emitter.pdf(p, d, 0.0, Vec3::ZERO));
    }
    sum
}
