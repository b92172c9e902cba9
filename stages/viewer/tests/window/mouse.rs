//! Every click and drag of the assignment's table, and the others.

use super::common::{Window, scene};
use egui::{Key, PointerButton, Pos2};
use kit::film::Cell;
use std::sync::Arc;
use viewer::command::Command;
use viewer::session::Mode;
use viewer::topology::Element;

/// The middle of the 3D view of a window of 900 by 600 points.
const MIDDLE: Pos2 = Pos2::new(300.0, 300.0);

fn window() -> Window {
    Window::open("-r 40 30 -s 1", "spheres.dae")
}

#[test]
fn left_drag_rotates_right_drag_moves_and_the_wheel_zooms() {
    for mode in [Key::E, Key::V] {
        let mut window = window();
        window.press(mode);
        let home = window.session().orbit().expect("a camera").view();
        let right = Pos2::new(360.0, 300.0);
        window.drag(PointerButton::Primary, MIDDLE, right);
        let rotated = window.session().orbit().expect("a camera").view();
        assert_eq!(rotated.target, home.target);
        assert!(rotated.camera.pos.distance(home.camera.pos) > 0.1);
        window.press(Key::Space);
        window.drag(PointerButton::Secondary, MIDDLE, right);
        let moved = window.session().orbit().expect("a camera").view();
        assert_eq!(moved.camera.c2w, home.camera.c2w);
        let shift = moved.target - home.target;
        assert!(
            shift.dot(home.camera.c2w.x_axis) < 0.0,
            "the scene follows the mouse: {shift}"
        );
        window.press(Key::Space);
        window.scroll(MIDDLE, 40.0);
        let near = window.session().orbit().expect("a camera").view();
        let distance = |view: scenes::placement::View| view.camera.pos.distance(view.target);
        let change = distance(near) / distance(home);
        assert!(
            (0.85..0.95).contains(&change),
            "one step of the wheel is a tenth: {change}"
        );
    }
}

#[test]
fn the_render_camera_stays_in_render_mode() {
    let mut window = window();
    window.press(Key::R);
    let camera = *window.session().orbit().expect("a camera");
    window.drag(PointerButton::Primary, MIDDLE, Pos2::new(380.0, 340.0));
    window.scroll(MIDDLE, 80.0);
    assert_eq!(*window.session().orbit().expect("a camera"), camera);
}

#[test]
fn a_click_selects_and_the_panel_tells() {
    let mut window = Window::open("", "cornell_whale.dae");
    window.click(MIDDLE);
    let session = window.session();
    assert!(session.selection().is_some());
    let info = session.selection_info().expect("facts");
    assert!(!info.node.is_empty(), "{info:?}");
    // Beside the scene nothing is hit.
    window.click(Pos2::new(5.0, 60.0));
    assert_eq!(window.session().selection(), None);
}

/// Selects the vertex of a triangle that is nearest to the middle of the view.
fn select_vertex(window: &mut Window) -> (u32, Pos2) {
    let session = window.session();
    let scene = Arc::clone(session.scene().expect("a scene"));
    let request = session.view.picture(&scene).expect("a picture").request;
    let projection = viewer::project::Projection::new(&request.camera);
    let topology = session.topology().expect("vertices");
    let size = request.size;
    let shown = |v: u32| {
        let film = projection.point(topology.position(v))?;
        let (w, h) = (size.0 as f32, size.1 as f32);
        Some(Pos2::new(w * film.x as f32, h * (1.0 - film.y as f32)))
    };
    let middle = Pos2::new(size.0 as f32 / 2.0, size.1 as f32 / 2.0);
    let picture = session.view.picture(&scene).expect("a picture");
    let visible = (0..topology.vertex_count() as u32).filter(|&v| {
        let p = topology.position(v);
        projection
            .point(p)
            .is_some_and(|film| !picture.hides(film, projection.distance(p)))
    });
    visible
        .filter_map(|v| Some((v, shown(v)?)))
        .min_by(|a, b| a.1.distance(middle).total_cmp(&b.1.distance(middle)))
        .expect("a vertex")
}

