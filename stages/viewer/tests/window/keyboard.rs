//! Without a mouse: selecting, moving, and looking around.

use super::common::Window;
use egui::{Key, Modifiers};
use viewer::session::Mode;
use viewer::topology::Element;

#[test]
fn number_keys_select_vertices_edges_and_faces() {
    let mut window = Window::open("-r 40 30", "cornell_whale.dae");
    window.press(Key::Num1);
    assert_eq!(window.session().selection(), Some(Element::Vertex(0)));
    window.press(Key::Num1);
    assert_eq!(window.session().selection(), Some(Element::Vertex(1)));
    window.press_with(Modifiers::SHIFT, Key::Num1);
    assert_eq!(window.session().selection(), Some(Element::Vertex(0)));
    window.press(Key::Num2);
    assert!(matches!(
        window.session().selection(),
        Some(Element::Edge(..))
    ));
    window.press(Key::Num3);
    assert_eq!(window.session().selection(), Some(Element::Face(0)));
    assert!(window.session().message().starts_with("Selected face 0"));
    window.press(Key::V);
    assert_eq!(window.session().message(), "", "nothing is selected here");
}

/// On many keyboards Shift and 1 write "!", which is the key that the window gets then.
#[test]
fn keys_that_arrive_as_the_sign_they_write_with_shift_work() {
    let mut window = Window::open("-r 40 30 -s 4", "cornell_whale.dae");
    window.press(Key::Num1);
    window.press(Key::Num1);
    window.press_with(Modifiers::SHIFT, Key::Exclamationmark);
    assert_eq!(window.session().selection(), Some(Element::Vertex(0)));
    let samples = |window: &mut Window| window.session().settings().map(|of| of.samples);
    window.press_with(Modifiers::SHIFT, Key::CloseCurlyBracket);
    assert_eq!(samples(&mut window), Some(8));
    window.press_with(Modifiers::SHIFT, Key::OpenCurlyBracket);
    assert_eq!(samples(&mut window), Some(4));
}

#[test]
fn a_selected_vertex_moves_by_key_and_back() {
    let mut window = Window::open("-r 40 30", "cornell_whale.dae");
    // The first vertices belong to the room, the last ones to its light.
    window.press(Key::Num1);
    let before = window
        .session()
        .selected_vertex_position()
        .expect("a vertex");
    let arrow = Modifiers::SHIFT.plus(Modifiers::ALT);
    window.press_with(arrow, Key::ArrowUp);
    window.settle();
    let moved = window
        .session()
        .selected_vertex_position()
        .expect("a vertex");
    assert!(moved.y > before.y, "{before} {moved}");
    window.press(Key::Z);
    window.settle();
    let back = window
        .session()
        .selected_vertex_position()
        .expect("a vertex");
    assert!(back.distance(before) < 1e-12, "{before} {back}");
}

#[test]
fn arrows_rotate_and_pan_and_page_keys_zoom() {
    let mut window = Window::open("-r 40 30", "spheres.dae");
    let view = |window: &mut Window| window.session().orbit().expect("a camera").view();
    let home = view(&mut window);
    window.press_with(Modifiers::SHIFT, Key::ArrowRight);
    let rotated = view(&mut window);
    assert_eq!(rotated.target, home.target);
    assert_ne!(rotated.camera.pos, home.camera.pos);
    window.press_with(Modifiers::ALT, Key::ArrowUp);
    let panned = view(&mut window);
    assert_ne!(panned.target, home.target);
    window.press(Key::PageUp);
    let near = view(&mut window);
    let distance = |v: scenes::placement::View| v.camera.pos.distance(v.target);
    assert!(distance(near) < distance(panned));
    window.press(Key::PageDown);
    assert!((distance(view(&mut window)) - distance(panned)).abs() < 1e-9);
}

#[test]
fn pixels_are_replayed_one_after_another() {
    let mut window = Window::open("-r 40 30", "spheres.dae");
    window.press(Key::R);
    window.press_with(Modifiers::CTRL, Key::ArrowLeft);
    let pixel = |window: &mut Window| {
        let inspected = window.session().inspector.inspected();
        inspected.expect("a replay").replay.pixel
    };
    assert_eq!(
        pixel(&mut window),
        (20, 15),
        "the first one is in the middle"
    );
    window.press_with(Modifiers::CTRL, Key::ArrowLeft);
    window.press_with(Modifiers::CTRL, Key::ArrowUp);
    assert_eq!(pixel(&mut window), (19, 16));
}

/// A mesh large enough for nodes of eight children.
#[test]
fn the_boxes_of_the_wide_tree_are_shown_by_depth() {
    let mut window = Window::open("-r 40 30", "cornell_whale.dae");
    window.press(Key::V);
    assert!(!window.session().shows_wide_tree());
    window.press(Key::Num8);
    assert!(
        window.session().shows_wide_tree(),
        "{}",
        window.session().message()
    );
    let session = window.session();
    let scene = session.scene().expect("a scene").bounds;
    let grown = kit::Aabb {
        min: scene.min - 1e-3,
        max: scene.max + 1e-3,
    };
    let boxes = session.wide_boxes();
    assert!(boxes.iter().all(|(b, _)| grown.contains(b)), "world space");
    assert!(boxes.iter().any(|(_, depth)| *depth > 0));
    window.press(Key::Num8);
    assert!(!window.session().shows_wide_tree());
    assert_eq!(window.session().mode(), Mode::Bvh);
}
