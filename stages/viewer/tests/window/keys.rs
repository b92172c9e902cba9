//! Every key of the assignment's table, and the others.

use super::common::{Window, session};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use kit::film::Cell;
use pathtracer::DirectSampling;
use pathtracer::args::SamplerName;
use viewer::command::Command;
use viewer::picture_pair::PairView;
use viewer::session::{HeatKind, Mode};

/// A window with a small picture.
fn window() -> Window {
    Window::open("-r 32 24 -s 2 -m 2", "cornell_spheres.dae")
}

#[test]
fn e_v_and_r_switch_the_mode_from_every_mode() {
    let mut window = window();
    assert_eq!(
        window.session().mode(),
        Mode::Edit,
        "edit mode is the first one"
    );
    for _ in 0..2 {
        for (key, mode) in [
            (Key::V, Mode::Bvh),
            (Key::R, Mode::Render),
            (Key::E, Mode::Edit),
        ] {
            window.press(key);
            assert_eq!(window.session().mode(), mode);
        }
    }
    assert!(
        window
            .session()
            .render()
            .is_some_and(|render| render.is_done())
    );
}

#[test]
fn keys_do_not_depend_on_case() {
    let mut window = window();
    window.press_with(Modifiers::SHIFT, Key::V);
    assert_eq!(window.session().mode(), Mode::Bvh);
}

#[test]
fn arrows_walk_through_the_tree() {
    let mut window = window();
    window.press(Key::ArrowLeft);
    assert_eq!(
        window.session().walk().depth(),
        0,
        "arrows belong to the visualiser"
    );
    window.press(Key::V);
    window.press(Key::ArrowLeft);
    let left = window.session().walk().node();
    window.press(Key::ArrowUp);
    assert_eq!(window.session().walk().node(), 0);
    window.press(Key::ArrowRight);
    let right = window.session().walk().node();
    assert!(left != right && left != 0 && right != 0, "{left} {right}");
    window.press(Key::ArrowUp);
    window.press(Key::ArrowUp);
    assert_eq!(window.session().walk().depth(), 0);
}

#[test]
fn brackets_minus_equals_and_angles_change_the_settings() {
    let mut window = window();
    let settings = |window: &mut Window| {
        let settings = *window.session().settings().expect("a scene");
        (
            settings.samples,
            settings.light.light_samples,
            settings.light.max_depth,
        )
    };
    assert_eq!(settings(&mut window), (2, 1, 2));
    for (key, expected) in [
        (Key::CloseBracket, (4, 1, 2)),
        (Key::Equals, (4, 2, 2)),
        (Key::Plus, (4, 4, 2)),
        (Key::Minus, (4, 2, 2)),
        (Key::Period, (4, 2, 3)),
        (Key::Comma, (4, 2, 2)),
        (Key::Comma, (4, 2, 1)),
        (Key::OpenBracket, (2, 2, 1)),
        (Key::OpenBracket, (1, 2, 1)),
        (Key::OpenBracket, (1, 2, 1)),
        (Key::Comma, (1, 2, 0)),
        (Key::Comma, (1, 2, 0)),
    ] {
        window.press(key);
        assert_eq!(settings(&mut window), expected, "after {key:?}");
    }
    // < and > are the same keys with Shift.
    window.press_with(Modifiers::SHIFT, Key::Period);
    assert_eq!(settings(&mut window), (1, 2, 1));
}

/// In render mode a changed setting starts the render again, with the new setting.
#[test]
fn a_changed_setting_restarts_the_render() {
    let mut window = window();
    window.press(Key::R);
    let first = window.session().render().expect("a render").number();
    window.press(Key::CloseBracket);
    let render = window.session().render().expect("a render");
    assert_ne!(render.number(), first);
    assert_eq!(render.job().samples, 4);
    assert!(render.is_done());
    // The line at the bottom stays when the picture is done.
    let message = window.session().message();
    assert!(message.starts_with("Picture with -r"), "{message}");
}

#[test]
fn h_m_a_and_u_change_the_sampling() {
    let mut window = window();
    let direct = |window: &mut Window| {
        window
            .session()
            .settings()
            .expect("a scene")
            .light
            .direct_sampling
    };
    window.press(Key::H);
    assert_eq!(direct(&mut window), DirectSampling::Hemisphere);
    window.press(Key::M);
    assert_eq!(direct(&mut window), DirectSampling::Mis);
    window.press(Key::M);
    assert_eq!(direct(&mut window), DirectSampling::Lights);
    window.press(Key::A);
    let settings = *window.session().settings().expect("a scene");
    assert_eq!(settings.light.adaptive, Some((64, 0.05)));
    window.press(Key::U);
    assert_eq!(
        window.session().settings().expect("a scene").sampler,
        SamplerName::Stratified
    );
}

#[test]
fn c_toggles_cell_mode_and_forgets_the_cell() {
    let mut window = window();
    window.press(Key::C);
    assert!(!window.session().cell_mode(), "cells belong to render mode");
    window.press(Key::R);
    window.press(Key::C);
    assert!(window.session().cell_mode());
    let cell = Cell {
        x0: 1,
        y0: 2,
        x1: 9,
        y1: 8,
    };
    window.session().apply(Command::SetCell(cell));
    assert_eq!(
        window.session().message(),
        "Selected cell measures 8x6 pixels"
    );
    window.settle();
    assert_eq!(
        window.session().render().expect("a render").job().cell,
        cell
    );
    window.press(Key::C);
    assert!(!window.session().cell_mode());
    let job = *window.session().render().expect("a render").job();
    assert_eq!(job.cell, job.film.whole());
}

