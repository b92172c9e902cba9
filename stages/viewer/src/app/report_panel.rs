//! The failing cases of a report, and what is known about the shown one.

use super::case_panel::NAMES;
use super::side_panel::{facts, short};
use super::text::{self, SMALL};
use super::{colors, inspector_panel, key_button, lines, pair_view};
use crate::command::Command;
use crate::digits;
use crate::report::child_order::{ChildOrder, EnteredChild};
use crate::report::pixel_case::PixelCase;
use crate::report::scatter_case::ScatterCase;
use crate::report::tree_case::TreeCase;
use crate::report::visit_case::VisitCase;
use crate::report::{CasePart, CaseView, FailedCase, OpenCase, RayCase};
use crate::session::Session;
use crate::tree_walk::{NodeStatistics, Side};
use egui::{Key, RichText, ScrollArea, Ui};
use judge::shown::ComparedNumber;
use pathtracer::replay;

pub(super) fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let Some(report) = session.report() else {
        return;
    };
    ui.heading("Report");
    if report.cases.is_empty() {
        ui.colored_label(colors::palette(ui).right, "No case lost points.");
        return;
    }
    ui.horizontal(|ui| {
        ui.weak(match report.cases.len() {
            1 => "1 case lost points".to_owned(),
            cases => format!("{cases} cases lost points"),
        });
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
                let text = RichText::new(format!("{} {}", case.task, case.name)).size(SMALL);
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
            Some(CaseView::Pixel(pixel)) => facts(ui, "pixel", &pixel_facts(pixel)),
            Some(CaseView::Scatter(scatter)) => {
                facts(ui, "directions", &directions(scatter));
            }
            Some(CaseView::Plot(plot)) => facts(ui, "plot", &plot.facts),
            None => {}
        },
        Some(part) => picture_facts(ui, opened, part, commands),
        None => {}
    }
    if case.test().is_some() && ui.button("Save as test").clicked() {
        commands.push(Command::SaveCaseAsTest);
    }
}

/// The samples of a pixel.
fn pixel_facts(case: &PixelCase) -> Vec<(&'static str, String)> {
    let [x, y] = case.pixel;
    let mut rows = vec![
        ("pixel", format!("{x}, {y}")),
        ("samples", format!("{} of {}", case.taken, case.most)),
        (
            "in the pixel",
            format!("{} of {}", case.inside(), case.samples.len()),
        ),
    ];
    if !case.checks.is_empty() {
        rows.push(("rule called", format!("{} times", case.checks.len())));
    }
    rows
}

/// The directions of a call, in local space: the normal is (0, 0, 1).
fn directions(case: &ScatterCase) -> Vec<(&'static str, String)> {
    let local = |w: kit::Vec3| short(kit::Vec3::new(w.x, -w.z, w.y));
    let rows = [
        ("to the viewer", Some(case.wo)),
        ("to the light", case.wi),
        ("exact", case.expected),
        ("yours", case.yours),
    ];
    let rows = rows.into_iter();
    rows.filter_map(|(name, w)| Some((name, local(w?))))
        .collect()
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
        ui.colored_label(colors::palette(ui).wrong, text);
        if let Some((_, sentence)) = &finding.worst {
            text::short(ui, sentence, SMALL);
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
        ui.colored_label(colors::palette(ui).attention, failure.to_string());
    }
    let Some(content) = opened.content() else {
        return;
    };
    ui.separator();
    if let Some(silent) = &content.silent {
        ui.colored_label(colors::palette(ui).attention, silent);
    }
    if content.is_untouched {
        ui.weak("The task still has the start that the course provides.");
    }
    match content.wrong_now.as_deref() {
        None => {}
        // Nothing was judged where nothing is written.
        Some([]) if content.silent.is_some() => {}
        Some([]) => {
            let right = colors::palette(ui).right;
            ui.colored_label(right, "Your code passes this case now.");
        }
        Some([first, ..]) => {
            ui.colored_label(colors::palette(ui).wrong, "Your code now:");
            text::short(ui, first, SMALL);
        }
    }
}

