//! Measures the speedup by a BVH: the student's brute force against the student's BVH, on generated
//! meshes of increasing size.
//!
//! Times depend on the machine. The number of tests per ray does not, and explains the times.
//! Neither earns points here: other cases score the number of tests, one task at a time.

mod growth;

pub use growth::{Growth, slope};

use crate::course::{Course, Task};
use crate::report::TaskReport;
use crate::score::Status;
use crate::workers::crash::Crash;
use crate::workers::runner::{self, Ending, Worker};
use base::GraderError;
use judge::cases::recorded::{self, RayWork};
use kit::Vec3;
use serde::Serialize;
use wire::answer::TimingAnswer;
use wire::work::{Ray, SceneSource, TimingWork};
use wire::{Answer, Outcome, Work};

/// The speedups of Part 2.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Speedups {
    /// One row for each mesh and size.
    pub rows: Vec<Speedup>,
    /// How the cost grows with the size, for each mesh.
    pub growth: Vec<Growth>,
    /// Why rows are missing, if any are.
    pub missing: Option<String>,
}

/// The speedup on one mesh. Times are medians of rounds that alternate between BVH and brute force;
/// each timed pass follows an untimed one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Speedup {
    /// Name of the mesh.
    pub mesh: String,
    /// Number of triangles.
    pub triangles: u64,
    /// Seconds to build the BVH.
    pub build_s: f64,
    /// Rays per round that are traced with the BVH.
    pub tree_rays: u64,
    /// Seconds per ray with the BVH.
    pub tree_s: f64,
    /// Rays per round that are traced by brute force: a sample of all rays.
    pub brute_rays: u64,
    /// Seconds per ray by brute force.
    pub brute_s: f64,
    /// Time by brute force / time with the BVH, without the time to build the BVH: the median of
    /// the ratios within a round.
    pub speedup: f64,
    /// The smallest and the largest of these ratios.
    pub speedup_range: [f64; 2],
    /// Box and primitive tests per ray.
    pub work: RayWork,
    /// The recorded tests per ray of the reference.
    pub reference: RayWork,
    /// The number of sampled rays for which BVH and brute force return a different `t`.
    pub differing_hits: u64,
}

/// The timed meshes: one smooth, one rough.
const MESHES: [&str; 2] = ["smooth", "terrain"];

/// The numbers of triangles.
const SIZES: [u32; 4] = [1_000, 10_000, 100_000, 1_000_000];

/// Triangle tests in a brute-force sample: about 20 ms, long enough to measure.
const SAMPLE_TESTS: u32 = 4_000_000;

/// The minimum number of rays in a brute-force sample.
const MIN_SAMPLE_RAYS: u32 = 8;

/// The number of rounds. Each times the BVH, then brute force.
const ROUNDS: u32 = 3;

/// Time limit of a mesh in milliseconds: a build that is not quadratic takes one or two seconds.
const LIMIT_MS: u64 = 20_000;

/// The maximum number of primitives in a leaf, as in the assignment.
const MAX_LEAF_SIZE: u32 = 4;

/// The tasks that the speedup depends on: BVH construction and traversal.
const TASKS: [&str; 2] = ["part2.task1", "part2.task3"];

/// Whether `tasks` include both tasks that the speedup depends on.
pub fn applies_to(tasks: &[&Task]) -> bool {
    TASKS
        .iter()
        .all(|key| tasks.iter().any(|task| task.key == *key))
}

/// Whether the code of both tasks is the student's own: there is nothing to time before that.
pub fn is_attempted(tasks: &[TaskReport]) -> bool {
    let written = |key: &str| {
        let mut results = tasks.iter().map(|task| &task.result);
        let result = results.find(|result| result.key == key);
        result.is_some_and(|result| result.status != Status::NotAttempted)
    };
    TASKS.into_iter().all(written)
}

