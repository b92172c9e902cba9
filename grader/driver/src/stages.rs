//! The student's functions, as a table: the driver is compiled without them, and once for all of
//! their versions.
//!
//! What a stage declares with `impl FnMut`, [`World`] or [`Scattering`] gets a trait object here.
//! What each function does is said at its declaration in `stages/`.

#![expect(
    missing_docs,
    reason = "the functions are described where they are declared"
)]

use kit::{
    Aabb, BsdfSample, Budget, Camera, FilmSize, Hit, Interval, LitScene, PixelEstimate,
    PixelSampler, PrimId, Ray, Scattering, Spectrum, Sphere, Surface, Tally, Triangle, TriangleHit,
    Vec2, Vec3, World,
};

/// Generates the ray through a position on the film.
pub type CameraRay<'a> = dyn FnMut(Vec2) -> Ray + 'a;
/// Returns the radiance along a ray.
pub type TraceRay<'a> = dyn FnMut(&Ray, &mut PixelSampler) -> Spectrum + 'a;
/// Returns the closest hit of a ray.
pub type Trace<'a> = dyn FnMut(&Ray) -> Option<Hit> + 'a;
/// Decides whether a ray is blocked.
pub type Occluded<'a> = dyn FnMut(&Ray) -> bool + 'a;
/// Estimates the direct light at a surface.
pub type DirectLight<'a> = dyn FnMut(&Surface, Vec3, &mut PixelSampler) -> Spectrum + 'a;
/// Ends a path, or returns its throughput.
pub type Roulette<'a> = dyn FnMut(Spectrum, u32, f64) -> Option<Spectrum> + 'a;
/// Decides whether the samples of a pixel suffice.
pub type Rule<'a> = dyn FnMut(&Tally, f64) -> bool + 'a;

/// The functions of `raygen`.
#[derive(Clone, Copy, Debug)]
pub struct Raygen {
    pub raytrace_pixel: fn(
        u32,
        u32,
        FilmSize,
        u32,
        &mut PixelSampler,
        &mut CameraRay<'_>,
        &mut TraceRay<'_>,
    ) -> PixelEstimate,
    pub generate_ray: fn(&Camera, Vec2) -> Ray,
}

/// The functions of `intersect`.
#[derive(Clone, Copy, Debug)]
pub struct Intersect {
    pub test_triangle: fn(&Triangle, &Ray) -> Option<TriangleHit>,
    pub intersect_triangle: fn(&Triangle, PrimId, &mut Ray) -> Option<Hit>,
    pub record_triangle: fn(&Triangle, PrimId, &mut Ray, TriangleHit) -> Hit,
    pub test_sphere: fn(&Sphere, &Ray) -> Option<f64>,
    pub intersect_sphere: fn(&Sphere, PrimId, &mut Ray) -> Option<Hit>,
}

/// The function of `bbox`.
#[derive(Clone, Copy, Debug)]
pub struct Bbox {
    pub intersect_bbox: fn(&Aabb, &Ray) -> Option<Interval>,
}

/// The functions of `bvh`.
#[derive(Clone, Copy, Debug)]
pub struct Bvh {
    pub construct_bvh: fn(&[Aabb], usize) -> kit::Bvh,
    pub intersect_bvh: fn(&kit::Bvh, &mut Ray, &mut dyn World) -> Option<Hit>,
    pub occludes_bvh: fn(&kit::Bvh, &Ray, &mut dyn World) -> bool,
}

/// The functions of `direct`.
#[derive(Clone, Copy, Debug)]
pub struct Direct {
    pub lambert_f: fn(Spectrum, Vec3, Vec3) -> Spectrum,
    pub lambert_pdf: fn(Vec3, Vec3) -> f64,
    pub lambert_sample: fn(Spectrum, Vec3, Vec2) -> Option<BsdfSample>,
    pub zero_bounce_radiance: fn(&Surface, Vec3) -> Spectrum,
    pub estimate_direct_lighting_hemisphere: fn(
        &LitScene,
        &Surface,
        Vec3,
        u32,
        &mut PixelSampler,
        &dyn Scattering,
        &mut Trace<'_>,
    ) -> Spectrum,
    pub estimate_direct_lighting_importance: fn(
        &LitScene,
        &Surface,
        Vec3,
        u32,
        &mut PixelSampler,
        &dyn Scattering,
        &mut Occluded<'_>,
    ) -> Spectrum,
}