/// A ring for what is right, a cross for what is wrong.
fn verdict_mark(ui: &mut Ui, is_right: bool) {
    let (rect, response) = ui.allocate_exact_size(egui::Vec2::splat(16.0), egui::Sense::hover());
    let palette = colors::palette(ui);
    match is_right {
        true => lines::ring(ui.painter(), rect.center(), palette.right),
        false => lines::cross(ui.painter(), rect.center(), palette.wrong),
    }
    let name = if is_right { "right" } else { "wrong" };
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
}

/// The numbers of a ray, side by side.
fn rows(ui: &mut Ui, view: &RayCase) {
    ui.separator();
    if let Some(failure) = &view.failure {
        ui.colored_label(colors::palette(ui).attention, failure);
    }
    ui.weak("Your code now, and the exact answer:");
    // What is wrong comes first.
    let mut rows: Vec<&ComparedNumber> = view.shown.rows.iter().collect();
    rows.sort_by_key(|row| row.is_right);
    for row in rows {
        ui.horizontal(|ui| {
            verdict_mark(ui, row.is_right);
            ui.label(RichText::new(row.name).strong());
        });
        let values = [&row.yours, &row.expected].map(|value| value.as_deref().unwrap_or("-"));
        let [yours, exact] = match row.is_right {
            true => values.map(digits::shortened),
            false => digits::compared(values[0], values[1]),
        };
        for (who, shown, full) in [("yours", yours, values[0]), ("exact", exact, values[1])] {
            let shown = format!("{who}: {shown}");
            text::shown_short(ui, RichText::new(shown).size(SMALL), full);
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
        ui.colored_label(colors::palette(ui).wrong, fault);
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
                let line = RichText::new(line).size(SMALL);
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
                replay::text::outcome(&case.scene, case.record.outcome),
            ),
            ("exactly hit", right),
            ("tests", format!("{boxes} boxes, {prims} primitives")),
        ],
    );
    if let Some(test) = case.first_difference() {
        let first = ui.button("Go to the first difference");
        if first.clicked() {
            commands.push(Command::FrameEvent(test + 1));
        }
    }
    orders(ui, &case.orders, commands);
    let count = case.record.tests.len();
    ui.label(RichText::new(format!("Tests {} of {count}", opened.step)).strong());
    ui.weak("N, B: next, back");
    let is_wrong = case
        .parting
        .as_ref()
        .is_some_and(|parting| parting.test.is_some());
    let word = if is_wrong { "WRONG" } else { "FARTHER CHILD" };
    let wrong = case.first_difference().map(|test| (test, word));
    let clicked = inspector_panel::test_list(ui, &case.scene, &case.record, opened.step, wrong);
    if let Some(test) = clicked {
        commands.push(Command::GoToEvent(test + 1));
    }
}

/// The order of the children of each node, as visited and by distance, side by side.
fn orders(ui: &mut Ui, orders: &[ChildOrder], commands: &mut Vec<Command>) {
    if orders.is_empty() {
        return;
    }
    let wrong = orders
        .iter()
        .filter(|order| !order.is_nearer_first())
        .count();
    ui.label(RichText::new("Order of children").strong());
    ui.weak(format!(
        "nearer first at {} of {} nodes",
        orders.len() - wrong,
        orders.len()
    ));
    let names =
        |children: [EnteredChild; 2]| children.map(|child| child.node.to_string()).join(", ");
    ScrollArea::vertical()
        .id_salt("orders")
        .max_height(120.0)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            egui::Grid::new("orders").num_columns(4).show(ui, |ui| {
                for title in ["", "node", "yours", "nearer first"] {
                    ui.weak(title);
                }
                ui.end_row();
                for order in orders {
                    verdict_mark(ui, order.is_nearer_first());
                    let hover = digits::shortened(&order.sentence());
                    let node = ui.button(order.node.to_string()).on_hover_text(hover);
                    let name = format!("node {}", order.node);
                    node.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
                    if let Some(test) = order.visited[0].first_test
                        && node.clicked()
                    {
                        commands.push(Command::FrameEvent(test + 1));
                    }
                    ui.label(names(order.visited));
                    ui.label(names(order.by_distance()));
                    ui.end_row();
                }
            });
        });
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
    pair_view::legend(ui, &pair.legend, 0);
}
