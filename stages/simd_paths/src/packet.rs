//! One bounce of eight paths, as the stage `global` computes it.

use crate::intersection::HitSource;
use crate::lane_mask::lanes;
use crate::material_class::MaterialClass;
use crate::queue::PathLanes;
use crate::ray_packet::RayPacket;
use crate::shadow_queue::ShadowQueue;
use crate::surface_packet::SurfacePacket;
use crate::vec3x8::{LANES, Vec3x8};
use crate::{PathMemory, PathScene, PathSettings, ScalarFallback, intersection};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::sampler::PixelSamplers;
use kit::{Spectrum, Vec3};
use std::mem;

/// For fewer paths at mirrors and glass the scalar fallback takes less time than the lanes.
const MIN_SPECULAR: u32 = 3;

/// Eight paths that are traced together.
pub(crate) struct PathPacket<'a, S: Simd> {
    pub(crate) simd: S,
    pub(crate) scene: &'a PathScene<'a>,
    pub(crate) settings: &'a PathSettings,
    /// Where the hits of their rays come from.
    pub(crate) hits: HitSource<'a>,
    /// The lanes that hold a path, one bit each.
    pub(crate) alive: u64,
    /// Whether they end at surfaces that are neither a mirror nor smooth glass: caustic rays do.
    pub(crate) are_caustic: bool,
    pub(crate) paths: PathLanes<S>,
    pub(crate) samplers: PixelSamplers<LANES>,
}

