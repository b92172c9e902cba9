//! What outlives a step or a start of the window: kept cameras, moves that are undone, settings.

use super::common::{Window, scene, session};
use egui::{Key, Modifiers, Pos2};
use egui_kittest::kittest::Queryable;
use kit::Vec2;
use scenes::CameraFile;
use std::path::PathBuf;
use viewer::app::App;
use viewer::command::Command;
use viewer::path_use::PathUse;
use viewer::remembered::Remembered;

const NAME: &str = "spheres.dae";

fn view(window: &mut Window) -> scenes::placement::View {
    window.session().orbit().expect("a camera").view()
}

#[test]
fn kept_cameras_are_returned_to_bit_for_bit_also_after_a_new_start() {
    let mut window = Window::open("-r 40 30", NAME);
    window
        .session()
        .apply(Command::Orbit(Vec2::new(0.123, 0.045)));
    let first = view(&mut window);
    window.press(Key::Num4);
    window.session().apply(Command::Pan(Vec2::new(0.1, 0.07)));
    let second = view(&mut window);
    window.press(Key::Num4);
    window.press(Key::Space);
    for expected in [first, second, first] {
        window.press_with(Modifiers::SHIFT, Key::Num4);
        assert_eq!(view(&mut window), expected);
    }
    let text = serde_json::to_string(&window.session().remembered()).expect("text");
    let remembered: Remembered = serde_json::from_str(&text).expect("the same text");
    let mut again = session("-r 40 30", NAME);
    again.restore(remembered);
    let mut again = Window::with(again, [900.0, 600.0]);
    again.harness.get_by_label("Camera 2").click();
    again.settle();
    assert_eq!(view(&mut again), second);
    // Those of another scene are not offered.
    again.session().apply(Command::Open(scene("gallery.dae")));
    again.settle();
    assert!(again.harness.query_by_label("Camera 1").is_none());
}

#[test]
fn a_damaged_camera_is_left_out_and_unknown_fields_are_ignored() {
    let text = r#"{"recent":["a.dae"],"cameras":[["a.dae","1 2 3"]],"newer":1}"#;
    let remembered: Remembered = serde_json::from_str(text).expect("what is known");
    let mut session = session("", "");
    session.restore(remembered);
    assert_eq!(session.recent(), [PathBuf::from("a.dae")]);
    assert_eq!(session.remembered().cameras, []);
}

#[test]
fn a_camera_file_sets_the_camera_and_the_size_of_the_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open("-r 40 30", NAME);
    let home = view(&mut window);
    window.session().apply(Command::Zoom(2.5));
    let near = view(&mut window);
    let path = folder.path().join("camera.txt");
    let file = CameraFile::new(near, kit::FilmSize { w: 24, h: 18 });
    std::fs::write(&path, file.to_string()).expect("a file");
    window.press(Key::Space);
    assert_eq!(view(&mut window), home);
    window.session().apply(Command::for_file(path.clone()));
    assert_eq!(view(&mut window), near);
    assert_eq!(
        window.session().settings().expect("a scene").film,
        file.film
    );
    std::fs::write(&path, "1 2 x").expect("a file");
    window.session().apply(Command::for_file(path));
    assert!(window.session().message().contains("camera.txt"));
    assert_eq!(view(&mut window), near, "the camera stays");
}

#[test]
fn the_dialog_opens_what_is_chosen_and_says_if_nothing_is() {
    for (picker, is_opened) in [
        ((|| Some(scene("gallery.dae"))) as viewer::app::Picker, true),
        (|| None, false),
    ] {
        let mut window = Window::open("", NAME);
        let state = window.harness.state_mut();
        *state = App::new(session("", NAME)).with_picker(picker);
        window.settle();
        window.press_with(Modifiers::CTRL, Key::O);
        window.settle();
        let name = window.session().scene().expect("a scene").name();
        assert_eq!(name == "gallery.dae", is_opened, "{name}");
        // A dialog that is over at once was none: the window asks for a path.
        assert_eq!(window.session().typed_path().is_some(), !is_opened);
    }
}

#[test]
fn without_a_dialog_a_path_is_typed() {
    let mut window = Window::open("", NAME);
    window.press_with(Modifiers::CTRL, Key::O);
    window
        .harness
        .event(egui::Event::Text("no_such.dae".to_owned()));
    window.press(Key::Enter);
    let message = window.session().message().to_owned();
    assert!(message.contains("no file no_such.dae"), "{message}");
    let typed = window.session().typed_path();
    assert_eq!(typed, Some((PathUse::Open, "no_such.dae")));
    let path = scene("gallery.dae").display().to_string();
    window.session().type_path(path);
    window.press(Key::Enter);
    window.settle();
    assert_eq!(
        window.session().scene().expect("a scene").name(),
        "gallery.dae"
    );
    assert_eq!(window.session().typed_path(), None);
    // Esc closes the sheet and not the window.
    window.press_with(Modifiers::CTRL, Key::O);
    window.press(Key::Escape);
    assert!(window.session().typed_path().is_none() && !window.session().quits());
}

