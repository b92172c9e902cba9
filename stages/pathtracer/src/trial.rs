//! A picture of one pixel, to find out whether the stages for it are written.

use crate::args::Shade;
use crate::{AccelKind, Job, LightSettings, Picture, PreparedScene, ProgressiveRender, Textures};
use kit::hole::Hole;
use kit::scene::{NamedLight, NamedMaterial, Object};
use kit::{Camera, FilmSize, Light, Mat3, Material, Scene, Spectrum, Triangle, Vec3};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::AtomicBool;

/// Renders a pixel of a lit triangle. Unwinds at the first hole, as every picture does.
pub fn render_pixel(shade: Shade, kind: AccelKind, settings: LightSettings) {
    let picture = Picture::new(shade, lit_triangle(), None);
    let prepared = PreparedScene::new(picture, Textures::default(), kind);
    let film = FilmSize { w: 1, h: 1 };
    let job = Job {
        camera: Camera {
            pos: Vec3::Z,
            c2w: Mat3::IDENTITY,
            h_fov: 40.0,
            v_fov: 40.0,
            n_clip: 0.0,
            f_clip: 10.0,
        },
        film,
        cell: film.whole(),
        samples: 2,
        sampling: 0.into(),
    };
    let mut render = ProgressiveRender::new(&prepared, job, settings);
    render.run(&prepared, 1, &AtomicBool::new(false));
}

/// The task that pictures of light wait for, if pictures of normals can be rendered. `None` if light
/// can be rendered as well, or if either fails in another way, which the picture itself will report.
pub fn light_waits_for(kind: AccelKind, settings: &LightSettings) -> Option<Hole> {
    let settings = LightSettings {
        direct_sampling: settings.direct_sampling,
        ..LightSettings::default()
    };
    let fails = |shade| {
        let trial = || render_pixel(shade, kind, settings);
        catch_unwind(AssertUnwindSafe(trial)).err()
    };
    let of_light = fails(Shade::Lit)?;
    let hole = of_light.downcast_ref::<Hole>().copied();
    hole.filter(|_| fails(Shade::Normals).is_none())
}

/// A triangle in front of the camera, and a lamp.
fn lit_triangle() -> Scene {
    let corner = |x, y| Vec3::new(x, y, 0.0);
    let grey = Material::Diffuse {
        reflectance: Spectrum::grey(0.5),
    };
    Scene {
        triangles: vec![Triangle::flat(
            corner(-3.0, -3.0),
            corner(3.0, -3.0),
            corner(0.0, 3.0),
        )],
        object_of: vec![0],
        objects: vec![Object {
            name: "triangle".to_owned(),
            material: 0,
        }],
        materials: vec![NamedMaterial {
            name: "grey".to_owned(),
            material: grey,
        }],
        lights: vec![NamedLight {
            name: "lamp".to_owned(),
            light: Light::Point {
                position: Vec3::Z,
                intensity: Spectrum::WHITE,
            },
        }],
        ..Scene::default()
    }
}

// BEGIN SOLUTION(part4.task3)
#[cfg(test)]
mod tests {
    use super::*;
    use crate::DirectSampling;

    #[test]
    fn in_the_full_course_light_waits_for_nothing() {
        for direct_sampling in [
            DirectSampling::Lights,
            DirectSampling::Hemisphere,
            DirectSampling::Mis,
        ] {
            let settings = LightSettings {
                direct_sampling,
                ..LightSettings::default()
            };
            assert_eq!(light_waits_for(AccelKind::Bvh, &settings), None);
        }
    }
}
// END SOLUTION(part4.task3)
