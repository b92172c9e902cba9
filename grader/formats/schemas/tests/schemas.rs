//! Every file of every outcome fits the JSON Schema of its format.

#[path = "../../tests/formats/outcomes.rs"]
mod outcomes;

use formats::{Format, Outcome};
use outcomes::{all, settings};
use serde_json::Value;

/// The names of the outcomes whose file in `format` violates the schema.
fn violating(format: Format, schema: &str) -> Vec<&'static str> {
    let schema: Value = serde_json::from_str(schema).expect("the schema is JSON");
    let schema = jsonschema::validator_for(&schema).expect("it is a schema");
    let violates = |outcome: &Outcome| {
        let text = format.write(outcome, &settings());
        let file: Value =
            serde_json::from_str(&text.expect("the settings have everything")).expect("it is JSON");
        let errors: Vec<String> = schema
            .iter_errors(&file)
            .map(|e| format!("{}: {e}", e.instance_path()))
            .collect();
        print!("{}", errors.join("\n"));
        !errors.is_empty()
    };
    let all = all();
    let violating = all.iter().filter(|(_, outcome)| violates(outcome));
    violating.map(|(name, _)| *name).collect()
}

#[test]
fn gradescope_accepts_every_file_but_that_of_a_failed_grader() {
    // Gradescope shows such a file as a failure of the autograder, without points.
    let schema = include_str!("../gradescope.json");
    assert_eq!(violating(Format::Gradescope, schema), ["failed_grader"]);
}

#[test]
fn classroom50_accepts_every_file() {
    let schema = include_str!("../classroom50.json");
    assert_eq!(violating(Format::Classroom50, schema), [""; 0]);
}

#[test]
fn prairielearn_accepts_every_file() {
    let schema = include_str!("../prairielearn.json");
    assert_eq!(violating(Format::PrairieLearn, schema), [""; 0]);
}

#[test]
fn the_reports_own_json_fits_its_schema() {
    let schema = include_str!("../report.json");
    assert_eq!(violating(Format::Json, schema), [""; 0]);
}