/// Times the code in `worker`. If there is no worker, `missing` names the stages that do not
/// compile.
pub fn measure(course: &Course, worker: &Result<Worker, String>) -> Result<Speedups, GraderError> {
    let mut speedups = Speedups::default();
    let worker = match worker {
        Ok(worker) => worker,
        Err(broken) => {
            speedups.missing = Some(format!("it needs {broken}, which does not compile"));
            return Ok(speedups);
        }
    };
    let meshes: Vec<(&str, u32)> = MESHES
        .iter()
        .flat_map(|mesh| SIZES.map(|size| (*mesh, size)))
        .collect();
    let cases: Vec<wire::Case> = meshes
        .iter()
        .map(|&(mesh, size)| case(mesh, size))
        .collect();
    let run = runner::run(worker, &cases)?;
    for ((mesh, size), ending) in meshes.into_iter().zip(&run.endings) {
        match ending.outcome() {
            Some(Outcome::Answered(Answer::Timing(times))) => {
                speedups.rows.push(Speedup::new(mesh, size, times));
            }
            _ => speedups.missing = Some(why_missing(mesh, size, ending, course)),
        }
    }
    speedups.growth = MESHES
        .iter()
        .filter_map(|mesh| Growth::of(mesh, &speedups.rows))
        .collect();
    Ok(speedups)
}

fn case(mesh: &str, size: u32) -> wire::Case {
    let timing = TimingWork {
        scene: SceneSource::Generated(mesh.into(), size),
        max_leaf_size: MAX_LEAF_SIZE,
        rays: rays(),
        brute_force_rays: (SAMPLE_TESTS / size).max(MIN_SAMPLE_RAYS),
        rounds: ROUNDS,
    };
    wire::Case {
        task: mesh.into(),
        name: size.to_string(),
        limit_ms: LIMIT_MS,
        work: Work::Timing(timing),
        order: Vec::new(),
    }
}

/// The timed rays: from one point outside the mesh, which fills the cube [-1, 1]^3, through a
/// regular grid of points on a square around the origin that faces that point.
pub fn rays() -> Vec<Ray> {
    const SIDE: u32 = 128;
    let eye = Vec3::new(1.6, 1.4, 2.4);
    let backward = eye.normalize();
    let right = Vec3::Y.cross(backward).normalize();
    let up = backward.cross(right);
    let centred = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE) - 0.5;
    let points = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
    points
        .map(|(x, y)| {
            let target = 2.2 * (centred(x) * right + centred(y) * up);
            Ray {
                o: eye.into(),
                d: (target - eye).normalize().into(),
                min_t: 0.0,
                max_t: f64::INFINITY,
            }
        })
        .collect()
}

/// The reason why a mesh has no times.
fn why_missing(mesh: &str, size: u32, ending: &Ending, course: &Course) -> String {
    let at = format!("the {mesh} mesh of {size} triangles");
    match ending {
        Ending::TimedOut { limit_ms, .. } => {
            format!("{at} takes more than {} s", limit_ms / 1000)
        }
        Ending::Malformed(why) | Ending::ChangedCounts(why) => format!("on {at} {why}"),
        Ending::Died { .. }
        | Ending::PrintedTooMuch { .. }
        | Ending::TooManyThreads { .. }
        | Ending::OutOfTime => crashed(&at, ending),
        Ending::Skipped | Ending::NotRun => {
            format!("{at} is skipped, because smaller ones took too long")
        }
        Ending::Recorded(record) => match &record.outcome {
            Outcome::NotAttempted { task } => {
                let title = course.tasks().find(|known| known.key == *task);
                let title = title.map_or("", |task| &task.title);
                format!("it needs {task} ({title})")
            }
            Outcome::Panicked { .. } | Outcome::CalledTooOften { .. } => crashed(&at, ending),
            Outcome::Unable { reason } => reason.clone(),
            Outcome::Answered(_) => format!("{at} was not timed"),
        },
    }
}

fn crashed(at: &str, ending: &Ending) -> String {
    let how = Crash::of(ending).unwrap_or_default().how;
    format!("on {at} your code {how}")
}