impl<S: Simd> PathPacket<'_, S> {
    /// Traces ray number `bounce` of each path, counted from 1, in `range`; adds the radiance at
    /// its hit to `radiance`, except the direct light at diffuse surfaces, whose shadow rays it
    /// adds to `shadows`; and samples the next ray. Returns the lanes whose paths continue.
    #[inline(never)]
    pub(crate) fn bounce(
        &mut self,
        bounce: u32,
        range: [f64; 2],
        memory: &mut PathMemory,
        shadows: &mut ShadowQueue,
        fallback: &mut dyn ScalarFallback,
        radiance: &mut [Spectrum],
    ) -> u64 {
        self.simd.vectorize(
            #[inline(always)]
            || {
                let simd = self.simd;
                let zero = f64x8::splat(simd, 0.0);
                let rays = RayPacket {
                    o: self.paths.o,
                    d: self.paths.d,
                    min_t: f64x8::splat(simd, range[0]),
                    max_t: f64x8::splat(simd, range[1]),
                };
                memory.counts.rays += u64::from(self.alive.count_ones());
                let (alive, skip) = (self.alive, self.paths.skip);
                let hits =
                    intersection::closest(simd, self.hits, &rays, alive, skip, memory, fallback);
                let hit = self.alive & !hits.is_none().to_bitmask();
                if self.scene.has_background && hit != self.alive {
                    self.add_background(self.alive & !hit, memory, radiance);
                }
                if hit == 0 {
                    return 0;
                }
                let ids: [usize; LANES] =
                    std::array::from_fn(|lane| hits.prim[lane].max(0.0) as usize);
                let materials = std::array::from_fn(|lane| self.scene.material_of(ids[lane]));
                let [mut diffuse, emissive, mut specular, mut other] =
                    lanes_by_class(&materials, hit);
                if self.are_caustic {
                    (diffuse, other) = (0, 0);
                }
                if specular.count_ones() < MIN_SPECULAR {
                    other |= mem::take(&mut specular);
                }
                let color = Vec3x8::gather(simd, |lane| materials[lane].1.to_array());
                let mut surfaces =
                    SurfacePacket::at(simd, self.scene, &rays, &hits, &ids, hit, color, fallback);
                if self.settings.has_textures {
                    // A texture changes only diffuse surfaces, but it is looked up on every surface.
                    for lane in lanes(diffuse | emissive | specular) {
                        let tint = fallback.texture_color(&surfaces.hit(lane, &hits));
                        if diffuse >> lane & 1 == 1 {
                            let color = surfaces.color.lane(lane) * Vec3::from(tint.to_array());
                            surfaces.color.set(lane, color.to_array());
                        }
                    }
                }
                // Before the other lanes draw random numbers: these paths draw their own.
                let scattered = (other != 0).then(|| {
                    self.scatter_others(other, bounce, &surfaces, &hits, fallback, radiance)
                });
                let by_mirrors = (specular != 0 && bounce < self.settings.max_depth)
                    .then(|| self.scatter_specular(bounce, &surfaces, &ids, specular, memory));
                let wo = -self.paths.d;
                let mut first = 0;
                if self.settings.reuses_paths && !self.are_caustic {
                    first = self.keep_vertices(bounce, &surfaces, hit, diffuse, memory);
                }
                if emissive != 0 {
                    let counts = zero.simd_lt(self.paths.emission_counts);
                    let in_front = zero.simd_lt(wo.dot(surfaces.departure.ng));
                    let visible = mask64x8::from_bitmask(simd, emissive) & counts & in_front;
                    let light = self.paths.throughput * surfaces.color * self.paths.emission_counts;
                    for lane in lanes(visible.to_bitmask()) {
                        self.add(lane, light.lane(lane), radiance);
                    }
                }
                let mut survivors = 0;
                if diffuse != 0 {
                    let wo_z = wo.dot(surfaces.n);
                    shadows.push_packet(self.paths.throughput, self.paths.index, diffuse);
                    self.sample_lights(&surfaces, wo_z, diffuse, shadows);
                    if self.scene.samples_bsdf(self.settings) {
                        self.sample_bsdf(&surfaces, wo_z, diffuse, memory, shadows, fallback);
                    }
                    if bounce + 1 < self.settings.max_depth {
                        self.send_caustic_rays(&surfaces, wo_z, diffuse, memory);
                    }
                    if bounce < self.settings.max_depth {
                        survivors = self.scatter(bounce, &surfaces, wo_z, diffuse, memory);
                        self.keep_throughputs(first, memory);
                    }
                }
                if let Some(scattered) = by_mirrors {
                    survivors |= self.merge_specular(&surfaces, &scattered);
                }
                survivors | scattered.map_or(0, |scattered| self.merge(scattered))
            },
        )
    }

    /// Adds the background to the lanes in `missed`, unless direct light has counted it.
    fn add_background(&self, missed: u64, memory: &mut PathMemory, radiance: &mut [Spectrum]) {
        memory.counts.background += u64::from(missed.count_ones());
        for lane in lanes(missed).filter(|&lane| self.paths.emission_counts[lane] > 0.0) {
            let light = self.scene.lit.background(self.paths.d.lane(lane));
            let throughput = self.paths.throughput.lane(lane) * self.paths.emission_counts[lane];
            self.add(lane, throughput * Vec3::from(light.to_array()), radiance);
        }
    }

    /// Adds `light` to the radiance of the path in a lane.
    #[inline(always)]
    fn add(&self, lane: usize, light: Vec3, radiance: &mut [Spectrum]) {
        radiance[self.paths.index[lane] as usize] += Spectrum::from(light.to_array());
    }
}

/// The lanes in `hit` by the class of their material: diffuse, emission, specular, other.
#[inline(always)]
fn lanes_by_class(materials: &[(MaterialClass, Spectrum); LANES], hit: u64) -> [u64; 4] {
    let mut masks = [0; 4];
    for (lane, &(class, _)) in materials.iter().enumerate() {
        masks[0] |= u64::from(class == MaterialClass::Diffuse) << lane;
        masks[1] |= u64::from(class == MaterialClass::Emission) << lane;
        masks[2] |= u64::from(class == MaterialClass::Specular) << lane;
        masks[3] |= u64::from(class == MaterialClass::Other) << lane;
    }
    for mask in &mut masks {
        *mask &= hit;
    }
    masks
}
