//! Interleaved measurements of tree construction and traversal.

use super::coplanar::CoplanarScenes;
use super::measure::SampleCounts;
use super::quartiles::Quartiles;
use super::report::Timing;
use super::student::{MissingReason, Student};
use super::timing::{Rounds, timing};
use super::trees::{SlackRow, TraversalCost, TreeReport, TreeRow};
use grader::error::GraderError;
use grader::speedup;
use grader::workspace::Workspace;
use judge::convert;
use kernels::{Builder, Pass, Traversal, brute_force};
use kit::{Bvh, Ray, Triangle};
use meshes::{MeshKind, generate};
use std::rc::Rc;
use std::time::Instant;
use wire::Work;
use wire::answer::TimingAnswer;
use wire::work::{SceneSource, TimingWork};

/// A rough mesh: its triangles vary in size, and much of it is occluded.
const MESH: MeshKind = MeshKind::Terrain;

/// Largest number of primitives in a leaf: the assignment's choice.
const MAX_LEAF_SIZE: usize = 4;

/// The values of slack that are compared, in ulp.
const SLACKS: [u32; 3] = [0, 2, 16];

/// Slack that is enough for every ray, used to compare trees.
const SAFE_SLACK: u32 = 16;

/// One in this many rays is timed.
const TIMED_EVERY: usize = 16;

/// Number of rays that are compared with brute force.
const CHECKED_RAYS: usize = 64;

/// The scene that all trees are built over.
struct Scene {
    triangles: Vec<Triangle>,
    rays: Vec<Ray>,
}

/// Measures trees over one mesh, the student's through the worker. `None` in a handout that does
/// not contain the builders, because they would be a solution.
pub(super) fn measure(
    workspace: Option<&Workspace>,
    seed: u64,
    size: SampleCounts,
) -> Result<Option<TreeReport>, GraderError> {
    let builders = kernels::builders();
    let Some(first) = builders.first() else {
        return Ok(None);
    };
    let scene = Rc::new(Scene {
        triangles: generate(MESH, size.mesh),
        rays: speedup::rays().iter().map(convert::ray).collect(),
    });
    let coplanar = CoplanarScenes::new(seed, size.rays);
    let bounds: Vec<_> = scene.triangles.iter().map(Triangle::bounds).collect();

    let mut build_s = vec![Vec::new(); builders.len()];
    let mut trees = Vec::new();
    for round in 0..size.builds {
        for (builder, seconds) in builders.iter().zip(&mut build_s) {
            let started = Instant::now();
            let tree = (builder.build)(&bounds, MAX_LEAF_SIZE);
            seconds.push(started.elapsed().as_secs_f64());
            if round == 0 {
                trees.push(Rc::new(tree));
            }
        }
    }
    let slack_passes = SLACKS.map(|slack| pass(&scene, &trees[0], slack));
    let build_passes = trees.iter().map(|tree| pass(&scene, tree, SAFE_SLACK));
    let mut passes: Vec<Pass> = slack_passes.into_iter().chain(build_passes).collect();
    let rounds = Rounds::measure(
        &mut passes,
        scene.rays.len().div_ceil(TIMED_EVERY),
        size.turns * size.rounds,
    );
    let (slack_ns, build_ns) = rounds.ns().split_at(SLACKS.len());

    let by_slack = SLACKS.iter().zip(slack_ns).map(|(slack_ulp, ns)| SlackRow {
        slack_ulp: *slack_ulp,
        trace: trace(
            &scene,
            &trees[0],
            *slack_ulp,
            timing(ns, &slack_ns[0]),
            (&coplanar, first),
        ),
    });
    let by_build = (builders.iter().zip(&trees).zip(&build_s).zip(build_ns)).map(
        |(((builder, tree), build_s), ns)| {
            let build_s = Quartiles::of(build_s.iter().copied());
            let time = timing(ns, &build_ns[0]);
            TreeRow {
                name: builder.name.into(),
                paper: builder.paper.into(),
                student: false,
                build_s: build_s.median,
                build_spread_s: build_s.spread(),
                nodes: Some(tree.nodes.len()),
                trace: trace(&scene, tree, SAFE_SLACK, time, (&coplanar, builder)),
                break_even_rays: None,
            }
        },
    );
    let mut by_build: Vec<TreeRow> = by_build.collect();
    let student_missing = match student(workspace, size)? {
        Ok(times) => {
            by_build.push(student_row(&times, &by_build[0]));
            None
        }
        Err(missing) => Some(missing),
    };
    let (build_s, ns) = (by_build[0].build_s, by_build[0].trace.time.ns_median);
    for tree in &mut by_build {
        tree.break_even_rays = break_even(tree, build_s, ns);
    }
    Ok(Some(TreeReport {
        mesh: MESH.name().into(),
        triangles: scene.triangles.len(),
        by_slack: by_slack.collect(),
        by_build,
        student_missing,
    }))
}

/// Returns a pass that traces an evenly spaced part of the rays. It is short, so that most passes
/// are not interrupted.
fn pass(scene: &Rc<Scene>, tree: &Rc<Bvh>, slack_ulp: u32) -> Pass {
    let (scene, tree) = (Rc::clone(scene), Rc::clone(tree));
    let mut traversal = Traversal::new(slack_ulp);
    Box::new(move || {
        let closest = |ray| traversal.closest(&tree, &scene.triangles, ray);
        let rays = scene.rays.iter().step_by(TIMED_EVERY);
        rays.filter_map(closest).count()
    })
}

