//! Pictures of every mode, light and dark, large and small. They are reviewed like goldens.

use super::common::{Window, session};
use clap::ValueEnum;
use egui::Key;
use egui_kittest::SnapshotOptions;
use viewer::command::Command;
use viewer::snapshot::{self, Shot};

/// Pixels may differ where compilers round differently: this many.
const MAX_FAILED_PIXELS: usize = 30;

fn check(window: &mut Window, name: &str) {
    window.harness.remove_cursor();
    window.settle();
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/snapshots");
    let options = SnapshotOptions::new()
        .output_path(folder)
        .max_failed_pixels(MAX_FAILED_PIXELS);
    window.harness.snapshot_options(name, &options);
}

/// A window without the sentence about the scene, which contains a time.
fn window(flags: &str, name: &str, size: [f32; 2]) -> Window {
    let mut window = Window::with(session(flags, name), size);
    window.session().say("");
    window
}

const SMALL: [f32; 2] = [800.0, 600.0];

#[test]
fn edit_mode() {
    let mut window = window("", "cornell_whale.dae", SMALL);
    window.click(egui::Pos2::new(250.0, 310.0));
    check(&mut window, "edit_dark");
    window.press(Key::L);
    check(&mut window, "edit_light");
}

#[test]
fn bvh_mode() {
    let mut window = window("", "cornell_whale.dae", SMALL);
    for key in [Key::V, Key::ArrowRight, Key::ArrowLeft] {
        window.press(key);
    }
    check(&mut window, "bvh_dark");
    window.press(Key::L);
    check(&mut window, "bvh_light");
}

#[test]
fn render_mode_and_heat_map() {
    let mut window = window("-r 120 90 -s 4 -m 3", "cornell_mirror_glass.dae", SMALL);
    window.press(Key::R);
    window.session().say("");
    check(&mut window, "render");
    window.press(Key::X);
    check(&mut window, "heat_boxes");
}

#[test]
fn replay() {
    let mut window = window(
        "-r 120 90 -s 4 -m 3",
        "cornell_mirror_glass.dae",
        [1200.0, 700.0],
    );
    window.press(Key::R);
    window.session().apply(Command::Inspect(40, 40));
    window.settle();
    for _ in 0..3 {
        window.press(Key::N);
    }
    window.session().say("");
    check(&mut window, "replay");
}

#[test]
fn keys() {
    let mut window = window("", "spheres.dae", [1000.0, 800.0]);
    window.press(Key::Questionmark);
    check(&mut window, "keys");
}

#[test]
fn without_a_scene() {
    let mut window = window("", "", SMALL);
    let names = ["cornell_box", "gallery", "spheres"];
    let scenes = names.map(|name| format!("{name}.dae").into());
    window.session().set_course_scenes(scenes.to_vec());
    check(&mut window, "empty");
}

/// The pictures of `--snapshot`, which README shows: every one has something in its middle.
#[test]
fn every_shot_can_be_taken() {
    for shot in Shot::value_variants() {
        let session = session("-r 32 24 -s 2", "cornell_spheres.dae");
        let picture = snapshot::take(session, *shot, [640, 480]);
        assert_eq!(picture.size, [640, 480]);
        let row = &picture.pixels[240 * 640..240 * 640 + 380];
        let is_plain = row.iter().all(|pixel| *pixel == row[0]);
        assert!(!is_plain, "{shot:?}");
    }
}
