//! The failing cases of a report, and the sentences about the shown one.

use super::colors;
use crate::command::Command;
use crate::session::Session;
use egui::{RichText, ScrollArea, Ui};

pub(super) fn show(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let Some(report) = session.report() else {
        return;
    };
    ui.heading("Report");
    if report.cases.is_empty() {
        ui.colored_label(colors::RIGHT, "No case lost points.");
        return;
    }
    ui.weak(format!("{} cases lost points", report.cases.len()));
    let opened = report.opened.as_ref().map(|(index, _)| *index);
    ScrollArea::vertical()
        .id_salt("cases")
        .max_height(180.0)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            for (i, case) in report.cases.iter().enumerate() {
                let text = RichText::new(format!("{} {}", case.task, case.name)).size(11.0);
                if ui
                    .add(egui::Button::selectable(opened == Some(i), text).truncate())
                    .clicked()
                {
                    commands.push(Command::OpenCase(i));
                }
            }
        });
    let Some(case) = report.case() else { return };
    ui.separator();
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
    if let Some(view) = report.view() {
        ui.separator();
        if let Some(failure) = &view.failure {
            ui.colored_label(colors::HOVERED, failure.to_string());
        }
        ui.weak("Your code now, and the exact answer:");
        for row in &view.rows {
            ui.horizontal(|ui| {
                colors::dot(
                    ui,
                    if row.is_right {
                        colors::RIGHT
                    } else {
                        colors::WRONG
                    },
                );
                ui.label(RichText::new(row.name).strong());
            });
            for (who, value) in [("yours", &row.student), ("exact", &row.right)] {
                let text = RichText::new(format!("{who}: {value}")).size(11.0);
                ui.add(egui::Label::new(text).wrap());
            }
        }
        if !view.is_of_report {
            ui.weak("The report's ray is another one: it was made with another seed.");
        }
    }
    if case.test().is_some() && ui.button("Save as test").clicked() {
        commands.push(Command::SaveCaseAsTest);
    }
}
