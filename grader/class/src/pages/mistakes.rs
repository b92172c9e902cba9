//! What students lost points by: the known mistakes of each task, as bars that open the students
//! behind them. A mistake counts only where it cost points.

use crate::collect::{Class, Row};
use maud::{Markup, html};
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// A mistake of a task, and whose it is.
#[derive(Clone, Debug, Default, PartialEq)]
struct Mistake<'a> {
    /// Its names: several where answers cannot tell them apart.
    name: String,
    /// What its code does.
    about: String,
    /// The numbers of the rows, and whether the mistake is likely.
    students: Vec<(usize, bool)>,
    /// Nobody knows the name of the mistakes of these.
    is_unnamed: bool,
    task: &'a str,
}

/// The mistakes of each task, in the order of the plan, the most frequent first.
fn by_task(class: &Class) -> Vec<(&str, Vec<Mistake<'_>>)> {
    let mut known: BTreeMap<(&str, Option<String>), Mistake> = BTreeMap::new();
    for (i, row) in class.rows.iter().enumerate() {
        let tasks = row.graded.iter().flat_map(|graded| &graded.tasks);
        for task in tasks.filter(|task| task.lost_points) {
            let is_judged = ["failed", "crashed"].contains(&task.status.as_str());
            let (name, about, is_likely) = match &task.diagnosis {
                Some(diagnosis) => (
                    Some(diagnosis.mistakes.join(" or ")),
                    about_code(&diagnosis.says),
                    diagnosis.certainty == "likely",
                ),
                None if is_judged => (None, String::new(), false),
                None => continue,
            };
            let mistake = known.entry((&task.key, name.clone())).or_default();
            mistake.is_unnamed = name.is_none();
            mistake.name = name.unwrap_or_default();
            mistake.about = about;
            mistake.task = &task.key;
            mistake.students.push((i, is_likely));
        }
    }
    let tasks = class.plan.tasks.iter().map(|task| {
        let of_task = known.values().filter(|mistake| mistake.task == task.key);
        let mut of_task: Vec<Mistake> = of_task.cloned().collect();
        // The sort is stable: equal ones stay in the order of their names.
        of_task.sort_by_key(|mistake| (mistake.is_unnamed, Reverse(mistake.students.len())));
        (task.key.as_str(), of_task)
    });
    tasks.filter(|(_, mistakes)| !mistakes.is_empty()).collect()
}

/// The section of the page.
pub(super) fn section(class: &Class, page_names: &[String]) -> Markup {
    let tasks = by_task(class);
    let of_all = tasks.iter().flat_map(|(_, mistakes)| mistakes);
    let most = of_all
        .map(|mistake| mistake.students.len())
        .max()
        .unwrap_or(1);
    html! {
        h2 id="mistakes" { "What points were lost by" }
        @if tasks.is_empty() {
            p { "No submission lost points by a wrong answer." }
        } @else {
            p.soft {
                "Each bar counts the submissions that lost core points by a mistake. Open it for their names."
            }
        }
        @for (task, mistakes) in &tasks {
            h3 { (task) }
            @for mistake in mistakes { (bar(class, page_names, mistake, most)) }
        }
    }
}

fn bar(class: &Class, page_names: &[String], mistake: &Mistake, most: usize) -> Markup {
    let count = mistake.students.len();
    let width = 100.0 * count as f64 / most as f64;
    let perhaps = mistake
        .students
        .iter()
        .filter(|(_, likely)| !likely)
        .count();
    html! {
        details.mistake {
            summary {
                span.track { span.fill style=(format!("width: {width:.1}%")) {} }
                span.count { (count) }
                span {
                    @if mistake.is_unnamed {
                        "mistakes without a name"
                    } @else {
                        code { (mistake.name) } " " (mistake.about)
                        @if perhaps > 0 { span.soft { " (" (perhaps) " perhaps)" } }
                    }
                }
            }
            p {
                @for (n, (i, _)) in mistake.students.iter().enumerate() {
                    @if n > 0 { ", " }
                    (link(&class.rows[*i], &page_names[*i]))
                }
            }
        }
    }
}

/// A link to the page of a student.
pub(super) fn link(row: &Row, page: &str) -> Markup {
    html! { a href=(format!("students/{page}.html")) { (row.name.line()) } }
}

/// What a diagnosis says about the code, without the student's numbers: of "your answers equal
/// those of code that culls back faces: on 560 of 560 calls" the words "code that culls back
/// faces".
fn about_code(says: &str) -> String {
    let start = says.find("code that ").unwrap_or(0);
    let end = says.rfind(": on ").filter(|end| *end > start);
    says[start..end.unwrap_or(says.len())].to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistake_is_named_without_the_numbers_of_one_student() {
        let says =
            "your answers nearly equal those of code that swaps x and y: on 230 of 231 calls";
        assert_eq!(about_code(says), "code that swaps x and y");
        assert_eq!(about_code("something else"), "something else");
    }
}
