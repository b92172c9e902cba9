//! Scalar paths with the stages, intersected by brute force.

use direct::{
    estimate_direct_lighting_importance, estimate_direct_lighting_mis, lambert_f, lambert_pdf,
    lambert_sample,
};
use global::{
    estimate_radiance, glass_sample, glossy_f, glossy_pdf, glossy_sample, mirror_sample,
    play_roulette, refraction_sample,
};
use kit::shading_normal::{Sides, towards_viewer};
use kit::{
    BsdfSample, Hit, LitScene, Material, PixelSampler, PrimId, Primitive, Ray, Scattering,
    Spectrum, Surface, TriangleHit, Vec2, Vec3,
};
use raygen::generate_ray;
use simd_paths::{
    Beam, Counts, NextRay, PathSettings, PathStart, ScalarFallback, ScalarPath, View,
};
use std::cell::Cell;

/// The scalar kernels: intersects `ray` with primitive `id`.
fn exact(lit: &LitScene, id: PrimId, ray: &Ray) -> Option<TriangleHit> {
    match lit.scene.primitive(id) {
        Primitive::Triangle(t) => intersect::test_triangle(t, ray),
        Primitive::Sphere(s) => intersect::test_sphere(s, ray).map(|t| TriangleHit {
            t,
            b1: 0.0,
            b2: 0.0,
        }),
    }
}

fn record(lit: &LitScene, id: PrimId, ray: &Ray, hit: TriangleHit) -> Hit {
    let ray = &mut Ray {
        max_t: hit.t,
        ..*ray
    };
    match lit.scene.primitive(id) {
        Primitive::Triangle(t) => intersect::record_triangle(t, id, ray, hit),
        Primitive::Sphere(s) => intersect::intersect_sphere(s, id, ray).expect("the same hit"),
    }
}

/// The texture colour and the sides of a surface, and whether its terminator is soft.
type Place = (Spectrum, Sides, bool);

/// The materials of the course, but no rough glass; and the place of the last hit, which the
/// callbacks of `estimate_radiance` share.
struct Materials<'a>(&'a Cell<Place>);

impl Scattering for Materials<'_> {
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        let (tint, sides, is_soft) = self.0.get();
        if sides.block(material, wo, wi) {
            return Spectrum::BLACK;
        }
        let f = match *material {
            Material::Diffuse { reflectance } => lambert_f(tint * reflectance, wo, wi),
            Material::Glossy {
                reflectance,
                shininess,
            } => glossy_f(reflectance, shininess, wo, wi),
            _ => Spectrum::BLACK,
        };
        if is_soft { f * sides.terminator(wi) } else { f }
    }

    fn pdf(&self, material: &Material, wo: Vec3, wi: Vec3) -> f64 {
        match *material {
            Material::Diffuse { .. } => lambert_pdf(wo, wi),
            Material::Glossy { shininess, .. } => glossy_pdf(shininess, wo, wi),
            _ => 0.0,
        }
    }

    fn sample(&self, material: &Material, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample> {
        let (tint, sides, is_soft) = self.0.get();
        let sample = match *material {
            Material::Diffuse { reflectance } => lambert_sample(tint * reflectance, wo, u),
            Material::Emission { .. } => None,
            Material::Mirror { reflectance } => mirror_sample(reflectance, wo),
            Material::Glossy {
                reflectance,
                shininess,
            } => glossy_sample(reflectance, shininess, wo, u),
            Material::Refraction {
                transmittance, ior, ..
            } => refraction_sample(transmittance, ior, wo),
            Material::Glass {
                reflectance,
                transmittance,
                ior,
                ..
            } => glass_sample(reflectance, transmittance, ior, wo, choice),
        };
        let mut sample = sample?;
        if is_soft && !sample.delta {
            sample.f = sample.f * sides.terminator(sample.wi);
        }
        (!sides.block(material, wo, sample.wi)).then_some(sample)
    }
}

/// Traces scalar paths through a scene.
pub(crate) struct ScalarPaths<'a> {
    lit: &'a LitScene,
    settings: PathSettings,
    /// The primitives that rays which are traced together do not hit.
    pub(crate) apart: Vec<PrimId>,
    /// What the scalar code did, without what packets counted.
    pub(crate) counts: Cell<Counts>,
}

