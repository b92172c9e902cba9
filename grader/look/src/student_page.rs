//! Writes what a student sees of a task as one HTML page.

use crate::page::pictures::panels;
use crate::page::viewer::viewer;
use crate::page::whole;
use crate::page::words::LOOK;
use crate::{FailedCase, Look};
use grader::diagnosis::simplest::SimplestCall;
use grader::grade::picture::Rendered;
use grader::report::message;
use grader::report::table::status_text;
use grader::score::{CaseResult, Status};
use grader::sketch::Sketch;
use judge::cases::{PITFALL, checked};
use judge::findings::Aspect;
use judge::pictures::Differences;
use judge::{Tier, plural};
use pages::html::{chip, escape, png_data_uri};
use std::fmt::Write;

const OWN_STYLE: &str = include_str!("look.css");

/// How many failed cases of a tier are shown in full. The others are folded.
const IN_FULL: usize = 6;

/// Formats the page.
pub fn write(look: &Look) -> String {
    let mut content = String::new();
    if let Some(call) = &look.simplest {
        content.push_str(&simplest(call));
    }
    if let Some(picture) = &look.picture {
        content.push_str(&task_picture(picture));
    }
    let of_tier = |tier| {
        let failed = look.failed.iter();
        failed.filter(move |case| case.result.tier == tier)
    };
    let core: Vec<&FailedCase> = of_tier(Tier::Core).collect();
    let extra: Vec<&FailedCase> = of_tier(Tier::Robust).collect();
    if !core.is_empty() {
        content.push_str("<h2>What is wrong</h2>\n");
        content.push_str(&cases(&core));
    }
    // Extra credit is for later: textbook code does not get it.
    if !extra.is_empty() {
        let _ = write!(
            content,
            "<details><summary>Extra credit: {} where textbook formulas fail</summary>\n{}</details>\n",
            plural(extra.len(), "case", "cases"),
            cases(&extra)
        );
    }
    content.push_str(&passed(look));
    let title = format!("{} · First Light", look.result.key);
    whole([OWN_STYLE, ""], &title, &header(look), &content)
}

/// The score in one sentence.
pub fn summary(look: &Look) -> String {
    let result = &look.result;
    match &result.status {
        Status::NotAttempted => "not written yet".into(),
        Status::DoesNotCompile => status_text(&result.status),
        _ if look.is_full() => "right, you have every core point".into(),
        _ => {
            let core = |case: &&CaseResult| case.tier == Tier::Core;
            let all = result.cases.iter().filter(core).count();
            let wrong = look.failed.iter().map(|case| &case.result).filter(core);
            format!("{} of {all} cases are wrong", wrong.count())
        }
    }
}

fn header(look: &Look) -> String {
    let result = &look.result;
    let percent = 100.0 * result.score / result.max_score.max(f64::MIN_POSITIVE);
    let mut text = format!(
        "<p class=\"eyebrow\">First Light · {}</p>\n<h1>{}: {}</h1>\n\
         <p>{:.2} of {:.2} core points</p>\n<div class=\"bar\"><span style=\"width:{percent:.0}%\"></span></div>\n",
        escape(&result.key),
        escape(&result.title),
        escape(&summary(look)),
        result.score,
        result.max_score,
    );
    if let Some(diagnosis) = &look.diagnosis {
        let _ = writeln!(
            text,
            "<details class=\"hint\"><summary>What the mistake may be</summary><p>{}: {}.</p><p>{}: {}</p></details>",
            diagnosis.certainty.label(),
            escape(&diagnosis.says),
            diagnosis.certainty.before_hint(),
            escape(&diagnosis.hint)
        );
    }
    text
}

/// The simplest call that shows what is wrong: drawn, in a sentence, and what was called.
fn simplest(call: &SimplestCall) -> String {
    let sketch = call.shown.as_ref().and_then(Sketch::of);
    let figure = sketch.map_or_else(String::new, |sketch| {
        format!("<figure class=\"figure\">{}</figure>", drawing(&sketch))
    });
    let label = call.aspect.map_or("a crash", Aspect::label);
    format!(
        "<section class=\"task simplest\"><h2>The simplest call that is wrong: {}</h2>\n{figure}<div>\
         <p class=\"result bad\">{}</p>\n<p class=\"input\">{}</p>{}</div></section>\n",
        escape(label),
        escape(&message::found(call)),
        escape(&message::input(call)),
        call.only.as_ref().map_or_else(String::new, |only| format!(
            "<p class=\"note\">{}.</p>",
            escape(only)
        )),
    )
}

/// A call as SVG, with what is seen and what the signs mean.
pub(super) fn drawing(sketch: &Sketch) -> String {
    format!(
        "{}<figcaption>{}.</figcaption><p class=\"key\">{}</p>",
        sketch.svg(),
        escape(sketch.caption()),
        sketch.key()
    )
}

