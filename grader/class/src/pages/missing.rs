//! What a class does not understand: the section of the class page, with the students behind each
//! bar, and the page for a lecture, which names nobody.

use super::mistakes::{self, IdeaMistakes, Mistake, TaskMistakes};
use super::page as whole_page;
use super::submissions::link;
use crate::collect::{Class, Drawing, Simplest};
use ::pages::html::image_uri;
use grader::course::chapter;
use maud::{Markup, html};

/// On the page for a lecture, what fewer students did is not told: who they are could be guessed.
const FEWEST: usize = 3;

/// The section of the page of the class.
pub(super) fn section(class: &Class, page_names: &[String]) -> Markup {
    let tasks = mistakes::by_task(class);
    let most = most(&tasks);
    html! {
        h2 id="mistakes" { "What points were lost by" }
        @if tasks.is_empty() {
            p { "No submission lost points by a wrong answer." }
        } @else {
            p.soft {
                "Each bar counts the submissions that lost core points by not having an idea. Open it for the mistakes, and a mistake for the students. "
                a href="lecture.html" { "The same for a lecture, without names" } "."
            }
        }
        @for task in &tasks {
            h3 id=(format!("mistakes-{}", task.task)) { (task.task) " " (task.title) }
            @for idea in &task.ideas {
                details.idea {
                    summary { (bar(idea.students(), most)) span { (idea.idea.name) span.soft { ": " (idea.lost()) " lost" } } }
                    (teach_again(task, idea))
                    @for mistake in &idea.mistakes {
                        details.mistake {
                            summary { (bar(mistake.students.len(), most)) span { (what(mistake)) } }
                            p {
                                @for (n, (i, _)) in mistake.students.iter().enumerate() {
                                    @if n > 0 { ", " }
                                    (link(&class.rows[*i], &page_names[*i]))
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The page for a lecture. No student is named on it.
pub fn lecture(class: &Class) -> String {
    let tasks = mistakes::by_task(class);
    let most = most(&tasks);
    let graded = class.rows.iter().filter(|row| row.graded.is_some()).count();
    let what_is_told = |idea: &&IdeaMistakes| idea.students() >= FEWEST;
    let body = html! {
        h1 { (class.title()) ": what to teach again" }
        p {
            (graded) " submissions were graded; " (mistakes::students(&tasks)) " of them lost core points by wrong answers. "
            "A bar counts submissions. What fewer than " (FEWEST) " did is left out."
        }
        @for task in &tasks {
            section.task {
                h2 { (task.task) " " (task.title) }
                @for idea in task.ideas.iter().filter(what_is_told) {
                    div.card {
                        p.head { (bar(idea.students(), most)) strong { (idea.idea.name) } }
                        ul {
                            @for mistake in idea.mistakes.iter().filter(|mistake| mistake.students.len() >= FEWEST) {
                                li { (mistake.students.len()) ": " (what(mistake)) }
                            }
                        }
                        (teach_again(task, idea))
                    }
                }
                @if !task.ideas.iter().any(|idea| what_is_told(&idea)) { p.soft { "Nothing that several submissions share." } }
            }
        }
        @if tasks.is_empty() { p { "No submission lost points by a wrong answer." } }
    };
    whole_page(
        &format!("{}, what to teach again", class.title()),
        &body,
        None,
    )
}

fn most(tasks: &[TaskMistakes<'_>]) -> usize {
    let ideas = tasks.iter().flat_map(|task| &task.ideas);
    ideas.map(IdeaMistakes::students).max().unwrap_or(1)
}

fn bar(count: usize, most: usize) -> Markup {
    let width = 100.0 * count as f64 / most as f64;
    html! {
        span.track { span.fill style=(format!("width: {width:.1}%")) {} }
        span.count { (count) }
    }
}

fn what(mistake: &Mistake<'_>) -> Markup {
    let perhaps = mistake
        .students
        .iter()
        .filter(|(_, is_likely)| !is_likely)
        .count();
    html! {
        @if mistake.name.is_empty() {
            "answers that are wrong in no known way"
        } @else {
            (mistake.about) " " code { (mistake.name) }
            @if perhaps > 0 { span.soft { " (" (perhaps) " perhaps)" } }
        }
    }
}

/// Where the book teaches an idea, and the simplest call that shows that it is missing.
fn teach_again(task: &TaskMistakes<'_>, idea: &IdeaMistakes<'_>) -> Markup {
    html! {
        p {
            "To teach again: \"" (idea.idea.section) "\" in the chapter of the task, "
            code { (chapter::chapter(task.task).unwrap_or_default()) } "."
        }
        // Words of a crash are a student's own.
        @if let Some(call) = idea.simplest().filter(|call| call.aspect.is_some()) { (simplest(call)) }
    }
}

/// The simplest call that shows what is wrong.
pub(super) fn simplest(call: &Simplest) -> Markup {
    html! {
        div.simplest {
            p { strong { "The simplest call" } " like one of " code { (call.case) } ":" }
            @if let Some(drawing) = &call.drawing { (drawn(drawing)) }
            p { code { (call.input.line()) } }
            p { code { (call.result.line()) } }
        }
    }
}

/// A drawing. As an image it can run no script and load nothing, whatever is in it.
fn drawn(drawing: &Drawing) -> Markup {
    let data = image_uri("svg+xml", drawing.svg.raw().as_bytes());
    html! {
        figure.drawing {
            img src=(data) alt=(drawing.caption.line());
            figcaption { (drawing.caption.line()) }
        }
    }
}
