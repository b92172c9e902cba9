//! What a thread needs to follow light through a scene, one path at a time.

use crate::materials::Materials;
use crate::textures::Textures;
use crate::{Accel, LightSettings, Looking, SceneWorld};
use direct::{
    estimate_direct_lighting_hemisphere, estimate_direct_lighting_importance,
    estimate_direct_lighting_mis, zero_bounce_radiance,
};
use global::{estimate_radiance, play_roulette};
use kit::effects::Effect;
use kit::{
    Camera, Hit, LitScene, PixelSampler, PrimId, Ray, Scattering, Spectrum, Surface, Tally,
    Texture, Vec3,
};
use std::cell::{Cell, RefCell};
use std::hint::black_box;

/// What a thread needs to follow light through a scene.
pub(crate) struct Walk<'a> {
    pub(crate) lit: &'a LitScene,
    textures: &'a Textures,
    accel: &'a Accel,
    settings: &'a LightSettings,
    pub(crate) world: RefCell<SceneWorld<'a>>,
    pub(crate) materials: Materials,
    /// Pixels that are done, and the luminances of their samples.
    pub(crate) luminance: Vec<((u32, u32), Tally)>,
    /// Rays on a path at most. In the dark the first one says all.
    pub(crate) max_depth: u32,
    /// Directions for a hemisphere estimate.
    directions: u32,
    has_background: bool,
    /// Where the ray at hand starts: the primitive, and its geometric normal.
    at: Cell<Option<(PrimId, Vec3)>>,
}