/// The picture of the task: expected and yours with a slider, and where they differ.
fn task_picture(rendered: &Rendered) -> String {
    let panels = &rendered.picture.panels;
    let abouts: Vec<&str> = panels.iter().map(|kind| kind.about).collect();
    let about = escape(&abouts.join("; below: "));
    let (yours, comparison) = match &rendered.yours {
        Ok(yours) => yours,
        Err(status) => {
            return format!(
                "<section class=\"task\"><h2>Your picture</h2>\n<p class=\"bad\">There is none: {}.</p>\n\
                 <figure><img class=\"alone\" alt=\"{} picture\" src=\"{}\"><figcaption>Expected. {about}.</figcaption></figure></section>\n",
                escape(&status_text(status)),
                LOOK.golden,
                png_data_uri(&rendered.golden),
            );
        }
    };
    let mut legend = String::new();
    if comparison.is_same() {
        legend.push_str("<p class=\"good\">Your picture is as expected.</p>\n");
    } else {
        legend.push_str("<ul class=\"legend\">");
        for (kind, marks) in panels.iter().zip(&comparison.counts) {
            if panels.len() > 1 && !marks.is_empty() {
                let _ = write!(legend, "<li class=\"note\">{}:</li>", escape(kind.about));
            }
            for (mark, count) in marks {
                let _ = write!(
                    legend,
                    "<li>{}{}: {}</li>",
                    chip(mark.colour()),
                    mark.label(),
                    plural(*count, "pixel", "pixels")
                );
            }
            if kind.differences == Differences::Choice && !marks.is_empty() {
                let _ = write!(
                    legend,
                    "<li class=\"note\">{}: another solution can be as right.</li>",
                    escape(kind.about)
                );
            }
        }
        legend.push_str("</ul>");
    }
    let difference = (!comparison.is_same()).then_some(&comparison.difference);
    format!(
        "<section class=\"task picture\"><h2>Your picture</h2>\n<p class=\"about\">{about}.</p>\n{}</section>\n",
        viewer(&rendered.golden, yours, difference, &legend, &LOOK)
    )
}

/// The failed cases. Of several cases with the same wrong fields, only the first is shown in full;
/// the others are folded below it.
fn cases(failed: &[&FailedCase]) -> String {
    let mut groups: Vec<(String, Vec<&FailedCase>)> = Vec::new();
    for case in failed {
        let finding = what_is_wrong(&case.result);
        match groups.iter_mut().find(|(other, _)| *other == finding) {
            Some((_, cases)) => cases.push(case),
            None => groups.push((finding, vec![case])),
        }
    }
    let (full, rest) = groups.split_at(groups.len().min(IN_FULL));
    let mut text: String = full.iter().map(|(_, cases)| group(cases)).collect();
    if !rest.is_empty() {
        let count: usize = rest.iter().map(|(_, cases)| cases.len()).sum();
        let _ = writeln!(
            text,
            "<details><summary>{}</summary>",
            plural(count, "more case", "more cases")
        );
        text.extend(rest.iter().map(|(_, cases)| group(cases)));
        text.push_str("</details>\n");
    }
    text
}

/// The key by which cases are grouped: the status, and the wrong aspects with their functions.
fn what_is_wrong(case: &CaseResult) -> String {
    let wrong = case
        .findings
        .iter()
        .filter(|finding| finding.wrong > 0)
        .map(|finding| format!("{} {:?}", finding.aspect.label(), finding.functions));
    format!(
        "{} {}",
        status_text(&case.status),
        wrong.collect::<Vec<_>>().join("; ")
    )
}

/// A group of cases with the same wrong fields: the first in full, the others folded.
fn group(cases: &[&FailedCase]) -> String {
    let Some((first, others)) = cases.split_first() else {
        return String::new();
    };
    let mut text = one_case(first);
    if !others.is_empty() {
        let names: Vec<String> = others
            .iter()
            .map(|case| escape(&case.result.name))
            .collect();
        let _ = writeln!(
            text,
            "<details class=\"same\"><summary>The same is wrong in {}: {}</summary>",
            plural(others.len(), "more case", "more cases"),
            names.join(", ")
        );
        text.extend(others.iter().map(|case| one_case(case)));
        text.push_str("</details>\n");
    }
    text
}

fn one_case(failed: &FailedCase) -> String {
    let case = &failed.result;
    let about = describe(case);
    if let Some(case) = &failed.picture
        && let Some(picture) = &case.picture
    {
        let id = escape(&case.path());
        return format!(
            "<article class=\"case picture\" id=\"{id}\"><h3>{}</h3>\n{about}{}</article>\n",
            escape(case.name),
            panels(case, picture, &LOOK)
        );
    }
    let figure = failed
        .figure
        .as_ref()
        .map(|svg| format!("<figure class=\"figure\">{svg}</figure>"));
    format!(
        "<article class=\"case failed\"><div><h3>{}</h3>\n{about}</div>{}</article>\n",
        escape(&case.name),
        figure.unwrap_or_default()
    )
}

