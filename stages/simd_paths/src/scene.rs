//! A scene that paths are followed through, eight at a time.

// BEGIN SOLUTION(part6.task2)
use crate::batch::Batch;
use crate::deed::{Does, deed};
use crate::room::{Room, Scratch};
use crate::{camera, follow};
use fearless_simd::dispatch;
use kit::{PrimId, Triangle};
// END SOLUTION(part6.task2)

use crate::{Level, Neighbours};
use kit::{Camera, FilmSize, LitScene, PixelSampler, Spectrum};

/// A scene made ready to be followed through.
#[derive(Clone, Debug)]
pub struct PathScene<'a> {
    /// The scene.
    pub lit: &'a LitScene,
    // BEGIN SOLUTION(part6.task2)
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
    /// Whether surfaces carry pictures: others know what these show.
    pub has_textures: bool,
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
    /// Whether the camera has a lens: others send rays through it.
    pub has_lens: bool,
    /// Whether a path goes through its pixel's centre; else through a place that its sampler gives.
    pub centered: bool,
}

/// A path to be: column and row of its pixel, and the sampler, which has drawn nothing of its sample yet.
pub type Start = ((u32, u32), PixelSampler);

/// How often what was done. Rays that others traced when they were asked to are in it, their tests are not; nor is what others
/// did with the paths that they took on.
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

/// Paths are followed so many at a time, in groups of eight: whoever starts as many wastes the fewest lanes.
pub const BATCH: usize = 64;

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
    /// Makes `lit` ready. `None` as long as paths are followed one at a time.
    pub fn new(lit: &'a LitScene) -> Option<PathScene<'a>> {
        // BEGIN SOLUTION(part6.task2)
        let scene = &lit.scene;
        Some(PathScene {
            deeds: scene.materials.iter().map(|m| deed(&m.material)).collect(),
            room: Room::new(scene),
            has_background: lit.has_background(),
            is_faceted: scene.triangles.iter().all(is_faceted),
            level: Level::new(),
            lit,
        })
        // STUB: kit::untouched!("part6.task2");
        // STUB: let _ = lit;
        // STUB: None
        // END SOLUTION(part6.task2)
    }

    // BEGIN SOLUTION(part6.task2)
    /// What primitive number `id` does with light, and in which colour.
    #[inline(always)]
    pub(crate) fn deed_of(&self, id: usize) -> (Does, Spectrum) {
        self.deeds[self.lit.scene.material_number(PrimId(id as u32))]
    }
    // END SOLUTION(part6.task2)

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
                camera::start(simd, view, starts, &mut work.batch, others);
                follow::follow(simd, self, settings, view, work, others, seen);
            });
        }
        seen
        // STUB: kit::hole!("part6.task2", self, view, settings, starts, work, others)
        // END SOLUTION(part6.task2)
    }
}

// BEGIN SOLUTION(part6.task2)
/// Whether the normals at the three vertices are one, to the sign of a 0.
fn is_faceted(t: &Triangle) -> bool {
    let [n0, n1, n2] = [t.n0, t.n1, t.n2].map(|n| n.to_array().map(f64::to_bits));
    n0 == n1 && n0 == n2
}
// END SOLUTION(part6.task2)
