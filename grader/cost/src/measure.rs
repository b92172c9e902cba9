//! One run of `grader cost`.

use super::accuracy::TestSet;
use super::leaks::ClosedMeshes;
use super::report::{
    self, Accuracy, CostReport, KernelFamily, KernelRow, Operations, RayColumn, RayFamily, Shape,
};
use super::student::{MissingReason, Student, StudentShape};
use super::timing::Rounds;
use super::truth::Answer;
use super::{machine, measure_trees, picture, rays};
use grader::error::GraderError;
use grader::workspace::Workspace;
use kernels::{HitF64, Kernel, OperationCounts, Pass, Precision, RayAndShapes};
use kit::{Aabb, Sphere, Triangle};
use rayon::prelude::*;

/// The arguments of [`measure()`]: what to measure.
#[derive(Clone, Debug)]
pub struct CostRequest {
    /// The shapes whose kernels are compared.
    pub shapes: Vec<Shape>,
    /// Whether trees are compared.
    pub trees: bool,
    /// Whether pictures are rendered with the program of the workspace.
    pub pictures: bool,
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
    /// Number of times that the kernels and the student's worker are timed in turn.
    pub turns: usize,
    /// Rounds in each turn.
    pub rounds: usize,
    /// Triangles in the mesh that trees are built over.
    pub mesh: usize,
    /// Number of times that each tree is built.
    pub builds: usize,
}

impl SampleCounts {
    /// Takes one or two minutes.
    pub const FULL: SampleCounts = SampleCounts {
        rays: 60_000,
        leak_rays: 60_000,
        turns: 6,
        rounds: 15,
        mesh: 200_000,
        builds: 5,
    };

    /// Takes some seconds.
    pub const QUICK: SampleCounts = SampleCounts {
        rays: 4_000,
        leak_rays: 6_000,
        turns: 2,
        rounds: 10,
        mesh: 20_000,
        builds: 3,
    };
}

/// Tests in a timed pass: too many for the branch predictor to remember, few enough for the L2
/// cache.
const TESTS_PER_PASS: usize = 4096;

/// Passes of the student's worker per measurement.
const STUDENT_PASSES: u32 = 8;

/// Measures what `request` selects: the kernels, and the code in `workspace`, if there is one.
pub fn measure(
    workspace: Option<&Workspace>,
    request: &CostRequest,
) -> Result<CostReport, GraderError> {
    let size = request.size;
    let is_quick = size != SampleCounts::FULL;
    let mut families = Vec::new();
    for shape in &request.shapes {
        families.push(match shape {
            Shape::Triangle => {
                let closed = [Precision::F64, Precision::F32]
                    .map(|precision| ClosedMeshes::new(request.seed, size.leak_rays, precision));
                let mut family = family(workspace, kernels::triangles(), request.seed, size)?;
                add_leaks(&mut family, workspace, &closed)?;
                family
            }
            Shape::Sphere => {
                family::<Sphere, _>(workspace, kernels::spheres(), request.seed, size)?
            }
            Shape::Box => family::<Aabb, _>(workspace, kernels::boxes(), request.seed, size)?,
        });
    }
    Ok(CostReport {
        machine: machine::describe(),
        seed: request.seed,
        quick: is_quick,
        families,
        bvh: if request.trees {
            measure_trees::measure(workspace, request.seed, size)?
        } else {
            None
        },
        pictures: match workspace.filter(|_| request.pictures) {
            Some(workspace) => Some(picture::measure(workspace, request.seed, is_quick)?),
            None => None,
        },
    })
}

/// Measures all kernels for shapes `S`.
fn family<S: StudentShape, W: Into<Answer> + Send + Sync + 'static>(
    workspace: Option<&Workspace>,
    kernels: Vec<Kernel<S, W>>,
    seed: u64,
    size: SampleCounts,
) -> Result<KernelFamily, GraderError> {
    let student = Student::build::<S>(workspace)?;
    let accuracies = accuracies(&kernels, &student, seed, size.rays)?;
    let batches = rays::timed_batches::<S>(seed, TESTS_PER_PASS);
    let (rounds, missing) = times(&kernels, student, &batches, size)?;
    let student_missing = missing.or(accuracies.student.clone().err());

    let mut timings = rounds.timings().into_iter();
    let mut rows: Vec<KernelRow> = kernels
        .iter()
        .zip(accuracies.kernels)
        .zip(timings.by_ref())
        .enumerate()
        .map(|(i, ((kernel, by_ray_family), time))| KernelRow {
            name: kernel.info.name.into(),
            precision: precision(kernel.precision),
            paper: kernel.info.paper.into(),
            student: false,
            textbook: i == 0,
            time,
            operations: Some(operations(kernel, &batches)),
            leaks_per_million: None,
            by_ray_family,
        })
        .collect();
    if let (None, Some(time), Ok(by_ray_family)) =
        (&student_missing, timings.next(), accuracies.student)
    {
        rows.push(KernelRow {
            name: "yours".into(),
            precision: report::Precision::F64,
            paper: format!("stages/{}", S::STAGE),
            student: true,
            textbook: false,
            time,
            operations: None,
            leaks_per_million: None,
            by_ray_family,
        });
    }
    Ok(KernelFamily {
        shape: S::SHAPE,
        columns: columns::<S>(),
        rows,
        student_missing,
    })
}

fn columns<S: StudentShape>() -> Vec<RayColumn> {
    let columns = S::RAY_FAMILIES.iter();
    columns
        .map(|(family, about)| RayColumn {
            family: *family,
            about: about.to_string(),
        })
        .collect()
}