/// What a case tests, and what is wrong.
fn describe(case: &CaseResult) -> String {
    let mut text = format!("<p class=\"about\">{}</p>\n", escape(checked(&case.about)));
    if case.status != Status::Failed {
        let _ = writeln!(
            text,
            "<p class=\"bad\">{}</p>",
            escape(&status_text(&case.status))
        );
    }
    let wrong = case.findings.iter().filter(|finding| finding.wrong > 0);
    for finding in wrong {
        let _ = writeln!(
            text,
            "<p><strong>{}</strong>: wrong on {} of {}</p>",
            escape(finding.aspect.label()),
            finding.wrong,
            finding.judged.max(finding.expected)
        );
        if let Some(worst) = &finding.worst {
            let _ = writeln!(
                text,
                "<p class=\"worst\">{}</p>",
                escape(&worst.message.to_string())
            );
        }
    }
    if let Some((_, pitfall)) = case.about.split_once(PITFALL) {
        let _ = writeln!(
            text,
            "<details class=\"hint\"><summary>A hint</summary><p>{}</p></details>",
            escape(pitfall)
        );
    }
    text
}

/// The names of the cases that passed.
fn passed(look: &Look) -> String {
    let cases = look.result.cases.iter();
    let is_right = |case: &&CaseResult| case.status == Status::Passed || case.is_only_reduced();
    let passed = cases.filter(is_right);
    let names: Vec<String> = passed.map(|case| escape(&case.name)).collect();
    if names.is_empty() {
        return String::new();
    }
    format!(
        "<h2>What is right</h2>\n<p class=\"good\">{}</p>\n",
        names.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::Workspace;
    use grader::course::Course;
    use grader::grade::picture;
    use grader::score::TaskResult;
    use judge::findings::{Aspect, Finding, Worst};
    use pictures::Image;
    use pictures::difference::compare;
    use std::path::Path;

    /// Part 1, task 3 with a failed case, and a picture that lacks one pixel.
    fn look(message: &str) -> Look {
        let workspace = Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR")))
            .expect("the crate is in a workspace");
        let course = Course::read(&workspace).expect("the course is sound");
        let task = course
            .tasks()
            .find(|task| task.key == "part1.task3")
            .expect("the course has it");
        let finding = Finding {
            expected: 4,
            judged: 4,
            wrong: 3,
            main: true,
            worst: Some(Worst {
                call: 1,
                function: None,
                badness: 1.0,
                message: message.into(),
            }),
            ..Finding::new(Aspect::HitOrMiss)
        };
        let about = "Rays from behind. Pitfall: culling.";
        let right = Finding {
            wrong: 0,
            worst: None,
            ..finding.clone()
        };
        let case = |(i, entry)| {
            let finding = if i == 0 { &finding } else { &right };
            CaseResult::new(entry, about, Status::Passed, vec![finding.clone()], &[])
        };
        let cases: Vec<CaseResult> = task.cases.iter().enumerate().map(case).collect();
        let failed = FailedCase {
            result: cases[0].clone(),
            figure: Some("<svg></svg>".into()),
            picture: None,
        };
        let picture = judge::pictures::of(&task.key).expect("it has a picture");
        let golden = Image::filled(picture.size(), [90; 3]);
        let mut yours = golden.clone();
        yours.set(3, 3, [0; 3]);
        let comparison = compare(&picture, &golden, &yours);
        Look {
            result: TaskResult::new(task, cases),
            diagnosis: None,
            simplest: None,
            picture: Some(picture::Rendered {
                picture,
                golden,
                yours: Ok((yours, comparison)),
            }),
            failed: vec![failed],
        }
    }

    #[test]
    fn a_failed_case_has_its_finding_and_its_figure_and_hides_the_hint() {
        let page = write(&look("your result: miss <here>"));
        for text in [
            "Intersecting triangles: 1 of 15 cases are wrong",
            "<h3>front_face</h3>\n<p class=\"about\">Rays from behind.</p>",
            "<strong>hit or miss</strong>: wrong on 3 of 4",
            "your result: miss &lt;here&gt;",
            "<figure class=\"figure\"><svg></svg>",
            "<details class=\"hint\"><summary>A hint</summary><p>culling.</p></details>",
            "black where there is a surface: 1 pixel",
        ] {
            assert!(page.contains(text), "no {text:?}");
        }
        assert!(page.find("What is wrong") < page.find("What is right"));
    }

    #[test]
    fn a_full_task_says_what_is_right_and_nothing_is_wrong() {
        let mut full = look("");
        full.failed.clear();
        full.result.score = full.result.max_score;
        let page = write(&full);
        assert!(page.contains("right, you have every core point"));
        assert!(!page.contains("What is wrong") && page.contains("back_face"));
    }

    #[test]
    fn the_page_loads_no_other_files() {
        let page = write(&look("src=x"));
        for outside in ["https://", "src=\"/", "href=\"/", "@import", "url(/"] {
            assert!(!page.contains(outside), "{outside}");
        }
        // The namespace of SVG is not loaded.
        let addresses = page.matches("http://").count();
        assert_eq!(
            addresses,
            page.matches("http://www.w3.org/2000/svg").count()
        );
    }
}
