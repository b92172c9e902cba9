//! Every golden is what the reference answers, and is not refused by the oracle, which judges every
//! aspect of every answer. `<task>/not_judged.txt` lists what it does not judge.
//!
//! `FIRSTLIGHT_BLESS=part1.task3` (or `part1`, or `all`) writes pictures that differ as `.new.png`
//! beside the goldens, and lists as `not_judged.txt.new`; insta does the same for snapshots, as
//! `INSTA_UPDATE` says.

use grader::course::Course;
use grader::workspace::Workspace;
use judge::cases::{self, Spec};
use judge::pictures;
use judge::snapshot;
use judge::tally::Finding;
use judge::whole::{Whole, judge_whole};
use pages::picture;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use wire::work::{NodeKind, SceneWork, VisitsWork};
use wire::{Answer, Outcome, Work};

#[test]
fn part1_goldens_are_what_the_reference_answers() {
    check("part1");
}

#[test]
fn part2_goldens_are_what_the_reference_answers() {
    check("part2");
}

#[test]
fn every_box_that_is_counted_is_a_visit() {
    let specs = cases::all(0);
    let spec = specs
        .iter()
        .find(|spec| spec.is("part2.task3", "mesh_in_cornell_box"));
    let case = spec.expect("the case is there").case();
    let Work::SceneHits(SceneWork {
        scene, tree, rays, ..
    }) = case.work.clone()
    else {
        panic!("{case:?}")
    };
    let work = Work::Visits(VisitsWork {
        scene,
        tree: tree.clone(),
        rays,
    });
    let visits = match worker::run(
        0,
        &wire::Case {
            work,
            ..case.clone()
        },
    )
    .outcome
    {
        Outcome::Answered(Answer::Visits(visits)) => visits,
        // A handout: there is no tree to walk yet.
        Outcome::NotAttempted { .. } => return,
        outcome => panic!("{outcome:?}"),
    };
    let Outcome::Answered(Answer::SceneHits(hits)) = worker::run(0, &case).outcome else {
        panic!("the case has an answer")
    };
    let count: usize = visits.rays.iter().map(Vec::len).sum();
    assert_eq!(count as u64, hits.box_tests);
    for (visits, hit) in visits.rays.iter().zip(&hits.hits) {
        assert_eq!(visits[0].node, 0, "the root comes first");
        // Who hits something has met the box of a leaf.
        let is_leaf = |node: u32| matches!(tree.nodes[node as usize].kind, NodeKind::Leaf { .. });
        assert!(hit.is_none() || visits.iter().any(|visit| visit.met && is_leaf(visit.node)));
    }
}

#[test]
fn part3_goldens_are_what_the_reference_answers() {
    check("part3");
}

#[test]
fn part4_goldens_are_what_the_reference_answers() {
    check("part4");
}

#[test]
fn part5_goldens_are_what_the_reference_answers() {
    check("part5");
}

