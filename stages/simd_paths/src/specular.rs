//! Mirrors and smooth glass.

use crate::PathMemory;
use crate::lane_mask::lanes;
use crate::packet::PathPacket;
use crate::samplers::{next_1d, next_2d};
use crate::surface_packet::SurfacePacket;
use crate::vec3x8::{LANES, Vec3x8};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::sampler::PixelSamplers;
use kit::{Material, Spectrum};
use lanes::diffuse::on_same_side;
use lanes::frame::Frame;
use std::mem;

/// A material that scatters light into one or two directions only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SpecularMaterial {
    reflectance: Spectrum,
    transmittance: Spectrum,
    ior: f64,
    reflection: Reflection,
}

/// How much light is reflected; the rest is refracted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Reflection {
    All,
    None,
    Fresnel,
}

impl SpecularMaterial {
    /// `None` for other materials.
    pub(crate) fn of(material: &Material) -> Option<SpecularMaterial> {
        if !material.is_delta() {
            return None;
        }
        let black = Spectrum::BLACK;
        let (reflectance, transmittance, ior, reflection) = match *material {
            Material::Mirror { reflectance } => (reflectance, black, 1.0, Reflection::All),
            Material::Refraction {
                transmittance, ior, ..
            } => (black, transmittance, ior, Reflection::None),
            Material::Glass {
                reflectance,
                transmittance,
                ior,
                ..
            } => (reflectance, transmittance, ior, Reflection::Fresnel),
            _ => return None,
        };
        Some(SpecularMaterial {
            reflectance,
            transmittance,
            ior,
            reflection,
        })
    }
}

/// The specular paths of a packet after a bounce.
pub(crate) struct SpecularScatter<S: Simd> {
    samplers: PixelSamplers<LANES>,
    wi: Vec3x8<S>,
    throughput: Vec3x8<S>,
    survivors: u64,
}

impl<S: Simd> PathPacket<'_, S> {
    /// Samples the next ray of the paths in the lanes of `specular`, which have hit the primitives
    /// `ids`. The other lanes draw no random numbers.
    #[inline(never)]
    pub(crate) fn scatter_specular(
        &mut self,
        bounce: u32,
        surfaces: &SurfacePacket<S>,
        ids: &[usize; LANES],
        specular: u64,
        memory: &mut PathMemory,
    ) -> SpecularScatter<S> {
        self.simd.vectorize(
            #[inline(always)]
            || {
                let simd = self.simd;
                let of_others = self.samplers.clone();
                // Rough surfaces use these numbers.
                next_2d(simd, &mut self.samplers);
                let choice = next_1d(simd, &mut self.samplers);
                // Lanes of other materials compute something that is not used.
                let mut materials = [NO_MATERIAL; LANES];
                for lane in 0..LANES {
                    if let Some(material) = self.scene.specular_of(ids[lane]) {
                        materials[lane] = *material;
                    }
                    let counted = u64::from(specular >> lane & 1 == 1);
                    match materials[lane].reflection {
                        Reflection::All => memory.counts.mirrors += counted,
                        Reflection::None => memory.counts.refractions += counted,
                        Reflection::Fresnel => memory.counts.fresnel += counted,
                    }
                }
                let frame = Frame::around(surfaces.n);
                let wo = frame.to_local(-self.paths.d);
                let sample = in_lanes(simd, &materials).sample(wo, choice);
                let wi = frame.to_world(sample.wi);
                // A mirror reflects nothing to the other side of the surface.
                let mut is_mirror = 0;
                for (lane, material) in materials.iter().enumerate() {
                    is_mirror |= u64::from(material.reflection == Reflection::All) << lane;
                }
                let same_side = on_same_side(self.wo_ng(surfaces), wi.dot(surfaces.departure.ng));
                let continues = mask64x8::from_bitmask(simd, specular)
                    & sample.exists
                    & (same_side | !mask64x8::from_bitmask(simd, is_mirror));
                memory.counts.bounces += u64::from(continues.to_bitmask().count_ones());
                let (throughput, survivors) =
                    self.roulette(bounce, self.paths.throughput * sample.weight);
                SpecularScatter {
                    samplers: mem::replace(&mut self.samplers, of_others),
                    wi,
                    throughput,
                    survivors: (continues & survivors).to_bitmask(),
                }
            },
        )
    }

    /// Stores the specular paths in their lanes. Returns the lanes whose paths continue.
    #[inline(never)]
    pub(crate) fn merge_specular(
        &mut self,
        surfaces: &SurfacePacket<S>,
        scattered: &SpecularScatter<S>,
    ) -> u64 {
        self.simd.vectorize(
            #[inline(always)]
            || {
                let simd = self.simd;
                let mask = mask64x8::from_bitmask(simd, scattered.survivors);
                for lane in lanes(scattered.survivors) {
                    self.paths.emission_counts[lane] = self.emission_behind(lane);
                }
                let (o, skip) = surfaces.leave(simd, scattered.wi);
                self.paths.o = o.masked_or(mask, self.paths.o);
                self.paths.d = scattered.wi.masked_or(mask, self.paths.d);
                self.paths.skip = mask.select(skip, self.paths.skip);
                self.paths.throughput = scattered.throughput.masked_or(mask, self.paths.throughput);
                for lane in lanes(scattered.survivors) {
                    self.samplers.set(lane, &scattered.samplers.get(lane));
                }
                scattered.survivors
            },
        )
    }
}

/// What lanes of other materials compute with.
const NO_MATERIAL: SpecularMaterial = SpecularMaterial {
    reflectance: Spectrum::BLACK,
    transmittance: Spectrum::BLACK,
    ior: 1.0,
    reflection: Reflection::All,
};

/// The materials of eight lanes.
#[inline(always)]
fn in_lanes<S: Simd>(
    simd: S,
    materials: &[SpecularMaterial; LANES],
) -> lanes::specular::SpecularMaterial<f64x8<S>> {
    let mirrors = f64x8::from_fn(simd, |lane| match materials[lane].reflection {
        Reflection::None => 0.0,
        Reflection::All => 1.0,
        Reflection::Fresnel => 2.0,
    });
    lanes::specular::SpecularMaterial {
        reflectance: Vec3x8::gather(simd, |lane| materials[lane].reflectance.to_array()),
        transmittance: Vec3x8::gather(simd, |lane| materials[lane].transmittance.to_array()),
        ior: f64x8::from_fn(simd, |lane| materials[lane].ior),
        has_fresnel: f64x8::splat(simd, 1.0).simd_lt(mirrors),
        mirrors,
    }
}
