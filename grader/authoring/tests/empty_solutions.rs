//! Points follow the point of the task: code without its idea gets less than a third of the core
//! points, and no extra credit.

use authoring::mutants::empty::{self, MAX_SHARE};
use grader::course::Course;
use grader::workspace::Workspace;
use std::collections::BTreeSet;
use std::path::Path;

/// Prints a row for each solution (`--nocapture` shows it).
#[test]
fn solutions_without_the_idea_of_their_task_get_less_than_a_third() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let workspace = Workspace::above(here).expect("the grader is in a workspace");
    let course = Course::read(&workspace).expect("the course is valid");
    let graded = empty::all(&workspace, &course).expect("every solution compiles");
    let mut unfair = Vec::new();
    println!("| task | solution | core | extra credit |\n|---|---|--:|--:|");
    for empty::Empty { name, result } in &graded {
        let row = format!(
            "| {} | {name} | {:.2}/{} | {:.2}/{} |",
            result.key,
            result.score,
            result.max_score,
            result.robust_score,
            result.robust_max_score
        );
        println!("{row}");
        if result.score >= MAX_SHARE * result.max_score || result.robust_score > 0.0 {
            unfair.push(row);
        }
    }
    assert!(unfair.is_empty(), "\n{}", unfair.join("\n"));
    let tested: BTreeSet<&str> = graded.iter().map(|e| e.result.key.as_str()).collect();
    let untested: Vec<&str> = course.tasks().map(|task| task.key.as_str()).collect();
    let untested: Vec<_> = untested.iter().filter(|key| !tested.contains(*key)).collect();
    assert!(untested.is_empty(), "no empty solution: {untested:?}");
}