fn check(part: &str) {
    let workspace =
        Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("golden is in a workspace");
    let course = Course::read(&workspace).expect("the course is sound");
    let blessed = std::env::var("FIRSTLIGHT_BLESS").unwrap_or_default();
    let chosen =
        |key: &str| blessed.is_empty() || blessed == "all" || blessed == part || blessed == key;
    let specs = cases::all(0);
    let mut wrong = Vec::new();
    for task in course
        .tasks()
        .filter(|task| task.part_key() == part && chosen(&task.key))
    {
        let bless = !blessed.is_empty();
        let mut not_judged = Some(String::new());
        for spec in specs
            .iter()
            .filter(|spec| task.cases.iter().any(|case| spec.is(&task.key, &case.name)))
        {
            match answer(spec) {
                Ok(None) => not_judged = None,
                Ok(Some(answer)) => {
                    let whole = judge_whole(spec, judge::Tier::Robust, &answer);
                    if let Err(why) = check_case(&workspace, spec, &answer, &whole, bless) {
                        wrong.push(format!("{} {}: {why}", spec.task, spec.name));
                    }
                    if let Some(list) = &mut not_judged {
                        list.push_str(&whole.not_judged_lines(spec.name));
                    }
                }
                Err(why) => wrong.push(format!("{} {}: {why}", spec.task, spec.name)),
            }
        }
        if let Err(why) = check_task_picture(&workspace, &task.key, bless) {
            wrong.push(format!("{} {}: {why}", task.key, pictures::NAME));
        }
        // What is refused is not blessed, nor is a list of what is not judged in it.
        if let Some(list) = not_judged
            && (!bless || wrong.is_empty())
            && let Err(why) = check_not_judged(&workspace, &task.key, &list, bless)
        {
            wrong.push(format!("{}: {why}", task.key));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The reference's answer; `None` in a handout, whose tasks are carved and whose goldens wait for
/// the student.
fn answer(spec: &Spec) -> Result<Option<Answer>, String> {
    let record = worker::run(0, &spec.case());
    match record.outcome {
        Outcome::Answered(answer) if record.untouched.is_empty() => Ok(Some(answer)),
        Outcome::Answered(_) | Outcome::NotAttempted { .. } => Ok(None),
        outcome => Err(format!("{outcome:?}")),
    }
}

fn check_case(
    workspace: &Workspace,
    spec: &Spec,
    answer: &Answer,
    whole: &Whole,
    bless: bool,
) -> Result<(), String> {
    let wrong: Vec<String> = whole.wrong.iter().map(Finding::to_string).collect();
    let refused =
        (!wrong.is_empty()).then(|| format!("the oracle refuses it: {}", wrong.join("; ")));
    if bless && let Some(why) = refused {
        return Err(why);
    }
    // What is refused is left beside the golden, too: a reviewer wants to see it.
    let complaints = [
        refused,
        check_snapshot(workspace, spec, answer).err(),
        check_picture(workspace, spec, answer, bless).err(),
    ];
    let complaints: Vec<String> = complaints.into_iter().flatten().collect();
    if complaints.is_empty() {
        Ok(())
    } else {
        Err(complaints.join("\n    "))
    }
}

/// Compares the `list` of what is not judged with the stored one.
fn check_not_judged(
    workspace: &Workspace,
    task: &str,
    list: &str,
    bless: bool,
) -> Result<(), String> {
    let path = workspace.not_judged(task);
    let stored = std::fs::read_to_string(&path).unwrap_or_default();
    if stored == list {
        return Ok(());
    }
    let new = path.with_extension("txt.new");
    std::fs::write(&new, list).map_err(|e| e.to_string())?;
    if bless {
        return Ok(());
    }
    Err(format!(
        "the oracle judges more or fewer aspects than {} lists: look at {}",
        path.display(),
        new.display()
    ))
}

fn check_snapshot(workspace: &Workspace, spec: &Spec, answer: &Answer) -> Result<(), String> {
    let Some(text) = snapshot::write(&spec.work, answer) else {
        return Ok(());
    };
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(workspace.snapshot(spec.task, spec.name).with_file_name(""));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    let asserted = catch_unwind(AssertUnwindSafe(|| {
        settings.bind(|| insta::assert_snapshot!(spec.name, text))
    }));
    asserted.map_err(|_| "the snapshot differs: look at it with `cargo insta review`".to_string())
}

fn check_picture(
    workspace: &Workspace,
    spec: &Spec,
    answer: &Answer,
    bless: bool,
) -> Result<(), String> {
    let Some(size) = spec.picture else {
        return Ok(());
    };
    let actual = picture::compose(size, &spec.work, answer).ok_or("its answers make no picture")?;
    let path = workspace.golden_picture(spec.task, spec.name);
    if picture::read_png(&path).is_ok_and(|golden| golden == actual) {
        return Ok(());
    }
    let new = path.with_extension("new.png");
    picture::write_png(&new, &actual).map_err(|e| e.to_string())?;
    differs(&path, &new, bless)
}

/// The largest file of a task's picture: a handout contains all of them.
const LARGEST_PICTURE: usize = 60_000;

/// Compares the picture that students see of a task with what the reference renders, bit for bit.
fn check_task_picture(workspace: &Workspace, task: &str, bless: bool) -> Result<(), String> {
    let Some(picture) = pictures::of(task) else {
        return Ok(());
    };
    let actual = match answer(&picture.spec())? {
        Some(Answer::Picture(answer)) => ::pictures::tone::compose(&picture, &answer),
        Some(other) => return Err(format!("the worker's answer is {}", other.kind())),
        None => return Ok(()),
    };
    let path = workspace.golden_picture(task, pictures::NAME);
    if ::pictures::png::read(&path).is_ok_and(|golden| golden == actual) {
        return Ok(());
    }
    let file = ::pictures::png::encode_smallest(&actual);
    let new = path.with_extension("new.png");
    std::fs::write(&new, &file).map_err(|e| e.to_string())?;
    if file.len() > LARGEST_PICTURE {
        return Err(format!(
            "{} has {} bytes, expected at most {LARGEST_PICTURE}: give its panels fewer steps or more samples",
            new.display(),
            file.len()
        ));
    }
    differs(&path, &new, bless)
}

/// That the new picture differs is an error, unless it is to be blessed.
fn differs(path: &Path, new: &Path, bless: bool) -> Result<(), String> {
    if bless {
        Ok(())
    } else {
        Err(format!(
            "the picture differs: look at {} and {}",
            path.display(),
            new.display()
        ))
    }
}
