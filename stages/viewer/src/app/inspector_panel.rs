//! The replay of a pixel: its values, its rays as a tree, and the walk through their tests.

use super::side_panel::facts;
use super::text::{SMALL, short};
use super::{arrow_button, colors, lines, outlined, sample_plots};
use crate::command::Command;
use crate::digits;
use crate::inspector::{Inspected, Inspector};
use crate::session::Session;
use egui::{Color32, Label, RichText, ScrollArea, Sense, Ui};
use kit::Scene;
use pathtracer::replay::{Outcome, RayRecord, Test, Visit, text};

pub(super) fn show(ui: &mut Ui, session: &mut Session, commands: &mut Vec<Command>) {
    if let Some((x, y)) = session.inspector.running() {
        ui.horizontal(|ui| {
            ui.spinner();
            ui.label(format!("Replaying pixel {x} {y}"));
        });
    }
    if let Some(failure) = session.inspector.failure() {
        ui.colored_label(
            colors::palette(ui).attention,
            format!("No replay: {failure}"),
        );
    }
    if session.inspector.inspected().is_none() {
        return;
    }
    ui.horizontal(|ui| {
        ui.heading("Pixel");
        if ui.button("Close (Q)").clicked() {
            commands.push(Command::CloseInspector);
        }
        if ui
            .button("As test")
            .on_hover_text("Save the selected ray or test as a Rust test")
            .clicked()
        {
            commands.push(Command::SaveRayAsTest);
        }
    });
    let inspector = &mut session.inspector;
    let mut filter = inspector.filter;
    let Some(inspected) = inspector.inspected() else {
        return;
    };
    ui.horizontal(|ui| {
        let scene = inspected.scene.scene();
        if ui.button("Copy pixel").clicked() {
            ui.copy_text(text::pixel(scene, inspected.job.film, &inspected.replay));
        }
        if let Some(record) = inspector.ray()
            && ui.button("Copy ray").clicked()
        {
            ui.copy_text(text::ray(scene, record));
        }
    });
    values(ui, inspected);
    truth(ui, inspected, commands);
    ui.horizontal_wrapped(|ui| {
        outlined(ui, |ui| {
            ui.checkbox(&mut filter.camera, "camera");
            ui.checkbox(&mut filter.bounce, "bounce");
            ui.checkbox(&mut filter.light, "light");
            ui.checkbox(&mut filter.one_sample, "this sample only");
            ui.checkbox(&mut filter.lobe, "lobe")
                .on_hover_text("How the surface scatters where the selected ray hits: the density of directions, and the sampled ones");
        });
        let mut depth = filter.depth.map_or(-1, i64::from);
        let any = |value: f64, _: std::ops::RangeInclusive<usize>| match value < 0.0 {
            true => "any".to_owned(),
            false => format!("{value:.0}"),
        };
        let label = ui.weak("depth").id;
        let field = egui::DragValue::new(&mut depth)
            .range(-1..=64)
            .custom_formatter(any);
        if ui.add(field).labelled_by(label).changed() {
            filter.depth = u32::try_from(depth).ok();
        }
    });
    rays(ui, inspector, commands);
    sample_plots::show(ui, inspector);
    tests(ui, inspector, commands);
    session.inspector.filter = filter;
    ui.separator();
}

fn values(ui: &mut Ui, inspected: &Inspected) {
    let replay = &inspected.replay;
    let film = inspected.job.film;
    // The text of `--pixel`: what is copied from there is found here.
    let lines = text::pixel(inspected.scene.scene(), film, replay);
    let rows: Vec<(&str, String)> = lines
        .lines()
        // Names have a column of twelve characters.
        .filter_map(|line| line.split_at_checked(12))
        .map(|(name, value)| (name.trim_end(), value.to_owned()))
        .collect();
    facts(ui, "values", &rows);
    match inspected.agrees() {
        Some(true) => ui.colored_label(
            colors::palette(ui).right,
            "The replay is the pixel, bit for bit.",
        ),
        Some(false) => ui.colored_label(
            colors::palette(ui).wrong,
            "The replay is not the pixel: two ways to find hits disagree.",
        ),
        None => ui.weak("The pixel is not rendered yet."),
    };
}

