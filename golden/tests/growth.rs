//! How the time of builds grows, judged as the grader does: no load of the machine makes a correct
//! build lose points, and a quadratic one loses them. Minutes, so `.ci/nightly growth` runs it.

mod builds;
#[rustfmt::skip]
#[path = "../../grader/mutants/variants/bvh"]
mod variants {
    #![allow(
        clippy::all,
        dead_code,
        unreachable_pub,
        unused_imports,
        reason = "written as students write it; only the build is used"
    )]
    pub(super) mod binned_sah;
    pub(super) mod breadth_first;
    pub(super) mod iterative;
    pub(super) mod java_style;
    pub(super) mod lists;
    pub(super) mod sah_sweep;
}

use crate::shared::{SPECS, spec};
use base::Workspace;
use builds::{Build, CORRECT, QUADRATIC};
use grader::course::Course;
use judge::Tier;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use wire::{Answer, Work};

/// Correct builds: the reference, versions of the corpus that differ most, and other kinds.
fn correct() -> Vec<(&'static str, Build)> {
    let mut all: Vec<(&'static str, Build)> = vec![
        ("reference", bvh::construct_bvh),
        ("binned SAH", variants::binned_sah::construct_bvh),
        ("breadth first", variants::breadth_first::construct_bvh),
        ("iterative", variants::iterative::construct_bvh),
        ("Java style", variants::java_style::construct_bvh),
        ("lists", variants::lists::construct_bvh),
        ("SAH sweep", variants::sah_sweep::construct_bvh),
    ];
    all.extend(CORRECT);
    all
}

/// Whether the build keeps the points of the case, and why nothing was judged, if so.
fn result(build: Build) -> (bool, Option<&'static str>) {
    let spec = spec("part2.task1", "growth_of_the_build_time");
    let Work::BuildGrowth(work) = &spec.work else {
        panic!("another kind of work");
    };
    let answer = driver::build_growth::time_builds(work, build);
    let findings = judge::judge(spec, Tier::Robust, &Answer::BuildGrowth(answer));
    (findings[0].passed(), findings[0].undecided)
}

#[test]
fn no_core_point_depends_on_a_time() {
    let workspace = Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR")));
    let course = Course::read(&workspace.expect("it exists")).expect("the course is sound");
    let is_timed = |work: &Work| {
        matches!(
            work,
            Work::BuildGrowth(_) | Work::Timing(_) | Work::TimeTest(_)
        )
    };
    let mut timed = 0;
    for spec in SPECS.iter().filter(|spec| is_timed(&spec.work)) {
        let task = course.tasks().find(|task| task.key == spec.task);
        let cases = &task.expect("the task exists").cases;
        let case = cases.iter().find(|case| case.name == spec.name);
        assert_eq!(
            case.map(|case| case.tier),
            Some(Tier::Robust),
            "{}",
            spec.name
        );
        timed += 1;
    }
    assert!(timed > 0);
}

/// Reads and writes 256 MB at random until `stop`.
fn thrash(stop: &AtomicBool, seed: usize) {
    let mut memory = vec![0_u64; 1 << 25];
    let mut at = seed;
    while !stop.load(Ordering::Relaxed) {
        for _ in 0..1 << 16 {
            at = at.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
            memory[(at >> 20) % (1 << 25)] ^= at as u64;
        }
    }
}

/// Set `FIRSTLIGHT_RUNS` for more runs of each build.
#[test]
#[ignore = "minutes of CPU: run by .ci/nightly growth"]
fn no_load_makes_a_correct_build_lose_points() {
    let runs = std::env::var("FIRSTLIGHT_RUNS").map_or(5, |runs| runs.parse().expect("a number"));
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let stop = AtomicBool::new(false);
    let mut lost = Vec::new();
    let mut undecided = 0;
    thread::scope(|scope| {
        for seed in 0..2 * cores {
            let stop = &stop;
            scope.spawn(move || thrash(stop, seed));
        }
        for run in 0..runs {
            for (name, build) in correct() {
                let (passed, why) = result(build);
                undecided += u32::from(why.is_some());
                if !passed {
                    lost.push(format!("{name} in run {run}"));
                }
            }
        }
        stop.store(true, Ordering::Relaxed);
    });
    println!(
        "{runs} runs of {} builds, {undecided} not judged",
        correct().len()
    );
    assert_eq!(lost, Vec::<String>::new());
}

#[test]
#[ignore = "minutes of CPU: run by .ci/nightly growth"]
fn a_quadratic_build_loses_the_points() {
    let kept: Vec<_> = QUADRATIC
        .into_iter()
        .map(|(name, build)| (name, result(build)))
        .filter(|(_, (passed, _))| *passed)
        .collect();
    assert_eq!(kept, []);
}
