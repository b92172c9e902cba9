//! Points follow the point of the task: code without its idea gets less than a third of the core
//! points and no extra credit, and code that is half-written gets more, function by function.

use authoring::mutants::empty::{self, FAIR_SHARE, Unfinished};
use base::Workspace;
use grader::course::Course;
use grader::score::Status;
use grader::score::functions::FunctionStatus;
use std::path::Path;
use std::sync::LazyLock;

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the grader is in a workspace")
}

static COURSE: LazyLock<Course> =
    LazyLock::new(|| Course::read(&workspace()).expect("the course is valid"));

fn row(solution: &Unfinished) -> String {
    let Unfinished { name, result, .. } = solution;
    format!(
        "| {} | {name} | {:.2}/{} | {:.2}/{} |",
        result.key, result.score, result.max_score, result.robust_score, result.robust_max_score
    )
}

/// Prints a row for each solution (`--nocapture` shows it).
#[test]
#[ignore = "compiles and grades the unfinished solutions of all stages: 50 s of CPU"]
fn unfinished_solutions_get_their_share() {
    let graded =
        empty::of_stages(&workspace(), &COURSE, &COURSE.stages()).expect("every solution compiles");
    assert_shares(&graded);
    assert_functions_of_triangles(&graded);
    use FunctionStatus::{Hole, Right};
    assert_eq!(
        functions(&graded, "part2.task3", "only intersect_bvh"),
        [("intersect_bvh", Right), ("occludes_bvh", Hole)]
    );
    assert_eq!(
        functions(&graded, "part5.task1", "only raytrace_pixel_adaptive"),
        [
            ("has_converged", Hole),
            ("raytrace_pixel_adaptive", needs("has_converged"))
        ]
    );
    let untested: Vec<&str> = COURSE
        .tasks()
        .map(|task| task.key.as_str())
        .filter(|key| !graded.iter().any(|s| !s.is_half && s.result.key == *key))
        .collect();
    assert!(untested.is_empty(), "no empty solution: {untested:?}");
}

/// Asserts that solutions without the idea of their task get less than a third of the core points
/// and no extra credit, and half-written ones more than a third.
fn assert_shares(graded: &[Unfinished]) {
    println!("| task | solution | core | extra credit |\n|---|---|--:|--:|");
    for solution in graded {
        println!("{}", row(solution));
        let result = &solution.result;
        let fair = FAIR_SHARE * result.max_score;
        if solution.is_half {
            assert_eq!(result.status, Status::Failed, "{}", row(solution));
            assert!(
                (fair..result.max_score).contains(&result.score),
                "{}",
                row(solution)
            );
        } else {
            assert!(result.score < fair, "{}", row(solution));
            assert_eq!(result.robust_score, 0.0, "{}", row(solution));
        }
    }
}

/// The functions of the half-written solution `name` of `task`: each is judged by itself.
fn functions<'a>(
    graded: &'a [Unfinished],
    task: &str,
    name: &str,
) -> Vec<(&'a str, FunctionStatus)> {
    let solution = graded
        .iter()
        .find(|solution| solution.is_half && solution.result.key == task && solution.name == name);
    let functions = &solution.expect("it is listed").result.functions;
    let each = functions
        .iter()
        .map(|f| (f.name.as_str(), f.status.clone()));
    each.collect()
}

fn needs(function: &str) -> FunctionStatus {
    FunctionStatus::Needs {
        function: function.into(),
    }
}

fn assert_functions_of_triangles(graded: &[Unfinished]) {
    use FunctionStatus::{Hole, Right};
    assert_eq!(
        functions(graded, "part1.task3", "only test_triangle"),
        [("test_triangle", Right), ("intersect_triangle", Hole)]
    );
    assert_eq!(
        functions(graded, "part1.task3", "all but record_triangle"),
        [
            ("test_triangle", Right),
            ("intersect_triangle", needs("record_triangle")),
            ("record_triangle", Hole)
        ]
    );
}
