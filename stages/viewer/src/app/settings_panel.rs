//! The settings of renders, and the progress of the one that runs.

use super::side_panel::{self, facts};
use super::single_picture::Look;
use super::text::SMALL;
use super::{arrow_button, compare_panel, key_button, outlined, scale};
use crate::command::Command;
use crate::compare::Reference;
use crate::features::{Feature, MissingFeatures};
use crate::session::{HeatKind, Session};
use crate::settings::Change;
use crate::task::StageFailure;
use egui::{ComboBox, DragValue, Key, ProgressBar, RichText, Ui};
use pathtracer::DirectSampling;
use pathtracer::args::{AccelName, SamplerName};
use pathtracer::tone::{Tone, ToneCurve};
use std::collections::BTreeMap;

/// The settings of the next render.
pub(super) fn settings(ui: &mut Ui, session: &mut Session, commands: &mut Vec<Command>) {
    let Some(mut settings) = session.settings().copied() else {
        return;
    };
    let missing = session.missing().clone();
    ui.heading("Settings");
    missing_features(ui, &missing);
    egui::Grid::new("settings")
        .num_columns(2)
        .spacing([12.0, 4.0])
        .show(ui, |ui| {
            stepper(
                ui,
                "camera rays ( [ ] )",
                settings.samples,
                commands,
                Command::Samples,
            );
            stepper(
                ui,
                "light samples ( - = )",
                settings.light.light_samples,
                commands,
                Command::LightSamples,
            );
            stepper(
                ui,
                "ray depth ( , . )",
                settings.light.max_depth,
                commands,
                Command::Depth,
            );
            let label = ui.label("size").id;
            ui.horizontal(|ui| {
                let mut film = settings.film;
                ui.add(edge(&mut film.w)).labelled_by(label);
                ui.label("x");
                ui.add(edge(&mut film.h)).labelled_by(label);
                if film != settings.film {
                    settings.film = film;
                    settings.cell = None;
                }
            });
            ui.end_row();
            choice(
                ui,
                "direct light (H, M)",
                &mut settings.light.direct_sampling,
                &[
                    (
                        DirectSampling::Lights,
                        "lights",
                        missing.why(Feature::Light),
                    ),
                    (
                        DirectSampling::Hemisphere,
                        "hemisphere",
                        missing.why(Feature::Hemisphere),
                    ),
                    (DirectSampling::Mis, "MIS", missing.why(Feature::Mis)),
                ],
            );
            choice(
                ui,
                "samples (U)",
                &mut settings.sampler,
                &[
                    (SamplerName::Sobol4, "Sobol", None),
                    (SamplerName::Sobol, "Sobol, 2D only", None),
                    (SamplerName::Stratified, "stratified", None),
                    (SamplerName::Independent, "independent", None),
                ],
            );
            let label = ui.label("adaptive (A)").id;
            ui.horizontal(|ui| {
                let mut is_on = settings.light.adaptive.is_some();
                let is_written = missing.why(Feature::Adaptive).is_none();
                let checkbox = egui::Checkbox::without_text(&mut is_on);
                let checkbox =
                    outlined(ui, |ui| ui.add_enabled(is_written, checkbox)).labelled_by(label);
                if checkbox.changed() {
                    commands.push(Command::ToggleAdaptive);
                }
                if let Some((batch, tolerance)) = &mut settings.light.adaptive {
                    let batch = DragValue::new(batch).range(1..=4096_u32);
                    ui.add(batch.update_while_editing(false)).labelled_by(label);
                    let tolerance = DragValue::new(tolerance).range(0.0..=1.0).speed(0.001);
                    ui.add(tolerance.update_while_editing(false))
                        .labelled_by(label);
                }
            });
            ui.end_row();
            let mut accel = session.accel();
            let accels = [
                (AccelName::Simd, "Part 6", None),
                (AccelName::Bvh, "the stages", None),
                (AccelName::Brute, "no tree", None),
            ];
            choice(ui, "traced by", &mut accel, &accels);
            session.set_accel(accel);
            tone(ui, &mut session.tone);
            let label = ui.label("roulette").id;
            outlined(ui, |ui| ui.checkbox(&mut settings.light.roulette, "")).labelled_by(label);
            ui.end_row();
        });
    session.set_settings(settings);
    kept_cameras(ui, session, commands);
    ui.horizontal_wrapped(|ui| {
        if ui.button("Camera to file (D)").clicked() {
            commands.push(Command::DumpCamera);
        }
        let flags = settings.flags() + &tone_flags(session.tone);
        ui.label(RichText::new(flags).size(SMALL).weak());
    });
}

