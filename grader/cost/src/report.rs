//! The results of `grader cost`: the data of the table, the JSON and the page.
//!
//! Every number is finite. Counts named `per_million` are scaled to a million rays. Times depend on
//! the machine and vary from run to run; all other numbers depend only on the seed.

use super::picture::PictureReport;
use super::trees::TreeReport;
use super::world::WorldReport;
use serde::{Deserialize, Serialize};

pub use super::precision::Precision;
pub use super::ray_family::RayFamily;
pub use super::timing::Timing;

/// The results of one run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CostReport {
    /// The machine that the times were measured on.
    pub machine: Machine,
    /// Seed of the random rays.
    pub seed: u64,
    /// Whether fewer rays and rounds were used (`--quick`).
    pub quick: bool,
    /// The kernels of each shape.
    pub families: Vec<KernelFamily>,
    /// Trees, if requested.
    pub bvh: Option<TreeReport>,
    /// Pictures, if requested.
    pub pictures: Option<PictureReport>,
    /// Hard cases beside real ray casters, if requested.
    pub world: Option<WorldReport>,
}

/// The machine that the times were measured on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// Name of the processor.
    pub cpu: String,
    /// Number of hardware threads. Kernels are timed on one.
    pub cores: usize,
    /// Version of the compiler.
    pub rustc: String,
    /// The target features that the compiler used, such as `sse2`.
    pub target_features: Vec<String>,
    /// Whether the processor has a fused multiply-add instruction.
    pub has_fma: bool,
}

/// The shapes whose kernels are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// Part 1, task 3.
    Triangle,
    /// Part 1, task 4.
    Sphere,
    /// Part 2, task 2.
    Box,
}

impl Shape {
    /// All shapes, in the order of the course.
    pub const ALL: [Shape; 3] = [Shape::Triangle, Shape::Sphere, Shape::Box];

    /// The name in lower case, as on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Shape::Triangle => "triangle",
            Shape::Sphere => "sphere",
            Shape::Box => "box",
        }
    }
}

/// The kernels of one shape.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KernelFamily {
    /// The shape.
    pub shape: Shape,
    /// The families of rays, in the order of [`KernelRow::by_ray_family`].
    pub columns: Vec<RayColumn>,
    /// The kernels: the textbook's in `f64` first, the student's last.
    pub rows: Vec<KernelRow>,
    /// Why there is no row for the student's kernel, if there is none.
    pub student_missing: Option<String>,
    /// The pixels of the picture of leaks in which rays pass through the mesh with the student's
    /// kernel. Triangles only; not part of the JSON.
    #[serde(skip)]
    pub student_leaks: Option<Vec<u32>>,
}

/// A family of rays with its description.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RayColumn {
    /// The family.
    pub family: RayFamily,
    /// What makes these rays hard for this shape.
    pub about: String,
}

/// The results of one kernel.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct KernelRow {
    /// The name; rows with the same name differ in precision.
    pub name: String,
    /// The precision.
    pub precision: Precision,
    /// The publication.
    pub paper: String,
    /// Whether this is the student's kernel.
    pub student: bool,
    /// Whether this is the kernel that times are compared with.
    pub textbook: bool,
    /// Whether the kernel contains fused multiply-adds, perhaps only for rare rays; unknown for the
    /// student's kernel, which counts as one without.
    pub uses_fma: bool,
    /// Time of hit or miss, `t` and hit point for one ordinary ray, with the instructions that the
    /// program is built for. Its ratio is to the time of the textbook's kernel.
    pub time: Timing,
    /// The same with AVX2 and FMA, found at run time; the ratio is to the textbook's kernel with
    /// these instructions, too. `None` if the machine does not have them, if the program is built
    /// for them, and for the student's kernel.
    pub time_with_fma: Option<Timing>,
    /// Mean number of operations for one ordinary ray; unknown for the student's kernel.
    pub operations: Option<Operations>,
    /// Rays from inside closed meshes, aimed at edges and vertices, that leave without a hit.
    /// Triangles only.
    pub leaks_per_million: Option<f64>,
    /// Rays exactly at vertices, edges and diagonals of an integer terrain. Triangles only.
    pub grid: Option<GridCounts>,
    /// Accuracy on each family of rays.
    pub by_ray_family: Vec<Accuracy>,
}

impl KernelRow {
    /// Returns the time that plots and rankings use: for kernels with fused multiply-adds that with
    /// FMA instructions, if the machine has them, for others that of the build. Its ratio is always
    /// to the textbook's kernel with the same instructions.
    pub fn ranked_time(&self) -> &Timing {
        let with_fma = self.time_with_fma.as_ref().filter(|_| self.uses_fma);
        with_fma.unwrap_or(&self.time)
    }

