//! A diffuse floor with configurable lights, for tests.

// BEGIN SOLUTION(part3.task3)
use direct::{
    estimate_direct_lighting_hemisphere, estimate_direct_lighting_importance,
    estimate_direct_lighting_mis, lambert_f, lambert_pdf, lambert_sample,
};
use kit::{
    BsdfSample, Frame, Hit, LitScene, Material, PixelSampler, PrimId, Primitive, Ray, Scattering,
    Spectrum, Surface, Tally, Vec2, Vec3,
};
use std::cell::Cell;

/// Reflectance of the floor.
pub(crate) const RHO: f64 = 0.8;

/// Diffuse materials; all others scatter nothing.
pub(crate) struct DiffuseOnly;

impl Scattering for DiffuseOnly {
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        match material {
            Material::Diffuse { reflectance } => lambert_f(*reflectance, wo, wi),
            _ => Spectrum::BLACK,
        }
    }
    fn pdf(&self, _: &Material, wo: Vec3, wi: Vec3) -> f64 {
        lambert_pdf(wo, wi)
    }
    fn sample(&self, material: &Material, wo: Vec3, u: Vec2, _: f64) -> Option<BsdfSample> {
        match material {
            Material::Diffuse { reflectance } => lambert_sample(*reflectance, wo, u),
            _ => None,
        }
    }
}

/// The same with a typical mistake: without the cosine.
struct WithoutCosine;

impl Scattering for WithoutCosine {
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        let f = DiffuseOnly.f(material, wo, wi);
        if f.is_black() { f } else { f / wi.z.abs() }
    }
    fn pdf(&self, material: &Material, wo: Vec3, wi: Vec3) -> f64 {
        DiffuseOnly.pdf(material, wo, wi)
    }
    fn sample(&self, material: &Material, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample> {
        DiffuseOnly.sample(material, wo, u, choice)
    }
}

/// The floor at the origin. All primitives of the scene are lamps.
pub(crate) struct Floor {
    lit: LitScene,
    material: Material,
    wo: Vec3,
    rays: Cell<u32>,
}

impl Floor {
    pub(crate) fn under(lit: LitScene) -> Floor {
        Floor {
            lit,
            material: Material::Diffuse {
                reflectance: Spectrum::grey(RHO),
            },
            wo: Vec3::new(0.6, 0.64, 0.48),
            rays: Cell::new(0),
        }
    }

    /// The same floor with another material.
    pub(crate) fn made_of(self, material: Material) -> Floor {
        Floor { material, ..self }
    }

    /// The same floor, seen from below.
    pub(crate) fn seen_from_below(self) -> Floor {
        Floor {
            wo: -self.wo,
            ..self
        }
    }

    fn surface<'a>(&self, material: &'a Material) -> Surface<'a> {
        Surface {
            p: Vec3::ZERO,
            frame: Frame::around(Vec3::Y),
            ng: Vec3::Y,
            error: Vec3::ZERO,
            material,
            prim: PrimId(u32::MAX),
        }
    }

    /// Estimates of the reflected radiance, each from one hemisphere sample.
    pub(crate) fn hemisphere(&self, estimates: u32) -> Tally {
        self.hemisphere_of(estimates, 1)
    }

    /// Estimates of the reflected radiance, each from `samples` hemisphere samples.
    pub(crate) fn hemisphere_of(&self, estimates: u32, samples: u32) -> Tally {
        self.estimate(estimates, |surface, wo, sampler, rays| {
            estimate_direct_lighting_hemisphere(
                &self.lit,
                surface,
                wo,
                samples,
                sampler,
                &DiffuseOnly,
                &mut |ray| {
                    *rays += 1;
                    self.closest(ray)
                },
            )
        })
    }

    /// Estimates of the reflected radiance, each from `ns_area_light` samples per light.
    pub(crate) fn lights(&self, estimates: u32, ns_area_light: u32) -> Tally {
        self.by_lights(estimates, ns_area_light, &DiffuseOnly)
    }

    pub(crate) fn lights_without_cosine(&self, estimates: u32) -> Tally {
        self.by_lights(estimates, 1, &WithoutCosine)
    }

    /// Estimates by multiple importance sampling, each from one sample per light and one of the
    /// BSDF.
    pub(crate) fn mis(&self, estimates: u32) -> Tally {
        self.estimate(estimates, |surface, wo, sampler, rays| {
            *rays += 2;
            estimate_direct_lighting_mis(
                &self.lit,
                surface,
                wo,
                1,
                sampler,
                &DiffuseOnly,
                &mut |ray| self.closest(ray),
                &mut |ray| self.closest(ray).is_some(),
            )
        })
    }

    fn by_lights(&self, estimates: u32, ns: u32, scattering: &impl Scattering) -> Tally {
        self.estimate(estimates, |surface, wo, sampler, rays| {
            estimate_direct_lighting_importance(
                &self.lit,
                surface,
                wo,
                ns,
                sampler,
                scattering,
                &mut |ray| {
                    *rays += 1;
                    self.closest(ray).is_some()
                },
            )
        })
    }

    fn estimate(
        &self,
        estimates: u32,
        mut estimator: impl FnMut(&Surface, Vec3, &mut PixelSampler, &mut u32) -> Spectrum,
    ) -> Tally {
        let surface = self.surface(&self.material);
        let mut sampler = PixelSampler::new(3, 5, 42);
        let mut rays = 0;
        let tally = (0..estimates)
            .map(|_| {
                sampler.get_sample();
                let radiance = estimator(&surface, self.wo, &mut sampler, &mut rays);
                assert!(radiance.r == radiance.g && radiance.g == radiance.b);
                radiance.r
            })
            .collect();
        self.rays.set(rays);
        tally
    }

    /// Number of rays that the last estimates traced.
    pub(crate) fn rays_of_last_estimate(&self) -> u32 {
        self.rays.get()
    }

    /// The closest lamp along the ray, by a simple test that is independent of the course's
    /// kernels.
    fn closest(&self, ray: &Ray) -> Option<Hit> {
        let scene = &self.lit.scene;
        (0..scene.len() as u32)
            .filter_map(|i| lamp_hit(scene.primitive(PrimId(i)), PrimId(i), ray))
            .min_by(|a, b| a.t.total_cmp(&b.t))
    }
}

fn lamp_hit(lamp: Primitive<'_>, prim: PrimId, ray: &Ray) -> Option<Hit> {
    let (t, n) = match lamp {
        Primitive::Triangle(tri) => {
            let n = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
            let t = (tri.p0 - ray.o).dot(n) / ray.d.dot(n);
            let p = ray.at(t);
            let inside = [(tri.p0, tri.p1), (tri.p1, tri.p2), (tri.p2, tri.p0)]
                .iter()
                .all(|&(a, b)| (b - a).cross(p - a).dot(n) >= 0.0);
            inside.then_some((t, n.normalize()))?
        }
        Primitive::Sphere(s) => {
            let f = ray.o - s.center;
            let b = f.dot(ray.d);
            let root = (b * b - f.length_squared() + s.radius * s.radius).sqrt();
            (!root.is_nan()).then(|| {
                let t = -b - root;
                (t, (ray.at(t) - s.center) / s.radius)
            })?
        }
    };
    ray.in_range(t).then(|| Hit {
        t,
        p: ray.at(t),
        n,
        ng: n,
        uv: Vec2::ZERO,
        prim,
    })
}
// END SOLUTION(part3.task3)
