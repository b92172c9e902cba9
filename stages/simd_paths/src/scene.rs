//! A scene prepared for tracing paths in packets.

// BEGIN SOLUTION(part6.task2)
use crate::camera::{self, CameraPaths};
use crate::intersection::TracedRays;
use crate::large::LargePrimitives;
use crate::material_class::{MaterialClass, classify};
use crate::primitive_list::{NearbyPrimitives, PrimitiveList, Scratch};
use crate::queue::PathQueue;
use crate::reuse::{self, Link};
use crate::shadow_queue::ShadowQueue;
use crate::specular::SpecularMaterial;
use crate::trace;
use crate::visible::VisiblePixels;
use kit::{Material, Triangle};
use lanes::dispatch;
use std::mem;
// END SOLUTION(part6.task2)

use crate::{CausticGuide, Level, ScalarFallback};
use kit::{Camera, FilmSize, LitScene, PixelSampler, PrimId, Spectrum};

/// A scene prepared for tracing paths in packets.
#[derive(Clone, Debug)]
pub struct PathScene<'a> {
    /// The scene.
    pub lit: &'a LitScene,
    // BEGIN SOLUTION(part6.task2)
    /// The class and the colour of each material.
    pub(crate) materials: Vec<(MaterialClass, Spectrum)>,
    /// The parameters of each material that is specular.
    specular: Vec<Option<SpecularMaterial>>,
    /// The primitives, if there are few; else the fallback traverses a tree.
    pub(crate) list: Option<PrimitiveList>,
    /// The primitives that the fallback need not find; none in a scene that has a list.
    pub(crate) large: Option<LargePrimitives>,
    /// The primitives that emit, if they are few and there is no background: only rays that hit one
    /// of them find light.
    pub(crate) lamps: Option<PrimitiveList>,
    /// Whether there is a light that a ray in a random direction can hit.
    has_extended_lights: bool,
    pub(crate) has_background: bool,
    /// Whether every triangle has the same normal at its three vertices.
    pub(crate) is_faceted: bool,
    /// Where caustic rays are sent.
    pub(crate) guide: Option<&'a CausticGuide>,
    level: Level,
    // STUB: // Add the fields that you need.
    // END SOLUTION(part6.task2)
}

/// How paths are traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathSettings {
    /// Samples per area light (`-l`).
    pub light_samples: u32,
    /// The largest number of rays on a path (`-m`), at least 1.
    pub max_depth: u32,
    /// Whether surfaces have textures, which the fallback looks up.
    pub has_textures: bool,
    /// Whether direct light samples the lights and the BSDF (`--mis`); else the lights only.
    pub samples_bsdf: bool,
    /// Bounces after which Russian roulette starts; `None` switches it off.
    pub min_bounces: Option<u32>,
    /// What roulette multiplies throughputs by, and divides those of survivors by.
    pub roulette_factor: u32,
    /// Whether the BSDF of diffuse surfaces has the factor
    /// [`Sides::terminator`](kit::shading_normal::Sides::terminator).
    pub soft_terminator: bool,
    /// Whether [`PathMemory::direct`] is set.
    pub keeps_direct: bool,
    /// Whether each eight pixels that start one after the other share what their paths find.
    /// Single samples are then not those of the stages; the mean of many is. Needs `keeps_direct`.
    pub reuses_paths: bool,
}

/// The camera and the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The camera.
    pub camera: Camera,
    /// The size of the whole film.
    pub film: FilmSize,
    /// Whether the camera has a lens, which the fallback sends the rays through.
    pub has_lens: bool,
    /// Whether camera rays go through the centre of the pixel; else the sampler chooses the point.
    pub centered: bool,
}

/// A pixel, in which paths start.
#[derive(Clone, Debug, PartialEq)]
pub struct PathStart {
    /// Column and row of the pixel.
    pub pixel: (u32, u32),
    /// The sampler, which has started none of the samples that are traced next.
    pub sampler: PixelSampler,
}

/// How many operations of each kind there were. Rays that the fallback traced for
/// [`ScalarFallback::closest`] and [`ScalarFallback::occluded`] are included, but not their tests,
/// nor what [`ScalarFallback::scatter`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Rays traced.
    pub rays: u64,
    /// Shadow rays among them.
    pub light_rays: u64,
    /// Those between the surfaces of different paths.
    pub reuse_rays: u64,
    /// Rays that missed everything in a scene with a background.
    pub background: u64,
    /// Bounces.
    pub bounces: u64,
    /// Bounces at mirrors.
    pub mirrors: u64,
    /// Bounces at surfaces that only refract.
    pub refractions: u64,
    /// Bounces at glass, which reflects and refracts.
    pub fresnel: u64,
    /// Ray/primitive tests.
    pub prim_tests: u64,
}

/// The number of paths that are traced together, in packets of eight. Multiples of it waste the
/// fewest lanes.
pub const BATCH_SIZE: usize = 256;

/// The memory that a thread reuses from batch to batch.
#[derive(Clone, Debug, Default)]
pub struct PathMemory {
    // BEGIN SOLUTION(part6.task2)
    pub(crate) queue: PathQueue,
    /// The paths through mirrors and glass that `queue` has started.
    pub(crate) caustics: PathQueue,
    pub(crate) scratch: Scratch,
    pub(crate) nearby: NearbyPrimitives,
    pub(crate) shadows: ShadowQueue,
    pub(crate) traced: TracedRays,
    pub(crate) visible: VisiblePixels,
    pub(crate) links: Vec<Link>,
    // END SOLUTION(part6.task2)
    /// The radiance of each path of the last call, in the order of its results, up to and including
    /// its first surface that is neither a mirror nor smooth glass, if a ray leaves this surface.
    pub direct: Vec<Option<Spectrum>>,
    /// The operations so far.
    pub counts: Counts,
}