impl<'a> ScalarPaths<'a> {
    pub(crate) fn new(lit: &'a LitScene, settings: PathSettings) -> ScalarPaths<'a> {
        ScalarPaths {
            lit,
            settings,
            apart: Vec::new(),
            counts: Cell::default(),
        }
    }

    /// The primitive that a ray from primitive `prim`, with the geometric normal `ng`, cannot hit.
    fn skip(&self, (prim, ng): (PrimId, Vec3), ray: &Ray) -> Option<PrimId> {
        let is_flat = (prim.0 as usize) < self.lit.scene.triangles.len();
        (is_flat || ray.d.dot(ng) > 0.0).then_some(prim)
    }

    fn ids(&self) -> impl Iterator<Item = PrimId> {
        (0..self.lit.scene.len() as u32).map(PrimId)
    }

    fn inner_ids(&self) -> impl Iterator<Item = PrimId> {
        self.ids().filter(|id| !self.apart.contains(id))
    }

    /// The closest hit with any of `ids`, which ascend, but `skip`.
    fn nearest_of(
        &self,
        ids: impl Iterator<Item = PrimId>,
        ray: &Ray,
        skip: Option<PrimId>,
    ) -> Option<(PrimId, TriangleHit)> {
        ids.filter(|&id| skip != Some(id))
            .filter_map(|id| Some((id, exact(self.lit, id, ray)?)))
            .reduce(|a, b| if b.1.t < a.1.t { b } else { a })
    }

    /// The closest hit of a ray that is counted.
    fn hit(&self, ray: &Ray, skip: Option<PrimId>) -> Option<Hit> {
        self.count(|counts| counts.rays += 1);
        let Some((id, hit)) = self.nearest_of(self.ids(), ray, skip) else {
            self.count(|counts| counts.background += u64::from(self.lit.has_background()));
            return None;
        };
        Some(record(self.lit, id, ray, hit))
    }

    fn blocked(&self, ray: &Ray, skip: Option<PrimId>) -> bool {
        self.ids()
            .any(|id| skip != Some(id) && exact(self.lit, id, ray).is_some())
    }

    fn direct(
        &self,
        surface: &Surface<'_>,
        place: Place,
        wo: Vec3,
        sampler: &mut PixelSampler,
    ) -> Spectrum {
        let samples = self.settings.light_samples;
        let materials = &Materials(&Cell::new(place));
        let origin = (surface.prim, surface.ng);
        let occluded = &mut |ray: &Ray| {
            self.count(|counts| {
                counts.rays += 1;
                counts.light_rays += 1;
            });
            self.blocked(ray, self.skip(origin, ray))
        };
        if self.settings.samples_bsdf {
            let trace = &mut |ray: &Ray| {
                self.count(|counts| counts.light_rays += 1);
                self.hit(ray, self.skip(origin, ray))
            };
            return estimate_direct_lighting_mis(
                self.lit, surface, wo, samples, sampler, materials, trace, occluded,
            );
        }
        estimate_direct_lighting_importance(
            self.lit, surface, wo, samples, sampler, materials, occluded,
        )
    }

    fn place(&self, hit: &Hit, surface: &Surface<'_>) -> Place {
        let is_soft = self.settings.soft_terminator;
        (self.look_up_texture(hit), Sides::of(surface), is_soft)
    }

    /// The colour of the texture, which all surfaces have if any has one; else white.
    fn look_up_texture(&self, hit: &Hit) -> Spectrum {
        if self.settings.has_textures {
            Spectrum::new(hit.uv.x, hit.uv.y, 0.5)
        } else {
            Spectrum::WHITE
        }
    }

    fn count(&self, add: impl FnOnce(&mut Counts)) {
        let mut counts = self.counts.get();
        add(&mut counts);
        self.counts.set(counts);
    }

    fn roulette(&self, throughput: Spectrum, bounce: u32, u: f64) -> Option<Spectrum> {
        self.count(|counts| counts.bounces += 1);
        let factor = f64::from(self.settings.roulette_factor);
        let survivor = match self.settings.min_bounces {
            // Replaces the threshold of the stage.
            Some(first) if bounce > first => play_roulette(throughput * factor, u32::MAX, u),
            Some(_) => play_roulette(throughput * factor, 0, u),
            None => return Some(throughput),
        };
        survivor.map(|throughput| throughput / factor)
    }
}

/// A made-up lens.
fn through_lens(ray: &Ray, sampler: &mut PixelSampler) -> Ray {
    let u = sampler.next_2d();
    let aside = 0.1 * Vec3::new(u.x, u.y, 0.0);
    Ray {
        o: ray.o + aside,
        d: (ray.d - 0.5 * aside).normalize(),
        ..*ray
    }
}

/// The radiance of the path from `start`, and the part that the first surface that is neither a
/// mirror nor smooth glass has from the lights.
pub(crate) fn radiance(
    scalar: &ScalarPaths<'_>,
    view: &View,
    start: &PathStart,
) -> (Spectrum, Option<Spectrum>) {
    let PathStart {
        pixel: (x, y),
        mut sampler,
    } = start.clone();
    let position = if view.centered {
        Vec2::splat(0.5)
    } else {
        sampler.next_2d()
    };
    let film = Vec2::new(f64::from(view.film.w), f64::from(view.film.h));
    let corner = Vec2::new(f64::from(x), f64::from(y));
    let ray = generate_ray(&view.camera, (corner + position) / film);
    let ray = if view.has_lens {
        through_lens(&ray, &mut sampler)
    } else {
        ray
    };
    let mut origin = None;
    let place = Cell::new((Spectrum::WHITE, Sides::FLAT, false));
    let (throughput, direct) = (Cell::new(Spectrum::WHITE), Cell::new(None));
    let radiance = estimate_radiance(
        scalar.lit,
        &ray,
        scalar.settings.max_depth,
        &mut sampler,
        &Materials(&place),
        &mut |ray| {
            let skip = origin.and_then(|origin| scalar.skip(origin, ray));
            let hit = towards_viewer(scalar.lit, scalar.hit(ray, skip)?, ray.d);
            origin = Some((hit.prim, hit.ng));
            place.set(scalar.place(&hit, &scalar.lit.surface(&hit)));
            Some(hit)
        },
        &mut |surface, wo, sampler| {
            let light = scalar.direct(surface, place.get(), wo, sampler);
            if !matches!(surface.material, Material::Emission { .. }) {
                direct.set(direct.get().or(Some(throughput.get() * light)));
            }
            light
        },
        &mut |weight, bounce, u| {
            let survivor = scalar.roulette(weight, bounce, u)?;
            throughput.set(survivor);
            Some(survivor)
        },
    );
    (radiance, direct.get())
}

impl ScalarFallback for ScalarPaths<'_> {
    fn test(&self, id: PrimId, ray: &Ray) -> Option<TriangleHit> {
        exact(self.lit, id, ray)
    }

