//! Points follow the point of the task: code without its idea gets less than a third of the core
//! points and no extra credit, and code that is half-written gets more, function by function.

use authoring::mutants::empty::{self, FAIR_SHARE, Unfinished};
use base::Workspace;
use grader::course::Course;
use grader::score::Status;
use grader::score::functions::FunctionStatus;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::LazyLock;

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the grader is in a workspace")
}

static COURSE: LazyLock<Course> =
    LazyLock::new(|| Course::read(&workspace()).expect("the course is valid"));

static GRADED: LazyLock<Vec<Unfinished>> =
    LazyLock::new(|| empty::all(&workspace(), &COURSE).expect("every solution compiles"));

fn row(solution: &Unfinished) -> String {
    let Unfinished { name, result, .. } = solution;
    format!(
        "| {} | {name} | {:.2}/{} | {:.2}/{} |",
        result.key, result.score, result.max_score, result.robust_score, result.robust_max_score
    )
}

/// Prints a row for each solution (`--nocapture` shows it).
#[test]
fn solutions_without_the_idea_of_their_task_get_less_than_a_third() {
    println!("| task | solution | core | extra credit |\n|---|---|--:|--:|");
    let mut tested = BTreeSet::new();
    let mut unfair = Vec::new();
    for solution in GRADED.iter().filter(|solution| !solution.is_half) {
        println!("{}", row(solution));
        let result = &solution.result;
        tested.insert(result.key.as_str());
        if result.score >= FAIR_SHARE * result.max_score || result.robust_score > 0.0 {
            unfair.push(row(solution));
        }
    }
    assert!(unfair.is_empty(), "\n{}", unfair.join("\n"));
    let untested: Vec<&str> = COURSE
        .tasks()
        .map(|task| task.key.as_str())
        .filter(|key| !tested.contains(key))
        .collect();
    assert!(untested.is_empty(), "no empty solution: {untested:?}");
}

/// Prints a row for each solution (`--nocapture` shows it).
#[test]
fn half_written_solutions_get_more_than_a_third() {
    let half = GRADED.iter().filter(|solution| solution.is_half);
    for solution in half {
        println!("{}", row(solution));
        let result = &solution.result;
        assert_eq!(result.status, Status::Failed, "{}", row(solution));
        let fair = FAIR_SHARE * result.max_score..result.max_score;
        assert!(fair.contains(&result.score), "{}", row(solution));
    }
}

#[test]
fn each_function_of_a_half_written_solution_is_judged_by_itself() {
    let functions = |task: &str, name: &str| {
        let solution = GRADED.iter().find(|solution| {
            solution.is_half && solution.result.key == task && solution.name == name
        });
        let functions = &solution.expect("it is listed").result.functions;
        let each = functions
            .iter()
            .map(|f| (f.name.as_str(), f.status.clone()));
        each.collect::<Vec<_>>()
    };
    use FunctionStatus::{Hole, Needs, Right};
    let needs = |function: &str| Needs {
        function: function.into(),
    };
    assert_eq!(
        functions("part1.task3", "only test_triangle"),
        [("test_triangle", Right), ("intersect_triangle", Hole)]
    );
    assert_eq!(
        functions("part1.task3", "all but record_triangle"),
        [
            ("test_triangle", Right),
            ("intersect_triangle", needs("record_triangle")),
            ("record_triangle", Hole)
        ]
    );
    assert_eq!(
        functions("part2.task3", "only intersect_bvh"),
        [("intersect_bvh", Right), ("occludes_bvh", Hole)]
    );
    assert_eq!(
        functions("part5.task1", "only raytrace_pixel_adaptive"),
        [
            ("has_converged", Hole),
            ("raytrace_pixel_adaptive", needs("has_converged"))
        ]
    );
}