#[test]
fn dragging_a_selected_vertex_moves_it_and_the_tree_and_the_picture_follow() {
    let mut window = Window::open("", "cornell_whale.dae");
    let (_, in_view) = select_vertex(&mut window);
    // The bars at the top and at the bottom are equally high.
    let top = (600.0 - view_height(&mut window)) / 2.0;
    let at = in_view + egui::vec2(0.0, top);
    // The picked element is a vertex only very near to it.
    let offsets = (-4..=4).flat_map(|y| (-4..=4).map(move |x| egui::vec2(x as f32, y as f32)));
    let mut selected = None;
    for offset in offsets {
        window.click(at + offset);
        if let Some(Element::Vertex(v)) = window.session().selection() {
            selected = Some((v, at + offset));
            break;
        }
    }
    let (v, at) = selected.expect("a vertex is picked near its place");
    let before = window.session().topology().expect("vertices").position(v);
    let old_scene = Arc::clone(window.session().scene().expect("a scene"));
    let old_picture = window
        .session()
        .view
        .picture(&old_scene)
        .expect("a picture")
        .pixels
        .clone();
    window.drag(PointerButton::Primary, at, at + egui::vec2(30.0, -20.0));
    let session = window.session();
    let scene = Arc::clone(session.scene().expect("a scene"));
    assert!(!Arc::ptr_eq(&scene, &old_scene), "the tree is a new one");
    let after = session.topology().expect("vertices").position(v);
    assert!(after.distance(before) > 0.01, "{before} {after}");
    assert_ne!(
        session.view.picture(&scene).expect("a picture").pixels,
        old_picture
    );
    let tree = scene.bvh().expect("a tree");
    let root = tree.nodes[0].bounds;
    assert!(
        root.contains(&kit::Aabb::of([after])),
        "the tree contains the vertex"
    );
    window.press(Key::Z);
    let back = window.session().topology().expect("vertices").position(v);
    assert_eq!(back, before, "undone in one step");
}

fn view_height(window: &mut Window) -> f32 {
    let session = window.session();
    let scene = Arc::clone(session.scene().expect("a scene"));
    session
        .view
        .picture(&scene)
        .expect("a picture")
        .request
        .size
        .1 as f32
}

#[test]
fn a_drag_in_cell_mode_selects_a_cell() {
    let mut window = window();
    window.press(Key::R);
    window.press(Key::C);
    window.drag(
        PointerButton::Primary,
        Pos2::new(250.0, 250.0),
        Pos2::new(350.0, 330.0),
    );
    let cell = window
        .session()
        .settings()
        .expect("a scene")
        .cell
        .expect("a cell");
    let job = *window.session().render().expect("a render").job();
    assert_eq!(job.cell, cell);
    let Cell { x0, y0, x1, y1 } = cell;
    assert!(
        x1 - x0 > 2 && y1 - y0 > 2 && x1 <= 40 && y1 <= 30,
        "{cell:?}"
    );
    let message = format!("Selected cell measures {}x{} pixels", x1 - x0, y1 - y0);
    assert_eq!(window.session().message(), message);
    let shown = window
        .session()
        .render()
        .expect("a render")
        .shown()
        .film
        .clone();
    assert_eq!(shown.get(x0, y0).samples, 1);
    assert_eq!(shown.get(0, 0).samples, 0, "only the cell is rendered");
}

#[test]
fn a_click_in_the_picture_replays_the_pixel() {
    let mut window = window();
    window.press(Key::R);
    window.click(MIDDLE);
    let inspected = window.session().inspector.inspected().expect("a replay");
    assert_eq!(inspected.agrees(), Some(true));
    let (x, y) = inspected.replay.pixel;
    assert!((18..22).contains(&x) && (13..17).contains(&y), "{x} {y}");
    // Now the view of the rays can be moved, and the render camera stays.
    let camera = *window.session().orbit().expect("a camera");
    let spy = *window.session().view_orbit().expect("a camera");
    window.drag(
        PointerButton::Primary,
        Pos2::new(450.0, 300.0),
        Pos2::new(500.0, 300.0),
    );
    assert_ne!(*window.session().view_orbit().expect("a camera"), spy);
    assert_eq!(*window.session().orbit().expect("a camera"), camera);
}

#[test]
fn a_drag_wipes_between_two_pictures() {
    let mut window = window();
    window.press(Key::R);
    window.press(Key::K);
    window.drag(PointerButton::Primary, MIDDLE, Pos2::new(200.0, 300.0));
    let wipe = window
        .session()
        .comparison()
        .expect("a comparison")
        .display
        .wipe;
    assert!(wipe < 0.45, "{wipe}");
}

#[test]
fn buttons_do_what_keys_do() {
    use egui_kittest::kittest::Queryable;
    let mut window = window();
    window.harness.get_by_label("BVH (V)").click();
    window.settle();
    assert_eq!(window.session().mode(), Mode::Bvh);
    window.harness.get_by_label("Right child").click();
    window.settle();
    assert_eq!(window.session().walk().depth(), 1);
}

