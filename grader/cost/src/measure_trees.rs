//! Building and walking trees, in turns.

use super::clock::{Rounds, timing};
use super::measure::Size;
use super::overlaps::Overlaps;
use super::quartiles::Quartiles;
use super::report::Timing;
use super::student::{Missing, Student};
use super::trees::{Trace, Tree, Trees, Walk};
use grader::error::GraderError;
use grader::speedup;
use grader::workspace::Workspace;
use judge::convert;
use kernels::{Builder, Pass, Walker, brute_force};
use kit::{Bvh, Ray, Triangle};
use meshes::{MeshKind, generate};
use std::rc::Rc;
use std::time::Instant;
use wire::Work;
use wire::answer::TimingAnswer;
use wire::work::{SceneSource, TimingWork};

/// A rough mesh: triangles of many sizes, and much of it hides behind the rest.
const MESH: MeshKind = MeshKind::Terrain;

/// Primitives in a leaf at most: the assignment's choice.
const MAX_LEAF_SIZE: usize = 4;

/// What is compared.
const SLACKS: [u32; 3] = [0, 2, 16];

/// Enough for every ray: what trees are compared with.
const SAFE: u32 = 16;

/// Of the rays through the mesh one in so many is timed.
const EVERY: usize = 16;

/// Rays through the mesh that are held against brute force.
const CHECKED: usize = 64;

/// What all trees hang in.
struct Scene {
    triangles: Vec<Triangle>,
    rays: Vec<Ray>,
}

/// Measures trees over one mesh; the student's through the worker. `None` where they would give a task away.
pub(super) fn measure(
    workspace: Option<&Workspace>,
    seed: u64,
    size: Size,
) -> Result<Option<Trees>, GraderError> {
    let builders = kernels::builders();
    let Some(first) = builders.first() else {
        return Ok(None);
    };
    let scene = Rc::new(Scene {
        triangles: generate(MESH, size.mesh),
        rays: speedup::rays().iter().map(convert::ray).collect(),
    });
    let overlaps = Overlaps::new(seed, size.rays);
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
    let build_passes = trees.iter().map(|tree| pass(&scene, tree, SAFE));
    let mut passes: Vec<Pass> = slack_passes.into_iter().chain(build_passes).collect();
    let rounds = Rounds::take(
        &mut passes,
        scene.rays.len().div_ceil(EVERY),
        size.turns * size.rounds,
    );
    let (slack_ns, build_ns) = rounds.ns().split_at(SLACKS.len());

    let by_slack = SLACKS.iter().zip(slack_ns).map(|(slack_ulp, ns)| Walk {
        slack_ulp: *slack_ulp,
        trace: trace(
            &scene,
            &trees[0],
            *slack_ulp,
            timing(ns, &slack_ns[0]),
            (&overlaps, first),
        ),
    });
    let by_build = (builders.iter().zip(&trees).zip(&build_s).zip(build_ns)).map(
        |(((builder, tree), build_s), ns)| {
            let build_s = Quartiles::of(build_s.iter().copied());
            let time = timing(ns, &build_ns[0]);
            Tree {
                name: builder.name.into(),
                paper: builder.paper.into(),
                student: false,
                build_s: build_s.median,
                build_spread_s: build_s.spread(),
                nodes: Some(tree.nodes.len()),
                trace: trace(&scene, tree, SAFE, time, (&overlaps, builder)),
                pays_after_rays: None,
            }
        },
    );
    let mut by_build: Vec<Tree> = by_build.collect();
    let student_missing = match student(workspace, size)? {
        Ok(times) => {
            by_build.push(of_student(&times, &by_build[0]));
            None
        }
        Err(missing) => Some(missing),
    };
    let (build_s, ns) = (by_build[0].build_s, by_build[0].trace.time.ns_median);
    for tree in &mut by_build {
        tree.pays_after_rays = pays_after(tree, build_s, ns);
    }
    Ok(Some(Trees {
        mesh: MESH.name().into(),
        triangles: scene.triangles.len(),
        by_slack: by_slack.collect(),
        by_build,
        student_missing,
    }))
}

/// Some of the rays through a tree, evenly spread: a pass is short, so that not every one is interrupted.
fn pass(scene: &Rc<Scene>, tree: &Rc<Bvh>, slack_ulp: u32) -> Pass {
    let (scene, tree) = (Rc::clone(scene), Rc::clone(tree));
    let mut walker = Walker::new(slack_ulp);
    Box::new(move || {
        let closest = |ray| walker.closest(&tree, &scene.triangles, ray);
        let rays = scene.rays.iter().step_by(EVERY);
        rays.filter_map(closest).count()
    })
}

