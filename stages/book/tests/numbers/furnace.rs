//! A closed room in which every surface emits 1, by the path tracer of the reference.

use super::claims::Claim;
use global::estimate_radiance;
use kit::scene::{NamedMaterial, Object};
use kit::{
    BsdfSample, Hit, LitScene, Material, PixelSampler, PrimId, Ray, Scattering, Scene, Spectrum,
    Triangle, Vec2, Vec3,
};

/// A surface that sends on the light of one direction.
struct Straight(f64);

impl Scattering for Straight {
    fn f(&self, _: &Material, _: Vec3, _: Vec3) -> Spectrum {
        Spectrum::BLACK
    }

    fn pdf(&self, _: &Material, _: Vec3, _: Vec3) -> f64 {
        0.0
    }

    fn sample(&self, _: &Material, _: Vec3, _: Vec2, _: f64) -> Option<BsdfSample> {
        Some(BsdfSample {
            wi: Vec3::Z,
            f: Spectrum::grey(self.0),
            pdf: 1.0,
            delta: false,
        })
    }
}

/// The radiance in the room with the reflectance `reflected` and paths of at most `rays` rays. The
/// emission of the first surface is added here; that of all others is direct light.
pub(super) fn radiance(reflected: f64, rays: u32) -> f64 {
    let grey = Material::Diffuse {
        reflectance: Spectrum::grey(reflected),
    };
    let scene = Scene {
        triangles: vec![Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y)],
        object_of: vec![0],
        objects: vec![Object {
            name: "wall".into(),
            material: 0,
        }],
        materials: vec![NamedMaterial {
            name: "grey".into(),
            material: grey,
        }],
        ..Scene::default()
    };
    let wall = Hit {
        t: 1.0,
        p: Vec3::new(0.25, 0.25, 0.0),
        n: Vec3::Z,
        ng: Vec3::Z,
        uv: Vec2::new(0.25, 0.25),
        prim: PrimId(0),
    };
    let scattered = estimate_radiance(
        &LitScene::new(scene, None),
        &Ray::new(Vec3::new(0.25, 0.25, 1.0), -Vec3::Z),
        rays,
        &mut PixelSampler::new(0, 0, 1),
        &Straight(reflected),
        &mut |_| Some(wall),
        &mut |_, _, _| Spectrum::grey(reflected),
        &mut |throughput, _, _| Some(throughput),
    );
    1.0 + scattered.g
}

pub(super) fn claims() -> Vec<Claim> {
    let whole = radiance(0.5, 60);
    let bright = radiance(0.8, 400);
    let lost = 100.0 * (1.0 - radiance(0.8, 10) / bright);
    vec![
        (
            "debugging.md",
            format!(
                "In a closed room that emits 1 and reflects 0.5, everything has the radiance {whole}"
            ),
        ),
        (
            "part4/task2.md",
            format!("If your code gives {} it bounces once", radiance(0.5, 1)),
        ),
        (
            "part4/task3.md",
            format!("with $\\rho = 0.8$, a limit of 10 rays cuts off {lost:.0} % of the light"),
        ),
    ]
}
