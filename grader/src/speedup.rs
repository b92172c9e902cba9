//! What a tree saves: the student's brute force against the student's tree, over generated meshes of growing size.
//!
//! Times say how fast, on this machine and today; tests per ray say why, and are the same everywhere. Neither earns
//! points: times are no one's fault, and the work is judged where it can be told whose it is.

use crate::course::{Course, Task};
use crate::error::GraderError;
use crate::runner::{self, Ending, Worker};
use judge::cases::recorded::{self, RayWork};
use kit::Vec3;
use serde::Serialize;
use wire::answer::TimingAnswer;
use wire::work::{Ray, SceneSource, TimingWork};
use wire::{Answer, Outcome, Work};

/// The times of Part 2.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Speedups {
    /// One mesh of one size each.
    pub rows: Vec<Speedup>,
    /// How cost grows with size, mesh by mesh.
    pub growth: Vec<Growth>,
    /// Why rows are missing, if some are.
    pub missing: Option<String>,
}

/// What the tree saves on one mesh. Times are medians of rounds in which tree and brute force take turns.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Speedup {
    /// Name of the mesh.
    pub mesh: String,
    /// Triangles in it.
    pub triangles: u64,
    /// Seconds to build the tree.
    pub build_s: f64,
    /// Rays through the tree, each round.
    pub tree_rays: u64,
    /// Seconds a ray through the tree.
    pub tree_s: f64,
    /// Rays through brute force, each round: a sample, from which the whole is extrapolated.
    pub brute_rays: u64,
    /// Seconds a ray through brute force.
    pub brute_s: f64,
    /// How many times as long brute force takes for the same rays, the building of the tree left aside.
    pub speedup: f64,
    /// Box and primitive tests a ray.
    pub work: RayWork,
    /// The same of the reference, recorded.
    pub reference: RayWork,
    /// On how many rays of the sample tree and brute force disagree about `t`.
    pub differing_hits: u64,
}

/// How the cost of a ray grows with the number of triangles `n`: as `n` to the power of the slope of log cost over
/// log `n`, fitted by least squares.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Growth {
    /// Name of the mesh.
    pub mesh: String,
    /// Of the time by brute force; 1 is proportional.
    pub brute: f64,
    /// Of the time through the tree.
    pub tree: f64,
    /// Of the box and primitive tests through the tree.
    pub tests: f64,
    /// Of the time to build the tree.
    pub build: f64,
}

/// The meshes that are timed: one smooth, one rough.
const MESHES: [&str; 2] = ["smooth", "terrain"];

/// Their sizes in triangles.
const SIZES: [u32; 4] = [1_000, 10_000, 100_000, 1_000_000];

/// Triangle tests of a brute-force sample: some 20 ms, long enough for the clock.
const SAMPLE_TESTS: u32 = 4_000_000;

/// Rays in a brute-force sample at least, so that it is one.
const SAMPLE_RAYS: u32 = 8;

/// How often tree and brute force take turns.
const ROUNDS: u32 = 3;

/// Milliseconds after which a size has failed: a build that is not quadratic takes one or two seconds.
const LIMIT_MS: u64 = 20_000;

/// Primitives in a leaf at most: the assignment's choice.
const MAX_LEAF_SIZE: u32 = 4;

/// Whether `tasks` are those whose speedup is shown: building the tree and walking it.
pub fn belongs_to(tasks: &[&Task]) -> bool {
    ["part2.task1", "part2.task3"]
        .iter()
        .all(|key| tasks.iter().any(|task| task.key == *key))
}

/// Times the code in `worker`; or says which stages there is none for.
pub fn measure(course: &Course, worker: &Result<Worker, String>) -> Result<Speedups, GraderError> {
    let mut speedups = Speedups::default();
    let worker = match worker {
        Ok(worker) => worker,
        Err(broken) => {
            speedups.missing = Some(format!("it needs {broken}, which does not compile"));
            return Ok(speedups);
        }
    };
    let orders: Vec<(&str, u32)> = MESHES
        .iter()
        .flat_map(|mesh| SIZES.map(|size| (*mesh, size)))
        .collect();
    let cases: Vec<wire::Case> = orders
        .iter()
        .map(|&(mesh, size)| case(mesh, size))
        .collect();
    let run = runner::run(worker, &cases)?;
    for ((mesh, size), ending) in orders.into_iter().zip(&run.endings) {
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
        brute_force_rays: (SAMPLE_TESTS / size).max(SAMPLE_RAYS),
        rounds: ROUNDS,
    };
    wire::Case {
        task: mesh.into(),
        name: size.to_string(),
        limit_ms: LIMIT_MS,
        work: Work::Timing(timing),
    }
}