#[test]
fn p_stops_and_o_adds_samples() {
    let mut window = window();
    window.press(Key::R);
    window.press(Key::O);
    let render = window.session().render().expect("a render");
    let film = &render.render().expect("it is done").rendered().film;
    assert_eq!(film.get(3, 3).samples, 4, "two passes of two samples");
    window.press(Key::P);
    assert!(
        window
            .session()
            .message()
            .starts_with("The picture is complete")
    );
}

#[test]
fn x_t_and_g_show_where_the_work_is() {
    let mut window = window();
    window.press(Key::R);
    window.press(Key::X);
    assert_eq!(window.session().heat().kind, Some(HeatKind::Boxes));
    let map = window.session().heat().map().expect("counts").clone();
    assert!(map.pixels.iter().any(|counts| counts.box_tests > 0));
    window.press(Key::X);
    assert_eq!(window.session().heat().kind, Some(HeatKind::Primitives));
    window.press(Key::G);
    let costliest = map.costliest(|counts| counts.prim_tests).expect("a pixel");
    let inspected = window.session().inspector.inspected().expect("a replay");
    assert_eq!(inspected.replay.pixel, costliest);
    assert_eq!(inspected.replay.counters, map.get(costliest.0, costliest.1));
    window.press(Key::X);
    assert_eq!(window.session().heat().kind, None);
    window.press(Key::T);
    assert!(window.session().shows_rate());
}

#[test]
fn n_and_b_walk_through_tests_and_rays() {
    let mut window = window();
    window.press(Key::R);
    window.session().apply(Command::Inspect(16, 12));
    window.settle();
    let position = |window: &mut Window| window.session().inspector.position();
    assert_eq!(position(&mut window), (0, 0, 0));
    window.press(Key::N);
    window.press(Key::N);
    assert_eq!(position(&mut window), (0, 0, 2));
    window.press(Key::B);
    assert_eq!(position(&mut window), (0, 0, 1));
    window.press_with(Modifiers::SHIFT, Key::N);
    assert_eq!(position(&mut window), (0, 1, 0));
    window.press_with(Modifiers::SHIFT, Key::B);
    assert_eq!(position(&mut window), (0, 0, 0));
    window.press(Key::B);
    assert_eq!(
        position(&mut window),
        (0, 0, 0),
        "nothing is before the first test"
    );
    window.press(Key::Q);
    assert!(window.session().inspector.inspected().is_none());
}

/// However wide the window is, no column of the sheet is cut.
#[test]
fn the_sheet_fits_the_window() {
    for width in [700.0, 1280.0, 1400.0, 1920.0] {
        let mut window = Window::with(session("", ""), [width, 800.0]);
        window.press(Key::Questionmark);
        let bindings = viewer::keys::bindings();
        for binding in bindings.iter().filter(|binding| !binding.label.is_empty()) {
            for label in window.harness.query_all_by_label(binding.help) {
                let right = label.rect().right();
                assert!(right < width - 16.0, "{width}: {} to {right}", binding.help);
            }
        }
    }
}

#[test]
fn other_keys_do_what_the_sheet_says() {
    let mut window = window();
    window.press(Key::Questionmark);
    assert!(window.session().help());
    window.press(Key::Escape);
    assert!(!window.session().help() && !window.session().quits());
    window.press(Key::Backtick);
    assert!(!window.session().overlay());
    window.press(Key::L);
    assert!(!window.session().dark());
    window.press(Key::K);
    assert!(
        window.session().comparison().is_none(),
        "there is no picture yet"
    );
    window.press(Key::R);
    window.press(Key::K);
    window.press(Key::F);
    assert!(
        window
            .session()
            .comparison()
            .is_some_and(|comparison| comparison.display.view == PairView::Flicker)
    );
    let errors = window
        .session()
        .compared()
        .and_then(|compared| compared.errors);
    let errors = errors.expect("one size");
    assert_eq!(errors.pixels, 0, "the picture is compared with itself");
    window.press(Key::J);
    let display = window.session().comparison().expect("both").display;
    assert_eq!(display.view, PairView::First);
    window.press(Key::Escape);
    assert!(window.session().quits());
}

#[test]
fn space_resets_the_view_completely() {
    let mut window = window();
    let home = *window.session().orbit().expect("a camera");
    window
        .session()
        .apply(Command::Orbit(kit::Vec2::new(0.2, 0.1)));
    window.session().apply(Command::Zoom(3.0));
    window
        .session()
        .apply(Command::Pan(kit::Vec2::new(0.1, 0.0)));
    assert_ne!(*window.session().orbit().expect("a camera"), home);
    window.press(Key::Space);
    assert_eq!(*window.session().orbit().expect("a camera"), home);
}

/// Every key of the sheet can be pressed in every mode, also without a scene.
#[test]
fn no_key_breaks_anything() {
    for name in ["spheres.dae", ""] {
        for mode in Mode::ALL {
            let folder = tempfile::tempdir().expect("a folder");
            let mut window = Window::open("-r 16 12", name);
            window.session().output_folder = folder.path().to_owned();
            for binding in viewer::keys::bindings() {
                if binding.key == Key::Escape {
                    continue;
                }
                window.session().apply(Command::Mode(mode));
                window.press_with(binding.held.modifiers(), binding.key);
            }
            assert!(!window.session().quits());
        }
    }
}
