//! Contrast of text, measured in the pixels of the window.

use super::common::{Window, session};
use super::reports::{failed, sized_window_with};
use egui::Key;
use egui_kittest::kittest::NodeT;
use std::collections::HashMap;
use viewer::command::Command;
use viewer::report::CaseContent;

/// The least contrast of text and its background (WCAG 2.2, level AA).
const LEAST: f64 = 4.5;

/// The least contrast of what shows a control and its state.
const LEAST_OF_SIGNS: f64 = 3.0;

fn luminance([r, g, b]: [u8; 3]) -> f64 {
    let linear = [r, g, b].map(|c| {
        let c = f64::from(c) / 255.0;
        match c <= 0.04045 {
            true => c / 12.92,
            false => ((c + 0.055) / 1.055).powf(2.4),
        }
    });
    0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
}

/// The largest contrast in a rectangle with its most frequent colour.
fn contrast(picture: &image::RgbaImage, rect: egui::Rect) -> f64 {
    let mut counts: HashMap<[u8; 3], usize> = HashMap::new();
    for y in rect.min.y as u32..(rect.max.y as u32).min(picture.height()) {
        for x in rect.min.x as u32..(rect.max.x as u32).min(picture.width()) {
            let [r, g, b, _] = picture.get_pixel(x, y).0;
            *counts.entry([r, g, b]).or_default() += 1;
        }
    }
    let background = counts
        .iter()
        .max_by_key(|(_, count)| **count)
        .map_or(0.0, |(color, _)| luminance(*color));
    let contrasts = counts.keys().map(|color| {
        let text = luminance(*color);
        (text.max(background) + 0.05) / (text.min(background) + 0.05)
    });
    contrasts.fold(1.0, f64::max)
}

/// Checks every text of the window that is visible as a whole. Returns how many there are.
fn check(window: &mut Window) -> usize {
    window.harness.remove_cursor();
    window.settle();
    let picture = window.harness.render().expect("a picture");
    let mut visible =
        egui::Rect::from_min_size(egui::Pos2::ZERO, window.harness.ctx.content_rect().size());
    // There the line at the bottom covers the panel at the side, which scrolls.
    visible.max.y -= 40.0;
    let mut checked = 0;
    for node in window.harness.root().children_recursive() {
        let name = node
            .accesskit_node()
            .value()
            .or_else(|| node.accesskit_node().label())
            .unwrap_or_default();
        let is_text = matches!(
            node.accesskit_node().role(),
            egui::Role::Label | egui::Role::Button
        );
        // The root has none.
        if node.accesskit_node().bounding_box().is_none() {
            continue;
        }
        let rect = node.rect();
        if node.accesskit_node().role() == egui::Role::CheckBox && visible.contains_rect(rect) {
            let edge = rect.height();
            let square = egui::Rect::from_min_size(rect.min, egui::Vec2::splat(edge));
            let found = contrast(&picture, square);
            assert!(found >= LEAST_OF_SIGNS, "{name:?} at {rect:?}: {found:.2}");
        }
        let has_letters = name.chars().any(char::is_alphabetic);
        if !is_text || !has_letters || !visible.contains_rect(rect) || rect.height() < 10.0 {
            continue;
        }
        // Lists that scroll hide some of their lines.
        let found = contrast(&picture, rect.expand(1.0));
        if found == 1.0 {
            continue;
        }
        checked += 1;
        assert!(found >= LEAST, "{name:?} at {rect:?}: {found:.2}");
    }
    checked
}

#[test]
fn every_text_has_contrast() {
    let flags = "-r 60 45 -s 2 -m 3";
    let session = session(flags, "cornell_mirror_glass.dae");
    let mut window = Window::with(session, [1280.0, 900.0]);
    let mut checked = 0;
    for _theme in 0..2 {
        for key in [Key::E, Key::V, Key::R] {
            window.press(key);
            checked += check(&mut window);
        }
        window.session().apply(Command::Inspect(20, 20));
        window.settle();
        window.press(Key::N);
        checked += check(&mut window);
        window.press(Key::Q);
        window.press(Key::L);
    }
    assert!(checked > 150, "{checked}");
}

/// Of every kind of case, light and dark.
#[test]
fn texts_of_cases_have_contrast_in_a_small_window_and_controls_have_names() {
    for (task, name) in [
        ("part1.task1", "samples_inside_the_pixel"),
        ("part1.task3", "back_face"),
        ("part2.task1", "centroids_on_the_split"),
        ("part2.task3", "both_children"),
        ("part3.task1", "sampled_directions"),
        ("part4.task1", "mirror"),
        ("part4.task3", "mean_of_many"),
        ("part5.task2", ""),
    ] {
        let name = match name {
            "" => judge::cases::of(task, 0)[0].name,
            name => name,
        };
        let case = failed(task, name);
        let content = CaseContent::of(&case);
        let mut window = sized_window_with([700.0, 500.0], case, content);
        assert!(window.named_controls(name) >= 10, "{task} {name}");
        for _theme in 0..2 {
            let checked = check(&mut window);
            assert!(checked > 10, "{checked} in {task} {name}");
            window.press(Key::L);
        }
    }
}
