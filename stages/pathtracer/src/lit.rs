//! Lit shading: each pixel shows the light that reaches it.
//!
//! One camera sample goes like this: `raygen` makes its ray, and a walk follows it with the stage `global`, which
//! asks the stage `direct` for the light at each surface on the way. With a depth of 0 or 1 there is no way to follow,
//! and `direct` alone does it.

use crate::materials::Materials;
use crate::textures::Textures;
use crate::{Accel, Job, Lens, Rendered, SceneWorld};
use adaptive::{has_converged, has_surely_converged, raytrace_pixel_adaptive};
use direct::{
    estimate_direct_lighting_hemisphere, estimate_direct_lighting_importance,
    estimate_direct_lighting_mis, zero_bounce_radiance,
};
use global::{estimate_radiance, play_roulette};
use kit::effects::{Asked, Call, Effect};
use kit::film::{self, Cell as Tile};
use kit::{
    Budget, Camera, Emitter, Hit, LitScene, PixelEstimate, PixelSampler, PrimId, Ray, Scattering,
    Spectrum, Surface, Tally, Texture, Vec3,
};
use raygen::{generate_ray, raytrace_pixel};
use std::cell::{Cell, RefCell};
use std::hint::black_box;
use std::sync::atomic::{AtomicBool, Ordering};

/// How direct light is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Looking {
    /// At the lights (part 3, task 3).
    Lights,
    /// Around, at random (part 3, task 2; the flag `-H`).
    Hemisphere,
    /// Both, weighed by how good each is.
    Both,
}

/// How light is simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSettings {
    /// Samples per light with an extent (`-l`); also directions per light when looking around.
    pub light_samples: u32,
    /// Ray depth (`-m`): 0 is emission only, 1 is direct light.
    pub max_depth: u32,
    /// How direct light is looked for.
    pub looking: Looking,
    /// Whether dim paths play roulette for their life.
    pub roulette: bool,
    /// Samples per batch and tolerance (`-a`).
    pub adaptive: Option<(u32, f64)>,
    /// The camera's lens.
    pub lens: Lens,
    /// Whether effects run that the scene does not call for. It changes no picture, only the counts.
    pub force_effects: bool,
    /// Whether the environment was asked for by a flag.
    pub environment: bool,
}

impl Default for LightSettings {
    /// The assignment's defaults.
    fn default() -> LightSettings {
        LightSettings {
            light_samples: 1,
            max_depth: 1,
            looking: Looking::Lights,
            roulette: true,
            adaptive: None,
            lens: Lens {
                radius: 0.0,
                focus: 1.0,
            },
            force_effects: false,
            environment: false,
        }
    }
}

impl LightSettings {
    /// What `lit` calls for under these settings.
    pub fn effects(&self, lit: &LitScene) -> Vec<Call> {
        lit.effects(Asked {
            max_depth: self.max_depth,
            lens_radius: self.lens.radius,
            environment: self.environment,
        })
    }
}

