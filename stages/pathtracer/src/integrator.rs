//! Path tracing, one path at a time: the stages `direct` and `global`, connected to a scene.
//!
//! The context of a ray is passed as arguments: the [`RayOrigin`], which determines the primitive
//! to skip, and the [`Place`] of a surface: its texture colour and its sides.

use crate::clamp::clamp_indirect;
use crate::exact_sum::PixelSum;
use crate::materials::{Materials, PathMaterials, Place};
use crate::textures::Textures;
use crate::tracer::{RayOrigin, RayRole, RayTracer, SceneTracer};
use crate::{Accel, Counters, DirectSampling, LightSettings};
use direct::{
    estimate_direct_lighting_hemisphere, estimate_direct_lighting_importance,
    estimate_direct_lighting_mis, zero_bounce_radiance,
};
use global::{estimate_radiance, play_roulette};
use kit::effects::Effect;
use kit::shading_normal::{Sides, towards_viewer};
use kit::{
    Camera, Hit, LitScene, Material, PixelSampler, PrimId, Ray, Scattering, Spectrum, Surface,
    Tally, Texture, Vec3,
};
use std::cell::Cell;
use std::hint::black_box;

/// Traces the paths of one tile through a scene.
pub(crate) struct PathIntegrator<'a, T = SceneTracer<'a>> {
    pub(crate) lit: &'a LitScene,
    textures: &'a Textures,
    pub(crate) tracer: T,
    pub(crate) settings: &'a LightSettings,
    /// The numbers of rays and tests so far. In a cell, because several callbacks that are passed
    /// to one stage increment them.
    counters: Cell<Counters>,
    pub(crate) materials: Materials,
    /// The luminances of the samples of each finished pixel.
    pub(crate) luminance: Vec<Tally>,
    /// The samples of each finished pixel.
    pub(crate) sums: Vec<PixelSum>,
    /// What clamping has removed from the samples of the pixel in progress.
    pub(crate) removed: Cell<PixelSum>,
    /// The same of each finished pixel; empty without clamping.
    pub(crate) removed_sums: Vec<PixelSum>,
    /// The largest number of rays on a path; 0 in a scene without light.
    pub(crate) max_depth: u32,
    /// The number of directions that one estimate by hemisphere sampling traces.
    directions: u32,
    has_background: bool,
}

impl<'a> PathIntegrator<'a> {
    pub(crate) fn new(
        lit: &'a LitScene,
        textures: &'a Textures,
        accel: &'a Accel,
        settings: &'a LightSettings,
    ) -> PathIntegrator<'a> {
        let tracer = SceneTracer {
            scene: &lit.scene,
            accel,
        };
        PathIntegrator::with_tracer(lit, textures, tracer, settings)
    }
}

