//! A scene that paths are followed through, eight at a time.

// BEGIN SOLUTION(part6.task2)
use crate::batch::{BATCH, Batch};
use crate::facts::{Does, Facts, deed};
use crate::room::{Room, Scratch};
use crate::{camera, follow};
use fearless_simd::dispatch;
// END SOLUTION(part6.task2)

use crate::{Level, Neighbours};
use kit::{Camera, FilmSize, LitScene, PixelSampler, PrimId, Spectrum, Vec3};

/// A scene made ready to be followed through.
#[derive(Clone, Debug)]
pub struct PathScene<'a> {
    /// The scene.
    pub lit: &'a LitScene,
    // BEGIN SOLUTION(part6.task2)
    pub(crate) facts: Vec<Facts>,
    /// What each material does, and in which colour.
    pub(crate) deeds: Vec<(Does, Spectrum)>,
    /// If there are few primitives; else `others` walk their tree.
    pub(crate) room: Option<Room>,
    pub(crate) has_background: bool,
    /// Whether every triangle has one normal at its three vertices.
    pub(crate) is_faceted: bool,
    level: Level,
    // STUB: // Whatever you need.
    // END SOLUTION(part6.task2)
}

/// How paths are followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathSettings {
    /// Samples per light with an extent (`-l`).
    pub light_samples: u32,
    /// Rays on a path at most (`-m`), at least 1.
    pub max_depth: u32,
    /// Bounces that a path makes before it plays roulette; `None` if it never does.
    pub first_game: Option<u32>,
}

/// What paths start from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The camera.
    pub camera: Camera,
    /// The whole film's size.
    pub film: FilmSize,
    /// Whether a path goes through its pixel's centre; else through a place that its sampler gives.
    pub centered: bool,
}

/// A path to be: column and row of its pixel, and the sampler, which has started the sample and drawn nothing of it yet.
pub type Start = ((u32, u32), PixelSampler);

/// How often what was done; what `others` did is not in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Rays traced.
    pub rays: u64,
    /// Of these, rays towards light.
    pub light_rays: u64,
    /// Rays that missed everything in a scene with a background.
    pub background: u64,
    /// Bounces.
    pub bounces: u64,
    /// Ray/primitive tests.
    pub prim_tests: u64,
}

/// Memory for a thread to work in.
#[derive(Clone, Debug, Default)]
pub struct PathBatch {
    // BEGIN SOLUTION(part6.task2)
    pub(crate) batch: Batch,
    pub(crate) scratch: Scratch,
    // END SOLUTION(part6.task2)
    /// What was done so far.
    pub counts: Counts,
}

impl<'a> PathScene<'a> {
    /// Makes `lit` ready; `ng` gives a triangle's geometric normal. `None` if its paths are better followed one at a time.
    pub fn new(lit: &'a LitScene, ng: impl Fn(PrimId) -> Vec3) -> Option<PathScene<'a>> {
        // BEGIN SOLUTION(part6.task2)
        let scene = &lit.scene;
        // The plain kernel has ways of its own for spheres without extent and of extreme size.
        if scene.spheres.iter().any(|s| !ORDINARY.contains(&s.radius)) {
            return None;
        }
        let facts = (0..scene.len() as u32).map(PrimId);
        let facets = |t: &kit::Triangle| t.n0 == t.n1 && t.n0 == t.n2;
        Some(PathScene {
            facts: facts.map(|id| Facts::of(lit, id, ng(id))).collect(),
            deeds: scene.materials.iter().map(|m| deed(&m.material)).collect(),
            room: Room::new(scene),
            has_background: lit.has_background(),
            is_faceted: scene.triangles.iter().all(facets),
            level: Level::new(),
            lit,
        })
        // STUB: kit::untouched!("part6.task2");
        // STUB: let _ = (lit, ng);
        // STUB: None
        // END SOLUTION(part6.task2)
    }

    /// The same scene, followed through with the instructions of `level` instead of the best that this machine has. It gives
    /// the same.
    #[must_use]
    pub fn at_level(self, level: Level) -> PathScene<'a> {
        // BEGIN SOLUTION(part6.task2)
        PathScene { level, ..self }
        // STUB: kit::hole!("part6.task2", self, level)
        // END SOLUTION(part6.task2)
    }

    /// The radiance that each of `starts` sees: what `raygen` and `global` would find one path at a time, with direct light by
    /// sampling the lights.
    pub fn follow(
        &self,
        view: &View,
        settings: &PathSettings,
        starts: &[Start],
        work: &mut PathBatch,
        others: &mut impl Neighbours,
    ) -> Vec<Spectrum> {
        // BEGIN SOLUTION(part6.task2)
        let mut seen = vec![Spectrum::BLACK; starts.len()];
        for (starts, seen) in starts.chunks(BATCH).zip(seen.chunks_mut(BATCH)) {
            dispatch!(self.level, simd => {
                camera::start(simd, view, starts, &mut work.batch);
                follow::follow(simd, self, settings, view, work, others, seen);
            });
        }
        seen
        // STUB: kit::hole!("part6.task2", self, view, settings, starts, work, others)
        // END SOLUTION(part6.task2)
    }
}

// BEGIN SOLUTION(part6.task2)
/// Radii of spheres whose squares, and those of places on them in radii, neither overflow nor underflow.
const ORDINARY: std::ops::Range<f64> = 1e-100..1e100;
// END SOLUTION(part6.task2)