impl Speedup {
    fn new(mesh: &str, size: u32, times: &TimingAnswer) -> Speedup {
        let rays = times.tree_rays as f64;
        let per_ray =
            |seconds: &[f64], rays: f64| -> Vec<f64> { seconds.iter().map(|s| s / rays).collect() };
        let tree_s = per_ray(&times.tree_s, rays);
        let brute_s = per_ray(&times.brute_s, times.brute_rays as f64);
        let in_rounds = brute_s.iter().zip(&tree_s);
        let speedups: Vec<f64> = in_rounds.map(|(brute, tree)| brute / tree).collect();
        Speedup {
            mesh: mesh.into(),
            triangles: times.primitives,
            build_s: median(&times.build_s),
            tree_rays: times.tree_rays,
            tree_s: median(&tree_s),
            brute_rays: times.brute_rays,
            brute_s: median(&brute_s),
            speedup: median(&speedups),
            speedup_range: [
                speedups.iter().copied().fold(f64::INFINITY, f64::min),
                speedups.iter().copied().fold(0.0, f64::max),
            ],
            work: RayWork {
                boxes: times.box_tests as f64 / rays,
                prims: times.prim_tests as f64 / rays,
            },
            reference: recorded::rays(mesh, size),
            differing_hits: times.differing_hits,
        }
    }
}

/// The median; of an even number of times, the lower of the two in the middle.
fn median(times: &[f64]) -> f64 {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len().saturating_sub(1) / 2;
    sorted.get(middle).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::score::TaskResult;

    #[test]
    fn one_slow_round_does_not_change_the_median() {
        assert_eq!(median(&[1.0, 99.0, 1.5]), 1.5);
        assert!(median(&[]).is_nan());
    }

    #[test]
    fn the_speedup_is_the_median_within_rounds() {
        // The machine takes five times as long in the second round, and is interrupted in the tree
        // of the third one.
        let times = TimingAnswer {
            primitives: 1000,
            build_s: vec![1.0; 3],
            tree_s: vec![2.0, 10.0, 4.0],
            tree_rays: 100,
            brute_s: vec![3.0, 15.0, 3.0],
            brute_rays: 10,
            box_tests: 0,
            prim_tests: 0,
            differing_hits: 0,
            tree_hits: 0,
        };
        let speedup = Speedup::new("smooth", 1000, &times);
        assert!((speedup.speedup - 15.0).abs() < 1e-9);
        assert!((speedup.speedup_range[0] - 7.5).abs() < 1e-9);
        assert!((speedup.speedup_range[1] - 15.0).abs() < 1e-9);
    }

    #[test]
    fn a_tree_that_is_not_attempted_is_not_timed() {
        let course = Course::parse(include_str!("../../../stages/course.toml")).unwrap();
        let tasks = |of_traversal: &Status| -> Vec<TaskReport> {
            let tasks = course.tasks().filter(|task| TASKS.contains(&&*task.key));
            let results = tasks.map(|task| TaskResult {
                status: match task.key == TASKS[1] {
                    true => of_traversal.clone(),
                    false => Status::Passed,
                },
                ..TaskResult::new(task, Vec::new())
            });
            results.map(TaskReport::from).collect()
        };
        assert!(is_attempted(&tasks(&Status::Failed)));
        assert!(!is_attempted(&tasks(&Status::NotAttempted)));
    }

    #[test]
    fn missing_times_name_the_task_to_write() {
        let course = Course::parse(include_str!("../../../stages/course.toml")).unwrap();
        let hole = Ending::Recorded(wire::Record {
            case: 0,
            untouched: Vec::new(),
            holes: Vec::new(),
            outcome: Outcome::NotAttempted {
                task: "part1.task3".into(),
            },
        });
        let why = why_missing("smooth", 1000, &hole, &course);
        assert_eq!(why, "it needs part1.task3 (Intersecting triangles)");
    }
}