/// The cameras of the scene that were kept.
fn kept_cameras(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        if key_button(ui, "Keep camera", Key::Num4) {
            commands.push(Command::KeepCamera);
        }
        for (number, (place, kept)) in session.kept_cameras().enumerate() {
            let name = format!("Camera {}", number + 1);
            let at = side_panel::short(kept.file.view.camera.pos);
            let help = format!("at {at}; with the right button: forget it");
            let button = ui.button(name).on_hover_text(help);
            if button.clicked() {
                commands.push(Command::GoToKeptCamera(place));
            }
            if button.secondary_clicked() {
                commands.push(Command::ForgetCamera(place));
            }
        }
    });
}

/// The tone curves and their flags.
const CURVES: [(ToneCurve, &str); 3] = [
    (ToneCurve::Assignment, "assignment"),
    (ToneCurve::Filmic, "filmic"),
    (ToneCurve::Agx, "agx"),
];

/// How radiance becomes the bytes of pictures, as with `--exposure` and `--tone`.
fn tone(ui: &mut Ui, tone: &mut Tone) {
    let label = ui.label("exposure, tone").id;
    ui.horizontal(|ui| {
        let stops = DragValue::new(&mut tone.exposure)
            .range(-20.0..=20.0)
            .speed(0.05)
            .max_decimals(2);
        ui.add(stops).labelled_by(label);
        let name = CURVES.iter().find(|(curve, _)| *curve == tone.curve);
        let field = ComboBox::from_id_salt("tone")
            .width(80.0)
            .selected_text(name.map_or("", |(_, name)| name));
        let shown = field.show_ui(ui, |ui| {
            for (curve, name) in CURVES {
                ui.selectable_value(&mut tone.curve, curve, name);
            }
        });
        shown.response.labelled_by(label);
    });
    ui.end_row();
}

/// The flags of the program for a tone that is not its default.
fn tone_flags(tone: Tone) -> String {
    let mut flags = String::new();
    if tone.exposure != 0.0 {
        flags += &format!(" --exposure {}", tone.exposure);
    }
    let name = CURVES.iter().find(|(curve, _)| *curve == tone.curve);
    if let Some((_, name)) = name.filter(|_| tone.curve != ToneCurve::default()) {
        flags += &format!(" --tone {name}");
    }
    flags
}

/// What waits for a task, greyed.
fn missing_features(ui: &mut Ui, missing: &MissingFeatures) {
    for (feature, why) in missing.iter() {
        let text = RichText::new(format!("{}: {why}", feature.name()));
        ui.add_enabled(false, egui::Label::new(text.size(SMALL)));
    }
}

/// A value, its name, and why it cannot be chosen.
type Choice<'a, T> = (T, &'a str, Option<&'a StageFailure>);

/// One of several values, in a row of its own. Values that wait for a task are greyed.
fn choice<T: Copy + PartialEq>(ui: &mut Ui, label: &str, value: &mut T, choices: &[Choice<'_, T>]) {
    let id = ui.label(label).id;
    let name = choices.iter().find(|(choice, ..)| choice == value);
    let field = ComboBox::from_id_salt(label).selected_text(name.map_or("", |(_, name, _)| name));
    let shown = field.width(96.0).show_ui(ui, |ui| {
        for (choice, name, why) in choices {
            let selected = egui::Button::selectable(value == choice, *name);
            let response = ui.add_enabled(why.is_none(), selected);
            if response.clicked() {
                *value = *choice;
            }
            if let Some(why) = why {
                response.on_disabled_hover_text(why.to_string());
            }
        }
    });
    shown.response.labelled_by(id);
    ui.end_row();
}

/// A field for the width or the height of the picture.
fn edge(size: &mut u32) -> DragValue<'_> {
    DragValue::new(size)
        .range(1..=8192_u32)
        .update_while_editing(false)
}

