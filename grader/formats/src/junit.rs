//! JUnit XML: a suite for each task, a test for each case. Points are properties of the suites.
//!
//! The format has no standard. This follows the schema that Jenkins publishes with its xUnit plugin
//! (`junit-10.xsd`), which is also what GitLab and test reporters of GitHub Actions read. There,
//! only suites have properties.

use crate::outcome::{NOT_GRADED, REFUSED, name};
use crate::points::rounded;
use crate::text::printable;
use crate::{Graded, Outcome};
use base::GraderError;
use grader::report::TaskReport;
use grader::report::table::status_text;
use grader::score::{CaseResult, Status};
use judge::Tier;
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};
use std::io;

/// How a test ended: the name of its element with the type and the message, and a text.
struct Ending {
    element: &'static str,
    kind: &'static str,
    message: String,
}

/// The file about `outcome`. If nothing was graded it has one test, which fails, or
/// has an error after a failure of the grader.
pub fn write(outcome: &Outcome) -> Result<String, GraderError> {
    let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
    let written = match outcome {
        Outcome::Graded(graded) => document(&mut writer, graded),
        Outcome::Infrastructure(why) => not_graded(&mut writer, &INFRASTRUCTURE, why),
        Outcome::Refused { why, .. } => not_graded(&mut writer, &A_REFUSAL, why),
    };
    let text = written.map(|()| String::from_utf8(writer.into_inner()));
    match text {
        Ok(Ok(text)) => Ok(format!("{text}\n")),
        Ok(Err(e)) => Err(GraderError::new(format!("cannot write JUnit XML: {e}"))),
        Err(e) => Err(GraderError::new(format!("cannot write JUnit XML: {e}"))),
    }
}

type Xml = Writer<Vec<u8>>;

/// How many tests ended in each way.
#[derive(Clone, Copy, Default)]
struct Counts {
    tests: usize,
    failures: usize,
    errors: usize,
    skipped: usize,
}

impl Counts {
    fn of<'a>(cases: impl Iterator<Item = &'a CaseResult>) -> Counts {
        cases.fold(Counts::default(), |mut counts, case| {
            counts.tests += 1;
            match ending(case).map(|ending| ending.element) {
                Some("failure") => counts.failures += 1,
                Some(_) => counts.skipped += 1,
                None => {}
            }
            counts
        })
    }
}

fn document(writer: &mut Xml, graded: &Graded) -> io::Result<()> {
    writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let tasks = &graded.report.tasks;
    let all = Counts::of(tasks.iter().flat_map(|task| &task.result.cases));
    let tag = writer.create_element("testsuites").with_attributes([
        ("name", "First Light"),
        ("tests", &*all.tests.to_string()),
        ("failures", &*all.failures.to_string()),
        ("errors", &*all.errors.to_string()),
    ]);
    tag.write_inner_content(|writer| {
        tasks
            .iter()
            .try_for_each(|task| suite(writer, graded, task))
    })?;
    Ok(())
}

fn suite(writer: &mut Xml, graded: &Graded, task: &TaskReport) -> io::Result<()> {
    let result = &task.result;
    let counts = Counts::of(result.cases.iter());
    let tag = with_counts(writer, "testsuite", &printable(&name(task)), counts);
    tag.write_inner_content(|writer| {
        let points = [
            ("points", result.score),
            ("max_points", result.max_score),
            ("extra_points", result.robust_score),
            ("max_extra_points", result.robust_max_score),
        ];
        let tag = writer.create_element("properties");
        tag.write_inner_content(|writer| {
            points.iter().try_for_each(|(name, points)| {
                let value = rounded(*points).to_string();
                let tag = writer
                    .create_element("property")
                    .with_attributes([("name", *name), ("value", &value)]);
                tag.write_empty().map(|_| ())
            })
        })?;
        for case in &result.cases {
            test(writer, &result.key, case)?;
        }
        let text = printable(&graded.task_text(task));
        let tag = writer.create_element("system-out");
        tag.write_text_content(BytesText::new(&text))?;
        Ok(())
    })?;
    Ok(())
}