/// Accuracy of the kernels and of the student's kernel, by family of rays.
struct Accuracies {
    /// By kernel, then by family.
    kernels: Vec<Vec<Accuracy>>,
    student: Result<Vec<Accuracy>, MissingReason>,
}

fn accuracies<S: StudentShape, W: Into<Answer> + Send + Sync + 'static>(
    kernels: &[Kernel<S, W>],
    student: &Result<Student, MissingReason>,
    seed: u64,
    rays: usize,
) -> Result<Accuracies, GraderError> {
    let families: Vec<RayFamily> = S::RAY_FAMILIES.iter().map(|(family, _)| *family).collect();
    let by_family: Vec<(Vec<Accuracy>, TestSet<S>)> = families
        .par_iter()
        .map(|family| {
            let [double, single] = [Precision::F64, Precision::F32].map(|precision| {
                let pairs = rays::pairs::<S>(*family, seed, rays).into_iter();
                let stored = pairs.map(|(shape, ray)| {
                    (shape.stored(precision), rays::stored_ray(&ray, precision))
                });
                TestSet::new(*family, stored.collect())
            });
            let kernel_accuracies = kernels.iter().map(|kernel| {
                let test_set = match kernel.precision {
                    Precision::F64 => &double,
                    Precision::F32 | Precision::F32InF64 => &single,
                };
                let pairs = test_set.pairs.iter();
                let answers = pairs.map(|(shape, ray)| kernel.answer(shape, ray).map(Into::into));
                test_set.accuracy(kernel.precision, kernel.info.culls, answers)
            });
            (kernel_accuracies.collect(), double)
        })
        .collect();
    let student_result = match student {
        Err(missing) => Err(missing.clone()),
        Ok(student) => {
            let each = by_family.iter();
            let each = each.map(|(_, test_set)| student.accuracy(test_set));
            each.collect::<Result<Result<Vec<Accuracy>, MissingReason>, GraderError>>()?
        }
    };
    let mut by_kernel = vec![Vec::new(); kernels.len()];
    for (kernel_accuracies, _) in by_family {
        for (all, one) in by_kernel.iter_mut().zip(kernel_accuracies) {
            all.push(one);
        }
    }
    Ok(Accuracies {
        kernels: by_kernel,
        student: student_result,
    })
}

/// Times every kernel, the student's last; also returns why the student's is missing, if it is.
fn times<S: StudentShape, W: Send + Sync + 'static>(
    kernels: &[Kernel<S, W>],
    student: Result<Student, MissingReason>,
    batches: &[RayAndShapes<S>],
    size: SampleCounts,
) -> Result<(Rounds, Option<MissingReason>), GraderError> {
    let mut passes: Vec<Pass> = kernels.iter().map(|kernel| kernel.pass(batches)).collect();
    let mut rounds = Rounds::default();
    let mut student_result = student.map(|student| (student, Vec::new()));
    for _ in 0..size.turns {
        rounds.extend(Rounds::measure(&mut passes, TESTS_PER_PASS, size.rounds));
        if let Ok((student, ns)) = &mut student_result {
            match student.times(batches, STUDENT_PASSES, size.rounds)? {
                Ok(turn) => ns.extend(turn),
                Err(missing) => student_result = Err(missing),
            }
        }
    }
    Ok(match student_result {
        Ok((_, ns)) => {
            rounds.push(ns);
            (rounds, None)
        }
        Err(missing) => (rounds, Some(missing)),
    })
}

/// Returns the mean number of operations in one of the timed tests.
fn operations<S: StudentShape, W: 'static>(
    kernel: &Kernel<S, W>,
    batches: &[RayAndShapes<S>],
) -> Operations {
    let mut all = OperationCounts::default();
    let mut tests = 0;
    for batch in batches {
        for shape in &batch.shapes {
            all += kernel.count(shape, &batch.ray);
            tests += 1;
        }
    }
    let each = |count: u64| count as f64 / f64::from(tests.max(1));
    Operations {
        add: each(all.add),
        mul: each(all.mul),
        div: each(all.div),
        sqrt: each(all.sqrt),
        fma: each(all.fma),
        compare: each(all.compare),
    }
}

/// Adds the leaks of the triangle tests.
fn add_leaks(
    family: &mut KernelFamily,
    workspace: Option<&Workspace>,
    closed: &[ClosedMeshes; 2],
) -> Result<(), GraderError> {
    let kernels: Vec<Kernel<Triangle, HitF64>> = kernels::triangles();
    let leaks: Vec<Option<f64>> = kernels
        .par_iter()
        .map(|kernel| {
            let mut closed = closed.iter();
            let closed = closed.find(|closed| closed.is_for(kernel.precision));
            closed.map(|closed| closed.leaks(kernel))
        })
        .collect();
    for (row, leaks) in family.rows.iter_mut().zip(leaks) {
        row.leaks_per_million = leaks;
    }
    if let Some(row) = family.rows.iter_mut().find(|row| row.student)
        && let Ok(student) = Student::build::<Triangle>(workspace)?
        && let Ok(leaks) = student.leaks(&closed[0])?
    {
        row.leaks_per_million = Some(leaks);
    }
    Ok(())
}

pub(crate) fn precision(of: Precision) -> report::Precision {
    match of {
        Precision::F32 => report::Precision::F32,
        Precision::F64 => report::Precision::F64,
        Precision::F32InF64 => report::Precision::F32InF64,
    }
}
