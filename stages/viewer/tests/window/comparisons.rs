//! A and B: any two pictures.

use super::common::{Window, session};
use egui::Key;
use egui_kittest::kittest::Queryable;
use image::RgbImage;
use std::path::PathBuf;
use viewer::command::Command;
use viewer::picture_pair::PairView;
use viewer::session::Mode;

/// A grey picture file with a white corner of this size.
fn picture(folder: &tempfile::TempDir, name: &str, corner: u32) -> PathBuf {
    let path = folder.path().join(name);
    let pixels = RgbImage::from_fn(32, 24, |x, y| match x < corner && y < corner {
        true => image::Rgb([255; 3]),
        false => image::Rgb([90; 3]),
    });
    pixels.save(&path).expect("a file");
    path
}

#[test]
fn two_files_are_compared_without_a_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::with(session("", ""), [900.0, 600.0]);
    for (name, corner) in [("a.png", 8), ("b.png", 0), ("c.png", 16)] {
        let path = picture(&folder, name, corner);
        window.session().apply(Command::CompareWith(path));
    }
    window
        .session()
        .apply(Command::CompareWith(folder.path().join("b.png")));
    window.settle();
    assert_eq!(window.session().mode(), Mode::Render);
    let compared = window.session().compared().expect("two pictures").clone();
    let errors = compared.errors.expect("one size");
    assert_eq!((errors.pixels, errors.largest), (64, 165));
    let pair = compared.pair.expect("one size");
    // The white corner is a block of its own: brighter than any noise.
    let [cause] = pair.legend.as_slice() else {
        panic!("one cause: {:?}", pair.legend)
    };
    assert_eq!((cause.label, cause.pixels), ("too bright", 64));
    window.press(Key::Num0);
    let swapped = window
        .session()
        .compared()
        .expect("two pictures")
        .pair
        .clone();
    assert_eq!(swapped.expect("one size").legend[0].label, "too dark");
    window.press(Key::J);
    let view = window
        .session()
        .comparison()
        .expect("two pictures")
        .display
        .view;
    assert_eq!(view, PairView::Flicker);
    let before = window.session().comparison().expect("two pictures").second;
    window.press(Key::Num9);
    let after = window.session().comparison().expect("two pictures").second;
    assert_ne!(before, after);
}

#[test]
fn a_picture_of_another_size_has_no_errors() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open("-r 40 30", "spheres.dae");
    window.press(Key::R);
    let path = picture(&folder, "a.png", 4);
    window.session().apply(Command::CompareWith(path));
    window.settle();
    let compared = window.session().compared().expect("two pictures");
    assert!(compared.errors.is_none() && compared.pair.is_none());
    let missing = folder.path().join("none.png");
    window.session().apply(Command::CompareWith(missing));
    assert!(window.session().message().contains("none.png"));
}

/// Two pictures that differ only within their noise are not said to be equal, and what only the
/// picture of a render has is not offered.
#[test]
fn noise_is_no_difference_and_maps_wait_for_the_end_of_a_comparison() {
    let mut window = Window::open("-r 40 30 -s 4 -m 2", "cornell_spheres.dae");
    window.press(Key::R);
    window.press(Key::K);
    let equal = "No pixel differs.";
    assert!(window.harness.query_by_label(equal).is_some());
    let other = |settings: &viewer::settings::RenderSettings| viewer::settings::RenderSettings {
        seed: 7,
        ..*settings
    };
    let settings = other(window.session().settings().expect("a scene"));
    window.session().set_settings(settings);
    window.settle();
    let compared = window.session().compared().expect("two pictures");
    let differing = compared.errors.expect("one size").pixels;
    assert!(differing > 0 && compared.pair.as_ref().expect("one size").legend.is_empty());
    assert!(window.harness.query_by_label(equal).is_none());
    let noise = format!("{differing} pixels differ, none of them beyond the noise.");
    window.harness.get_by_label(&noise);
    let alone = [
        (Key::T, "sample rate"),
        (Key::X, "heat map"),
        (Key::C, "cell"),
    ];
    for (key, name) in alone {
        window.press(key);
        assert!(window.session().message().contains(name));
    }
    assert!(!window.session().shows_rate() && window.session().heat().kind.is_none());
    assert!(!window.session().cell_mode());
    window.session().apply(Command::EndComparison);
    window.press(Key::T);
    assert!(window.session().shows_rate());
}

/// A picture file is shown alone, with the values under the mouse.
#[test]
fn a_single_picture_is_shown_with_its_values() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.exr");
    let pixels =
        image::Rgb32FImage::from_fn(32, 24, |x, _| image::Rgb([x as f32 / 8.0, 0.25, 0.5]));
    pixels.save(&path).expect("a file");
    let mut window = Window::with(session("--exposure 1", ""), [900.0, 600.0]);
    window.session().apply(Command::CompareWith(path));
    window.settle();
    window
        .harness
        .event(egui::Event::PointerMoved(egui::pos2(200.0, 300.0)));
    window.settle();
    let (x, y) = window.session().pixel_under_pointer().expect("a pixel");
    assert!(x < 32 && y < 24);
    let linear = format!("{:.5} 0.25000 0.50000", x as f32 / 8.0);
    window.harness.get_by_label(&linear);
    let expected = window
        .session()
        .tone
        .to_bytes([f64::from(x) / 8.0, 0.25, 0.5].into());
    // The mouse is drawn, too: elsewhere in the same column.
    window.harness.remove_cursor();
    window.settle();
    let picture = window.harness.render().expect("a picture");
    assert_eq!(picture.get_pixel(200, 330).0[..3], expected);
}
