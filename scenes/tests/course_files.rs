//! The scenes of the original course, if they are available: set `FIRSTLIGHT_SCENES` to their
//! folder.

use kit::FilmSize;
use scenes::{CameraFile, placement};
use std::path::PathBuf;

fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("FIRSTLIGHT_SCENES").map(PathBuf::from);
    if folder.is_none() {
        println!("skipped: set FIRSTLIGHT_SCENES to the folder with the course's .dae files");
    }
    folder
}

/// File name and the numbers of triangles, spheres, lights, materials, objects, warnings.
const EXPECTED: [(&str, [usize; 6]); 11] = [
    ("CBbunny", [28588, 0, 1, 7, 7, 0]),
    ("CBempty", [12, 0, 1, 6, 6, 0]),
    ("CBspheres", [12, 2, 1, 8, 8, 0]),
    ("CBspheres_cmu462", [12, 2, 1, 8, 8, 0]),
    ("CBspheres_lambertian", [12, 2, 1, 8, 8, 0]),
    ("banana", [2458, 0, 2, 3, 3, 1]),
    ("cow", [5856, 0, 1, 1, 1, 0]),
    ("maxplanck", [50801, 0, 1, 1, 1, 0]),
    ("sphere7_glass", [0, 7, 2, 1, 7, 0]),
    ("teapot", [2464, 0, 1, 1, 1, 0]),
    ("trigs5", [5, 0, 1, 5, 5, 0]),
];

#[test]
fn every_course_file_loads() {
    let Some(folder) = folder() else { return };
    for (name, expected) in EXPECTED {
        let loaded =
            scenes::load(folder.join(name).with_extension("dae")).unwrap_or_else(|e| panic!("{e}"));
        let scene = &loaded.scene;
        let found = [
            scene.triangles.len(),
            scene.spheres.len(),
            scene.lights.len(),
            scene.materials.len(),
            scene.objects.len(),
            loaded.warnings.len(),
        ];
        let warnings: String = loaded.warnings.iter().map(|w| format!("{w}\n")).collect();
        assert_eq!(found, expected, "{name}\n{warnings}");
        assert_eq!(scene.object_of.len(), scene.len(), "{name}");
        assert!(scene.camera.is_some(), "{name}");
    }
}

#[test]
fn every_file_in_the_folder_loads() {
    let Some(folder) = folder() else { return };
    for file in std::fs::read_dir(folder).expect("a folder") {
        let path = file.expect("an entry").path();
        if path.extension().is_some_and(|ending| ending == "dae") {
            scenes::load(&path).unwrap_or_else(|e| panic!("{e}"));
        }
    }
}

/// The direction from which the original program frames a scene: the point one unit in front of the
/// file's camera, used as a direction from the origin.
fn original_direction(camera: &kit::Camera, matrix_scale: f64) -> kit::Vec3 {
    camera.pos - matrix_scale * camera.c2w.z_axis
}

/// Tolerance for the original's cameras. It stores numbers as `float`, which have about 7 digits.
const FLOAT_TOLERANCE: f64 = 3e-7;

#[test]
fn framing_gives_the_cameras_of_the_original() {
    let Some(folder) = folder() else { return };
    let Some(reference) = folder.parent().map(|parent| parent.join("reference")) else {
        return;
    };
    let mut compared = 0;
    for (name, _) in EXPECTED {
        let path = reference.join(format!("{name}.cam.txt"));
        if !path.exists() {
            continue;
        }
        let file = CameraFile::load(path).unwrap_or_else(|e| panic!("{e}"));
        let scene = scenes::load(folder.join(name).with_extension("dae"))
            .unwrap()
            .scene;
        let camera = scene.camera.unwrap();
        // The camera's matrix in these files has a scale of 0.38.
        let scale = if ["cow", "maxplanck", "teapot"].contains(&name) {
            0.3801742
        } else {
            1.0
        };

        // The original fits the frame to its first window, then resizes it to -r with the same
        // focal length.
        let direction = original_direction(&camera, scale);
        let view = placement::frame(&scene, direction, FilmSize { w: 800, h: 600 });
        let cut = |fov: f64, share: f64| {
            2.0 * libm::atan(share * libm::tan(fov.to_radians() / 2.0)).to_degrees()
        };
        let expected = &file.view.camera;
        let near = |a: f64, b: f64, what: &str| {
            assert!(
                (a - b).abs() <= FLOAT_TOLERANCE * b.abs().max(1.0),
                "{name}: {what} {a} {b}"
            )
        };
        near(
            cut(view.camera.h_fov, 480.0 / 800.0),
            expected.h_fov,
            "hFov",
        );
        near(
            cut(view.camera.v_fov, 360.0 / 600.0),
            expected.v_fov,
            "vFov",
        );
        near(view.camera.n_clip, expected.n_clip, "nClip");
        near(view.camera.f_clip, expected.f_clip, "fClip");
        near(view.target.distance(file.view.target), 0.0, "target");
        near(view.camera.pos.distance(expected.pos), 0.0, "pos");
        for i in 0..3 {
            near(
                view.camera.c2w.col(i).distance(expected.c2w.col(i)),
                0.0,
                "c2w",
            );
        }
        compared += 1;
    }
    println!("compared {compared} cameras");
}

#[test]
fn camera_files_of_the_original_are_written_unchanged() {
    let Some(folder) = folder() else { return };
    let Some(reference) = folder.parent().map(|parent| parent.join("reference")) else {
        return;
    };
    let Ok(files) = std::fs::read_dir(reference) else {
        return;
    };
    for path in files.map(|entry| entry.unwrap().path()) {
        if path.extension().is_none_or(|ending| ending != "txt") {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let written = CameraFile::parse("original", &text).unwrap().to_string();
        let numbers = |text: &str| -> Vec<f64> {
            text.split_whitespace()
                .map(|w| w.parse().unwrap())
                .collect()
        };
        for (was, is) in numbers(&text).into_iter().zip(numbers(&written)) {
            // Numbers that follow from others are computed again, so their last digits differ.
            assert!(
                (was - is).abs() <= 1e-12 * was.abs().max(1.0),
                "{}: {was} {is}",
                path.display()
            );
        }
    }
}
