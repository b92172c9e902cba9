//! Time and accuracy of the kernels of one shape, the student's among them.

use super::accuracy::TestSet;
use super::leak_view::MeshView;
use super::leaks::{ClosedMesh, ClosedMeshes};
use super::measure::SampleCounts;
use super::rays;
use super::report::{
    self, Accuracy, GridCounts, KernelFamily, KernelRow, Operations, RayColumn, RayFamily, Timing,
};
use super::student::{Student, StudentShape};
use super::timing::{
    Contender, Measured, MissingReason, Rounds, SystemClock, TIMED_PASSES, or_missing,
};
use super::truth::Answer;
use base::{GraderError, Workspace};
use kernels::{HitF64, Instructions, Kernel, OperationCounts, Precision, RayAndShapes};
use kit::Triangle;
use rayon::prelude::*;

/// Tests in a pass: few enough for the L2 cache.
const TESTS_PER_PASS: usize = 4096;

/// Orders in which the rays of a pass are tested. A prime number, and many more orders than passes
/// in a turn: an order returns only when the branch predictor has forgotten it.
const ORDERS: usize = 61;

/// How often all tests are run in one pass of the student's worker.
const STUDENT_REPEATS: usize = 8;

/// Measures all kernels for shapes `S`.
pub(super) fn family<S: StudentShape, W: Into<Answer> + Send + Sync + 'static>(
    workspace: Option<&Workspace>,
    kernels: Vec<Kernel<S, W>>,
    seed: u64,
    size: SampleCounts,
) -> Result<KernelFamily, GraderError> {
    let student = or_missing(Student::build::<S>(workspace))?;
    let accuracies = accuracies(&kernels, &student, seed, size.rays)?;
    let batches = rays::timed_batches::<S>(seed, TESTS_PER_PASS);
    let orders = rays::orders(seed, batches.len(), ORDERS);
    let times = Times::measure(&kernels, &student, &batches, &orders, size)?;
    let student_missing = match (&times.student, &accuracies.student) {
        (Err(missing), _) | (_, Err(missing)) => Some(missing.clone()),
        (Ok(_), Ok(_)) => None,
    };

    let mut rows: Vec<KernelRow> = kernels
        .iter()
        .zip(accuracies.kernels)
        .enumerate()
        .map(|(i, (kernel, by_ray_family))| KernelRow {
            name: kernel.info.name.into(),
            precision: precision(kernel.precision),
            paper: kernel.info.paper.into(),
            textbook: i == 0,
            uses_fma: kernel.info.uses_fma,
            time_with_fma: times.with_fma.get(i).copied(),
            operations: Some(operations(kernel, &batches)),
            time: times.build[i],
            by_ray_family,
            ..KernelRow::default()
        })
        .collect();
    if let (Ok(time), Ok(by_ray_family)) = (times.student, accuracies.student) {
        rows.push(KernelRow {
            name: "yours".into(),
            paper: format!("stages/{}", S::STAGE),
            student: true,
            time,
            by_ray_family,
            ..KernelRow::default()
        });
    }
    Ok(KernelFamily {
        shape: S::SHAPE,
        columns: columns::<S>(),
        rows,
        student_missing,
        student_leaks: None,
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
            let each = by_family
                .iter()
                .map(|(_, test_set)| student.accuracy(test_set));
            or_missing(each.collect::<Measured<Vec<Accuracy>>>())?
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

/// The times of all kernels, measured in turns. Ratios are to the textbook's kernel with the same
/// instructions.
struct Times {
    /// With the instructions of the build, by kernel.
    build: Vec<Timing>,
    /// With AVX2 and FMA, by kernel; empty if they are not used.
    with_fma: Vec<Timing>,
    /// With the instructions of the build.
    student: Result<Timing, MissingReason>,
}

impl Times {
    fn measure<S: StudentShape, W: 'static>(
        kernels: &[Kernel<S, W>],
        student: &Result<Student, MissingReason>,
        batches: &[RayAndShapes<S>],
        orders: &[Vec<u32>],
        size: SampleCounts,
    ) -> Result<Times, GraderError> {
        let with_fma = Instructions::with_fma();
        let instructions = [Some(Instructions::BUILD), with_fma].into_iter().flatten();
        let mut contenders: Vec<Contender> = instructions
            .flat_map(|instructions| {
                let kernels = kernels.iter();
                kernels.map(move |kernel| {
                    let mut orders = orders.iter().cycle();
                    let mut prepared = (0, kernel.pass(batches, instructions));
                    let work = move |round| {
                        // Other memory in each round: its place in the caches affects the time,
                        // too.
                        if prepared.0 != round {
                            prepared = (round, kernel.pass(batches, instructions));
                        }
                        orders.next().map(|order| (prepared.1)(order))
                    };
                    Contender::here(TESTS_PER_PASS, work)
                })
            })
            .collect();
        let in_process = contenders.len();
        if let Ok(student) = student {
            let mut orders = orders.iter().cycle();
            let mut pass = move || {
                let orders = orders.by_ref().take(STUDENT_REPEATS);
                orders.flatten().copied().collect::<Vec<u32>>()
            };
            let turn = move |_| {
                let passes = (0..1 + TIMED_PASSES).map(|_| pass());
                student.time(batches, passes.collect())
            };
            contenders.push(Contender::elsewhere(turn));
        }
        let rounds = Rounds::measure(&SystemClock::start(), &mut contenders, size.rounds)?;
        let timings = |first: usize, end: usize| {
            let timings: Result<Vec<Timing>, MissingReason> =
                (first..end).map(|i| rounds.timing(i, first)).collect();
            timings.map_err(GraderError::new)
        };
        Ok(Times {
            build: timings(0, kernels.len())?,
            with_fma: timings(kernels.len(), in_process)?,
            student: match student {
                Ok(_) => rounds.timing(in_process, 0),
                Err(missing) => Err(missing.clone()),
            },
        })
    }
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

/// Adds the leaks of the triangle tests, and what they make of rays at an integer terrain.
pub(super) fn add_leaks(
    family: &mut KernelFamily,
    workspace: Option<&Workspace>,
    closed: &[ClosedMeshes; 2],
    grid: &ClosedMesh,
) -> Result<(), GraderError> {
    let kernels: Vec<Kernel<Triangle, HitF64>> = kernels::triangles();
    let counts: Vec<(Option<f64>, GridCounts)> = kernels
        .par_iter()
        .map(|kernel| {
            let mut closed = closed.iter();
            let closed = closed.find(|closed| closed.is_for(kernel.precision));
            let leaks = closed.map(|closed| closed.leaks(kernel));
            (leaks, GridCounts::of(&grid.hits(kernel)))
        })
        .collect();
    for (row, (leaks, grid)) in family.rows.iter_mut().zip(counts) {
        row.leaks_per_million = leaks;
        row.grid = Some(grid);
    }
    if let Some(row) = family.rows.iter_mut().find(|row| row.student)
        && let Ok(student) = or_missing(Student::build::<Triangle>(workspace))?
        && let Ok(leaks) = or_missing(student.leaks(&closed[0]))?
    {
        row.leaks_per_million = Some(leaks);
        row.grid = or_missing(student.grid(grid))?.ok();
        if let Some(view) = MeshView::traced() {
            family.student_leaks = or_missing(student.leaking_pixels(view))?.ok();
        }
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

#[cfg(test)]
mod tests;
