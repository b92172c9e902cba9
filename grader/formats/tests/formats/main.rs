//! Every format says what the report says. That every file fits its published schema is tested in
//! `schemas`, except of JUnit.

mod junit_schema;
mod outcomes;

use formats::{Format, Outcome};
use outcomes::{all, failed_grader, full, hostile, nothing_compiles, partly, refused, settings};
use serde_json::Value;

fn written(format: Format, outcome: &Outcome) -> String {
    let text = format.write(outcome, &settings());
    text.expect("the settings have everything")
}

fn json(format: Format, outcome: &Outcome) -> Value {
    serde_json::from_str(&written(format, outcome)).expect("it is JSON")
}

#[test]
fn gradescope_shows_a_failed_grader_as_no_fault_of_the_code() {
    let file = json(Format::Gradescope, &failed_grader());
    assert!(
        file.get("score").is_none() && file.get("tests").is_none(),
        "{file}"
    );
    assert!(
        file["output"]
            .as_str()
            .unwrap()
            .contains("not the fault of the code"),
        "{file}"
    );
}

#[test]
fn the_points_of_classroom50_add_up() {
    for (name, outcome) in all() {
        let file = json(Format::Classroom50, &outcome);
        let points = |value: &Value| {
            let [score, max] = ["score", "max-score"].map(|key| value[key].as_u64().unwrap());
            assert!(score <= max, "{name}: {value}");
            [score, max]
        };
        let tests = file["tests"].as_array().unwrap();
        let sums = tests
            .iter()
            .map(points)
            .fold([0, 0], |[a, b], [c, d]| [a + c, b + d]);
        let total = points(&file);
        if tests.is_empty() {
            let max = if name == "refused" { 1000 } else { 0 };
            assert_eq!(total, [0, max], "{name}");
            continue;
        }
        assert_eq!(total[1], sums[1], "{name}");
        assert!(total[0].abs_diff(sums[0]) <= tests.len() as u64, "{name}");
    }
}

#[test]
fn prairielearn_gets_a_share_of_the_points() {
    for (name, outcome) in all() {
        let file = written(Format::PrairieLearn, &outcome);
        assert!(file.len() < 1_000_000, "{name}: {} bytes", file.len());
    }
    for outcome in [failed_grader(), refused(), nothing_compiles()] {
        assert_eq!(json(Format::PrairieLearn, &outcome)["gradable"], false);
    }
    assert_eq!(json(Format::PrairieLearn, &full())["score"], 1.0);
    assert!(
        json(Format::PrairieLearn, &partly())["score"]
            .as_f64()
            .unwrap()
            < 1.0
    );
}

#[test]
fn junit_fits_the_schema_of_jenkins() {
    for (name, outcome) in all() {
        let text = written(Format::JUnit, &outcome);
        let found = junit_schema::violations(&text);
        assert!(found.is_empty(), "{name}: {found:?}\n{text}");
    }
}

#[test]
fn junit_fails_core_cases_and_skips_extra_credit() {
    let text = written(Format::JUnit, &partly());
    let document = roxmltree::Document::parse(&text).expect("it is XML");
    let count = |element: &str| {
        document
            .descendants()
            .filter(|n| n.has_tag_name(element))
            .count()
    };
    assert_eq!(
        [count("failure"), count("skipped"), count("error")],
        [1, 1, 0],
        "{text}"
    );
    assert!(
        text.contains("<property name=\"points\" value=\"7.5\"/>"),
        "{text}"
    );
    let failed = written(Format::JUnit, &failed_grader());
    assert!(
        failed.contains("<error type=\"infrastructure\""),
        "{failed}"
    );
}

#[test]
fn a_student_is_told_what_to_mend_in_a_submission_that_is_none() {
    let file = json(Format::Gradescope, &refused());
    assert_eq!(file["score"], 0.0);
    for format in Format::ALL {
        let text = written(format, &refused());
        let says = text.contains("the folder contains no stage");
        assert!(says || format == Format::Classroom50, "{format:?}: {text}");
        assert!(
            !text.contains("not the fault of the code"),
            "{format:?}: {text}"
        );
    }
}

#[test]
fn points_and_texts_arrive() {
    let file = json(Format::Gradescope, &partly());
    assert_eq!(file["score"], 7.5);
    assert_eq!(file["extra_data"]["extra"], 1.0);
    let tests = file["tests"].as_array().unwrap();
    assert_eq!(tests.len(), 2);
    assert_eq!(
        (&tests[0]["score"], &tests[0]["max_score"]),
        (&7.5.into(), &10.0.into())
    );
    assert_eq!(tests[0]["number"], "1.3");
    let output = tests[0]["output"].as_str().unwrap();
    assert!(output.contains("hit or miss: wrong on 3 of 10"), "{output}");
    assert!(
        !output.contains("no known mistake"),
        "it is the text of level 2: {output}"
    );
    assert_eq!(
        (&tests[1]["score"], &tests[1]["max_score"]),
        (&1.0.into(), &2.0.into())
    );
}

#[test]
fn extra_credit_counts_if_the_instructor_says_so() {
    let mut settings = settings();
    settings.add_extra = true;
    let score = |format: Format, outcome: &Outcome| {
        let text = format.write(outcome, &settings).unwrap();
        serde_json::from_str::<Value>(&text).unwrap()["score"]
            .as_f64()
            .unwrap()
    };
    assert_eq!(score(Format::Gradescope, &partly()), 8.5);
    assert_eq!(score(Format::PrairieLearn, &partly()), 0.85);
    assert_eq!(score(Format::Classroom50, &partly()), 850.0);
    // Above the maximum only where the course system accepts it.
    assert_eq!(score(Format::Gradescope, &full()), 12.0);
    assert_eq!(score(Format::PrairieLearn, &full()), 1.0);
    assert_eq!(score(Format::Classroom50, &full()), 1000.0);
}

#[test]
fn nothing_that_code_prints_becomes_a_command_a_tag_or_a_cell() {
    let actions = written(Format::Actions, &hostile());
    for line in actions.lines() {
        let is_ours = ["::error file=stages/", "::notice title=part1::"];
        assert!(
            is_ours.iter().any(|start| line.starts_with(start)),
            "{line}"
        );
    }
    // What it says is between fences that are longer than its own.
    let markdown = written(Format::Markdown, &hostile());
    let (_, fenced) = markdown.split_once("\n`````text\n").expect("a fence");
    assert!(
        fenced.contains("\n# Full points") && fenced.ends_with("\n`````\n"),
        "{markdown}"
    );
    let junit = written(Format::JUnit, &hostile());
    let document = roxmltree::Document::parse(&junit).expect("it is XML");
    assert!(
        document
            .descendants()
            .all(|node| !node.has_tag_name("evil")),
        "{junit}"
    );
}

#[test]
fn annotations_are_on_the_lines_of_the_code() {
    let actions = written(Format::Actions, &partly());
    let expected = "::error file=stages/intersect/src/triangle.rs,line=3,title=part1.task3%3A intersect_triangle is wrong in 1 of 2 cases::";
    assert!(actions.starts_with(expected), "{actions}");
    assert!(actions.contains("wrong on 3 of 10"), "{actions}");
    let last = "::notice title=part1::7.5 of 10 points, extra credit 1 of 2\n";
    assert!(actions.ends_with(last), "{actions}");
    let failed = written(Format::Actions, &failed_grader());
    assert!(failed.starts_with("::error title=Not graded::"), "{failed}");
}
