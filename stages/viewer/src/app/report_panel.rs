//! The failing cases of a report, and what is known about the shown one.

use super::case_panel::NAMES;
use super::side_panel::{facts, short};
use super::{colors, inspector_panel, key_button, pair_view};
use crate::command::Command;
use crate::report::tree_case::TreeCase;
use crate::report::visit_case::VisitCase;
use crate::report::{CasePart, CaseView, FailedCase, OpenCase, RayCase};
use crate::session::Session;
use crate::tree_walk::{NodeStatistics, Side};
use egui::{Key, Label, RichText, ScrollArea, Ui};
use pathtracer::replay::text;

pub(super) fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let Some(report) = session.report() else {
        return;
    };
    ui.heading("Report");
    if report.cases.is_empty() {
        ui.colored_label(colors::RIGHT, "No case lost points.");
        return;
    }
    ui.horizontal(|ui| {
        ui.weak(format!("{} cases lost points", report.cases.len()));
        if key_button(ui, "Next", Key::Enter) {
            commands.push(Command::NeighbourCase { forward: true });
        }
    });
    let opened = report.opened.as_ref().map(|opened| opened.index);
    ScrollArea::vertical()
        .id_salt("cases")
        .max_height(150.0)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            for (i, case) in report.cases.iter().enumerate() {
                let text = RichText::new(format!("{} {}", case.task, case.name)).size(11.0);
                let response = ui.add(egui::Button::selectable(opened == Some(i), text).truncate());
                if opened == Some(i) {
                    response.scroll_to_me(None);
                }
                if response.clicked() {
                    commands.push(Command::OpenCase(i));
                }
            }
        });
    let (Some(case), Some(opened)) = (report.case(), &report.opened) else {
        return;
    };
    ui.separator();
    about(ui, case);
    now(ui, opened);
    match opened.part() {
        Some(CasePart::View) => match opened.view() {
            Some(CaseView::Ray(ray)) => rows(ui, ray),
            Some(CaseView::Tree(tree)) => tree_facts(ui, opened, tree, commands),
            Some(CaseView::Visits(visits)) => visit_facts(ui, opened, visits, commands),
            Some(CaseView::Light(light)) => facts(
                ui,
                "light",
                &[
                    (
                        "radiance",
                        light.radiance.map(|c| format!("{c:.6}")).join(" "),
                    ),
                    ("rays", light.rays.len().to_string()),
                ],
            ),
            None => {}
        },
        Some(part) => picture_facts(ui, opened, part, commands),
        None => {}
    }
    if case.test().is_some() && ui.button("Save as test").clicked() {
        commands.push(Command::SaveCaseAsTest);
    }
}

/// What the report says about a case.
fn about(ui: &mut Ui, case: &FailedCase) {
    ui.label(RichText::new(&case.title).strong());
    ui.label(&case.about);
    ui.weak(format!(
        "{:.2} of {} points, {}",
        case.points.0, case.points.1, case.status
    ));
    if let Some(diagnosis) = &case.diagnosis {
        ui.label(diagnosis);
    }
    for finding in &case.findings {
        let text = format!(
            "{}: wrong on {} of {}",
            finding.aspect, finding.wrong, finding.judged
        );
        ui.colored_label(colors::WRONG, text);
        if let Some((_, sentence)) = &finding.worst {
            ui.label(RichText::new(sentence).size(11.0));
        }
    }
}

/// What the stages of this program answer now.
fn now(ui: &mut Ui, opened: &OpenCase) {
    if opened.content().is_none() && opened.is_running() {
        ui.horizontal(|ui| {
            ui.spinner();
            ui.label("Running the case with your code");
        });
    }
    if let Some(failure) = opened.failure() {
        ui.colored_label(colors::HOVERED, failure.to_string());
    }
    let Some(content) = opened.content() else {
        return;
    };
    ui.separator();
    if let Some(silent) = &content.silent {
        ui.colored_label(colors::HOVERED, silent);
    }
    if content.is_untouched {
        ui.weak("The task still has the start that the course provides.");
    }
    match content.wrong_now.as_deref() {
        None => {}
        // Nothing was judged where nothing is written.
        Some([]) if content.silent.is_some() => {}
        Some([]) => {
            ui.colored_label(colors::RIGHT, "Your code passes this case now.");
        }
        Some([first, ..]) => {
            ui.colored_label(colors::WRONG, "Your code now:");
            ui.add(Label::new(RichText::new(first).size(11.0)).wrap());
        }
    }
}