/// A number with a button for less and one for more.
fn stepper(
    ui: &mut Ui,
    label: &str,
    value: u32,
    commands: &mut Vec<Command>,
    command: fn(Change) -> Command,
) {
    ui.label(label);
    ui.horizontal(|ui| {
        if arrow_button(ui, "<", &format!("less: {label}")).clicked() {
            commands.push(command(Change::Less));
        }
        ui.monospace(value.to_string());
        if arrow_button(ui, ">", &format!("more: {label}")).clicked() {
            commands.push(command(Change::More));
        }
    });
    ui.end_row();
}

/// The render: its progress, and what can be done with it.
pub(super) fn progress(ui: &mut Ui, session: &mut Session, commands: &mut Vec<Command>) {
    ui.heading("Render");
    let Some(render) = session.render() else {
        ui.weak("R renders the picture.");
        if let Some(picture) = session.single_picture().cloned() {
            of_file(ui, session, &picture, commands);
        }
        return compare_panel::show(ui, session, commands);
    };
    let (progress, pass) = {
        let shown = render.shown();
        (shown.progress, shown.pass)
    };
    let (is_running, is_done) = (render.is_running(), render.is_done());
    let state = match (is_running, is_done) {
        (true, _) => format!("{:.0} %", 100.0 * progress),
        (false, true) => "done".to_owned(),
        (false, false) => format!("stopped at {:.0} %", 100.0 * progress),
    };
    ui.add(ProgressBar::new(progress as f32).text(state));
    let scene = render.scene();
    let mut rows = vec![("traced by", scene.traced_by().to_owned())];
    if scene.has_no_light() {
        rows.push(("shows", "normals, since the scene has no light".to_owned()));
    }
    rows.push(("pass", pass.to_string()));
    let seconds = render.time().as_secs_f64();
    // Snapshots are the same on every machine: they show no times.
    let is_timed = !session.patience.always_sharp;
    if is_timed {
        rows.push(("time", format!("{seconds:.1} s")));
        if let Some(first) = render.shown().first_after {
            rows.push(("first picture", format!("{:.2} s", first.as_secs_f64())));
        }
    }
    if let Some(progress) = render.render() {
        let rendered = progress.rendered();
        let rays = rendered.counters.rays;
        let rate = rays as f64 / seconds.max(1e-9) / 1e6;
        rows.push((
            "rays",
            match is_timed {
                true => format!("{rays}, {rate:.2} million/s"),
                false => rays.to_string(),
            },
        ));
        if let Some(noise) = rendered.noise(progress.job().sampling.pattern) {
            rows.push(("noise", noise));
        }
    }
    facts(ui, "render", &rows);
    ui.horizontal_wrapped(|ui| {
        let name = if is_running { "Stop (P)" } else { "Resume (P)" };
        let button = ui
            .add_enabled(!is_done, egui::Button::new(name))
            .on_disabled_hover_text("The picture is complete");
        if button.clicked() {
            commands.push(Command::StopOrResume);
        }
        if key_button(ui, "More samples", Key::O) {
            commands.push(Command::AddSamples);
        }
        if key_button(ui, "Restart", Key::R) {
            commands.push(Command::Render);
        }
    });
    ui.horizontal_wrapped(|ui| {
        let compares = session.comparison().is_some();
        let toggle_alone = |ui: &mut Ui, is_on: bool, label: &str| {
            let button = egui::Button::selectable(is_on && !compares, label);
            let response = ui
                .add_enabled(!compares, button)
                .on_disabled_hover_text("A and B are shown: end the comparison");
            response.clicked()
        };
        if toggle_alone(ui, session.cell_mode(), "Cell (C)") {
            commands.push(Command::ToggleCell);
        }
        if toggle_alone(ui, session.shows_rate(), "Rate (T)") {
            commands.push(Command::ToggleRate);
        }
        let heat = match session.heat().kind {
            None => "Heat map (X)",
            Some(HeatKind::Boxes) => "Heat map: boxes (X)",
            Some(HeatKind::Primitives) => "Heat map: primitives (X)",
        };
        if toggle_alone(ui, session.heat().kind.is_some(), heat) {
            commands.push(Command::NextHeat);
        }
        if toggle_alone(ui, session.false_color(), "False colour (6)") {
            commands.push(Command::ToggleFalseColor);
        }
        if ui.button("Costliest pixel (G)").clicked() {
            commands.push(Command::GoToCostliest);
        }
    });
    legends(ui, session);
    under_pointer(ui, session);
    compare_panel::show(ui, session, commands);
}