impl<'a, T: RayTracer> PathIntegrator<'a, T> {
    /// An integrator whose rays are traced by `tracer` in `lit.scene`.
    pub(crate) fn with_tracer(
        lit: &'a LitScene,
        textures: &'a Textures,
        tracer: T,
        settings: &'a LightSettings,
    ) -> PathIntegrator<'a, T> {
        let area_lights = lit.emitters.iter().filter(|e| !e.is_delta()).count() as u32;
        PathIntegrator {
            lit,
            textures,
            tracer,
            settings,
            counters: Cell::default(),
            materials: Materials::new(settings.force_effects, settings.soft_terminator),
            luminance: Vec::new(),
            sums: Vec::new(),
            removed: Cell::default(),
            removed_sums: Vec::new(),
            max_depth: if lit.has_light() || settings.force_effects {
                settings.max_depth
            } else {
                0
            },
            // As many as light sampling would use, as in the assignment's program.
            directions: area_lights * settings.light_samples,
            has_background: lit.has_background(),
        }
    }

    /// The numbers of rays and tests so far.
    pub(crate) fn counters(&self) -> Counters {
        self.counters.get()
    }

    /// Calls `count`, which may increment the counters. Calls must not be nested.
    #[inline]
    pub(crate) fn counting<R>(&self, count: impl FnOnce(&mut Counters) -> R) -> R {
        let mut counters = self.counters.get();
        let result = count(&mut counters);
        self.counters.set(counters);
        result
    }

    /// Returns `ray`, the ray of a pinhole camera, refracted by the lens if the camera has one.
    #[inline]
    pub(crate) fn through_lens(
        &self,
        camera: &Camera,
        ray: &Ray,
        sampler: &mut PixelSampler,
    ) -> Ray {
        let lens = &self.settings.lens;
        if lens.radius > 0.0 {
            self.materials.count(Effect::Lens);
            return lens.refract(camera, ray, sampler.next_2d());
        }
        if self.settings.force_effects {
            self.materials.count(Effect::Lens);
            // Draws from a copy of the sampler, so the picture's random numbers stay the same.
            return lens.refract(camera, ray, sampler.clone().next_2d());
        }
        *ray
    }

    /// The radiance that arrives along a camera ray.
    #[inline]
    pub(crate) fn radiance(&self, ray: &Ray, sampler: &mut PixelSampler) -> Spectrum {
        if self.max_depth <= 1 {
            return self.emission_and_direct(ray, sampler);
        }
        // The surface that the next ray starts on: `None` for the camera ray, then the last hit.
        let mut origin: Option<RayOrigin> = None;
        // The last hit. `estimate_radiance` passes the material of a surface to its callbacks, but
        // neither texture coordinates nor normals, so they share this cell.
        let place = Cell::new(Place::PLAIN);
        // The throughput, and the light of the first surface that scatters light. Mirrors and
        // smooth glass before it emit nothing.
        let throughput = Cell::new(Spectrum::WHITE);
        let direct = Cell::new(None);
        let radiance = estimate_radiance(
            self.lit,
            ray,
            self.max_depth,
            sampler,
            &PathMaterials {
                materials: &self.materials,
                place: &place,
            },
            &mut |ray| {
                let role = RayRole::of_path(origin.is_some());
                let found = self.closest(role, ray, self.skip(origin, ray))?;
                let hit = towards_viewer(self.lit, found, ray.d);
                origin = Some(RayOrigin::from(&hit));
                place.set(self.place(&hit, &self.lit.surface(&hit)));
                Some(hit)
            },
            &mut |surface, wo, sampler| {
                let light = self.direct(surface, place.get(), wo, sampler);
                // Lamps scatter nothing: their own light is direct.
                if !matches!(surface.material, Material::Emission { .. }) {
                    direct.set(direct.get().or(Some(throughput.get() * light)));
                }
                light
            },
            &mut |weight, bounces, u| {
                let survivor = self.roulette(weight, bounces, u)?;
                throughput.set(survivor);
                Some(survivor)
            },
        );
        match self.settings.clamp {
            Some(limit) => clamp_indirect(limit, radiance, direct.get(), &self.removed),
            None => radiance,
        }
    }

    /// Russian roulette, unless it is switched off.
    #[inline]
    pub(crate) fn roulette(&self, throughput: Spectrum, bounces: u32, u: f64) -> Option<Spectrum> {
        self.materials.count(Effect::Bounces);
        if !self.settings.roulette {
            return Some(throughput);
        }
        let factor = f64::from(self.settings.roulette_factor);
        let survivor = play_roulette(throughput * factor, bounces, u).map(|t| t / factor);
        self.tracer.roulette_played(throughput, survivor);
        survivor
    }

    /// Emission and direct light at the first hit. Needs the stage `direct`, but not `global`.
    fn emission_and_direct(&self, ray: &Ray, sampler: &mut PixelSampler) -> Spectrum {
        let Some(hit) = self.closest(RayRole::Camera, ray, None) else {
            return self.lit.background(ray.d);
        };
        let hit = towards_viewer(self.lit, hit, ray.d);
        let surface = self.lit.surface(&hit);
        let place = self.place(&hit, &surface);
        let wo = -ray.d;
        let mut radiance = zero_bounce_radiance(&surface, wo);
        if self.max_depth > 0 {
            radiance += self.direct(&surface, place, wo, sampler);
        }
        if self.settings.force_effects {
            self.force_bounce(&surface, place, wo, sampler.clone());
        }
        radiance
    }

    /// Estimates direct light and traces one bounce only to count the operations: the results are
    /// discarded.
    fn force_bounce(
        &self,
        surface: &Surface<'_>,
        place: Place,
        wo: Vec3,
        mut sampler: PixelSampler,
    ) {
        if self.max_depth == 0 {
            black_box(self.direct(surface, place, wo, &mut sampler));
        }
        self.materials.count(Effect::Bounces);
        let (u, choice) = (sampler.next_2d(), sampler.next_1d());
        let wo = surface.frame.to_local(wo);
        let materials = self.materials.at(place);
        if let Some(sample) = materials.sample(surface.material, wo, u, choice) {
            let ray = surface.leave(surface.frame.to_world(sample.wi));
            let skip = self.skip(Some(surface.into()), &ray);
            black_box(self.closest(RayRole::Bounce, &ray, skip));
        }
    }

    /// What the material at a hit depends on. `surface` is the surface there.
    #[inline]
    pub(crate) fn place(&self, hit: &Hit, surface: &Surface<'_>) -> Place {
        Place {
            tint: self.texture_color(hit),
            sides: Sides::of(surface),
        }
    }

    /// The colour of the texture where a surface was hit. White if it has no texture, or if no
    /// light is computed (`max_depth` is 0).
    #[inline]
    pub(crate) fn texture_color(&self, hit: &Hit) -> Spectrum {
        if self.textures.is_empty() || self.max_depth == 0 {
            if self.settings.force_effects {
                self.materials.count(Effect::Texture);
                black_box(Texture::uniform(Spectrum::WHITE).at(hit.uv));
            }
            return Spectrum::WHITE;
        }
        let Some(color) = self.textures.at(&self.lit.scene, hit) else {
            return Spectrum::WHITE;
        };
        self.materials.count(Effect::Texture);
        color
    }

    /// The primitive that `ray`, which starts at `origin`, cannot hit; `None` for a camera ray.
    #[inline]
    pub(crate) fn skip(&self, origin: Option<RayOrigin>, ray: &Ray) -> Option<PrimId> {
        origin?.skip(&self.lit.scene, ray.d)
    }

    #[inline]
    fn closest(&self, role: RayRole, ray: &Ray, skip: Option<PrimId>) -> Option<Hit> {
        let hit = self.counting(|counters| {
            counters.rays += 1;
            self.tracer.closest(role, ray, skip, counters)
        });
        if hit.is_none() && (self.has_background || self.settings.force_effects) {
            self.materials.count(Effect::Background);
        }
        hit
    }

    #[inline]
    fn occluded(&self, ray: &Ray, skip: Option<PrimId>) -> bool {
        self.counting(|counters| {
            counters.rays += 1;
            self.tracer.occluded(ray, skip, counters)
        })
    }

    /// Estimates the direct light that `surface` sends along `wo`.
    #[inline]
    pub(crate) fn direct(
        &self,
        surface: &Surface<'_>,
        place: Place,
        wo: Vec3,
        sampler: &mut PixelSampler,
    ) -> Spectrum {
        let origin = Some(RayOrigin::from(surface));
        if !self.lit.has_light() {
            if self.settings.force_effects {
                self.materials.count(Effect::DirectLight);
                let ray = surface.leave(surface.ng);
                black_box(self.occluded(&ray, self.skip(origin, &ray)));
            }
            return Spectrum::BLACK;
        }
        let samples = self.settings.light_samples;
        let (lit, materials) = (self.lit, &self.materials.at(place));
        let trace = &mut |ray: &Ray| {
            self.materials.count(Effect::DirectLight);
            self.closest(RayRole::Light, ray, self.skip(origin, ray))
        };
        let occluded = &mut |ray: &Ray| {
            self.materials.count(Effect::DirectLight);
            self.occluded(ray, self.skip(origin, ray))
        };
        // Hemisphere sampling covers only one side of the surface, but rough glass scatters light
        // from both.
        let sampling = match self.settings.direct_sampling {
            DirectSampling::Hemisphere if surface.material.lets_light_through() => {
                DirectSampling::Lights
            }
            sampling => sampling,
        };
        match sampling {
            DirectSampling::Lights => estimate_direct_lighting_importance(
                lit, surface, wo, samples, sampler, materials, occluded,
            ),
            DirectSampling::Hemisphere => estimate_direct_lighting_hemisphere(
                lit,
                surface,
                wo,
                self.directions,
                sampler,
                materials,
                trace,
            ),
            DirectSampling::Mis => estimate_direct_lighting_mis(
                lit, surface, wo, samples, sampler, materials, trace, occluded,
            ),
        }
    }
}
