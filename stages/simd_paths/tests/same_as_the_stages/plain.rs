// BEGIN SOLUTION(part6.task2)
//! One path at a time, by the stages: asking every primitive.

use direct::{estimate_direct_lighting_importance, lambert_f, lambert_pdf, lambert_sample};
use global::{
    estimate_radiance, glass_sample, glossy_f, glossy_pdf, glossy_sample, mirror_sample,
    play_roulette, refraction_sample,
};
use kit::{
    BsdfSample, Hit, LitScene, Material, PixelSampler, PrimId, Primitive, Ray, Scattering,
    Spectrum, Surface, TriangleHit, Vec2, Vec3,
};
use raygen::generate_ray;
use simd_paths::{Neighbours, Path, PathSettings, Start, View};
use std::cell::Cell;

/// The plain kernels: where `ray` meets primitive `id`.
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

/// The geometric normal of a triangle.
pub(crate) fn geometric_normal(lit: &LitScene, id: PrimId) -> Vec3 {
    let corner = TriangleHit {
        t: 0.0,
        b1: 0.0,
        b2: 0.0,
    };
    match lit.scene.primitive(id) {
        Primitive::Triangle(_) => record(lit, id, &Ray::new(Vec3::ZERO, Vec3::Z), corner).ng,
        Primitive::Sphere(_) => Vec3::ZERO,
    }
}

/// The materials of the course; rough glass does without its roughness.
struct Materials;

impl Scattering for Materials {
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        match *material {
            Material::Diffuse { reflectance } => lambert_f(reflectance, wo, wi),
            Material::Glossy {
                reflectance,
                shininess,
            } => glossy_f(reflectance, shininess, wo, wi),
            _ => Spectrum::BLACK,
        }
    }

    fn pdf(&self, material: &Material, wo: Vec3, wi: Vec3) -> f64 {
        match *material {
            Material::Diffuse { .. } => lambert_pdf(wo, wi),
            Material::Glossy { shininess, .. } => glossy_pdf(shininess, wo, wi),
            _ => 0.0,
        }
    }

    fn sample(&self, material: &Material, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample> {
        match *material {
            Material::Diffuse { reflectance } => lambert_sample(reflectance, wo, u),
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
        }
    }
}

/// The plain way through a scene.
pub(crate) struct Plain<'a> {
    lit: &'a LitScene,
    settings: PathSettings,
    /// Rays traced; not those that the lanes have counted.
    pub(crate) rays: u64,
}

/// Where a ray starts: the primitive, and its geometric normal.
type At = Cell<Option<(PrimId, Vec3)>>;

impl<'a> Plain<'a> {
    pub(crate) fn new(lit: &'a LitScene, settings: PathSettings) -> Plain<'a> {
        Plain {
            lit,
            settings,
            rays: 0,
        }
    }

    fn left_by(&self, at: &At, ray: &Ray) -> Option<PrimId> {
        let (prim, ng) = at.get()?;
        let is_flat = (prim.0 as usize) < self.lit.scene.triangles.len();
        (is_flat || ray.d.dot(ng) > 0.0).then_some(prim)
    }

    fn nearest(&self, ray: &Ray, left: Option<PrimId>) -> Option<(PrimId, TriangleHit)> {
        (0..self.lit.scene.len() as u32)
            .map(PrimId)
            .filter(|&id| left != Some(id))
            .filter_map(|id| Some((id, exact(self.lit, id, ray)?)))
            .reduce(|a, b| if b.1.t < a.1.t { b } else { a })
    }

    fn blocked(&self, ray: &Ray, left: Option<PrimId>) -> bool {
        (0..self.lit.scene.len() as u32)
            .map(PrimId)
            .any(|id| left != Some(id) && exact(self.lit, id, ray).is_some())
    }

    fn direct(
        &self,
        at: &At,
        rays: &Cell<u64>,
        surface: &Surface<'_>,
        wo: Vec3,
        sampler: &mut PixelSampler,
    ) -> Spectrum {
        let samples = self.settings.light_samples;
        let occluded = &mut |ray: &Ray| {
            rays.set(rays.get() + 1);
            self.blocked(ray, self.left_by(at, ray))
        };
        estimate_direct_lighting_importance(
            self.lit, surface, wo, samples, sampler, &Materials, occluded,
        )
    }

    fn play(&self, throughput: Spectrum, bounce: u32, u: f64) -> Option<Spectrum> {
        match self.settings.first_game {
            // The stage's own first game is its own affair.
            Some(first) if bounce > first => play_roulette(throughput, u32::MAX, u),
            Some(_) => play_roulette(throughput, 0, u),
            None => Some(throughput),
        }
    }
}

/// What the path of `start` sees.
pub(crate) fn radiance(plain: &mut Plain<'_>, view: &View, start: &Start) -> Spectrum {
    let ((x, y), mut sampler) = start.clone();
    let place = if view.centered {
        Vec2::splat(0.5)
    } else {
        sampler.next_2d()
    };
    let film = Vec2::new(f64::from(view.film.w), f64::from(view.film.h));
    let corner = Vec2::new(f64::from(x), f64::from(y));
    let ray = generate_ray(&view.camera, (corner + place) / film);
    let (at, rays) = (Cell::new(None), Cell::new(0));
    let seen = estimate_radiance(
        plain.lit,
        &ray,
        plain.settings.max_depth,
        &mut sampler,
        &Materials,
        &mut |ray| {
            rays.set(rays.get() + 1);
            let (id, hit) = plain.nearest(ray, plain.left_by(&at, ray))?;
            let hit = record(plain.lit, id, ray, hit);
            at.set(Some((hit.prim, hit.ng)));
            Some(hit)
        },
        &mut |surface, wo, sampler| plain.direct(&at, &rays, surface, wo, sampler),
        &mut |throughput, bounce, u| plain.play(throughput, bounce, u),
    );
    plain.rays += rays.get();
    seen
}

impl Neighbours for Plain<'_> {
    fn test(&self, id: PrimId, ray: &Ray) -> Option<TriangleHit> {
        exact(self.lit, id, ray)
    }

    fn closest(&mut self, ray: &Ray, left: Option<PrimId>) -> Option<(PrimId, TriangleHit)> {
        self.nearest(ray, left)
    }

    fn occluded(&mut self, ray: &Ray, left: Option<PrimId>) -> bool {
        self.blocked(ray, left)
    }

    fn go_on(&mut self, path: &mut Path, d: Vec3, hit: &Hit) -> Option<(Ray, Option<PrimId>)> {
        let (at, rays) = (Cell::new(Some((hit.prim, hit.ng))), Cell::new(0));
        let surface = self.lit.surface(hit);
        if !surface.material.is_delta() {
            let direct = self.direct(&at, &rays, &surface, -d, &mut path.sampler);
            path.radiance += path.throughput * direct;
            self.rays += rays.get();
        }
        if path.bounce == self.settings.max_depth {
            return None;
        }
        let (u, choice) = (path.sampler.next_2d(), path.sampler.next_1d());
        let wo = surface.frame.to_local(-d);
        let sample = Materials.sample(surface.material, wo, u, choice)?;
        let u = path.sampler.next_1d();
        path.throughput = self.play(path.throughput * sample.weight(), path.bounce, u)?;
        path.sees_light = sample.delta;
        let ray = surface.leave(surface.frame.to_world(sample.wi));
        Some((ray, self.left_by(&at, &ray)))
    }
}
// END SOLUTION(part6.task2)
