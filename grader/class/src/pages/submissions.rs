//! The table of all submissions. A script sorts it by a column and filters it; without one it is in
//! the order of the names.

use super::OwnPage;
use crate::collect::{Class, Row, points};
use maud::{Markup, html};

/// The script that sorts and filters.
pub(super) const SCRIPT: &str = include_str!("submissions.js");

/// The section of the page.
pub(super) fn section(class: &Class, page_names: &[String], own_pages: &[OwnPage<'_>]) -> Markup {
    html! {
        h2 id="submissions" { "All submissions" }
        div id="filter" {}
        div.scroll {
            table.sortable {
                thead {
                    tr {
                        th { "submission" }
                        th { "status" }
                        th.number { "points" }
                        th.number { "extra" }
                        @for task in &class.plan.tasks { th.number { (task.key) } }
                        th { "notes" }
                    }
                }
                tbody {
                    @for (row, page) in class.rows.iter().zip(page_names) { (line(class, row, page, own_pages)) }
                }
            }
        }
    }
}

/// A link to the page of a student.
pub(super) fn link(row: &Row, page: &str) -> Markup {
    html! { a href=(format!("students/{page}.html")) title=(row.name.line()) { (row.who().line()) } }
}

fn line(class: &Class, row: &Row, page: &str, own_pages: &[OwnPage<'_>]) -> Markup {
    let tasks = class.plan.tasks.iter();
    html! {
        tr id=(format!("s-{page}")) {
            td.name {
                (link(row, page))
                @for OwnPage { member, page } in own_pages.iter().filter(|own| own.is_of(row)) {
                    br; a href=(format!("students/{page}.html")) { (member.name.line()) " alone" }
                }
            }
            td.status { (row.status.label()) }
            @match &row.score {
                Some(score) => {
                    td.number data-name="points" { (points(score.core)) }
                    td.number data-name="extra" { (points(score.extra)) }
                    @for task in tasks {
                        td.number data-name=(task.key) { (points(score.tasks.get(&task.key).map_or(0.0, |[core, _]| *core))) }
                    }
                }
                None => @for _ in 0..2 + tasks.len() { td.number {} },
            }
            td.note { (row.about()) }
        }
    }
}