/// The numbers of a ray, side by side.
fn rows(ui: &mut Ui, view: &RayCase) {
    ui.separator();
    if let Some(failure) = &view.failure {
        ui.colored_label(colors::HOVERED, failure);
    }
    ui.weak("Your code now, and the exact answer:");
    for row in &view.shown.rows {
        ui.horizontal(|ui| {
            let color = match row.is_right {
                true => colors::RIGHT,
                false => colors::WRONG,
            };
            colors::dot(ui, color);
            ui.label(RichText::new(row.name).strong());
        });
        for (who, value) in [("yours", &row.yours), ("exact", &row.expected)] {
            let value = value.as_deref().unwrap_or("-");
            let text = RichText::new(format!("{who}: {value}")).size(11.0);
            ui.add(Label::new(text).wrap());
        }
    }
    if !view.is_of_report {
        ui.weak("The report's ray is another one: it was made with another seed.");
    }
}

/// The selected node of a tree, and the wrong nodes.
fn tree_facts(ui: &mut Ui, opened: &OpenCase, case: &TreeCase, commands: &mut Vec<Command>) {
    ui.separator();
    ui.horizontal(|ui| {
        for (label, command) in [
            ("Left", Command::Descend(Side::Left)),
            ("Right", Command::Descend(Side::Right)),
            ("Parent (Up)", Command::Ascend),
        ] {
            if ui.button(label).clicked() {
                commands.push(command);
            }
        }
    });
    let node = opened.walk.node();
    if let Some(statistics) = NodeStatistics::of(&case.tree, node) {
        let mut rows = vec![
            ("node", format!("{node}, depth {}", opened.walk.depth())),
            ("primitives", statistics.primitives.to_string()),
            ("SAH cost", format!("{:.2} tests", statistics.sah)),
            ("yours from", short(statistics.bounds.min)),
            ("yours to", short(statistics.bounds.max)),
        ];
        if let Some(exact) = case.exact.get(node as usize) {
            rows.push(("exact from", short(exact.min)));
            rows.push(("exact to", short(exact.max)));
        }
        facts(ui, "tree case", &rows);
    }
    if let Some(fault) = &case.fault {
        ui.colored_label(colors::WRONG, fault);
    }
    if case.wrong.is_empty() {
        return;
    }
    let count = case.wrong.len();
    ui.label(RichText::new(format!("Wrong nodes: {} of {count}", opened.step)).strong());
    ui.weak("N, B: next, back");
    ScrollArea::vertical()
        .id_salt("wrong nodes")
        .max_height(140.0)
        .auto_shrink([false, true])
        .show_rows(ui, 16.0, count, |ui, range| {
            for i in range {
                let wrong = &case.wrong[i];
                let line = format!("{}: {}", wrong.node, wrong.sentence);
                let line = RichText::new(line).size(11.0);
                let is_shown = opened.step == i + 1;
                let button = egui::Button::selectable(is_shown, line).truncate();
                if ui.add(button).clicked() {
                    commands.push(Command::GoToEvent(i + 1));
                }
            }
        });
}

/// The tests of a traversal.
fn visit_facts(ui: &mut Ui, opened: &OpenCase, case: &VisitCase, commands: &mut Vec<Command>) {
    ui.separator();
    let (boxes, prims) = case.record.test_counts();
    let right = match case.right {
        Some((prim, t)) => format!("primitive {} at t = {t:?}", prim.0),
        None => "nothing".to_owned(),
    };
    facts(
        ui,
        "visits",
        &[
            (
                "your result",
                text::outcome(&case.scene, case.record.outcome),
            ),
            ("exactly hit", right),
            ("tests", format!("{boxes} boxes, {prims} primitives")),
        ],
    );
    let count = case.record.tests.len();
    ui.label(RichText::new(format!("Tests {} of {count}", opened.step)).strong());
    ui.weak("N, B: next, back");
    let wrong = case.parting.as_ref().and_then(|parting| parting.test);
    let clicked = inspector_panel::test_list(ui, &case.scene, &case.record, opened.step, wrong);
    if let Some(test) = clicked {
        commands.push(Command::GoToEvent(test + 1));
    }
}

/// What a picture shows, how it is shown, and the causes of differences.
fn picture_facts(ui: &mut Ui, opened: &OpenCase, part: CasePart, commands: &mut Vec<Command>) {
    let Some(Ok(pair)) = opened.pictures().pair(part) else {
        return;
    };
    ui.separator();
    for about in &pair.about {
        ui.weak(about);
    }
    pair_view::buttons(ui, opened.display.view, NAMES, commands);
    pair_view::legend(ui, &pair.legend);
}