/// What a walk costs and finds, given its time.
fn trace(
    scene: &Scene,
    tree: &Bvh,
    slack_ulp: u32,
    time: Timing,
    (overlaps, builder): (&Overlaps, &Builder),
) -> Trace {
    let mut walker = Walker::new(slack_ulp);
    for ray in &scene.rays {
        walker.closest(tree, &scene.triangles, ray);
    }
    let rays = scene.rays.len() as f64;
    let (box_tests, prim_tests) = (walker.box_tests, walker.prim_tests);
    let checked = scene
        .rays
        .iter()
        .step_by(scene.rays.len().div_ceil(CHECKED));
    let checked: Vec<&Ray> = checked.collect();
    let differs = |ray: &&&Ray| {
        walker.closest(tree, &scene.triangles, ray) != brute_force(&scene.triangles, ray)
    };
    let wrong = checked.iter().filter(differs).count() + overlaps.wrong(builder, slack_ulp);
    let checked_rays = checked.len() + overlaps.rays();
    Trace {
        time,
        box_tests: box_tests as f64 / rays,
        prim_tests: prim_tests as f64 / rays,
        checked_rays,
        wrong_per_million: 1e6 * wrong as f64 / checked_rays as f64,
    }
}

/// The student's tree over the same mesh, with the student's own tests.
fn student(
    workspace: Option<&Workspace>,
    size: Size,
) -> Result<Result<TimingAnswer, Missing>, GraderError> {
    let student = match Student::with("meshes", "part2.task1", workspace)? {
        Ok(student) => student,
        Err(missing) => return Ok(Err(missing)),
    };
    let timing = TimingWork {
        scene: SceneSource::Generated(MESH.name().into(), size.mesh as u32),
        max_leaf_size: MAX_LEAF_SIZE as u32,
        rays: speedup::rays(),
        brute_force_rays: CHECKED as u32,
        rounds: size.builds as u32,
    };
    student.ask(Work::Timing(timing)).map(|answer| {
        answer.and_then(|answer| match answer {
            wire::Answer::Timing(times) => Ok(times),
            _ => Err("the worker answered to other work than it was given".into()),
        })
    })
}

fn of_student(times: &TimingAnswer, midpoint: &Tree) -> Tree {
    let rays = times.tree_rays.max(1) as f64;
    let build_s = Quartiles::of(times.build_s.iter().copied());
    let ns = Quartiles::of(times.tree_s.iter().map(|s| 1e9 * s / rays));
    // Not in turns with the others: only the medians can be compared.
    let ratio = ns.median / midpoint.trace.time.ns_median;
    let spread = (ns.spread() + midpoint.trace.time.ns_spread) / midpoint.trace.time.ns_median;
    Tree {
        name: "yours".into(),
        paper: "stages/bvh".into(),
        student: true,
        build_s: build_s.median,
        build_spread_s: build_s.spread(),
        nodes: None,
        trace: Trace {
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
        pays_after_rays: None,
    }
}

/// After how many rays a tree has made up for its longer building, against one that takes `build_s` and `ns` a ray.
fn pays_after(tree: &Tree, build_s: f64, ns: f64) -> Option<f64> {
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

    fn tree(build_s: f64, ns: f64) -> Tree {
        Tree {
            name: String::new(),
            paper: String::new(),
            student: false,
            build_s,
            build_spread_s: 0.0,
            nodes: None,
            trace: Trace {
                time: Timing {
                    ns_median: ns,
                    ..Timing::default()
                },
                box_tests: 0.0,
                prim_tests: 0.0,
                checked_rays: 0,
                wrong_per_million: 0.0,
            },
            pays_after_rays: None,
        }
    }

    #[test]
    fn a_better_tree_pays_for_itself_and_a_worse_one_never_does() {
        let better = pays_after(&tree(3.0, 500.0), 1.0, 1000.0).unwrap();
        assert!((better - 4e6).abs() < 1.0);
        assert_eq!(pays_after(&tree(3.0, 1000.0), 1.0, 1000.0), None);
        assert_eq!(pays_after(&tree(1.0, 900.0), 1.0, 1000.0), Some(0.0));
        assert_eq!(pays_after(&tree(0.5, 1100.0), 1.0, 1000.0), None);
    }
}
