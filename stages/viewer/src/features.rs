//! Which features work, and which task the others wait for.
//!
//! Each feature is tried once, on a picture of one pixel: the hole that it runs into names the
//! task.

use crate::task::{StageFailure, guarded};
use kit::scene::{NamedLight, NamedMaterial, Object};
use kit::{Camera, FilmSize, Light, Mat3, Material, Scene, Spectrum, Triangle, Vec3};
use pathtracer::args::Shade;
use pathtracer::{
    AccelKind, DirectSampling, Job, LightSettings, Picture, PreparedScene, ProgressiveRender,
    Textures,
};
use std::sync::atomic::AtomicBool;

/// What may wait for a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// Any picture: camera rays, intersections, the tree.
    Pictures,
    /// Light, sampled at the lights.
    Light,
    /// Light, sampled over the hemisphere.
    Hemisphere,
    /// Multiple importance sampling.
    Mis,
    /// A ray depth of more than 1.
    Bounces,
    /// Adaptive sampling.
    Adaptive,
    /// The wide tree.
    WideTree,
}

impl Feature {
    /// All features.
    pub const ALL: [Feature; 7] = [
        Feature::Pictures,
        Feature::Light,
        Feature::Hemisphere,
        Feature::Mis,
        Feature::Bounces,
        Feature::Adaptive,
        Feature::WideTree,
    ];

    /// Its name in the window.
    pub fn name(self) -> &'static str {
        match self {
            Feature::Pictures => "pictures",
            Feature::Light => "light",
            Feature::Hemisphere => "hemisphere sampling",
            Feature::Mis => "multiple importance sampling",
            Feature::Bounces => "ray depth above 1",
            Feature::Adaptive => "adaptive sampling",
            Feature::WideTree => "the wide tree",
        }
    }

    /// Why it does not work; `None` if it does.
    pub fn missing(self) -> Option<StageFailure> {
        guarded(|| self.run()).err()
    }

    /// Renders a pixel with the feature.
    fn run(self) {
        let default = LightSettings::default();
        let settings = match self {
            Feature::Pictures | Feature::Light | Feature::WideTree => default,
            Feature::Hemisphere => LightSettings {
                direct_sampling: DirectSampling::Hemisphere,
                ..default
            },
            Feature::Mis => LightSettings {
                direct_sampling: DirectSampling::Mis,
                ..default
            },
            Feature::Bounces => LightSettings {
                max_depth: 2,
                ..default
            },
            Feature::Adaptive => LightSettings {
                adaptive: Some((1, 0.1)),
                ..default
            },
        };
        let (shade, kind) = match self {
            Feature::Pictures => (Shade::Normals, AccelKind::Bvh),
            Feature::WideTree => (Shade::Normals, AccelKind::Simd),
            _ => (Shade::Lit, AccelKind::Bvh),
        };
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

/// The features that do not work, and why.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MissingFeatures(Vec<(Feature, StageFailure)>);

impl MissingFeatures {
    /// Tries all features.
    pub fn find() -> MissingFeatures {
        let all = Feature::ALL.into_iter();
        MissingFeatures(all.filter_map(|f| Some((f, f.missing()?))).collect())
    }

    /// Why a feature does not work; `None` if it does.
    pub fn why(&self, feature: Feature) -> Option<&StageFailure> {
        let found = self.0.iter().find(|(missing, _)| *missing == feature);
        found.map(|(_, why)| why)
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &(Feature, StageFailure)> {
        self.0.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_feature_is_named() {
        let hole = guarded(|| -> () { kit::hole!("part3.task2") }).expect_err("a hole");
        let missing = MissingFeatures(vec![(Feature::Hemisphere, hole)]);
        let why = missing.why(Feature::Hemisphere).expect("it is missing");
        assert_eq!(why.to_string(), "part3.task2 is not written yet");
        assert_eq!(missing.why(Feature::Light), None);
    }
}