fn with_counts<'a>(
    writer: &'a mut Xml,
    element: &'a str,
    name: &str,
    counts: Counts,
) -> quick_xml::writer::ElementWriter<'a, Vec<u8>> {
    writer.create_element(element).with_attributes([
        ("name", name),
        ("tests", &*counts.tests.to_string()),
        ("failures", &*counts.failures.to_string()),
        ("errors", &*counts.errors.to_string()),
        ("skipped", &*counts.skipped.to_string()),
    ])
}

fn test(writer: &mut Xml, task: &str, case: &CaseResult) -> io::Result<()> {
    let tag = writer
        .create_element("testcase")
        .with_attributes([("name", &*case.name), ("classname", task)]);
    let Some(ending) = ending(case) else {
        return tag.write_empty().map(|_| ());
    };
    tag.write_inner_content(|writer| {
        let tag = writer.create_element(ending.element).with_attributes([
            ("type", ending.kind),
            ("message", &*printable(&ending.message)),
        ]);
        let tested = printable(judge::cases::checked(&case.about));
        tag.write_text_content(BytesText::new(&tested))?;
        Ok(())
    })?;
    Ok(())
}

/// How a case ended; `None` if it passed. A case of extra credit never fails: without its points it
/// counts as skipped, because nobody needs it.
fn ending(case: &CaseResult) -> Option<Ending> {
    let points = || {
        format!(
            "{} of {} points",
            rounded(case.score),
            rounded(case.max_score)
        )
    };
    let reductions = || match case.reductions.is_empty() {
        true => points(),
        false => format!("{}: {}", points(), case.reductions.join("; ")),
    };
    let kind = match &case.status {
        Status::Passed => return None,
        Status::Failed => "wrong",
        Status::NotAttempted => "not_attempted",
        Status::Needs(_) => "needs",
        Status::Crashed(_) => "crashed",
        Status::DoesNotCompile => "does_not_compile",
    };
    let message = match &case.status {
        Status::Failed => reductions(),
        status => status_text(status),
    };
    Some(match case.tier {
        Tier::Core => Ending {
            element: "failure",
            kind,
            message,
        },
        Tier::Robust => Ending {
            element: "skipped",
            kind,
            message: format!("extra credit: {message}"),
        },
    })
}

/// How the only test of a file ends if nothing was graded: its element, type and message, and the
/// numbers of failures and errors.
struct OnlyTest([&'static str; 3], [&'static str; 2]);

const INFRASTRUCTURE: OnlyTest = OnlyTest(["error", "infrastructure", NOT_GRADED], ["0", "1"]);
const A_REFUSAL: OnlyTest = OnlyTest(["failure", "refused", REFUSED], ["1", "0"]);

fn not_graded(writer: &mut Xml, test: &OnlyTest, why: &str) -> io::Result<()> {
    let OnlyTest([element, kind, message], [failures, errors]) = *test;
    writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let counts = [("tests", "1"), ("failures", failures), ("errors", errors)];
    let tag = writer
        .create_element("testsuites")
        .with_attribute(("name", "First Light"));
    tag.with_attributes(counts).write_inner_content(|writer| {
        let tag = writer
            .create_element("testsuite")
            .with_attribute(("name", "grader"));
        tag.with_attributes(counts).write_inner_content(|writer| {
            let tag = writer
                .create_element("testcase")
                .with_attributes([("name", "grading"), ("classname", "grader")]);
            tag.write_inner_content(|writer| {
                let tag = writer
                    .create_element(element)
                    .with_attributes([("type", kind), ("message", message)]);
                tag.write_text_content(BytesText::new(&printable(why)))?;
                Ok(())
            })?;
            Ok(())
        })?;
        Ok(())
    })?;
    Ok(())
}
