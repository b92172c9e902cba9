//! Which features the stages of this project lack.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use viewer::features::{Feature, MissingFeatures};
use viewer::task::{StageFailure, silence_holes};

/// The tasks with a hole in the stages of this project: none in a complete one.
fn open_tasks() -> BTreeSet<String> {
    let stages = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut folders: Vec<_> = fs::read_dir(stages)
        .expect("the stages")
        .map(|stage| stage.expect("an entry").path().join("src"))
        .filter(|folder| folder.is_dir() && !folder.ends_with("viewer/src"))
        .collect();
    let mut tasks = BTreeSet::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "rs") {
                let text = fs::read_to_string(&path).expect("a source file");
                let holes = text.lines().filter_map(|line| {
                    let key = line.trim_start().strip_prefix("kit::hole!(\"")?;
                    Some(key.split_once('"')?.0.to_owned())
                });
                tasks.extend(holes);
            }
        }
    }
    tasks
}

/// The tasks that a feature cannot do without.
fn tasks_of(feature: Feature) -> &'static [&'static str] {
    match feature {
        Feature::Pictures => &["part1.task1", "part1.task2", "part1.task3"],
        Feature::Light => &["part3.task1", "part3.task3"],
        Feature::Hemisphere => &["part3.task2"],
        Feature::Mis => &["part3.task3"],
        Feature::Bounces => &["part4.task2"],
        Feature::Adaptive => &["part5.task2"],
        Feature::WideTree => &["part6.task1"],
    }
}

/// What is greyed is what the holes of the sources say: nothing in a complete project, and in a handout
/// each feature whose task is open, with the name of an open task.
#[test]
fn the_greyed_features_are_those_of_the_holes() {
    silence_holes();
    let open = open_tasks();
    let missing = MissingFeatures::find();
    for feature in Feature::ALL {
        let is_open = tasks_of(feature).iter().any(|task| open.contains(*task));
        match missing.why(feature) {
            Some(StageFailure::Hole(task)) => {
                assert!(
                    open.contains(*task),
                    "{feature:?} waits for {task}, which is written"
                );
            }
            Some(StageFailure::Panic(why)) => panic!("{feature:?}: {why}"),
            None => assert!(
                !is_open,
                "{feature:?} works without {:?}",
                tasks_of(feature)
            ),
        }
    }
    if open.is_empty() {
        assert_eq!(missing, MissingFeatures::default());
    }
}
