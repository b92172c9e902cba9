//! Files that the window writes, and pictures that are those of the program.

use super::common::{Window, scene, session};
use egui::Key;
use egui_kittest::kittest::Queryable;
use kit::FilmSize;
use pathtracer::args::Args;
use pathtracer::{Output, Picture, PreparedScene, ProgressiveRender, Textures};
use picture_files::{Channel, Values};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use viewer::cli::ViewerArgs;
use viewer::command::Command;
use viewer::session::Saved;

const FLAGS: &str = "-r 40 30 -s 3 -m 3 --seed 5";

/// The only file in `folder` whose name contains `part`.
fn file(folder: &Path, part: &str) -> PathBuf {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut found = paths.filter(|path| path.to_string_lossy().contains(part));
    let first = found.next().expect("the file was written");
    assert_eq!(found.next(), None);
    first
}

/// The picture of the program with these flags.
fn program(flags: &str, camera: Option<PathBuf>, name: &str) -> ProgressiveRender {
    let mut arguments: Vec<OsString> = vec!["viewer".into()];
    arguments.extend(flags.split_whitespace().map(OsString::from));
    arguments.push(scene(name).into_os_string());
    let mut args: Args = ViewerArgs::parse_from(arguments)
        .expect("the flags are valid")
        .render;
    args.camera = camera;
    let loaded = scenes::load(scene(name)).expect("a scene").scene;
    let (view, film) = args.view(&loaded).expect("a view");
    let picture = Picture::new(args.shade, loaded, None);
    let folder = scene(name).parent().expect("a folder").to_owned();
    let (textures, _) = Textures::load(picture.scene(), &folder);
    let prepared = PreparedScene::new(picture, textures, args.accel.into());
    let job = pathtracer::Job {
        camera: view.camera,
        film,
        cell: args.cell_of(film).expect("a cell"),
        samples: args.samples,
        sampling: args.sampling(args.samples),
    };
    let light = args.light().expect("settings");
    let mut render = ProgressiveRender::new(&prepared, job, light);
    render.run(&prepared, usize::MAX, &AtomicBool::new(false));
    render
}

#[test]
fn the_windows_picture_is_the_programs_bit_for_bit() {
    for name in ["cornell_mirror_glass.dae", "gallery.dae", "spheres.dae"] {
        for more in ["", "-H", "--mis", "-a 2 0.1", "-p 5 4 20 10", "--accel bvh"] {
            let flags = format!("{FLAGS} {more}");
            let mut session = session(&flags, name);
            session.update(std::time::Instant::now());
            session.apply(Command::Render);
            session.update(std::time::Instant::now());
            let render = session.render().expect("a render");
            assert!(render.is_done(), "{name} {flags}");
            let expected = program(&flags, None, name);
            assert_eq!(
                render.shown().film,
                expected.rendered().film,
                "{name} {flags}"
            );
        }
    }
}

/// The key D writes a camera with which the program renders the same picture, bit for bit, also
/// after the camera was moved.
#[test]
fn a_dumped_camera_gives_the_same_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open(FLAGS, "cornell_whale.dae");
    window.session().output_folder = folder.path().to_owned();
    window
        .session()
        .apply(Command::Orbit(kit::Vec2::new(0.123, 0.0456)));
    window.session().apply(Command::Zoom(1.7));
    window
        .session()
        .apply(Command::Pan(kit::Vec2::new(0.03, -0.02)));
    window.press(Key::D);
    window.press(Key::R);
    let camera = file(folder.path(), "cornell_whale_cam_settings.txt");
    let expected = program(FLAGS, Some(camera), "cornell_whale.dae");
    let render = window.session().render().expect("a render");
    assert_eq!(render.shown().film, expected.rendered().film);
    assert!(
        render
            .shown()
            .film
            .pixels()
            .iter()
            .any(|pixel| !pixel.radiance.is_black())
    );
}