impl<'a> PathScene<'a> {
    /// Prepares `lit`. The packets test the primitives `apart` themselves, which are in ascending
    /// order, and the fallback only has to find the others. Returns `None` if packets are not
    /// implemented.
    pub fn new(lit: &'a LitScene, apart: &[PrimId]) -> Option<PathScene<'a>> {
        // BEGIN SOLUTION(part6.task2)
        let scene = &lit.scene;
        let materials = scene.materials.iter().map(|m| &m.material);
        let list = PrimitiveList::of(scene, |_| true);
        Some(PathScene {
            materials: materials.clone().map(classify).collect(),
            specular: materials.map(SpecularMaterial::of).collect(),
            large: LargePrimitives::new(scene, apart).filter(|_| list.is_none()),
            list,
            lamps: if lit.has_background() {
                None
            } else {
                let emits = |id| matches!(scene.material_of(id), Material::Emission { .. });
                PrimitiveList::of(scene, emits)
            },
            has_extended_lights: lit.emitters.iter().any(|emitter| !emitter.is_delta()),
            has_background: lit.has_background(),
            is_faceted: scene.triangles.iter().all(is_faceted),
            guide: None,
            level: Level::new(),
            lit,
        })
        // STUB: kit::untouched!("part6.task2");
        // STUB: let _ = (lit, apart);
        // STUB: None
        // END SOLUTION(part6.task2)
    }

    // BEGIN SOLUTION(part6.task2)
    /// The class and the colour of the material of primitive number `id`.
    #[inline(always)]
    pub(crate) fn material_of(&self, id: usize) -> (MaterialClass, Spectrum) {
        self.materials[self.lit.scene.material_number(PrimId(id as u32))]
    }

    /// The parameters of the material of primitive number `id`, if it is specular.
    #[inline(always)]
    pub(crate) fn specular_of(&self, id: usize) -> Option<&SpecularMaterial> {
        self.specular[self.lit.scene.material_number(PrimId(id as u32))].as_ref()
    }

    /// Whether direct light samples the BSDF.
    #[inline(always)]
    pub(crate) fn samples_bsdf(&self, settings: &PathSettings) -> bool {
        settings.samples_bsdf && self.has_extended_lights
    }
    // END SOLUTION(part6.task2)

    /// The same scene for the instruction set `level` instead of the best one of this machine. The
    /// results are the same.
    #[must_use]
    pub fn at_level(self, level: Level) -> PathScene<'a> {
        // BEGIN SOLUTION(part6.task2)
        PathScene { level, ..self }
        // STUB: kit::hole!("part6.task2", self, level)
        // END SOLUTION(part6.task2)
    }

    /// The same scene with caustic rays, which are sent where `guide` says. Single samples are then
    /// not those of the stages; the mean of many is. For materials without a soft terminator.
    #[must_use]
    pub fn guided(self, guide: Option<&'a CausticGuide>) -> PathScene<'a> {
        // BEGIN SOLUTION(part6.task2)
        PathScene { guide, ..self }
        // STUB: kit::hole!("part6.task2", self, guide)
        // END SOLUTION(part6.task2)
    }

    /// Traces paths through the pixels `starts`, the next `samples` of each, and returns their
    /// radiances, those of the first pixel first: bit for bit what `raygen` and `global` compute
    /// one path at a time, with direct light by light sampling or, with
    /// [`PathSettings::samples_bsdf`], by multiple importance sampling.
    pub fn trace(
        &self,
        view: &View,
        settings: &PathSettings,
        starts: &[PathStart],
        samples: u32,
        memory: &mut PathMemory,
        fallback: &mut dyn ScalarFallback,
    ) -> Vec<Spectrum> {
        // BEGIN SOLUTION(part6.task2)
        let samples = samples as usize;
        let mut radiance = vec![Spectrum::BLACK; starts.len() * samples];
        memory.direct.clear();
        if settings.keeps_direct {
            memory.direct.resize(radiance.len(), None);
        }
        memory.links.clear();
        if settings.reuses_paths {
            memory.links.resize(radiance.len(), Link::default());
        }
        dispatch!(self.level, simd => {
            let mut visible = mem::take(&mut memory.visible);
            visible.find(simd, self, view, starts, samples, memory, fallback);
            let paths = CameraPaths {
                starts,
                pixels: visible.pixels(),
                samples,
            };
            for first in (0..paths.pixels.len() * samples).step_by(BATCH_SIZE) {
                camera::generate_paths(simd, view, paths, first, &mut memory.queue, fallback);
                trace::trace_paths(simd, self, settings, view, memory, fallback, &mut radiance);
            }
            memory.visible = visible;
            if settings.reuses_paths {
                reuse::share(simd, self, samples, memory, fallback, &mut radiance);
            }
        });
        radiance
        // STUB: kit::hole!("part6.task2", self, view, settings, starts, samples, memory, fallback)
        // END SOLUTION(part6.task2)
    }
}

// BEGIN SOLUTION(part6.task2)
/// Whether the three vertices have the same normal, down to the sign of a 0.
fn is_faceted(t: &Triangle) -> bool {
    let [n0, n1, n2] = [t.n0, t.n1, t.n2].map(|n| n.to_array().map(f64::to_bits));
    n0 == n1 && n0 == n2
}
// END SOLUTION(part6.task2)