/// What the colours of the picture mean, if they are not its own, and its histogram.
fn legends(ui: &mut Ui, session: &mut Session) {
    if session.comparison().is_none() {
        if session.heat().is_counting() {
            ui.horizontal(|ui| {
                ui.spinner();
                ui.label("Counting the tests of every pixel");
            });
        } else if let (Some(kind), Some(map)) = (session.heat().kind, session.heat().map()) {
            let most = map.pixels.iter().map(|c| kind.of(c)).max().unwrap_or(0);
            let marks = [(0.0, "0 tests".to_owned()), (1.0, format!("{most} tests"))];
            scale::legend(ui, &marks);
        } else if session.shows_rate() {
            rate_legend(ui, session);
        }
    }
    histogram(ui, session);
}

/// How many pixels stopped after how many samples.
fn rate_legend(ui: &mut Ui, session: &Session) {
    let Some(render) = session.render() else {
        return;
    };
    let shown = render.shown();
    let most = render.job().samples * shown.pass;
    let mut stopped = BTreeMap::new();
    for pixel in shown.film.pixels().iter().filter(|pixel| pixel.samples > 0) {
        *stopped.entry(pixel.samples).or_insert(0) += 1;
    }
    let counts: Vec<(f64, usize)> = stopped
        .iter()
        .map(|(samples, n)| (f64::from(*samples) / f64::from(most.max(1)), *n))
        .collect();
    let marks = [(0.0, "0 samples".to_owned()), (1.0, most.to_string())];
    scale::counts(ui, &counts, &marks);
    let all: usize = stopped.values().sum();
    let early = all - stopped.get(&most).copied().unwrap_or(0);
    let share = 100.0 * early as f64 / all.max(1) as f64;
    let text = match render.settings().adaptive {
        Some((batch, _)) => {
            format!("{share:.1} % of the pixels stopped early, after batches of {batch}")
        }
        None => "Every pixel takes all samples: A switches adaptive sampling on".to_owned(),
    };
    ui.label(RichText::new(text).size(SMALL));
}

/// The luminances of the picture: always with false colours, as their legend.
fn histogram(ui: &mut Ui, session: &mut Session) {
    let open = session.false_color().then_some(true);
    egui::CollapsingHeader::new("Histogram of luminances")
        .open(open)
        .show(ui, |ui| match session.histogram() {
            Some(histogram) => scale::histogram(ui, &histogram),
            None => {
                ui.weak("The file has bytes and no luminances.");
            }
        });
}

