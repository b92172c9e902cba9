//! The 3D views: cuts, lobes, roulettes, the positions of samples.

use super::common::Window;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use image::RgbaImage;
use viewer::command::Command;
use viewer::cut::Cut;

fn window(flags: &str, scene: &str) -> Window {
    let mut window = Window::open(flags, scene);
    window.session().say("");
    window.harness.remove_cursor();
    window
}

fn picture(window: &mut Window) -> RgbaImage {
    window.settle();
    window.harness.render().expect("a picture")
}

fn differing(a: &RgbaImage, b: &RgbaImage) -> usize {
    a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count()
}

/// The distances at which the rays of the view hit.
fn hits(window: &mut Window) -> Vec<f32> {
    window.settle();
    let session = window.session();
    let scene = session.scene().expect("a scene").clone();
    let picture = session.view.picture(&scene).expect("a picture");
    picture.hits.iter().map(|hit| hit.t).collect()
}

#[test]
fn five_cuts_the_scene_open_and_shift_shows_the_other_side() {
    let mut window = window("-r 32 24", "cornell_spheres.dae");
    let whole = hits(&mut window);
    let mut cuts = Vec::new();
    for axis in 0..3 {
        window.press(Key::Num5);
        let cut = window.session().cut().expect("a cut");
        assert_eq!(cut.axis, axis);
        cuts.push(hits(&mut window));
        assert!(cuts[axis] != whole, "{}", Cut::AXES[axis]);
        window.press_with(Modifiers::SHIFT, Key::Num5);
        let other = hits(&mut window);
        // Each ray sees what it saw before on one of the sides, or nothing there.
        let sides = cuts[axis].iter().zip(&other).zip(&whole);
        let nearer = sides.filter(|((a, b), whole)| a.min(**b) != **whole);
        assert_eq!(nearer.count(), 0, "{}", Cut::AXES[axis]);
    }
    window.press(Key::Num5);
    assert_eq!(window.session().cut(), None);
    assert!(hits(&mut window) == whole);
    // A picture alone is not cut, and the scene is there.
    window.press(Key::R);
    window.press(Key::Num5);
    assert_eq!(window.session().cut(), None);
    let message = window.session().message();
    assert!(message.contains("picture is not cut"), "{message}");
}

#[test]
fn w_hides_the_edges_of_triangles_in_both_views() {
    let mut window = window("-r 32 24", "cornell_spheres.dae");
    for mode in [Key::E, Key::V] {
        window.press(mode);
        let with = picture(&mut window);
        window.press(Key::W);
        let without = picture(&mut window);
        assert!(differing(&with, &without) > 100, "{mode:?}");
        window.press(Key::W);
        assert_eq!(differing(&picture(&mut window), &with), 0, "{mode:?}");
    }
}

#[test]
fn the_slider_moves_the_cut_within_the_scene() {
    let mut window = window("-r 32 24", "cornell_spheres.dae");
    window.press(Key::Num5);
    let before = hits(&mut window);
    let [least, greatest] = window.session().cut_range().expect("a range");
    let at = 0.75 * greatest + 0.25 * least;
    window.session().apply(Command::MoveCut(at));
    assert!(hits(&mut window) != before);
    window.harness.get_by_label("flip").click();
    window.settle();
    assert_eq!(window.session().cut().expect("a cut").at, at);
}

#[test]
fn the_lobe_of_a_surface_is_drawn_and_can_be_switched_off() {
    let mut window = window("-r 32 24 -s 16 -m 3", "cornell_spheres.dae");
    window.press(Key::R);
    window.session().apply(Command::Inspect(16, 12));
    let with = picture(&mut window);
    window.session().inspector.filter.lobe = false;
    let without = picture(&mut window);
    // The checkbox itself has some 200 pixels.
    assert!(
        differing(&with, &without) > 600,
        "{}",
        differing(&with, &without)
    );
}

#[test]
fn roulettes_of_a_path_are_listed_and_drawn() {
    let mut window = window("-r 32 24 -s 16 -m 12", "cornell_spheres.dae");
    window.press(Key::R);
    window.session().apply(Command::Inspect(16, 12));
    window.settle();
    let inspected = window.session().inspector.inspected().expect("a replay");
    let samples = inspected.replay.samples.iter();
    let ends = |sample: &pathtracer::replay::SampleRecord| {
        sample
            .roulettes
            .iter()
            .any(|played| played.survivor.is_none())
    };
    let ended = samples.enumerate().find(|(_, sample)| ends(sample));
    let (place, _) = ended.expect("a path that roulette ends");
    window.session().apply(Command::SelectSample(place));
    window.settle();
    let texts = window.harness.query_all_by_label_contains("the path ends");
    assert_eq!(texts.count(), 1);
}

#[test]
fn the_samples_of_an_adaptive_pixel_say_when_it_stopped() {
    let mut window = window("-r 32 24 -s 512 -a 32 0.2 -m 2", "cornell_spheres.dae");
    window.press(Key::R);
    window.press(Key::T);
    let texts = window.harness.query_all_by_label_contains("stopped early");
    assert_eq!(texts.count(), 1, "how many pixels stopped when");
    window.session().apply(Command::Inspect(16, 12));
    window.settle();
    let inspected = window.session().inspector.inspected().expect("a replay");
    let took = inspected.replay.samples.len();
    assert!(took < inspected.most_samples());
    for position in inspected.positions() {
        assert!((0.0..=1.0).contains(&position.x) && (0.0..=1.0).contains(&position.y));
    }
    let header = "Samples in the pixel, and their mean";
    window.harness.get_by_label(header).click();
    window.harness.run_steps(20);
    let text = format!("stopped after {took} of 512 samples");
    assert_eq!(window.harness.query_all_by_label_contains(&text).count(), 1);
}

/// The sphere in front of a selected wall stays as it is.
#[test]
fn a_selected_face_is_not_painted_over_what_is_in_front_of_it() {
    let mut window = window("-r 32 24", "cornell_spheres.dae");
    let scene = window.session().scene().expect("a scene").clone();
    let of_sphere = |prim: u32| prim as usize >= scene.scene().triangles.len();
    let plain = picture(&mut window);
    // The back wall, behind both spheres.
    for _ in 0..6 {
        window.press(Key::Num3);
    }
    window.harness.remove_cursor();
    let selected = picture(&mut window);
    let view = window
        .session()
        .view
        .picture(&scene)
        .expect("a view")
        .clone();
    let (w, h) = view.size;
    // The view is between the bars at the top and the bottom, which are of one height.
    let (left, top) = (8, (plain.height() - h) / 2);
    let mut changed = 0;
    for y in 0..h {
        for x in 0..w {
            let hit = view.hits[(y * w + x) as usize];
            if hit.t.is_finite() {
                let at = (x + left, y + top);
                let differs = plain.get_pixel(at.0, at.1) != selected.get_pixel(at.0, at.1);
                changed += usize::from(differs && of_sphere(hit.prim));
            }
        }
    }
    let all = differing(&plain, &selected);
    assert!(all > 10_000, "a face is selected: {all}");
    assert!(
        changed < 400,
        "{changed} pixels of spheres: only the edges of the face"
    );
}