#[test]
fn a_screenshot_has_the_pixels_of_the_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open("-r 20 15 -s 4 -a 2 0.5", "cornell_spheres.dae");
    window.session().output_folder = folder.path().to_owned();
    window.press(Key::R);
    window.press(Key::S);
    let rate = file(folder.path(), "_rate.png");
    std::fs::remove_file(rate).expect("it exists");
    let path = file(folder.path(), "cornell_spheres_screenshot_");
    let picture = image::open(path).expect("a picture").to_rgb8();
    let film = window
        .session()
        .render()
        .expect("a render")
        .shown()
        .film
        .clone();
    let size = FilmSize { w: 20, h: 15 };
    assert_eq!(film.size(), size);
    for (x, y, pixel) in picture.enumerate_pixels() {
        let expected = pathtracer::tone::to_bytes(film.get(x, size.h - 1 - y).radiance);
        assert_eq!(pixel.0, expected);
    }
}

#[test]
fn two_screenshots_in_one_second_are_two_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open("-r 8 6", "spheres.dae");
    window.session().output_folder = folder.path().to_owned();
    window.press(Key::R);
    (0..3).for_each(|_| window.press(Key::S));
    assert_eq!(
        std::fs::read_dir(folder.path()).expect("a folder").count(),
        3
    );
}

/// In edit mode the window itself is saved: it is asked to.
#[test]
fn in_edit_mode_the_window_is_saved() {
    let mut session = session("", "spheres.dae");
    session.update(std::time::Instant::now());
    session.apply(Command::Screenshot);
    assert!(matches!(
        session.take_saved().as_slice(),
        [Saved::Window(_)]
    ));
}

#[test]
fn a_changed_file_is_read_again_and_the_camera_stays() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.dae");
    std::fs::copy(scene("spheres.dae"), &path).expect("a copy");
    let mut session = session("", "");
    session.apply(Command::Open(path.clone()));
    let now = std::time::Instant::now();
    session.update(now);
    let spheres = session.scene().expect("a scene").scene().spheres.len();
    session.apply(Command::Zoom(2.0));
    let camera = *session.orbit().expect("a camera");
    std::fs::copy(scene("sphereflake.dae"), &path).expect("a copy");
    let file = std::fs::File::options()
        .append(true)
        .open(&path)
        .expect("a file");
    let later = std::time::SystemTime::now() + std::time::Duration::from_secs(5);
    file.set_modified(later).expect("a time");
    session.update(now + std::time::Duration::from_secs(2));
    session.update(now + std::time::Duration::from_secs(3));
    assert_ne!(
        session.scene().expect("a scene").scene().spheres.len(),
        spheres
    );
    assert_eq!(*session.orbit().expect("a camera"), camera);
}

#[test]
fn a_clicked_ray_is_saved_as_a_test() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open("-r 20 15", "spheres.dae");
    window.session().output_folder = folder.path().to_owned();
    window.press(Key::R);
    window.session().apply(Command::Inspect(10, 7));
    window.settle();
    window.session().apply(Command::SaveRayAsTest);
    let path = folder.path().join("stages/intersect/tests/ray.rs");
    let text = std::fs::read_to_string(path).expect("the test was written");
    assert!(
        text.contains("#[test]") && text.contains("intersect::intersect_"),
        "{text}"
    );
    let d = window.session().inspector.ray().expect("a ray").ray.d;
    assert!(
        text.contains(&format!("{:?}", d.x)),
        "the ray is in full:\n{text}"
    );
    // A box test belongs to another stage.
    window.press(Key::N);
    window.session().apply(Command::SaveRayAsTest);
    let path = folder.path().join("stages/bbox/tests/ray.rs");
    assert!(
        std::fs::read_to_string(path)
            .expect("the test")
            .contains("intersect_bbox")
    );
}