/// The layers of a file, and its pixel under the mouse.
fn of_file(ui: &mut Ui, session: &mut Session, picture: &Reference, commands: &mut Vec<Command>) {
    egui::Grid::new("tone of a file").show(ui, |ui| {
        tone(ui, &mut session.tone);
        layers(ui, session, picture, commands);
    });
    if picture.linear.is_some() {
        let button = egui::Button::selectable(session.false_color(), "False colour (6)");
        if ui.add_enabled(session.layer().is_none(), button).clicked() {
            commands.push(Command::ToggleFalseColor);
        }
    }
    match session.layer().and_then(|(_, layer)| layer.range()) {
        Some([least, greatest]) => {
            let marks = [(0.0, least.to_string()), (1.0, greatest.to_string())];
            scale::legend(ui, &marks);
        }
        None => histogram(ui, session),
    }
    let look = Look::of(session);
    let mut rows = vec![("size", format!("{} x {}", picture.size.w, picture.size.h))];
    if let Some((x, y)) = session.pixel_under_pointer()
        && x < picture.size.w
        && y < picture.size.h
    {
        rows.push(("pixel", format!("{x} {y}")));
        if let Some(radiance) = picture.radiance(x, y) {
            rows.push(("linear", radiance.map(|c| format!("{c:.5}")).join(" ")));
        }
        if let Some((_, layer)) = session.layer() {
            let values: Vec<String> = layer
                .get(x, y)
                .into_iter()
                .map(|value| value.to_string())
                .collect();
            rows.push((
                "layer",
                format!("{}: {}", layer.channels.join(" "), values.join(" ")),
            ));
        }
        let [r, g, b] = look.bytes(picture, x, y);
        rows.push(("8 bit", format!("{r} {g} {b}")));
    }
    facts(ui, "file", &rows);
}

/// Which layer of the file is shown, if it has several.
fn layers(ui: &mut Ui, session: &Session, picture: &Reference, commands: &mut Vec<Command>) {
    if picture.layers.is_empty() {
        return;
    }
    let names = picture.layers.iter().map(|layer| layer.name.as_str());
    let choices: Vec<(Option<usize>, &str)> = std::iter::once((None, "the picture"))
        .chain(names.enumerate().map(|(place, name)| (Some(place), name)))
        .collect();
    let shown = session.layer().map(|(place, _)| place);
    let mut wanted = shown;
    let choices: Vec<Choice<'_, Option<usize>>> = choices
        .into_iter()
        .map(|(place, name)| (place, name, None))
        .collect();
    choice(ui, "layer", &mut wanted, &choices);
    if wanted != shown {
        commands.push(Command::ShowLayer(wanted));
    }
}

/// The pixel under the mouse.
fn under_pointer(ui: &mut Ui, session: &Session) {
    let (Some(render), Some((x, y))) = (session.render(), session.pixel_under_pointer()) else {
        ui.weak("Click a pixel to replay its samples.");
        return;
    };
    let film = render.job().film;
    if x >= film.w || y >= film.h {
        return;
    }
    let pixel = render.shown().film.get(x, y);
    let [r, g, b] = session.tone.to_bytes(pixel.radiance);
    let mut rows = vec![
        ("pixel", format!("{x} {y}")),
        (
            "linear",
            pixel
                .radiance
                .to_array()
                .map(|c| format!("{c:.5}"))
                .join(" "),
        ),
        ("8 bit", format!("{r} {g} {b}")),
        ("samples", pixel.samples.to_string()),
    ];
    let rendered = render.render().map(|render| render.rendered());
    let i = y as usize * film.w as usize + x as usize;
    if let Some(tally) = rendered.and_then(|rendered| rendered.luminance.get(i)) {
        rows.push(("variance", format!("{:.3e}", tally.variance())));
    }
    if let Some(map) = session.heat().map().filter(|map| map.size == film) {
        let counts = map.get(x, y);
        rows.push((
            "tests",
            format!(
                "{} boxes, {} primitives",
                counts.box_tests, counts.prim_tests
            ),
        ));
    }
    if let Some(other) = session.second_picture().filter(|other| other.size == film) {
        let [r, g, b] = other.get(x, y);
        rows.push(("B", format!("{r} {g} {b}")));
    }
    facts(ui, "pixel", &rows);
}
