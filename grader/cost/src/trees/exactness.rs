//! What exactness costs a tree: time, missed and false hits of the same tree with the tests and the
//! precision that others use.

use crate::leaks::ClosedMesh;
use crate::measure_kernels::precision;
use crate::quartiles::Quartiles;
use crate::report::Precision;
use crate::timing::Timing;
use judge::cases::probes::{ProbeRng, through};
use kernels::{ClosestHit, RoundedTree, brute_force};
use kit::{Ray, Triangle};
use serde::{Deserialize, Serialize};

/// Results for one tree, with one pair of tests in one precision.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ExactnessRow {
    /// The rule that splits a node of the tree.
    pub split: String,
    /// Name of the box test.
    pub box_test: String,
    /// Name of the triangle test.
    pub triangle_test: String,
    /// What boxes, triangles and rays are stored and computed in.
    pub precision: Precision,
    /// Slack of the pruning, in units in the last place of the precision.
    pub slack_ulp: u32,
    /// Time per ray. Its ratio is to the time of the first row, which is exact.
    pub time: Timing,
    /// Rays that were compared with brute force, or with the exact tree. Half of them are aimed at
    /// an edge.
    pub rays: usize,
    /// Rays that pass through the surface that they hit: a miss, or a hit farther away.
    pub missed: usize,
    /// Rays with a hit where there is none, or nearer than the closest.
    pub wrong: usize,
    /// Rays that were aimed exactly at vertices, edges and diagonals of an integer terrain.
    pub grid_rays: usize,
    /// Those of them whose hit is not that of brute force.
    pub grid_lost: usize,
}

impl ExactnessRow {
    /// A row whose hits are not counted yet.
    pub(super) fn new(split: &str, tree: &RoundedTree, time: Timing) -> ExactnessRow {
        ExactnessRow {
            split: split.into(),
            box_test: tree.box_test.into(),
            triangle_test: tree.triangle_test.into(),
            precision: precision(tree.precision),
            slack_ulp: tree.slack_ulp,
            time,
            ..ExactnessRow::default()
        }
    }

    /// Whether a ray has another hit than the exact one: at the mesh, or at the integer terrain.
    pub fn loses(&self) -> bool {
        self.missed + self.wrong + self.grid_lost > 0
    }

    /// Millions of rays in a second.
    pub fn rate(&self) -> Quartiles {
        let ns = &self.time.ns;
        Quartiles {
            lower: 1e3 / ns.upper,
            median: 1e3 / ns.median,
            upper: 1e3 / ns.lower,
        }
    }

    /// Rays with another hit than the exact one, in a million: at the mesh or at the integer
    /// terrain, where more are lost.
    pub fn worst_per_million(&self) -> f64 {
        self.lost_per_million().max(self.grid_lost_per_million())
    }

    /// Rays with another hit than the exact one, in a million.
    pub fn lost_per_million(&self) -> f64 {
        in_a_million(self.missed + self.wrong, self.rays)
    }

    /// Lost rays at the integer terrain, in a million.
    pub fn grid_lost_per_million(&self) -> f64 {
        in_a_million(self.grid_lost, self.grid_rays)
    }
}

/// Scales a count of `rays` rays to a million.
pub(crate) fn in_a_million(count: usize, rays: usize) -> f64 {
    1e6 * count as f64 / rays.max(1) as f64
}

/// A `t` that differs by less than this share is the same hit: a ray that is aimed at an edge may
/// hit either triangle, and single precision rounds the vertices.
const SAME_T: f64 = 1e-4;

/// The distance of the origins, which is outside of the mesh.
const DISTANCE: f64 = 3.0;

/// Rays at random triangles from all directions: at their insides and, every other one, at an edge.
pub(super) fn rays(triangles: &[Triangle], seed: u64, count: usize) -> Vec<Ray> {
    let mut dice = ProbeRng::new("cost exactness", seed);
    let rays = (0..count).map(|i| {
        let triangle = &triangles[dice.below(triangles.len())];
        let (mut b1, mut b2) = (dice.range(0.0, 1.0), dice.range(0.0, 1.0));
        if b1 + b2 > 1.0 {
            (b1, b2) = (1.0 - b1, 1.0 - b2);
        }
        if i % 2 == 1 {
            b2 = 0.0;
        }
        let [e1, e2] = [triangle.p1 - triangle.p0, triangle.p2 - triangle.p0];
        let target = triangle.p0 + b1 * e1 + b2 * e2;
        through(target + DISTANCE * dice.direction(), target)
    });
    rays.collect()
}

/// Counts the lost hits of `closest`, a traversal of the tree of `row`.
pub(super) fn count(
    row: &mut ExactnessRow,
    mut closest: impl FnMut(&Ray) -> ClosestHit,
    rays: &[Ray],
    truth: &[ClosestHit],
) {
    row.rays = rays.len();
    for (ray, truth) in rays.iter().zip(truth) {
        match (closest(ray), truth) {
            (Some((t, _)), Some((truth, _))) => {
                let share = t / truth - 1.0;
                row.missed += usize::from(share > SAME_T);
                row.wrong += usize::from(share < -SAME_T);
            }
            (None, Some(_)) => row.missed += 1,
            (Some(_), None) => row.wrong += 1,
            (None, None) => {}
        }
    }
}

/// The integer terrain of [`ClosedMesh::grid`] with the hits of its rays. A box test computes 0/0
/// or 0 times infinity for them.
pub(super) struct Grid {
    pub(super) triangles: Vec<Triangle>,
    rays: Vec<(Ray, ClosestHit)>,
}

impl Grid {
    pub(super) fn new(seed: u64) -> Grid {
        let ClosedMesh { triangles, rays } = ClosedMesh::grid(seed);
        let hits = rays
            .iter()
            .map(|(ray, _)| (*ray, brute_force(&triangles, ray)));
        Grid {
            rays: hits.collect(),
            triangles,
        }
    }

    /// Counts the lost hits of `closest`, a traversal of a tree over the terrain.
    pub(super) fn count(
        &self,
        row: &mut ExactnessRow,
        mut closest: impl FnMut(&Ray) -> ClosestHit,
    ) {
        let t = |hit: ClosestHit| hit.map(|(t, _)| t);
        let lost = self
            .rays
            .iter()
            .filter(|(ray, hit)| t(closest(ray)) != t(*hit));
        row.grid_lost = lost.count();
        row.grid_rays = self.rays.len();
    }
}