fn truth(ui: &mut Ui, inspected: &Inspected, commands: &mut Vec<Command>) {
    let truth = &inspected.truth;
    let Some((sample, ray, of_ray)) = &truth.first_wrong else {
        let all = truth.checked == truth.recorded;
        let rays = if all {
            "all rays".to_owned()
        } else {
            format!("the first {} rays", truth.checked)
        };
        ui.colored_label(
            colors::palette(ui).right,
            format!("Exactly checked: {rays} are right."),
        );
        return;
    };
    let Some(parting) = &of_ray.parting else {
        return;
    };
    ui.colored_label(
        colors::palette(ui).wrong,
        format!("First wrong: sample {}, ray {}.", sample + 1, ray + 1),
    );
    short(ui, &parting.sentence, 14.0);
    if ui.button("Go there").clicked() {
        commands.push(Command::SelectSample(*sample));
        commands.push(Command::SelectRay(*ray));
        if let Some(test) = parting.test {
            commands.push(Command::SelectTest(test));
        }
    }
}

/// The rays of the selected sample as a tree.
fn rays(ui: &mut Ui, inspector: &Inspector, commands: &mut Vec<Command>) {
    let Some(inspected) = inspector.inspected() else {
        return;
    };
    let (sample, ray, _) = inspector.position();
    let samples = inspected.replay.samples.len();
    ui.horizontal(|ui| {
        ui.label(RichText::new(format!("Sample {} of {samples}", sample + 1)).strong());
        if arrow_button(ui, "<", "previous sample").clicked() {
            commands.push(Command::SelectSample(sample.wrapping_sub(1)));
        }
        if arrow_button(ui, ">", "next sample").clicked() {
            commands.push(Command::SelectSample(sample + 1));
        }
        ui.weak("Shift N, Shift B: rays");
    });
    let Some(record) = inspector.sample() else {
        return;
    };
    if record.rays.is_empty() {
        ui.weak("The rays of this sample were not recorded.");
    }
    let wrong = inspected
        .truth
        .first_wrong
        .as_ref()
        .filter(|(s, ..)| *s == sample);
    ScrollArea::vertical()
        .id_salt("rays")
        .max_height(150.0)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            for (i, of) in record.rays.iter().enumerate() {
                if !inspector.filter.shows(of) && i != ray {
                    continue;
                }
                let is_wrong = wrong.is_some_and(|(_, r, _)| *r == i);
                if ray_line(ui, inspected.scene.scene(), of, i == ray, is_wrong) {
                    commands.push(Command::SelectRay(i));
                }
                // Paths that go on unchanged are most of them.
                let played = record.roulette_after(i);
                let played = played.filter(|played| played.survivor != Some(played.throughput));
                if let Some(played) = played {
                    ui.horizontal(|ui| {
                        ui.add_space(8.0 * of.depth as f32 + 30.0);
                        short(ui, &text::roulette(played), SMALL);
                    });
                }
            }
        });
}

fn ray_line(ui: &mut Ui, scene: &Scene, record: &RayRecord, selected: bool, wrong: bool) -> bool {
    let found = match record.outcome {
        Outcome::Hit(hit) => format!("{}, t = {:.4}", text::primitive(scene, hit.prim), hit.t),
        other => text::outcome(scene, other),
    };
    let (boxes, prims) = record.test_counts();
    ui.horizontal(|ui| {
        ui.add_space(8.0 * record.depth as f32);
        let palette = colors::palette(ui);
        let (rect, _) = ui.allocate_exact_size(egui::vec2(24.0, 12.0), Sense::hover());
        match wrong {
            true => lines::cross(ui.painter(), rect.center(), palette.wrong),
            false => {
                let stroke = egui::Stroke::new(2.5, palette.ray(record.role));
                lines::sample(
                    ui.painter(),
                    rect.center(),
                    stroke,
                    colors::pattern(record.role),
                );
            }
        }
        let wrong = if wrong { "WRONG: " } else { "" };
        let line = format!("{wrong}{}: {found}", text::role(record.role));
        let hover = format!("{boxes} box tests, {prims} primitive tests");
        let label = egui::Button::selectable(selected, RichText::new(line).size(SMALL)).truncate();
        ui.add(label).on_hover_text(hover).clicked()
    })
    .inner
}