/// `estimate_radiance`.
type EstimateRadiance = fn(
    &LitScene,
    &Ray,
    u32,
    &mut PixelSampler,
    &dyn Scattering,
    &mut Trace<'_>,
    &mut DirectLight<'_>,
    &mut Roulette<'_>,
) -> Spectrum;

/// The functions of `global`.
#[derive(Clone, Copy, Debug)]
pub struct Global {
    pub fresnel_dielectric: fn(f64, f64) -> f64,
    pub reflect: fn(Vec3) -> Vec3,
    pub refract: fn(Vec3, f64) -> Option<Vec3>,
    pub mirror_sample: fn(Spectrum, Vec3) -> Option<BsdfSample>,
    pub refraction_sample: fn(Spectrum, f64, Vec3) -> Option<BsdfSample>,
    pub glass_sample: fn(Spectrum, Spectrum, f64, Vec3, f64) -> Option<BsdfSample>,
    pub estimate_radiance: EstimateRadiance,
    pub play_roulette: fn(Spectrum, u32, f64) -> Option<Spectrum>,
}

/// `raytrace_pixel_adaptive`.
type RaytracePixel = fn(
    (u32, u32),
    FilmSize,
    Budget,
    &mut PixelSampler,
    &mut CameraRay<'_>,
    &mut TraceRay<'_>,
    &mut Rule<'_>,
) -> PixelEstimate;

/// The functions of `adaptive`.
#[derive(Clone, Copy, Debug)]
pub struct Adaptive {
    pub has_converged: fn(&Tally, f64) -> bool,
    pub has_surely_converged: fn(&Tally, f64, &mut Rule<'_>) -> bool,
    pub raytrace_pixel_adaptive: RaytracePixel,
    pub rate_colour: fn(u32, u32) -> Spectrum,
}

/// The stages that a worker links; `None` for those that it was built without.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stages {
    pub raygen: Option<Raygen>,
    pub intersect: Option<Intersect>,
    pub bbox: Option<Bbox>,
    pub bvh: Option<Bvh>,
    pub direct: Option<Direct>,
    pub global: Option<Global>,
    pub adaptive: Option<Adaptive>,
}

/// The stages that trace a ray through a whole scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OfScenes<'a> {
    pub(crate) intersect: &'a Intersect,
    pub(crate) bbox: &'a Bbox,
    pub(crate) bvh: &'a Bvh,
}

/// The stage `name`, or a sentence that it is not there.
fn linked<'a, S>(stage: &'a Option<S>, name: &str) -> Result<&'a S, String> {
    let missing = || format!("this worker was built without the stage {name}");
    stage.as_ref().ok_or_else(missing)
}

impl Stages {
    pub(crate) fn raygen(&self) -> Result<&Raygen, String> {
        linked(&self.raygen, "raygen")
    }

    pub(crate) fn intersect(&self) -> Result<&Intersect, String> {
        linked(&self.intersect, "intersect")
    }

    pub(crate) fn bbox(&self) -> Result<&Bbox, String> {
        linked(&self.bbox, "bbox")
    }

    pub(crate) fn bvh(&self) -> Result<&Bvh, String> {
        linked(&self.bvh, "bvh")
    }

    pub(crate) fn direct(&self) -> Result<&Direct, String> {
        linked(&self.direct, "direct")
    }

    pub(crate) fn global(&self) -> Result<&Global, String> {
        linked(&self.global, "global")
    }

    pub(crate) fn adaptive(&self) -> Result<&Adaptive, String> {
        linked(&self.adaptive, "adaptive")
    }

    pub(crate) fn of_scenes(&self) -> Result<OfScenes<'_>, String> {
        Ok(OfScenes {
            intersect: self.intersect()?,
            bbox: self.bbox()?,
            bvh: self.bvh()?,
        })
    }
}