/// Renders light on rayon's current thread pool.
///
/// The picture depends on `lit`, `job` and `settings` alone, not on threads. `tile_done` hears of each finished tile and its rays. Once
/// `stop` is set, the pixels that are left stay black. `accel` is built over `lit.scene`, whose pictures are `textures`.
pub fn render_lit(
    lit: &LitScene,
    textures: &Textures,
    accel: &Accel,
    job: &Job,
    settings: &LightSettings,
    stop: &AtomicBool,
    tile_done: &(dyn Fn(Tile, u64) + Sync),
) -> Rendered {
    let (film, walks) = film::render(
        job.film,
        job.cell,
        job.sampling,
        || Walk::new(lit, textures, accel, settings),
        |walk, x, y, sampler| {
            if stop.load(Ordering::Relaxed) {
                return PixelEstimate::default();
            }
            let mut luminance = Tally::default();
            let camera_ray = &mut |sensor| generate_ray(&job.camera, sensor);
            let trace_ray = &mut |ray: &Ray, sampler: &mut PixelSampler| {
                let ray = walk.through_lens(&job.camera, ray, sampler);
                let radiance = walk.radiance(&ray, sampler);
                luminance.push(radiance.luminance());
                radiance
            };
            let estimate = match settings.adaptive {
                None => raytrace_pixel(x, y, job.film, job.samples, sampler, camera_ray, trace_ray),
                Some((batch, tolerance)) => raytrace_pixel_adaptive(
                    (x, y),
                    job.film,
                    Budget {
                        ns_aa: job.samples,
                        batch,
                        tolerance,
                    },
                    sampler,
                    camera_ray,
                    trace_ray,
                    &mut |samples: &Tally, tolerance| {
                        has_surely_converged(samples, tolerance, &mut has_converged)
                    },
                ),
            };
            walk.luminance.push(((x, y), luminance));
            estimate
        },
        |cell, walk| tile_done(cell, walk.world.borrow().counters.rays),
    );
    let mut luminance = vec![Tally::default(); film.pixels().len()];
    for ((x, y), tally) in walks.iter().flat_map(|w| &w.luminance) {
        luminance[*y as usize * job.film.w as usize + *x as usize] = *tally;
    }
    Rendered {
        film,
        luminance,
        counters: walks.iter().map(|w| w.world.borrow().counters).sum(),
        effects: walks.iter().map(|w| w.materials.counts()).sum(),
    }
}

/// What a thread needs to follow light through a scene.
struct Walk<'a> {
    lit: &'a LitScene,
    textures: &'a Textures,
    accel: &'a Accel,
    settings: &'a LightSettings,
    world: RefCell<SceneWorld<'a>>,
    materials: Materials,
    /// Pixels that are done, and the luminances of their samples.
    luminance: Vec<((u32, u32), Tally)>,
    /// Rays on a path at most. In the dark the first one says all.
    max_depth: u32,
    /// Directions for a hemisphere estimate.
    directions: u32,
    has_background: bool,
    /// Where the ray at hand starts: the primitive, and its geometric normal.
    at: Cell<Option<(PrimId, Vec3)>>,
}

impl<'a> Walk<'a> {
    fn new(
        lit: &'a LitScene,
        textures: &'a Textures,
        accel: &'a Accel,
        settings: &'a LightSettings,
    ) -> Walk<'a> {
        let is_background =
            |e: &Emitter| matches!(e, Emitter::Sky { .. } | Emitter::Environment(_));
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
            has_background: lit.emitters.iter().any(is_background),
            at: Cell::new(None),
        }
    }

    /// The pinhole's ray, sent through the lens if there is one.
    #[inline]
    fn through_lens(&self, camera: &Camera, ray: &Ray, sampler: &mut PixelSampler) -> Ray {
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
    fn radiance(&self, ray: &Ray, sampler: &mut PixelSampler) -> Spectrum {
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
            &mut |throughput, bounces, u| {
                self.materials.count(Effect::Bounces);
                if self.settings.roulette {
                    play_roulette(throughput, bounces, u)
                } else {
                    Some(throughput)
                }
            },
        )
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
            self.at.set(Some((hit.prim, hit.ng)));
            self.look_up_texture(hit);
        }
        hit
    }

    /// Reads what the picture on the surface shows, if it carries one and anything will light it. All that is asked
    /// of `materials` until the path's next hit is about this surface.
    #[inline]
    fn look_up_texture(&self, hit: &Hit) {
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
    fn left_by(&self, ray: &Ray) -> Option<PrimId> {
        let (prim, ng) = self.at.get()?;
        let is_flat = (prim.0 as usize) < self.lit.scene.triangles.len();
        (is_flat || ray.d.dot(ng) > 0.0).then_some(prim)
    }

    #[inline]
    fn direct(&self, surface: &Surface, wo: Vec3, sampler: &mut PixelSampler) -> Spectrum {
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