/// The tests of the selected ray.
fn tests(ui: &mut Ui, inspector: &Inspector, commands: &mut Vec<Command>) {
    let (Some(inspected), Some(record)) = (inspector.inspected(), inspector.ray()) else {
        return;
    };
    let (sample, ray, step) = inspector.position();
    let scene = inspected.scene.scene();
    ui.horizontal(|ui| {
        ui.label(RichText::new(format!("Tests {step} of {}", record.tests.len())).strong());
        if arrow_button(ui, "<", "previous test").clicked() {
            commands.push(Command::StepTest { forward: false });
        }
        if arrow_button(ui, ">", "next test").clicked() {
            commands.push(Command::StepTest { forward: true });
        }
        ui.weak("N, B: tests");
    });
    for line in
        std::iter::once(format!("max_t = {:?}", record.ray.max_t)).chain(text::surface(record))
    {
        short(ui, &line, SMALL);
    }
    let parting = inspected
        .truth
        .first_wrong
        .as_ref()
        .filter(|(s, r, _)| (*s, *r) == (sample, ray));
    let wrong = parting
        .and_then(|(_, _, truth)| truth.parting.as_ref()?.test)
        .map(|test| (test, "WRONG"));
    if let Some(test) = test_list(ui, scene, record, step, wrong) {
        commands.push(Command::SelectTest(test));
    }
}

/// The tests of a ray, of which `step` were walked; `differing` is the first that differs from a
/// right traversal's, and a word about it. Returns the one that was clicked.
pub(super) fn test_list(
    ui: &mut Ui,
    scene: &Scene,
    record: &RayRecord,
    step: usize,
    differing: Option<(usize, &str)>,
) -> Option<usize> {
    let mut clicked = None;
    ScrollArea::vertical()
        .id_salt("tests")
        .max_height(220.0)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            for (i, test) in record.tests.iter().enumerate() {
                let note = differing.filter(|(test, _)| *test == i);
                let is_wrong = note.is_some();
                let full = text::test(scene, test);
                let mut shown = digits::shortened(&full);
                if let Some((_, note)) = note {
                    shown = format!("{note}: {shown}");
                }
                let selection = ui.visuals().selection;
                let line = match (i + 1 == step, is_wrong) {
                    (true, _) => RichText::new(shown)
                        .color(selection.stroke.color)
                        .background_color(selection.bg_fill),
                    (false, true) => RichText::new(shown).color(colors::palette(ui).wrong),
                    (false, false) => RichText::new(shown).color(test_color(ui, test)),
                };
                let line = line.size(SMALL);
                let response = ui
                    .add(Label::new(line).wrap().sense(Sense::click()))
                    .on_hover_text(full);
                if i + 1 == step {
                    response.scroll_to_me(None);
                }
                if response.clicked() {
                    clicked = Some(i);
                }
            }
        });
    clicked
}

fn test_color(ui: &Ui, test: &Test) -> Color32 {
    let weak = ui.visuals().weak_text_color();
    match test {
        Test::Box { visit, .. } => match visit {
            Visit::Entered { .. } => ui.visuals().text_color(),
            _ => weak,
        },
        Test::Primitive { answer, .. } => match answer {
            pathtracer::replay::PrimAnswer::Hit(_) | pathtracer::replay::PrimAnswer::Blocks => {
                colors::palette(ui).right
            }
            _ => weak,
        },
    }
}