#[test]
fn a_broken_file_is_shown_with_its_line_and_a_missing_one_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let broken = folder.path().join("broken.dae");
    let text = std::fs::read_to_string(scene("spheres.dae")).expect("a scene");
    std::fs::write(&broken, text.replacen("</COLLADA>", "</COLLADO>", 1)).expect("a file");
    let mut window = Window::open("", "spheres.dae");
    for (path, parts) in [
        (broken, ["broken.dae:", "^"]),
        (folder.path().join("none.dae"), ["none.dae", "No such file"]),
    ] {
        window.session().apply(Command::Open(path));
        window.settle();
        let problem = window.session().problem().expect("a problem").to_owned();
        for part in parts {
            assert!(problem.contains(part), "{part}: {problem}");
        }
        // What is read from the screen is the whole text, as the program prints it.
        window.harness.get_by_label(problem.trim_end());
        assert!(window.session().scene().is_some(), "the last scene stays");
    }
    window.harness.get_by_label("Close").click();
    window.settle();
    assert_eq!(window.session().problem(), None);
}

#[test]
fn the_scenes_of_the_course_are_found_and_open() {
    let mut window = Window::open("", "");
    let scenes = window.session().course_scenes().to_vec();
    assert!(
        scenes
            .iter()
            .any(|path| path.ends_with("scenes/dae/gallery.dae")),
        "{scenes:?}"
    );
    let first = scenes[0]
        .file_stem()
        .expect("a name")
        .to_string_lossy()
        .into_owned();
    window.harness.get_by_label(&first).click();
    window.settle();
    let opened = window
        .session()
        .scene()
        .map(|scene| scene.source.path.clone());
    assert_eq!(opened, Some(scenes[0].clone()));
}

#[test]
fn a_scene_without_light_says_that_normals_are_shown() {
    for (name, has_no_light) in [("dusk.dae", true), ("cornell_spheres.dae", false)] {
        let mut window = Window::open("-r 20 15", name);
        window.press(Key::R);
        let text = "normals, since the scene has no light";
        let shown = window.harness.query_by_label(text).is_some();
        assert_eq!(shown, has_no_light, "{name}");
    }
}

/// A file with the layers that `--layers` writes.
fn layered_file(folder: &Path) -> PathBuf {
    let path = folder.join("layers.exr");
    let channel = |name, values: [f32; 4]| Channel {
        name,
        values: Values::Float(values.to_vec()),
    };
    let channels = vec![
        channel("R", [0.5; 4]),
        channel("G", [0.25; 4]),
        channel("B", [1.0, 0.5, 0.25, 0.0]),
        channel("depth.Z", [1.0, 2.0, 3.0, 4.0]),
    ];
    Output::create(&path)
        .and_then(|output| output.write_channels(channels, 2, 2))
        .expect("a file");
    path
}

#[test]
fn the_layers_of_a_file_are_shown_with_their_values() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open("", "");
    let path = layered_file(folder.path());
    window.session().apply(Command::for_file(path));
    window.settle();
    assert!(window.session().layer().is_none(), "first the picture");
    window.session().apply(Command::ShowLayer(Some(0)));
    window.settle();
    let (_, layer) = window.session().layer().expect("a layer");
    assert_eq!(
        (layer.name.as_str(), layer.range()),
        ("depth", Some([1.0, 4.0]))
    );
    assert_eq!(layer.get(1, 1), [2.0]);
    // Another file starts with its picture.
    let again = layered_file(&folder.path().join("."));
    window.session().apply(Command::EndComparison);
    window.session().apply(Command::CompareWith(again));
    assert!(window.session().layer().is_none());
}

#[test]
fn false_colors_and_the_histogram_are_of_the_picture_that_is_shown() {
    let mut window = Window::open("-r 16 12 -s 1", "cornell_spheres.dae");
    assert!(window.session().histogram().is_none(), "no picture");
    window.press(Key::R);
    let first = window.session().histogram().expect("a picture");
    assert_eq!(first.pixels, 16 * 12);
    window.session().tone.exposure = -6.0;
    let darker = window.session().histogram().expect("a picture");
    assert!(darker.above_one < first.above_one);
    window.press(Key::Num6);
    assert!(window.session().false_color());
    // A and B keep their colours.
    window.press(Key::K);
    window.press(Key::Num6);
    assert!(window.session().message().contains("end the comparison"));
}
