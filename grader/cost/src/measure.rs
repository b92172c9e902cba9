//! One run.

use super::accuracy::Judge;
use super::clock::Rounds;
use super::leaks::Closed;
use super::report::{self, Accuracy, Column, Family, Operations, RayFamily, Report, Row, Shape};
use super::student::{Asked, Missing, Student};
use super::truth::Answer;
use super::{machine, measure_trees, picture, rays};
use grader::error::GraderError;
use grader::workspace::Workspace;
use kernels::{Bundle, Count, Found, Kernel, Pass, Precision};
use kit::{Aabb, Sphere, Triangle};
use rayon::prelude::*;

/// What to measure.
#[derive(Clone, Debug)]
pub struct Order {
    /// The shapes whose kernels to compare.
    pub shapes: Vec<Shape>,
    /// Whether to compare trees.
    pub trees: bool,
    /// Whether to render pictures with the program of the workspace.
    pub pictures: bool,
    /// How much of it.
    pub size: Size,
    /// What the rays are drawn from.
    pub seed: u64,
}

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Rays of each family.
    pub rays: usize,
    /// Rays through closed meshes.
    pub leak_rays: usize,
    /// How often the kernels and the student's worker take turns.
    pub turns: usize,
    /// Rounds in each turn.
    pub rounds: usize,
    /// Triangles of the mesh that trees are built over.
    pub mesh: usize,
    /// How often each tree is built.
    pub builds: usize,
}

impl Size {
    /// A minute or two.
    pub const FULL: Size = Size {
        rays: 60_000,
        leak_rays: 60_000,
        turns: 6,
        rounds: 15,
        mesh: 200_000,
        builds: 5,
    };

    /// Some seconds.
    pub const QUICK: Size = Size {
        rays: 4_000,
        leak_rays: 6_000,
        turns: 2,
        rounds: 10,
        mesh: 20_000,
        builds: 3,
    };
}

/// Tests in a pass that is timed: too many for a branch predictor to learn by heart, few enough for the second cache.
const TESTS: usize = 4096;

/// Passes that the student's worker makes between two looks at the clock.
const STUDENT_PASSES: u32 = 8;

/// Measures what `order` asks for: the kernels, and the code in `workspace` beside them, if there is one.
pub fn measure(workspace: Option<&Workspace>, order: &Order) -> Result<Report, GraderError> {
    let size = order.size;
    let is_quick = size != Size::FULL;
    let mut families = Vec::new();
    for shape in &order.shapes {
        families.push(match shape {
            Shape::Triangle => {
                let closed = [Precision::F64, Precision::F32]
                    .map(|precision| Closed::new(order.seed, size.leak_rays, precision));
                let mut family = family(workspace, kernels::triangles(), order.seed, size)?;
                add_leaks(&mut family, workspace, &closed)?;
                family
            }
            Shape::Sphere => family::<Sphere, _>(workspace, kernels::spheres(), order.seed, size)?,
            Shape::Box => family::<Aabb, _>(workspace, kernels::boxes(), order.seed, size)?,
        });
    }
    Ok(Report {
        machine: machine::this(),
        seed: order.seed,
        quick: is_quick,
        families,
        bvh: if order.trees {
            measure_trees::measure(workspace, order.seed, size)?
        } else {
            None
        },
        pictures: match workspace.filter(|_| order.pictures) {
            Some(workspace) => Some(picture::measure(workspace, order.seed, is_quick)?),
            None => None,
        },
    })
}

