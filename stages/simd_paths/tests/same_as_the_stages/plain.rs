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
use simd_paths::{Counts, Neighbours, Path, PathSettings, Start, View};
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

/// The materials of the course, rough glass without its roughness; and the tint of the surface at hand.
struct Materials(Cell<Spectrum>);

impl Scattering for Materials {
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        match *material {
            Material::Diffuse { reflectance } => lambert_f(self.0.get() * reflectance, wo, wi),
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
            Material::Diffuse { reflectance } => lambert_sample(self.0.get() * reflectance, wo, u),
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
    materials: Materials,
    /// What was done; not what the lanes have counted.
    pub(crate) counts: Cell<Counts>,
}

/// Where a ray starts: the primitive, and its geometric normal.
type At = Cell<Option<(PrimId, Vec3)>>;

impl<'a> Plain<'a> {
    pub(crate) fn new(lit: &'a LitScene, settings: PathSettings) -> Plain<'a> {
        Plain {
            lit,
            settings,
            materials: Materials(Cell::new(Spectrum::WHITE)),
            counts: Cell::default(),
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
        surface: &Surface<'_>,
        wo: Vec3,
        sampler: &mut PixelSampler,
    ) -> Spectrum {
        let samples = self.settings.light_samples;
        let occluded = &mut |ray: &Ray| {
            self.count(|counts| {
                counts.rays += 1;
                counts.light_rays += 1;
            });
            self.blocked(ray, self.left_by(at, ray))
        };
        estimate_direct_lighting_importance(
            self.lit,
            surface,
            wo,
            samples,
            sampler,
            &self.materials,
            occluded,
        )
    }

    /// What a picture shows that every surface carries, if any does.
    fn look_at(&self, hit: &Hit) -> Spectrum {
        let tint = if self.settings.has_textures {
            Spectrum::new(hit.uv.x, hit.uv.y, 0.5)
        } else {
            Spectrum::WHITE
        };
        self.materials.0.set(tint);
        tint
    }

    fn count(&self, add: impl FnOnce(&mut Counts)) {
        let mut counts = self.counts.get();
        add(&mut counts);
        self.counts.set(counts);
    }

    fn play(&self, throughput: Spectrum, bounce: u32, u: f64) -> Option<Spectrum> {
        self.count(|counts| counts.bounces += 1);
        match self.settings.first_game {
            // The stage's own first game is its own affair.
            Some(first) if bounce > first => play_roulette(throughput, u32::MAX, u),
            Some(_) => play_roulette(throughput, 0, u),
            None => Some(throughput),
        }
    }
}

/// A lens of a kind.
fn through_lens(ray: &Ray, sampler: &mut PixelSampler) -> Ray {
    let u = sampler.next_2d();
    let aside = 0.1 * Vec3::new(u.x, u.y, 0.0);
    Ray {
        o: ray.o + aside,
        d: (ray.d - 0.5 * aside).normalize(),
        ..*ray
    }
}

/// What the path of `start` sees.
pub(crate) fn radiance(plain: &Plain<'_>, view: &View, start: &Start) -> Spectrum {
    let ((x, y), mut sampler) = start.clone();
    let place = if view.centered {
        Vec2::splat(0.5)
    } else {
        sampler.next_2d()
    };
    let film = Vec2::new(f64::from(view.film.w), f64::from(view.film.h));
    let corner = Vec2::new(f64::from(x), f64::from(y));
    let ray = generate_ray(&view.camera, (corner + place) / film);
    let ray = if view.has_lens {
        through_lens(&ray, &mut sampler)
    } else {
        ray
    };
    let at = Cell::new(None);
    estimate_radiance(
        plain.lit,
        &ray,
        plain.settings.max_depth,
        &mut sampler,
        &plain.materials,
        &mut |ray| {
            plain.count(|counts| counts.rays += 1);
            let Some((id, hit)) = plain.nearest(ray, plain.left_by(&at, ray)) else {
                plain.count(|counts| counts.background += u64::from(plain.lit.has_background()));
                return None;
            };
            let hit = record(plain.lit, id, ray, hit);
            at.set(Some((hit.prim, hit.ng)));
            plain.look_at(&hit);
            Some(hit)
        },
        &mut |surface, wo, sampler| plain.direct(&at, surface, wo, sampler),
        &mut |throughput, bounce, u| plain.play(throughput, bounce, u),
    )
}

impl Neighbours for Plain<'_> {
    fn test(&self, id: PrimId, ray: &Ray) -> Option<TriangleHit> {
        exact(self.lit, id, ray)
    }

    fn record(&self, id: PrimId, ray: &Ray, hit: TriangleHit) -> Hit {
        record(self.lit, id, ray, hit)
    }

    fn closest(&mut self, ray: &Ray, left: Option<PrimId>) -> Option<(PrimId, TriangleHit)> {
        self.nearest(ray, left)
    }

    fn occluded(&mut self, ray: &Ray, left: Option<PrimId>) -> bool {
        self.blocked(ray, left)
    }

    fn aim(&mut self, ray: &Ray, sampler: &mut PixelSampler) -> Ray {
        through_lens(ray, sampler)
    }

    fn tint(&mut self, hit: &Hit) -> Spectrum {
        self.look_at(hit)
    }

    fn go_on(&mut self, path: &mut Path, d: Vec3, hit: &Hit) -> Option<(Ray, Option<PrimId>)> {
        let at = Cell::new(Some((hit.prim, hit.ng)));
        self.look_at(hit);
        let surface = self.lit.surface(hit);
        if !surface.material.is_delta() {
            let direct = self.direct(&at, &surface, -d, &mut path.sampler);
            path.radiance += path.throughput * direct;
        }
        if path.bounce == self.settings.max_depth {
            return None;
        }
        let (u, choice) = (path.sampler.next_2d(), path.sampler.next_1d());
        let wo = surface.frame.to_local(-d);
        let sample = self.materials.sample(surface.material, wo, u, choice)?;
        let u = path.sampler.next_1d();
        path.throughput = self.play(path.throughput * sample.weight(), path.bounce, u)?;
        path.sees_light = sample.delta;
        let ray = surface.leave(surface.frame.to_world(sample.wi));
        Some((ray, self.left_by(&at, &ray)))
    }
}
// END SOLUTION(part6.task2)