    /// Returns the correct bits of `t`, averaged over all families of rays: see
    /// [`Errors::correct_bits`]. A family with hits in which the kernel finds none counts as 0
    /// bits.
    pub fn mean_correct_bits(&self) -> f64 {
        let families = self.by_ray_family.iter();
        let with_hits = families.filter(|a| a.t.is_some() || a.false_misses_per_million > 0.0);
        let bits: kit::Tally = with_hits
            .map(|a| a.t.map_or(0.0, |t| t.correct_bits()))
            .collect();
        bits.mean()
    }
}

/// What a test makes of rays from inside a closed terrain with integer coordinates, each exactly
/// through a vertex, an edge or a diagonal: each crosses the surface once.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GridCounts {
    /// Number of rays.
    pub rays: usize,
    /// Rays that leave without a hit.
    pub lost_per_million: f64,
    /// Rays that do not hit exactly one triangle: a count of them, as parity needs it, is wrong.
    pub miscounted_per_million: f64,
}

/// Mean number of operations of one test. Subtractions count as additions; negation and `abs` are
/// not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Operations {
    /// Additions and subtractions.
    pub add: f64,
    /// Multiplications.
    pub mul: f64,
    /// Divisions.
    pub div: f64,
    /// Square roots.
    pub sqrt: f64,
    /// Fused multiply-adds.
    pub fma: f64,
    /// Comparisons, including minima and maxima.
    pub compare: f64,
}

impl Operations {
    /// Returns the total.
    pub fn total(&self) -> f64 {
        self.add + self.mul + self.div + self.sqrt + self.fma + self.compare
    }
}

/// The accuracy of a kernel on one family of rays. A decision (hit or miss) is wrong if it differs
/// from the exact oracle's and the ray is decidable for a robust kernel in `f64`; undecidable rays
/// are counted separately.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// The family.
    pub family: RayFamily,
    /// Number of rays.
    pub rays: usize,
    /// Rays that miss, but the kernel returned a hit.
    pub false_hits_per_million: f64,
    /// Rays that hit, but the kernel returned a miss.
    pub false_misses_per_million: f64,
    /// Rays that are undecidable in `f64`: neither result is wrong.
    pub undecidable_per_million: f64,
    /// Undecidable rays for which the kernel differs from the exact result.
    pub undecidable_differing_per_million: f64,
    /// Hits whose `t` has an error larger than [`Accuracy::forward_bound`] allows.
    pub beyond_bound_per_million: f64,
    /// Error of `t`, over rays that hit and for which the kernel returns a hit; for a box, over
    /// both ends of the interval. `None` without such rays.
    pub t: Option<Errors>,
    /// Distance of the hit point from the true one, in its worst coordinate, relative to the
    /// largest coordinate of the shape. `None` for boxes.
    pub position: Option<Errors>,
    /// Distance of the hit point from the surface, relative to the largest coordinate of the shape:
    /// it makes shadow rays hit the surface that they start on. `None` for boxes.
    pub off_surface: Option<Errors>,
    /// The distribution of the relative error of `t`: pairs (error, fraction of hits with at most
    /// this error), in increasing order. The first errors may be 0.
    pub cdf: Vec<(f64, f64)>,
    /// The distribution of the forward error bounds of a robust kernel of this precision, for the
    /// same rays.
    pub forward_bound: Vec<(f64, f64)>,
}

impl Accuracy {
    /// Returns the wrong decisions, false hits and false misses.
    pub fn wrong_per_million(&self) -> f64 {
        self.false_hits_per_million + self.false_misses_per_million
    }
}

/// The distribution of an error, in two units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// In units in the last place, in the precision of the kernel's results (`f32` or `f64`), at
    /// the true value.
    pub ulp: Quantiles,
    /// Relative to the true value, 1 at most, which means that no digit is correct.
    pub relative: Quantiles,
}

impl Errors {
    /// Returns the number of leading bits that are correct for at least half of the rays.
    pub fn correct_bits(&self) -> f64 {
        correct_bits(self.relative.p50)
    }
}

/// Returns the number of leading bits that are correct with a relative error: `-log2` of it, from 0
/// to 53.
pub fn correct_bits(relative: f64) -> f64 {
    // The sum makes -0 a 0.
    (-relative.log2()).clamp(0.0, 53.0) + 0.0
}

/// Rounds a number of correct bits down: tables, captions and rankings use whole bits.
pub fn whole_bits(bits: f64) -> u32 {
    bits as u32
}

/// Three quantiles of a distribution (nearest rank).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Quantiles {
    /// Median.
    pub p50: f64,
    /// 99.9 % quantile.
    pub p999: f64,
    /// Maximum.
    pub max: f64,
}
