//! What a replay records.

use crate::Counters;
use crate::tracer::RayRole;
use kit::{Aabb, Hit, PixelEstimate, PrimId, Ray, Spectrum, Tally, Vec2};

/// A pixel whose samples were traced again.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelReplay {
    /// Column and row, from the bottom left.
    pub pixel: (u32, u32),
    /// The mean of the samples: the pixel of the picture, bit for bit.
    pub estimate: PixelEstimate,
    /// The luminances of the samples; `None` for normals.
    pub luminance: Option<Tally>,
    /// Rays and tests of all samples.
    pub counters: Counters,
    /// The samples, in order.
    pub samples: Vec<SampleRecord>,
}

/// One camera sample: a path and its light rays.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleRecord {
    /// The position on the film, in [0, 1]² from the bottom left.
    pub sensor: Vec2,
    /// The radiance of its path.
    pub of_path: Spectrum,
    /// The radiance of the sample: in a pixel at the edge of a lamp that of the path with the light
    /// of lamps as the mean of several camera rays, which are not recorded.
    pub radiance: Spectrum,
    /// Its rays, in the order in which they were traced. Empty beyond
    /// [`MAX_RECORDED_SAMPLES`](super::MAX_RECORDED_SAMPLES).
    pub rays: Vec<RayRecord>,
    /// The roulettes that its path played, in order; none if roulette is switched off.
    pub roulettes: Vec<Roulette>,
}

impl SampleRecord {
    /// The index of the last ray of the path, not of its light.
    pub fn last_of_path(&self) -> Option<usize> {
        let is_path = |ray: &RayRecord| matches!(ray.role, RayRole::Camera | RayRole::Bounce);
        self.rays.iter().rposition(is_path)
    }

    /// The roulette that was played where a ray hit.
    pub fn roulette_after(&self, ray: usize) -> Option<&Roulette> {
        self.roulettes.iter().find(|roulette| roulette.ray == ray)
    }
}

/// Russian roulette, played before a path leaves a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roulette {
    /// The index of the ray that hit the surface.
    pub ray: usize,
    /// The throughput before it.
    pub throughput: Spectrum,
    /// The throughput after it; `None` if the path ends.
    pub survivor: Option<Spectrum>,
}

/// One ray and its tests.
#[derive(Clone, Debug, PartialEq)]
pub struct RayRecord {
    /// Why it was traced.
    pub role: RayRole,
    /// The number of surfaces between the camera and its origin: 0 for a camera ray.
    pub depth: u32,
    /// The index of the ray that hit the surface where this one starts.
    pub parent: Option<usize>,
    /// The ray before it was traced.
    pub ray: Ray,
    /// The primitive that it leaves and cannot hit.
    pub skip: Option<PrimId>,
    /// What it found.
    pub outcome: Outcome,
    /// The tests, in order.
    pub tests: Vec<Test>,
}

/// What a ray found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// The closest hit.
    Hit(Hit),
    /// No hit.
    Miss,
    /// A shadow ray: something is in the way. Traversal ends with the first such primitive.
    Blocked,
    /// A shadow ray: nothing is in the way.
    Unblocked,
}

impl RayRecord {
    /// The end of the ray in a drawing: the hit, or its `max_t`; `None` if that is far away.
    pub fn end(&self) -> Option<f64> {
        match self.outcome {
            Outcome::Hit(hit) => Some(hit.t),
            _ => (self.ray.max_t < 1e15).then_some(self.ray.max_t),
        }
    }

    /// The numbers of box tests and primitive tests. A skipped primitive is not tested.
    pub fn test_counts(&self) -> (usize, usize) {
        let boxes = self.tests.iter();
        let boxes = boxes.filter(|test| matches!(test, Test::Box { .. }));
        let prims = self.tests.iter().filter(
            |test| matches!(test, Test::Primitive { answer, .. } if *answer != PrimAnswer::Skipped),
        );
        (boxes.count(), prims.count())
    }
}

/// A test of one ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Test {
    /// Of the box of a node.
    Box {
        /// The node of the tree with this box; `None` if there is none.
        node: Option<u32>,
        /// The box.
        bounds: Aabb,
        /// The end of the ray's range in this test.
        max_t: f64,
        /// The result.
        visit: Visit,
    },
    /// Of a primitive.
    Primitive {
        /// Which one.
        prim: PrimId,
        /// The end of the ray's range in this test.
        max_t: f64,
        /// The result.
        answer: PrimAnswer,
    },
}

/// The result of a box test, and what followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Visit {
    /// The ray enters the box at `entry`, and what it contains was tested.
    Entered {
        /// Start of the interval inside the box.
        entry: f64,
        /// End of the interval.
        exit: f64,
    },
    /// The ray passes the box.
    Missed,
    /// The ray would enter the box only at `entry`, beyond its `max_t`.
    Behind {
        /// Where the ray would enter.
        entry: f64,
    },
    /// The ray enters the box, but nothing in it was tested: meanwhile a nearer hit was found.
    Pruned {
        /// Start of the interval inside the box.
        entry: f64,
        /// End of the interval.
        exit: f64,
    },
}

/// The result of a primitive test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PrimAnswer {
    /// No hit in the ray's range.
    Miss,
    /// A hit at this `t`.
    Hit(f64),
    /// Any hit, of a shadow ray.
    Blocks,
    /// Not tested: the ray starts on this primitive.
    Skipped,
}