/// All kernels for shapes `S`.
fn family<S: Asked, W: Into<Answer> + Send + Sync + 'static>(
    workspace: Option<&Workspace>,
    kernels: Vec<Kernel<S, W>>,
    seed: u64,
    size: Size,
) -> Result<Family, GraderError> {
    let student = Student::of::<S>(workspace)?;
    let accuracies = accuracies(&kernels, &student, seed, size.rays)?;
    let bundles = rays::bundles::<S>(seed, TESTS);
    let (rounds, missing) = times(&kernels, student, &bundles, size)?;
    let student_missing = missing.or(accuracies.student.clone().err());

    let mut timings = rounds.timings().into_iter();
    let mut rows: Vec<Row> = kernels
        .iter()
        .zip(accuracies.kernels)
        .zip(timings.by_ref())
        .enumerate()
        .map(|(i, ((kernel, by_ray_family), time))| Row {
            name: kernel.about.name.into(),
            precision: precision(kernel.precision),
            paper: kernel.about.paper.into(),
            student: false,
            textbook: i == 0,
            time,
            operations: Some(operations(kernel, &bundles)),
            leaks_per_million: None,
            by_ray_family,
        })
        .collect();
    if let (None, Some(time), Ok(by_ray_family)) =
        (&student_missing, timings.next(), accuracies.student)
    {
        rows.push(Row {
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
    Ok(Family {
        shape: S::SHAPE,
        columns: columns::<S>(),
        rows,
        student_missing,
    })
}

fn columns<S: Asked>() -> Vec<Column> {
    let columns = S::COLUMNS.iter();
    columns
        .map(|(family, about)| Column {
            family: *family,
            about: about.to_string(),
        })
        .collect()
}

/// How right everyone is, by family of rays.
struct Accuracies {
    /// Kernel by kernel.
    kernels: Vec<Vec<Accuracy>>,
    student: Result<Vec<Accuracy>, Missing>,
}

fn accuracies<S: Asked, W: Into<Answer> + Send + Sync + 'static>(
    kernels: &[Kernel<S, W>],
    student: &Result<Student, Missing>,
    seed: u64,
    rays: usize,
) -> Result<Accuracies, GraderError> {
    let families: Vec<RayFamily> = S::COLUMNS.iter().map(|(family, _)| *family).collect();
    let by_family: Vec<(Vec<Accuracy>, Judge<S>)> = families
        .par_iter()
        .map(|family| {
            let [double, single] = [Precision::F64, Precision::F32].map(|precision| {
                let pairs = rays::pairs::<S>(*family, seed, rays).into_iter();
                let stored = pairs.map(|(shape, ray)| {
                    (shape.stored(precision), rays::stored_ray(&ray, precision))
                });
                Judge::new(*family, stored.collect())
            });
            let of_each = kernels.iter().map(|kernel| {
                let judge = match kernel.precision {
                    Precision::F64 => &double,
                    Precision::F32 | Precision::F32InF64 => &single,
                };
                let pairs = judge.pairs.iter();
                let answers = pairs.map(|(shape, ray)| kernel.answer(shape, ray).map(Into::into));
                judge.accuracy(kernel.precision, kernel.about.culls, answers)
            });
            (of_each.collect(), double)
        })
        .collect();
    let of_student = match student {
        Err(missing) => Err(missing.clone()),
        Ok(student) => {
            let each = by_family.iter();
            let each = each.map(|(_, judge)| student.accuracy(judge));
            each.collect::<Result<Result<Vec<Accuracy>, Missing>, GraderError>>()?
        }
    };
    let mut of_kernels = vec![Vec::new(); kernels.len()];
    for (of_each, _) in by_family {
        for (all, one) in of_kernels.iter_mut().zip(of_each) {
            all.push(one);
        }
    }
    Ok(Accuracies {
        kernels: of_kernels,
        student: of_student,
    })
}

/// The rounds of every kernel, the student's last; and why that one is missing, if it is.
fn times<S: Asked, W: Send + Sync + 'static>(
    kernels: &[Kernel<S, W>],
    student: Result<Student, Missing>,
    bundles: &[Bundle<S>],
    size: Size,
) -> Result<(Rounds, Option<Missing>), GraderError> {
    let mut passes: Vec<Pass> = kernels.iter().map(|kernel| kernel.pass(bundles)).collect();
    let mut rounds = Rounds::default();
    let mut of_student = student.map(|student| (student, Vec::new()));
    for _ in 0..size.turns {
        rounds.extend(Rounds::take(&mut passes, TESTS, size.rounds));
        if let Ok((student, ns)) = &mut of_student {
            match student.times(bundles, STUDENT_PASSES, size.rounds)? {
                Ok(turn) => ns.extend(turn),
                Err(missing) => of_student = Err(missing),
            }
        }
    }
    Ok(match of_student {
        Ok((_, ns)) => {
            rounds.push(ns);
            (rounds, None)
        }
        Err(missing) => (rounds, Some(missing)),
    })
}

/// What the kernel computes for one test of the timed ones.
fn operations<S: Asked, W: 'static>(kernel: &Kernel<S, W>, bundles: &[Bundle<S>]) -> Operations {
    let mut all = Count::default();
    let mut tests = 0;
    for bundle in bundles {
        for shape in &bundle.shapes {
            all += kernel.count(shape, &bundle.ray);
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

/// Fills in the leaks of triangle tests.
fn add_leaks(
    family: &mut Family,
    workspace: Option<&Workspace>,
    closed: &[Closed; 2],
) -> Result<(), GraderError> {
    let kernels: Vec<Kernel<Triangle, Found>> = kernels::triangles();
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
        && let Ok(student) = Student::of::<Triangle>(workspace)?
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