/// Counts the tests of a traversal and its wrong hits; `time` is given.
fn trace(
    scene: &Scene,
    tree: &Bvh,
    slack_ulp: u32,
    time: Timing,
    (coplanar, builder): (&CoplanarScenes, &Builder),
) -> TraversalCost {
    let mut traversal = Traversal::new(slack_ulp);
    for ray in &scene.rays {
        traversal.closest(tree, &scene.triangles, ray);
    }
    let rays = scene.rays.len() as f64;
    let (box_tests, prim_tests) = (traversal.box_tests, traversal.prim_tests);
    let checked = scene
        .rays
        .iter()
        .step_by(scene.rays.len().div_ceil(CHECKED_RAYS));
    let checked: Vec<&Ray> = checked.collect();
    let differs = |ray: &&&Ray| {
        traversal.closest(tree, &scene.triangles, ray) != brute_force(&scene.triangles, ray)
    };
    let wrong = checked.iter().filter(differs).count() + coplanar.wrong(builder, slack_ulp);
    let checked_rays = checked.len() + coplanar.rays();
    TraversalCost {
        time,
        box_tests: box_tests as f64 / rays,
        prim_tests: prim_tests as f64 / rays,
        checked_rays,
        wrong_per_million: 1e6 * wrong as f64 / checked_rays as f64,
    }
}

/// Measures the student's tree over the same mesh, with the student's own tests.
fn student(
    workspace: Option<&Workspace>,
    size: SampleCounts,
) -> Result<Result<TimingAnswer, MissingReason>, GraderError> {
    let student = match Student::build_with("meshes", "part2.task1", workspace)? {
        Ok(student) => student,
        Err(missing) => return Ok(Err(missing)),
    };
    let timing = TimingWork {
        scene: SceneSource::Generated(MESH.name().into(), size.mesh as u32),
        max_leaf_size: MAX_LEAF_SIZE as u32,
        rays: speedup::rays(),
        brute_force_rays: CHECKED_RAYS as u32,
        rounds: size.builds as u32,
    };
    student.run(Work::Timing(timing)).map(|answer| {
        answer.and_then(|answer| match answer {
            wire::Answer::Timing(times) => Ok(times),
            _ => Err("the worker's answer is for another kind of work".into()),
        })
    })
}

fn student_row(times: &TimingAnswer, midpoint: &TreeRow) -> TreeRow {
    let rays = times.tree_rays.max(1) as f64;
    let build_s = Quartiles::of(times.build_s.iter().copied());
    let ns = Quartiles::of(times.tree_s.iter().map(|s| 1e9 * s / rays));
    // Not interleaved with the others, so only the medians can be compared.
    let ratio = ns.median / midpoint.trace.time.ns_median;
    let spread = (ns.spread() + midpoint.trace.time.ns_spread) / midpoint.trace.time.ns_median;
    TreeRow {
        name: "yours".into(),
        paper: "stages/bvh".into(),
        student: true,
        build_s: build_s.median,
        build_spread_s: build_s.spread(),
        nodes: None,
        trace: TraversalCost {
            time: Timing {
                ns_median: ns.median,
                ns_spread: ns.spread(),
                ratio_to_textbook: ratio,
                ratio_spread: spread,
                inside_noise: (ratio - 1.0).abs() <= spread,
            },
            box_tests: times.box_tests as f64 / rays,
            prim_tests: times.prim_tests as f64 / rays,
            checked_rays: times.brute_rays as usize,
            wrong_per_million: 1e6 * times.differing_hits as f64 / times.brute_rays.max(1) as f64,
        },
        break_even_rays: None,
    }
}

/// Returns the number of rays after which the time saved in tracing equals the additional time of
/// construction, against a tree that takes `build_s` to build and `ns` per ray.
fn break_even(tree: &TreeRow, build_s: f64, ns: f64) -> Option<f64> {
    let longer_s = tree.build_s - build_s;
    let saved_s = 1e-9 * (ns - tree.trace.time.ns_median);
    if longer_s <= 0.0 && saved_s >= 0.0 {
        return Some(0.0);
    }
    (saved_s > 0.0).then(|| longer_s / saved_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tree(build_s: f64, ns: f64) -> TreeRow {
        TreeRow {
            name: String::new(),
            paper: String::new(),
            student: false,
            build_s,
            build_spread_s: 0.0,
            nodes: None,
            trace: TraversalCost {
                time: Timing {
                    ns_median: ns,
                    ..Timing::default()
                },
                box_tests: 0.0,
                prim_tests: 0.0,
                checked_rays: 0,
                wrong_per_million: 0.0,
            },
            break_even_rays: None,
        }
    }

    #[test]
    fn a_faster_tree_breaks_even_and_a_slower_one_never_does() {
        let better = break_even(&tree(3.0, 500.0), 1.0, 1000.0).unwrap();
        assert!((better - 4e6).abs() < 1.0);
        assert_eq!(break_even(&tree(3.0, 1000.0), 1.0, 1000.0), None);
        assert_eq!(break_even(&tree(1.0, 900.0), 1.0, 1000.0), Some(0.0));
        assert_eq!(break_even(&tree(0.5, 1100.0), 1.0, 1000.0), None);
    }
}
