//! The table of the book's chapter about accuracy is what is measured, and the code of a workspace
//! answers the hard cases of the libraries.

use super::cost::on;
use base::Workspace;
use cost::picture::program::Program;
use cost::picture::{Curve, experiment, plan};
use cost::report::{KernelRow, RayFamily, Shape};
use cost::{CostRequest, SampleCounts, measure};
use std::path::Path;

/// The course that this test is a part of: its stages are the student's code.
fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the course")
}

fn chapter(workspace: &Workspace) -> String {
    let path = workspace.root().join("stages/book/src/accuracy.md");
    std::fs::read_to_string(path).expect("the chapter")
}

/// A row as the chapter writes it.
fn written(row: &KernelRow) -> String {
    let name = if row.student {
        "* the reference"
    } else {
        &row.name
    };
    let operations = row
        .operations
        .as_ref()
        .map_or(String::new(), |all| format!("{:.0} ", all.total()));
    let leaks = row.leaks_per_million.expect("triangles leak or do not");
    // Fewer than 50 in a million count as none.
    let leaks = if leaks < 50.0 { 0.0 } else { leaks };
    let bits = |family| on(row, family).t.expect("hits").correct_bits().floor();
    let [ordinary, slivers] = [RayFamily::Ordinary, RayFamily::Sliver].map(bits);
    let mean = row.mean_correct_bits().floor();
    let wrong = on(row, RayFamily::Sliver).wrong_per_million();
    format!(
        "| {name}, {} | {operations}| {leaks:.0} | {ordinary} | {slivers} | {mean} | {wrong:.0} |",
        row.precision.name()
    )
}

#[test]
#[ignore = "a full measurement: half a minute of CPU"]
fn every_row_of_the_chapter_is_what_is_measured() {
    let workspace = workspace();
    let request = CostRequest {
        shapes: vec![Shape::Triangle],
        trees: false,
        pictures: false,
        world: false,
        // Times are not compared.
        size: SampleCounts {
            rounds: 1,
            ..SampleCounts::FULL
        },
        seed: 0,
    };
    let report = measure(Some(&workspace), &request, &mut |_| Ok(())).expect("a measurement");
    let measured: Vec<String> = report.families[0].rows.iter().map(written).collect();
    let chapter = chapter(&workspace);
    let rows = chapter
        .lines()
        .filter(|line| line.contains(", f32 |") || line.contains(", f64 |"));
    let mut compared = 0;
    for row in rows {
        assert!(
            measured.iter().any(|measured| measured == row),
            "accuracy.md has {row}, measured are\n{}",
            measured.join("\n")
        );
        compared += 1;
    }
    assert!(compared >= 7, "found {compared} rows");
}

/// Errors and biases are counts of light, the same on each machine; times are not compared.
#[test]
#[ignore = "compiles the renderer and renders pictures: minutes of CPU"]
fn the_clamps_of_the_chapter_are_what_is_measured() {
    let workspace = workspace();
    let program = Program::build(workspace.root()).expect("the course's renderer");
    let plans = plan::all(false);
    let plan = plans.iter().find(|plan| plan.title == "fireflies");
    let measured = experiment(&workspace, &program, plan.expect("the plan"), 0);
    let curves = measured.expect("a measurement").curves;
    let chapter = chapter(&workspace);
    let row = |curve: &Curve| {
        let percent = curve.points.iter().map(|p| 100.0 * p.rmse.value);
        let errors: Vec<String> = percent.map(|error| format!("{error:.1} |")).collect();
        let bias = curve.points.last().expect("points").mean_difference;
        match curve.name.strip_prefix("clamp ") {
            Some(x) => format!(
                "| `--clamp {x}` | {} {:+.1} % |",
                errors.join(" "),
                100.0 * bias
            ),
            None => format!("| {} | {} |", curve.name, errors.join(" ")),
        }
    };
    let rows: Vec<String> = curves.iter().map(row).collect();
    let lacks = rows.iter().any(|row| !chapter.contains(row));
    assert!(!lacks, "accuracy.md lacks some of\n{}", rows.join("\n"));
    assert_eq!(curves.len(), 6);
}

/// Builds a worker with the stages of the workspace, as for a student.
#[test]
#[ignore = "compiles a worker: half a minute of CPU"]
fn the_reference_has_a_row_without_a_wrong_answer() {
    let request = CostRequest {
        shapes: Vec::new(),
        trees: false,
        pictures: false,
        world: true,
        size: SampleCounts::QUICK,
        seed: 0,
    };
    let report = measure(Some(&workspace()), &request, &mut |_| Ok(())).expect("a measurement");
    let world = report.world.expect("the hard cases");
    let row = world.yours.expect("the reference's row");
    assert!(row.is_right(), "{row:?}");
    assert_eq!(row.value("on_surface"), Some(100.0));
}