/// From an eye beside the mesh, which fills the cube from -1 to 1, through points spread evenly over a square in its
/// middle that faces the eye.
pub fn rays() -> Vec<Ray> {
    const SIDE: u32 = 128;
    let eye = Vec3::new(1.6, 1.4, 2.4);
    let backward = eye.normalize();
    let right = Vec3::Y.cross(backward).normalize();
    let up = backward.cross(right);
    let share = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE) - 0.5;
    let points = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
    points
        .map(|(x, y)| {
            let target = 2.2 * (share(x) * right + share(y) * up);
            Ray {
                o: eye.into(),
                d: (target - eye).normalize().into(),
                min_t: 0.0,
                max_t: f64::INFINITY,
            }
        })
        .collect()
}

/// Why there are no times, in words that end the sentence "timing stops at ...".
fn why_missing(mesh: &str, size: u32, ending: &Ending, course: &Course) -> String {
    let at = format!("the {mesh} mesh of {size} triangles");
    match ending {
        Ending::TimedOut { limit_ms, .. } => {
            format!("{at} takes more than {} s", limit_ms / 1000)
        }
        Ending::Died(how) => format!("on {at} your code {how}"),
        Ending::Malformed(why) => format!("at {at} {why}"),
        Ending::Skipped => format!("{at} is skipped, as smaller ones took too long"),
        Ending::Recorded(record) => match &record.outcome {
            Outcome::NotAttempted { task } => {
                let title = course.tasks().find(|known| known.key == *task);
                let title = title.map_or("", |task| &task.title);
                format!("it needs {task} ({title})")
            }
            Outcome::Panicked { message, .. } => format!("on {at} your code panics: {message}"),
            Outcome::Unable { reason } => reason.clone(),
            Outcome::Answered(_) => format!("{at} was not timed"),
        },
    }
}

impl Speedup {
    fn new(mesh: &str, size: u32, times: &TimingAnswer) -> Speedup {
        let rays = times.tree_rays as f64;
        let tree_s = median(&times.tree_s) / rays;
        let brute_s = median(&times.brute_s) / times.brute_rays as f64;
        Speedup {
            mesh: mesh.into(),
            triangles: times.primitives,
            build_s: median(&times.build_s),
            tree_rays: times.tree_rays,
            tree_s,
            brute_rays: times.brute_rays,
            brute_s,
            speedup: brute_s / tree_s,
            work: RayWork {
                boxes: times.box_tests as f64 / rays,
                prims: times.prim_tests as f64 / rays,
            },
            reference: recorded::rays(mesh, size),
            differing_hits: times.differing_hits,
        }
    }
}

impl Growth {
    /// The slopes of a mesh that was timed in two sizes at least.
    fn of(mesh: &str, rows: &[Speedup]) -> Option<Growth> {
        let rows: Vec<&Speedup> = rows.iter().filter(|row| row.mesh == mesh).collect();
        let of = |cost: fn(&Speedup) -> f64| {
            let points: Vec<(f64, f64)> = rows
                .iter()
                .map(|row| (row.triangles as f64, cost(row)))
                .collect();
            slope(&points)
        };
        Some(Growth {
            mesh: mesh.into(),
            brute: of(|row| row.brute_s)?,
            tree: of(|row| row.tree_s)?,
            tests: of(|row| row.work.boxes + row.work.prims)?,
            build: of(|row| row.build_s)?,
        })
    }
}

/// The slope of the straight line through the logarithms of the points, by least squares; `None` if they have one
/// size only.
pub fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let n = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let mean_x = logs.iter().map(|(x, _)| x).sum::<f64>() / n;
    let mean_y = logs.iter().map(|(_, y)| y).sum::<f64>() / n;
    let along: f64 = logs.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    let across: f64 = logs.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    (along > 0.0).then_some(across / along)
}

/// The middle one; of an even number the lower of the two in the middle.
fn median(times: &[f64]) -> f64 {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len().saturating_sub(1) / 2;
    sorted.get(middle).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_has_its_exponent_for_a_slope() {
        let cube_root: Vec<(f64, f64)> = [1e3, 1e4, 1e6].map(|n: f64| (n, 7.0 * n.cbrt())).into();
        assert!((slope(&cube_root).unwrap() - 1.0 / 3.0).abs() < 1e-12);
        assert_eq!(slope(&[(1e3, 1.0)]), None);
    }

    #[test]
    fn one_slow_round_does_not_move_the_median() {
        assert_eq!(median(&[1.0, 99.0, 1.5]), 1.5);
        assert!(median(&[]).is_nan());
    }

    #[test]
    fn what_is_missing_is_said() {
        let course = Course::parse(include_str!("../../stages/course.toml")).unwrap();
        let hole = Ending::Recorded(wire::Record {
            case: 0,
            untouched: Vec::new(),
            outcome: Outcome::NotAttempted {
                task: "part1.task3".into(),
            },
        });
        let why = why_missing("smooth", 1000, &hole, &course);
        assert_eq!(why, "it needs part1.task3 (Intersecting triangles)");
    }
}