    fn record(&self, id: PrimId, ray: &Ray, hit: TriangleHit) -> Hit {
        record(self.lit, id, ray, hit)
    }

    fn closest(&mut self, ray: &Ray, skip: Option<PrimId>) -> Option<(PrimId, TriangleHit)> {
        self.nearest_of(self.ids(), ray, skip)
    }

    fn occluded(&mut self, ray: &Ray, skip: Option<PrimId>) -> bool {
        self.blocked(ray, skip)
    }

    fn closest_each(
        &mut self,
        rays: &[(Ray, Option<PrimId>)],
        hits: &mut Vec<Option<(PrimId, TriangleHit)>>,
    ) {
        hits.clear();
        hits.extend(
            rays.iter()
                .map(|(ray, skip)| self.nearest_of(self.inner_ids(), ray, *skip)),
        );
    }

    fn occluded_each(&mut self, rays: &[(Ray, Option<PrimId>)], occluded: &mut Vec<bool>) {
        occluded.clear();
        occluded.extend(
            rays.iter()
                .map(|(ray, skip)| self.nearest_of(self.inner_ids(), ray, *skip).is_some()),
        );
    }

    fn primitives_in(&mut self, _: &Beam, most: usize, ids: &mut Vec<PrimId>) -> bool {
        ids.extend(self.inner_ids());
        ids.len() <= most
    }

    fn through_lens(&mut self, ray: &Ray, sampler: &mut PixelSampler) -> Ray {
        through_lens(ray, sampler)
    }

    fn texture_color(&mut self, hit: &Hit) -> Spectrum {
        self.look_up_texture(hit)
    }

    fn scatter(&mut self, path: &mut ScalarPath, d: Vec3, hit: &Hit) -> Option<NextRay> {
        let surface = self.lit.surface(hit);
        let place = self.place(hit, &surface);
        if !surface.material.is_delta() {
            let direct = self.direct(&surface, place, -d, &mut path.sampler);
            path.radiance += path.throughput * direct;
        }
        if path.bounce == self.settings.max_depth {
            return None;
        }
        let (u, choice) = (path.sampler.next_2d(), path.sampler.next_1d());
        let wo = surface.frame.to_local(-d);
        let materials = Materials(&Cell::new(place));
        let sample = materials.sample(surface.material, wo, u, choice)?;
        let u = path.sampler.next_1d();
        path.throughput = self.roulette(path.throughput * sample.weight(), path.bounce, u)?;
        path.emission_counts = sample.delta;
        let ray = surface.leave(surface.frame.to_world(sample.wi));
        let skip = self.skip((surface.prim, surface.ng), &ray);
        Some(NextRay { ray, skip })
    }
}