#[test]
fn a_dropped_scene_is_opened_and_a_bad_one_leaves_the_last() {
    let mut window = window();
    window.session().apply(Command::Open(scene("gems.dae")));
    window.settle();
    assert_eq!(
        window.session().scene().expect("a scene").name(),
        "gems.dae"
    );
    let folder = tempfile::tempdir().expect("a folder");
    let bad = folder.path().join("bad.dae");
    std::fs::write(&bad, "<COLLADA").expect("a file");
    window.session().apply(Command::Open(bad));
    window.settle();
    assert!(
        window
            .session()
            .message()
            .ends_with("is not loaded: see above"),
        "{}",
        window.session().message()
    );
    assert_eq!(
        window.session().scene().expect("a scene").name(),
        "gems.dae"
    );
    assert_eq!(window.session().recent().len(), 2);
}

#[test]
fn a_resize_keeps_the_picture() {
    let mut window = window();
    window.press(Key::R);
    let number = window.session().render().expect("a render").number();
    window.harness.set_size(egui::vec2(640.0, 480.0));
    window.settle();
    let render = window.session().render().expect("a render");
    assert_eq!(render.number(), number);
    assert!(render.shown().film.get(20, 15).samples > 0);
}

#[test]
fn closing_during_a_render_asks() {
    let mut window = Window::open("-r 400 300 -s 64", "cornell_whale.dae");
    let session = window.session();
    session.patience = viewer::view3d::Patience::WINDOW;
    session.apply(Command::Render);
    assert!(!session.may_close());
    assert!(session.asks_to_quit());
    session.apply(Command::DoNotQuit);
    assert!(!session.asks_to_quit() && !session.quits());
    session.apply(Command::StopOrResume);
    session.patience = viewer::view3d::Patience::COMPLETE;
    session.update(std::time::Instant::now());
    let render = session.render().expect("a render");
    assert!(!render.is_running() && !render.is_done());
    assert!(session.may_close());
}

/// The line between the picture and the rays of a pixel moves with the mouse.
#[test]
fn the_picture_and_the_view_share_the_window_as_one_drags() {
    let mut window = Window::open("-r 32 24 -s 2 -m 2", "cornell_spheres.dae");
    window.press(Key::R);
    window.session().apply(Command::Inspect(16, 12));
    window.settle();
    // The column of the line, by its colour in a row above the picture.
    let column = |window: &mut Window| {
        window.harness.remove_cursor();
        window.settle();
        let picture = window.harness.render().expect("a picture");
        let found = (20..600).find(|x| picture.get_pixel(*x, 80).0[..3] == [0x8a; 3]);
        found.expect("there is a line") as f32
    };
    let before = column(&mut window);
    let at = Pos2::new(before, 400.0);
    window.drag(PointerButton::Primary, at, at + egui::vec2(90.0, 0.0));
    let moved = column(&mut window) - before;
    assert!((moved - 90.0).abs() <= 2.0, "{moved}");
}

/// The wheel enlarges the picture, a drag moves it, and the pixel under the mouse is still the one
/// that a click replays.
#[test]
fn an_enlarged_picture_is_moved_and_its_pixels_are_replayed() {
    let mut window = window();
    window.press(Key::R);
    let pixel = |window: &mut Window| window.session().pixel_under_pointer();
    window.scroll(MIDDLE, 120.0);
    let before = pixel(&mut window).expect("a pixel");
    let at = MIDDLE + egui::vec2(60.0, 0.0);
    window.drag(PointerButton::Primary, MIDDLE, at);
    assert_eq!(
        pixel(&mut window),
        Some(before),
        "the picture follows the mouse"
    );
    window.click(at);
    let replayed = window.session().inspector.inspected().expect("a replay");
    assert_eq!(replayed.replay.pixel, before);
}

/// With the flags of the program the window shows the bytes that the program writes.
#[test]
fn exposure_and_tone_are_those_of_the_program() {
    let flags = "-r 40 30 -s 2 --exposure 1.5 --tone filmic";
    let mut window = Window::open(flags, "cornell_spheres.dae");
    window.press(Key::R);
    let tone = window.session().tone;
    assert_eq!(tone.exposure, 1.5);
    let radiance = window
        .session()
        .render()
        .expect("a render")
        .shown()
        .film
        .get(20, 15)
        .radiance;
    let expected = tone.to_bytes(radiance);
    assert_ne!(
        expected,
        pathtracer::tone::to_bytes(radiance),
        "it makes a difference"
    );
    window.harness.remove_cursor();
    window.settle();
    let picture = window.harness.render().expect("a picture");
    // A pixel of the picture is more than ten points wide.
    let shown = |bytes: [u8; 3]| {
        picture
            .pixels()
            .filter(|pixel| pixel.0[..3] == bytes)
            .count()
    };
    let found = shown(expected);
    assert!(found > 100, "{found} pixels have {expected:?}");
}
