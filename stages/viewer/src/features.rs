//! Which features work, and which task the others wait for.
//!
//! Each feature is tried once, on a picture of one pixel: the hole that it runs into names the
//! task.

use crate::task::{StageFailure, guarded};
use pathtracer::args::Shade;
use pathtracer::{AccelKind, DirectSampling, LightSettings, trial};

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
        trial::render_pixel(shade, kind, settings);
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