#[test]
fn moves_are_undone_and_done_again_in_order() {
    let mut window = Window::open("-r 40 30", "cornell_spheres.dae");
    window.press(Key::Num1);
    let position = |window: &mut Window| {
        window.settle();
        window
            .session()
            .selected_vertex_position()
            .expect("a vertex")
    };
    let mut places = vec![position(&mut window)];
    let held = Modifiers::SHIFT.plus(Modifiers::ALT);
    for key in [Key::ArrowUp, Key::ArrowRight, Key::ArrowUp] {
        window.press_with(held, key);
        places.push(position(&mut window));
    }
    for i in [2, 1, 0] {
        window.press(Key::Z);
        assert_eq!(position(&mut window), places[i], "back to {i}");
    }
    for i in [1, 2] {
        window.press_with(Modifiers::SHIFT, Key::Z);
        assert_eq!(position(&mut window), places[i], "again to {i}");
    }
    // A new move ends what could be done again.
    window.press_with(held, Key::ArrowLeft);
    let last = position(&mut window);
    window.press_with(Modifiers::SHIFT, Key::Z);
    assert_eq!(position(&mut window), last);
    assert_eq!(window.session().message(), "Nothing was moved back");
}

#[test]
fn pinching_moves_the_camera_and_scrolling_sideways_orbits() {
    let mut window = Window::open("-r 40 30", NAME);
    let at = Pos2::new(250.0, 310.0);
    let distance = |view: scenes::placement::View| view.camera.pos.distance(view.target);
    let home = view(&mut window);
    window.harness.event(egui::Event::PointerMoved(at));
    window.harness.event(egui::Event::Zoom(1.5));
    window.settle();
    let pinched = view(&mut window);
    assert!(distance(pinched) < 0.95 * distance(home));
    window.harness.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: egui::vec2(40.0, 0.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    window.harness.run_steps(12);
    let turned = view(&mut window);
    assert_eq!(turned.target, pinched.target);
    assert!(turned.camera.pos.distance(pinched.camera.pos) > 0.01);
    assert!((distance(turned) - distance(pinched)).abs() < 1e-9);
}

/// What a screen reader reads: everything that can be focused has a name.
#[test]
fn every_control_has_a_name() {
    let mut window = Window::open("-r 32 24 -s 1 -m 1", "cornell_spheres.dae");
    for (keys, shown, least) in [
        (&[Key::E, Key::Num1, Key::Num5][..], "a cut", 20),
        (&[Key::V], "a tree", 20),
        (&[Key::A, Key::R], "a picture", 25),
        (&[Key::G, Key::N], "a replay", 40),
        (&[Key::Q, Key::K], "a comparison", 25),
        (&[Key::Questionmark], "the keys", 0),
    ] {
        for key in keys {
            window.press(*key);
        }
        let controls = window.named_controls(shown);
        assert!(controls >= least, "{controls} in {shown}");
    }
    window.press(Key::Escape);
    window.press_with(Modifiers::CTRL, Key::O);
    assert!(window.named_controls("a path") >= 3);
}

#[test]
fn a_scene_is_saved_as_it_was_edited_and_read_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open("-r 40 30", "cornell_spheres.dae");
    window.press(Key::Num1);
    let held = Modifiers::SHIFT.plus(Modifiers::ALT);
    window.press_with(held, Key::ArrowUp);
    window.settle();
    let moved = window
        .session()
        .selected_vertex_position()
        .expect("a vertex");
    let camera = window.session().orbit().expect("a camera").camera();
    window.press_with(Modifiers::CTRL, Key::S);
    let (path_use, proposed) = window.session().typed_path().expect("a question");
    assert_eq!(path_use, PathUse::SaveScene);
    assert!(
        proposed.ends_with("cornell_spheres_edited.dae"),
        "{proposed}"
    );
    let none = folder.path().join("scene.txt").display().to_string();
    window.session().type_path(none);
    window.session().apply(Command::UseTypedPath);
    assert!(window.session().message().contains(".dae"));
    assert!(window.session().typed_path().is_some(), "to be corrected");
    let path = folder.path().join("saved.dae");
    window.session().type_path(path.display().to_string());
    window.session().apply(Command::UseTypedPath);
    assert!(window.session().typed_path().is_none());
    let read = scenes::load(&path).expect("a scene");
    assert_eq!(read.warnings.len(), 0);
    let triangles = read.scene.triangles.iter();
    let mut vertices = triangles.flat_map(|t| [t.p0, t.p1, t.p2]);
    assert!(
        vertices.any(|p| p == moved),
        "the vertex is where it was moved"
    );
    let saved = read.scene.camera.expect("a camera");
    assert!(saved.pos == camera.pos && saved.h_fov == camera.h_fov);
}
