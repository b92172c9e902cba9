//! One run of `grader cost`.

use super::leaks::{ClosedMesh, ClosedMeshes};
use super::report::{CostReport, Shape};
use super::student::Student;
use super::timing::{missing, or_missing};
use super::{machine, measure_kernels, picture, trees, world};
use base::{GraderError, Workspace};
use kernels::Precision;
use kit::{Aabb, Sphere};

/// The arguments of [`measure()`]: what to measure.
#[derive(Clone, Debug)]
pub struct CostRequest {
    /// The shapes whose kernels are compared.
    pub shapes: Vec<Shape>,
    /// Whether trees are compared.
    pub trees: bool,
    /// Whether pictures are rendered with the program of the workspace.
    pub pictures: bool,
    /// Whether the student's tree answers the hard cases of the libraries.
    pub world: bool,
    /// The numbers of rays and rounds.
    pub size: SampleCounts,
    /// Seed of the random rays.
    pub seed: u64,
}

/// The numbers of rays, rounds and triangles that are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleCounts {
    /// Rays in each family.
    pub rays: usize,
    /// Rays through closed meshes.
    pub leak_rays: usize,
    /// Rounds in which all kernels of a shape are timed, the student's too.
    pub rounds: usize,
    /// Triangles in the mesh that trees are built over.
    pub mesh: usize,
    /// Rounds in which all trees are built and traversed.
    pub tree_rounds: usize,
    /// Rays of each hard case of the libraries.
    pub world_rays: usize,
}

impl SampleCounts {
    /// Takes one or two minutes.
    pub const FULL: SampleCounts = SampleCounts {
        rays: 60_000,
        leak_rays: 60_000,
        rounds: 90,
        mesh: 200_000,
        tree_rounds: 24,
        world_rays: 2_000,
    };

    /// Takes some seconds.
    pub const QUICK: SampleCounts = SampleCounts {
        rays: 4_000,
        leak_rays: 6_000,
        rounds: 20,
        mesh: 20_000,
        tree_rounds: 24,
        world_rays: 200,
    };
}

impl CostRequest {
    /// The number of parts that are measured one after another.
    pub fn parts(&self) -> usize {
        let pictures = match self.pictures {
            true => picture::plan::all(self.is_quick()).len(),
            false => 0,
        };
        self.shapes.len() + usize::from(self.trees) + usize::from(self.world) + pictures
    }

    fn is_quick(&self) -> bool {
        self.size != SampleCounts::FULL
    }
}

/// Measures what `request` selects: the kernels, and the code in `workspace`, if there is one.
/// Calls `report` with the results so far after each part, so that they are kept if the program is
/// stopped.
///
/// # Errors
///
/// Also returns the error of `report`, after which nothing more is measured.
pub fn measure(
    workspace: Option<&Workspace>,
    request: &CostRequest,
    report: &mut dyn FnMut(&CostReport) -> Result<(), GraderError>,
) -> Result<CostReport, GraderError> {
    let size = request.size;
    let mut cost = CostReport {
        machine: machine::describe(),
        seed: request.seed,
        quick: request.is_quick(),
        families: Vec::new(),
        bvh: None,
        pictures: None,
        world: None,
    };
    for shape in &request.shapes {
        progress::stage(shape.name());
        cost.families.push(match shape {
            Shape::Triangle => {
                let closed = [Precision::F64, Precision::F32]
                    .map(|precision| ClosedMeshes::new(request.seed, size.leak_rays, precision));
                let triangles = kernels::triangles();
                let mut family = measure_kernels::family(workspace, triangles, request.seed, size)?;
                let grid = ClosedMesh::grid(request.seed);
                measure_kernels::add_leaks(&mut family, workspace, &closed, &grid)?;
                family
            }
            Shape::Sphere => measure_kernels::family::<Sphere, _>(
                workspace,
                kernels::spheres(),
                request.seed,
                size,
            )?,
            Shape::Box => {
                measure_kernels::family::<Aabb, _>(workspace, kernels::boxes(), request.seed, size)?
            }
        });
        report(&cost)?;
    }
    if request.trees {
        progress::stage("trees");
        cost.bvh = trees::measure(workspace, request.seed, size)?;
        report(&cost)?;
    }
    if request.world {
        progress::stage("ray casters");
        let student = or_missing(Student::build_with("meshes", "part2.task3", workspace))?;
        let mut trace = |case: &world::Case| match &student {
            Ok(student) => student.closest(&case.triangles(), &case.rays),
            Err(why) => missing(why.clone()),
        };
        cost.world = Some(world::measure(size.world_rays, &mut trace)?);
        report(&cost)?;
    }
    if let Some(workspace) = workspace.filter(|_| request.pictures) {
        let pictures = picture::measure(workspace, request.seed, request.is_quick())?;
        cost.pictures = Some(pictures);
        report(&cost)?;
    }
    Ok(cost)
}
