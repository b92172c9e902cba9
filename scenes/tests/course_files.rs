//! The scenes of the original course, where they are at hand: set `FIRSTLIGHT_SCENES` to their folder.

use std::path::PathBuf;

fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("FIRSTLIGHT_SCENES").map(PathBuf::from);
    if folder.is_none() {
        println!("skipped: set FIRSTLIGHT_SCENES to the folder with the course's .dae files");
    }
    folder
}

/// File, triangles, spheres, lights, materials, objects, warnings.
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