impl<'a> Walk<'a> {
    pub(crate) fn new(
        lit: &'a LitScene,
        textures: &'a Textures,
        accel: &'a Accel,
        settings: &'a LightSettings,
    ) -> Walk<'a> {
        let with_extent = lit.emitters.iter().filter(|e| !e.is_delta()).count() as u32;
        Walk {
            lit,
            textures,
            accel,
            settings,
            world: RefCell::new(SceneWorld::new(&lit.scene)),
            materials: Materials::new(settings.force_effects),
            luminance: Vec::new(),
            max_depth: if lit.has_light() || settings.force_effects {
                settings.max_depth
            } else {
                0
            },
            // As many as light sampling would take, as in the assignment's program.
            directions: with_extent * settings.light_samples,
            has_background: lit.has_background(),
            at: Cell::new(None),
        }
    }

    /// How many rays it has traced.
    pub(crate) fn rays(&self) -> u64 {
        self.world.borrow().counters.rays
    }

    /// The pinhole's ray, sent through the lens if there is one.
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
            // Numbers of its own: those of the picture stay where they are.
            return lens.refract(camera, ray, sampler.clone().next_2d());
        }
        *ray
    }

    /// Radiance that arrives along a camera ray.
    #[inline]
    pub(crate) fn radiance(&self, ray: &Ray, sampler: &mut PixelSampler) -> Spectrum {
        self.at.set(None);
        if self.max_depth <= 1 {
            return self.part_three(ray, sampler);
        }
        estimate_radiance(
            self.lit,
            ray,
            self.max_depth,
            sampler,
            &self.materials,
            &mut |ray| self.next(ray),
            &mut |surface, wo, sampler| self.direct(surface, wo, sampler),
            &mut |throughput, bounces, u| self.play(throughput, bounces, u),
        )
    }

    /// Roulette, if it is played.
    #[inline]
    pub(crate) fn play(&self, throughput: Spectrum, bounces: u32, u: f64) -> Option<Spectrum> {
        self.materials.count(Effect::Bounces);
        if self.settings.roulette {
            play_roulette(throughput, bounces, u)
        } else {
            Some(throughput)
        }
    }

    /// Emission and direct light at the first hit: what part 3 can do alone.
    fn part_three(&self, ray: &Ray, sampler: &mut PixelSampler) -> Spectrum {
        let Some(hit) = self.next(ray) else {
            return self.lit.background(ray.d);
        };
        let surface = self.lit.surface(&hit);
        let wo = -ray.d;
        let mut radiance = zero_bounce_radiance(&surface, wo);
        if self.max_depth > 0 {
            radiance += self.direct(&surface, wo, sampler);
        }
        if self.settings.force_effects {
            self.light_in_vain(&surface, wo, sampler.clone());
        }
        radiance
    }

    /// Direct light and one more bounce, with numbers of their own, that no picture shows.
    fn light_in_vain(&self, surface: &Surface, wo: Vec3, mut sampler: PixelSampler) {
        if self.max_depth == 0 {
            black_box(self.direct(surface, wo, &mut sampler));
        }
        self.materials.count(Effect::Bounces);
        let (u, choice) = (sampler.next_2d(), sampler.next_1d());
        let wo = surface.frame.to_local(wo);
        if let Some(sample) = self.materials.sample(surface.material, wo, u, choice) {
            let ray = surface.leave(surface.frame.to_world(sample.wi));
            black_box(self.closest(&ray));
        }
    }

    /// The next surface on the path, from which the path goes on.
    #[inline]
    fn next(&self, ray: &Ray) -> Option<Hit> {
        let hit = self.closest(ray);
        if let Some(hit) = &hit {
            self.come_to(hit);
        }
        hit
    }

    /// From now on rays leave the surface that was hit, and `materials` are asked about it.
    #[inline]
    pub(crate) fn come_to(&self, hit: &Hit) {
        self.at.set(Some((hit.prim, hit.ng)));
        self.look_up_texture(hit);
    }

    /// Reads what the picture on the surface shows, if it carries one and anything will light it.
    #[inline]
    pub(crate) fn look_up_texture(&self, hit: &Hit) {
        if self.textures.is_empty() || self.max_depth == 0 {
            if self.settings.force_effects {
                self.materials.count(Effect::Texture);
                black_box(Texture::uniform(Spectrum::WHITE).at(hit.uv));
            }
            return;
        }
        let tint = self.textures.at(&self.lit.scene, hit);
        if tint.is_some() {
            self.materials.count(Effect::Texture);
        }
        self.materials.set_tint(tint.unwrap_or(Spectrum::WHITE));
    }

    #[inline]
    fn closest(&self, ray: &Ray) -> Option<Hit> {
        let mut world = self.world.borrow_mut();
        world.counters.rays += 1;
        world.left = self.left_by(ray);
        let hit = self.accel.closest(&mut { *ray }, &mut world);
        if hit.is_none() && (self.has_background || self.settings.force_effects) {
            self.materials.count(Effect::Background);
        }
        hit
    }

    #[inline]
    fn occluded(&self, ray: &Ray) -> bool {
        let mut world = self.world.borrow_mut();
        world.counters.rays += 1;
        world.left = self.left_by(ray);
        self.accel.occluded(ray, &mut world)
    }

    /// The primitive that `ray` leaves for good. A triangle is flat; a sphere is met again by a ray that goes in.
    #[inline]
    pub(crate) fn left_by(&self, ray: &Ray) -> Option<PrimId> {
        let (prim, ng) = self.at.get()?;
        let is_flat = (prim.0 as usize) < self.lit.scene.triangles.len();
        (is_flat || ray.d.dot(ng) > 0.0).then_some(prim)
    }

    #[inline]
    pub(crate) fn direct(
        &self,
        surface: &Surface,
        wo: Vec3,
        sampler: &mut PixelSampler,
    ) -> Spectrum {
        if !self.lit.has_light() {
            if self.settings.force_effects {
                self.materials.count(Effect::DirectLight);
                black_box(self.occluded(&surface.leave(surface.ng)));
            }
            return Spectrum::BLACK;
        }
        let samples = self.settings.light_samples;
        let (lit, materials) = (self.lit, &self.materials);
        let trace = &mut |ray: &Ray| {
            self.materials.count(Effect::DirectLight);
            self.closest(ray)
        };
        let occluded = &mut |ray: &Ray| {
            self.materials.count(Effect::DirectLight);
            self.occluded(ray)
        };
        // A hemisphere is on one side of the surface, and rough glass scatters light from both.
        let looking = match self.settings.looking {
            Looking::Hemisphere if surface.material.lets_light_through() => Looking::Lights,
            looking => looking,
        };
        match looking {
            Looking::Lights => estimate_direct_lighting_importance(
                lit, surface, wo, samples, sampler, materials, occluded,
            ),
            Looking::Hemisphere => estimate_direct_lighting_hemisphere(
                lit,
                surface,
                wo,
                self.directions,
                sampler,
                materials,
                trace,
            ),
            Looking::Both => estimate_direct_lighting_mis(
                lit, surface, wo, samples, sampler, materials, trace, occluded,
            ),
        }
    }
}
