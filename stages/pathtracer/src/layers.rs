//! Layers beside the picture (albedo, normal, depth, ...), for denoisers and for inspection.

use crate::textures::Textures;
use crate::{Accel, Counters, Job, Rendered};
use kit::{Hit, Material, Scene, Spectrum, Vec2, Vec3};
use picture_files::{Channel, Values};
use raygen::generate_ray;
use rayon::prelude::*;

/// The first hit of the ray through a pixel's centre. For a miss all fields are zero, but `prim` is
/// [`Feature::NO_PRIMITIVE`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feature {
    /// Reflectance or transmittance; black for emitters.
    pub albedo: Spectrum,
    /// Unit shading normal.
    pub normal: Vec3,
    /// Distance from the camera along the ray.
    pub depth: f64,
    /// The number of the primitive.
    pub prim: u32,
}

impl Feature {
    /// The number that stands for no primitive.
    pub const NO_PRIMITIVE: u32 = u32::MAX;

    fn of(scene: &Scene, textures: &Textures, hit: Option<Hit>) -> Feature {
        match hit {
            Some(hit) => Feature {
                albedo: textures.at(scene, &hit).unwrap_or(Spectrum::WHITE)
                    * albedo(scene.material_of(hit.prim)),
                normal: hit.n,
                depth: hit.t,
                prim: hit.prim.0,
            },
            None => Feature {
                albedo: Spectrum::BLACK,
                normal: Vec3::ZERO,
                depth: 0.0,
                prim: Feature::NO_PRIMITIVE,
            },
        }
    }
}

/// The reflectance or transmittance of a material; black for emitters.
pub fn albedo(material: &Material) -> Spectrum {
    match *material {
        Material::Diffuse { reflectance }
        | Material::Mirror { reflectance }
        | Material::Glossy { reflectance, .. } => reflectance,
        Material::Refraction { transmittance, .. } | Material::Glass { transmittance, .. } => {
            transmittance
        }
        Material::Emission { .. } => Spectrum::BLACK,
    }
}

/// The features of the pixels of `job.cell`, row by row from the top left.
pub fn features(scene: &Scene, textures: &Textures, accel: &Accel, job: &Job) -> Vec<Feature> {
    let cell = job.cell;
    let size = Vec2::new(f64::from(job.film.w), f64::from(job.film.h));
    (cell.y0..cell.y1)
        .into_par_iter()
        .rev()
        .flat_map_iter(|y| {
            let mut counters = Counters::default();
            (cell.x0..cell.x1).map(move |x| {
                let center = Vec2::new(f64::from(x), f64::from(y)) + 0.5;
                let mut ray = generate_ray(&job.camera, center / size);
                let hit = accel.closest(scene, &mut ray, None, &mut counters);
                Feature::of(scene, textures, hit)
            })
        })
        .collect()
}

/// The channels of the picture, its features, and the variance of the luminances of each pixel's
/// samples.
pub fn channels(rendered: &Rendered, features: &[Feature], job: &Job) -> Vec<Channel> {
    let cell = job.cell;
    let pixels: Vec<(u32, u32)> = (cell.y0..cell.y1)
        .rev()
        .flat_map(|y| (cell.x0..cell.x1).map(move |x| (x, y)))
        .collect();
    let picture = |c: fn(Spectrum) -> f64| {
        let value = |&(x, y): &(u32, u32)| c(rendered.film.get(x, y).radiance) as f32;
        Values::Float(pixels.iter().map(value).collect())
    };
    let variance = |&(x, y): &(u32, u32)| {
        let i = y as usize * job.film.w as usize + x as usize;
        rendered
            .luminance
            .get(i)
            .map_or(0.0, |tally| tally.variance()) as f32
    };
    let feature =
        |c: fn(&Feature) -> f64| Values::Float(features.iter().map(|f| c(f) as f32).collect());
    let channel = |name, values| Channel { name, values };
    vec![
        channel("R", picture(|c| c.r)),
        channel("G", picture(|c| c.g)),
        channel("B", picture(|c| c.b)),
        channel("albedo.R", feature(|f| f.albedo.r)),
        channel("albedo.G", feature(|f| f.albedo.g)),
        channel("albedo.B", feature(|f| f.albedo.b)),
        channel("normal.X", feature(|f| f.normal.x)),
        channel("normal.Y", feature(|f| f.normal.y)),
        channel("normal.Z", feature(|f| f.normal.z)),
        channel("depth.Z", feature(|f| f.depth)),
        channel(
            "primitive.id",
            Values::Id(features.iter().map(|f| f.prim).collect()),
        ),
        channel(
            "variance.Y",
            Values::Float(pixels.iter().map(variance).collect()),
        ),
    ]
}
