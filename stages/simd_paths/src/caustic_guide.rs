//! Where diffuse surfaces see light through mirrors and smooth glass: directions for caustic rays.
//!
//! Paths from the lamps, which mirrors and glass have led to diffuse surfaces (Jensen, "Importance
//! driven path tracing using the photon map", 1995), are kept by cells of a grid. In each cell they
//! are divided into a few cones. Rays into these have a known density, so that what they find
//! can be combined with what other rays find: the guide decides on the noise, not on the mean.

use kit::{Frame, Vec2, Vec3, warp};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// Where light that has left a mirror or smooth glass reaches a diffuse surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landing {
    /// The point on the diffuse surface.
    pub p: Vec3,
    /// The point where the light has left the mirror or glass.
    pub from: Vec3,
    /// How much light it is, in any unit.
    pub light: f64,
}

/// Directions in which points see light through mirrors or glass, with a density.
#[derive(Clone, Debug, PartialEq)]
pub struct CausticGuide {
    low: Vec3,
    /// Cells per unit of length.
    scale: f64,
    /// The number of cells along each axis.
    size: [usize; 3],
    /// The lobes of each cell, a range.
    cells: Vec<(u32, u32)>,
    lobes: Vec<Lobe>,
}

/// A cone of directions towards a point, all equally likely.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Lobe {
    target: Vec3,
    /// The cosine of the angle between the axis and the edge of the cone, less than 1.
    cos: f64,
    /// The expected number of rays into the cone.
    rays: f64,
}

/// The largest number of cells along the longest side of the grid.
const MAX_CELLS: f64 = 64.0;

/// On average a cell that is not empty has at least as many landings.
const LANDINGS_PER_CELL: usize = 48;

/// Further landings of a cell are left out.
const MAX_LANDINGS: usize = 256;

/// A lobe of fewer landings is left out.
const MIN_LANDINGS: usize = 3;

/// The largest number of lobes of a cell.
const MAX_LOBES: usize = 6;

/// A cone is divided if the two halves together have at most this part of its solid angle.
const MAX_SIZE: f64 = 0.7;

/// The least angle at the edge of a cone, in radians.
const MIN_ANGLE: f64 = 2e-3;

/// Each lobe has at least this part of the rays of an average one.
const MIN_SHARE: f64 = 0.2;

/// The expected number of rays from a point in a cell with as much light as an average one. The
/// numbers of others are in proportion to their light.
const RAYS_OF_MEAN: f64 = 0.25;

/// The least expected number of rays where there are lobes.
const MIN_RAYS: f64 = 0.05;

/// The largest number of rays from a point.
pub const MAX_CAUSTIC_RAYS: usize = 4;

impl CausticGuide {
    /// Divides `landings` into lobes. `None` if there are too few, or if their points are not
    /// finite.
    pub fn new(landings: &[Landing]) -> Option<CausticGuide> {
        let first = landings.first()?.p;
        let fold = |f: fn(Vec3, Vec3) -> Vec3| landings.iter().map(|l| l.p).fold(first, f);
        let (low, high) = (fold(Vec3::min), fold(Vec3::max));
        let extent = (high - low).max_element();
        if !(extent > 0.0 && extent.is_finite()) {
            return None;
        }
        let mut per_side = MAX_CELLS;
        loop {
            let scale = per_side / extent;
            let size = ((high - low) * scale)
                .to_array()
                .map(|cells| cells as usize + 1);
            let mut guide = CausticGuide {
                low,
                scale,
                size,
                cells: vec![(0, 0); size.iter().product()],
                lobes: Vec::new(),
            };
            let by_cell = guide.by_cell(landings);
            let sum: usize = by_cell.values().map(Vec::len).sum();
            if by_cell.len() * LANDINGS_PER_CELL <= sum || per_side < 4.0 {
                let light = |landings: &[Landing]| landings.iter().map(|l| l.light).sum::<f64>();
                let total: f64 = by_cell.values().map(|landings| light(landings)).sum();
                let mean = total / by_cell.len() as f64;
                for (cell, landings) in by_cell {
                    let first = guide.lobes.len() as u32;
                    let rays = (light(&landings) / mean * RAYS_OF_MEAN)
                        .clamp(MIN_RAYS, MAX_CAUSTIC_RAYS as f64);
                    guide.lobes.extend(lobes_of(landings, rays));
                    guide.cells[cell] = (first, guide.lobes.len() as u32);
                }
                return (!guide.lobes.is_empty()).then_some(guide);
            }
            per_side /= 1.25;
        }
    }

    /// The landings in each cell, and up to half a cell around it.
    fn by_cell(&self, landings: &[Landing]) -> BTreeMap<usize, Vec<Landing>> {
        let mut by_cell = BTreeMap::<usize, Vec<Landing>>::new();
        let half = 0.5 / self.scale;
        for landing in landings {
            for corner in 0..8 {
                let side = |axis: u32| if corner >> axis & 1 == 0 { -half } else { half };
                let p = landing.p + Vec3::new(side(0), side(1), side(2));
                if let Some(cell) = self.cell(p) {
                    by_cell.entry(cell).or_default().push(*landing);
                }
            }
        }
        by_cell
    }

    fn cell(&self, p: Vec3) -> Option<usize> {
        let place = ((p - self.low) * self.scale).to_array();
        let mut cell = 0;
        for axis in [2, 1, 0] {
            let (place, size) = (place[axis], self.size[axis]);
            // Also of NaN.
            if !(-0.5 <= place && place < size as f64) {
                return None;
            }
            cell = cell * size + place as usize;
        }
        Some(cell)
    }

