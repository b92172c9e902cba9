//! Every golden is what the reference answers, and what the oracle confirms.
//!
//! `FIRSTLIGHT_BLESS=part1.task3` (or `part1`, or `all`) writes pictures that differ as `.new.png` beside the
//! goldens; insta does the same for snapshots, as `INSTA_UPDATE` says.

use grader::cases::{self, Spec};
use grader::course::Course;
use grader::judge;
use grader::workspace::Workspace;
use grader::{picture, snapshot};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use wire::{Answer, Outcome};

#[test]
fn part1_goldens_are_what_the_reference_answers() {
    check("part1");
}

#[test]
fn part2_goldens_are_what_the_reference_answers() {
    check("part2");
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
        for spec in specs
            .iter()
            .filter(|spec| task.cases.iter().any(|case| spec.is(&task.key, &case.name)))
        {
            if let Err(why) = check_case(&workspace, spec, !blessed.is_empty()) {
                wrong.push(format!("{} {}: {why}", spec.task, spec.name));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn check_case(workspace: &Workspace, spec: &Spec, bless: bool) -> Result<(), String> {
    let record = worker::run(0, &spec.case());
    let answer = match record.outcome {
        Outcome::Answered(answer) if record.untouched.is_empty() => answer,
        // A handout: the task is carved, and its goldens wait for the student.
        Outcome::Answered(_) | Outcome::NotAttempted { .. } => return Ok(()),
        outcome => return Err(format!("{outcome:?}")),
    };
    let tier = grader::course::Tier::Robust;
    let lost: Vec<_> = judge::judge(spec, tier, &answer)
        .into_iter()
        .filter(|finding| !finding.passed())
        .collect();
    if !lost.is_empty() {
        return Err(format!("the oracle does not confirm it: {lost:?}"));
    }
    check_snapshot(workspace, spec, &answer)?;
    check_picture(workspace, spec, &answer, bless)
}

fn check_snapshot(workspace: &Workspace, spec: &Spec, answer: &Answer) -> Result<(), String> {
    let Some(text) = snapshot::write(&spec.work, answer) else {
        return Ok(());
    };
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(workspace.snapshot(spec.task, spec.name).with_file_name(""));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_description(spec.about);
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
    let actual = picture::compose(size, answer).ok_or("its answers make no picture")?;
    let path = workspace.golden_picture(spec.task, spec.name);
    if picture::read_png(&path).is_ok_and(|golden| golden == actual) {
        return Ok(());
    }
    let new = path.with_extension("new.png");
    picture::write_png(&new, &actual).map_err(|e| e.to_string())?;
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