    /// The lobes at `p`: none where the guide knows nothing.
    #[inline]
    pub fn lobes_at(&self, p: Vec3) -> Lobes<'_> {
        let (first, end) = self.cell(p).map_or((0, 0), |cell| self.cells[cell]);
        Lobes {
            p,
            lobes: &self.lobes[first as usize..end as usize],
        }
    }
}

/// The lobes at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobes<'a> {
    p: Vec3,
    lobes: &'a [Lobe],
}

impl Lobes<'_> {
    /// The expected number of rays, from 0 to [`MAX_CAUSTIC_RAYS`].
    #[inline]
    pub fn rays(&self) -> f64 {
        self.lobes.iter().map(|lobe| lobe.rays).sum()
    }

    /// The direction of a ray: `u` in [0, 1)² chooses it in a lobe, which `choice` in [0, 1)
    /// chooses. `None` without lobes.
    #[inline]
    pub fn sample(&self, choice: f64, u: Vec2) -> Option<Vec3> {
        let mut left = choice * self.rays();
        let chosen = self.lobes.iter().find(|lobe| {
            left -= lobe.rays;
            left < 0.0
        });
        let lobe = chosen.or(self.lobes.last())?;
        let axis = (lobe.target - self.p).try_normalize()?;
        let z = 1.0 - u.x * (1.0 - lobe.cos);
        Some(Frame::around(axis).to_world(warp::on_sphere(z, u.y)))
    }

    /// The expected number of rays along the unit vector `d`, per steradian.
    #[inline]
    pub fn density(&self, d: Vec3) -> f64 {
        let density = |lobe: &Lobe| {
            let axis = lobe.target - self.p;
            let is_inside = axis.dot(d) >= lobe.cos * axis.length();
            f64::from(u8::from(is_inside)) * lobe.rays / (TAU * (1.0 - lobe.cos))
        };
        self.lobes.iter().map(density).sum()
    }
}

/// Divides the landings of a cell into few narrow cones.
fn lobes_of(landings: Vec<Landing>, rays: f64) -> Vec<Lobe> {
    let step = landings.len().div_ceil(MAX_LANDINGS);
    let mut open = vec![Cluster::new(landings.into_iter().step_by(step).collect())];
    let mut done = Vec::new();
    while let Some(cluster) = open.pop() {
        let halves = match open.len() + done.len() + 1 < MAX_LOBES {
            true => cluster.halves(),
            false => None,
        };
        match halves {
            Some(halves) => open.extend(halves),
            None => done.push(cluster),
        }
        open.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    }
    done.retain(|cluster| cluster.landings.len() >= MIN_LANDINGS);
    let light = |cluster: &Cluster| cluster.landings.iter().map(|l| l.light).sum::<f64>();
    let total: f64 = done.iter().map(light).sum();
    let least = MIN_SHARE * total / done.len() as f64;
    let shares: Vec<f64> = done
        .iter()
        .map(|cluster| light(cluster).max(least))
        .collect();
    let total: f64 = shares.iter().sum();
    let lobe = |(cluster, share): (&Cluster, f64)| Lobe {
        target: cluster.target,
        cos: cluster.edge().cos(),
        rays: rays * share / total,
    };
    done.iter().zip(shares).map(lobe).collect()
}

/// Landings that a cone contains.
struct Cluster {
    landings: Vec<Landing>,
    target: Vec3,
    /// The largest angle between the direction of a landing and that towards `target`.
    angle: f64,
}

impl Cluster {
    fn new(landings: Vec<Landing>) -> Cluster {
        let target = landings.iter().map(|l| l.from).sum::<Vec3>() / landings.len() as f64;
        let angle = |l: &Landing| (l.from - l.p).angle_between(target - l.p);
        Cluster {
            angle: landings.iter().map(angle).fold(0.0, f64::max),
            target,
            landings,
        }
    }

    /// The angle at the edge of the cone: larger than those of the landings, the fewer there are
    /// the more.
    fn edge(&self) -> f64 {
        let margin = 1.0 + 2.0 / (self.landings.len() as f64).sqrt();
        (self.angle * margin).clamp(MIN_ANGLE, PI)
    }

    /// Its landings by the nearer of two directions, if these cones are together much smaller.
    fn halves(&self) -> Option<[Cluster; 2]> {
        let direction = |l: &Landing| (l.from - l.p).normalize_or_zero();
        let directions: Vec<Vec3> = self.landings.iter().map(direction).collect();
        let farthest = |from: Vec3| {
            let nearer = |a: &&Vec3, b: &&Vec3| b.dot(from).total_cmp(&a.dot(from));
            directions.iter().max_by(nearer).copied()
        };
        let mut centers = [farthest(*directions.first()?)?; 2];
        centers[1] = farthest(centers[0])?;
        let mut sides = [const { Vec::new() }; 2];
        for _ in 0..4 {
            sides = [const { Vec::new() }; 2];
            let mut sums = [Vec3::ZERO; 2];
            for (landing, &d) in self.landings.iter().zip(&directions) {
                let side = usize::from(d.dot(centers[1]) > d.dot(centers[0]));
                sides[side].push(*landing);
                sums[side] += d;
            }
            centers = sums.map(Vec3::normalize_or_zero);
        }
        if sides.iter().any(|side| side.len() < MIN_LANDINGS) {
            return None;
        }
        let halves = sides.map(Cluster::new);
        let size = |cluster: &Cluster| 1.0 - cluster.edge().cos();
        (halves.iter().map(size).sum::<f64>() < MAX_SIZE * size(self)).then_some(halves)
    }
}
