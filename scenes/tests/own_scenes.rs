//! The scenes of this course, in `scenes/dae`.

use kit::{Light, Material, Scene, Triangle, Vec3};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("dae")
}

fn load(name: &str) -> Scene {
    let loaded =
        scenes::load(folder().join(name).with_extension("dae")).unwrap_or_else(|e| panic!("{e}"));
    let warnings: String = loaded.warnings.iter().map(|w| format!("{w}\n")).collect();
    assert_eq!(warnings, "", "{name}");
    loaded.scene
}

/// File name and the numbers of triangles, spheres, lights, materials.
const EXPECTED: [(&str, [usize; 4]); 13] = [
    ("cornell_mirror_glass", [12, 2, 1, 6]),
    ("cornell_spheres", [12, 2, 1, 6]),
    ("cornell_whale", [162, 0, 1, 6]),
    ("dusk", [60, 6, 0, 6]),
    ("gallery", [24, 1, 0, 10]),
    ("gems", [260, 0, 2, 8]),
    ("integer_terrain", [128, 0, 2, 1]),
    ("materials", [2, 41, 3, 13]),
    ("sphereflake", [2, 825, 3, 7]),
    ("spheres", [0, 22, 2, 9]),
    ("stairs_sky", [240, 2, 1, 4]),
    ("stones_sun", [278, 0, 1, 2]),
    ("window_room", [408, 6, 2, 11]),
];

#[test]
fn every_scene_loads_without_a_warning() {
    for (name, expected) in EXPECTED {
        let scene = load(name);
        let found = [
            scene.triangles.len(),
            scene.spheres.len(),
            scene.lights.len(),
            scene.materials.len(),
        ];
        assert_eq!(found, expected, "{name}");
        assert!(scene.camera.is_some(), "{name} has no camera");
    }
}

#[test]
fn all_scenes_are_listed() {
    let files = std::fs::read_dir(folder()).unwrap();
    let found: BTreeSet<String> = files
        .map(|file| file.unwrap().path())
        .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    assert_eq!(
        found,
        EXPECTED
            .iter()
            .map(|(name, _)| (*name).to_owned())
            .collect()
    );
}

/// Whether the vertex normals of a triangle are on the side of its geometric normal.
fn normals_agree(t: &Triangle) -> bool {
    let ng = (t.p1 - t.p0).cross(t.p2 - t.p0);
    [t.n0, t.n1, t.n2].iter().all(|n| n.dot(ng) > 0.0)
}

#[test]
fn normals_agree_with_the_winding_also_in_mirrored_nodes() {
    for (name, _) in EXPECTED {
        assert!(load(name).triangles.iter().all(normals_agree), "{name}");
    }
}

#[test]
fn textures_of_the_gallery_exist() {
    let textures = load("gallery").textures;
    assert_eq!(textures.files.len(), 4);
    for file in &textures.files {
        assert!(folder().join(file).is_file(), "{file} is missing");
    }
}

#[test]
fn whale_is_symmetric() {
    let scene = load("cornell_whale");
    let half = |name: &str| -> Vec<&Triangle> {
        let is_half = |i: &usize| scene.objects[scene.object_of[*i] as usize].name == name;
        (0..scene.triangles.len())
            .filter(is_half)
            .map(|i| &scene.triangles[i])
            .collect()
    };
    let (left, right) = (half("left-half"), half("right-half"));
    assert_eq!((left.len(), right.len()), (75, 75));
    let area = |half: &[&Triangle]| -> f64 {
        half.iter()
            .map(|t| (t.p1 - t.p0).cross(t.p2 - t.p0).length())
            .sum()
    };
    assert!((area(&left) - area(&right)).abs() < 1e-12);
}

/// So the rays of the camera, which is above an integer, meet edges and diagonals exactly.
#[test]
fn the_terrain_has_integer_coordinates() {
    let scene = load("integer_terrain");
    let mut corners = scene.triangles.iter().flat_map(|t| [t.p0, t.p1, t.p2]);
    assert!(corners.all(|p| p.fract() == Vec3::ZERO));
    let camera = scene.camera.expect("a camera");
    assert_eq!(camera.pos, Vec3::new(0.0, 24.0, 0.0));
    let axes = [camera.c2w.x_axis, camera.c2w.y_axis, camera.c2w.z_axis];
    assert!(axes.iter().all(|axis| axis.abs().element_sum() == 1.0));
}

#[test]
fn gems_are_closed_with_outward_normals() {
    let scene = load("gems");
    for (index, object) in scene.objects.iter().enumerate() {
        if !matches!(
            scene.materials[object.material as usize].material,
            Material::Glass { .. } | Material::Refraction { .. }
        ) {
            continue;
        }
        let facets: Vec<&Triangle> = (0..scene.triangles.len())
            .filter(|i| scene.object_of[*i] as usize == index)
            .map(|i| &scene.triangles[i])
            .collect();
        // For a closed surface the area vectors cancel, and its volume is positive if the normals
        // point outwards.
        let open: Vec3 = facets
            .iter()
            .map(|t| (t.p1 - t.p0).cross(t.p2 - t.p0))
            .sum();
        let middle = facets[0].p0;
        let volume: f64 = facets
            .iter()
            .map(|t| (t.p0 - middle).dot((t.p1 - middle).cross(t.p2 - middle)))
            .sum();
        assert!(open.length() < 1e-12, "{} is not closed", object.name);
        assert!(volume > 0.0, "{} has inward normals", object.name);
    }
}

#[test]
fn lights_of_the_cornell_boxes_face_down_from_their_panel() {
    for name in ["cornell_spheres", "cornell_mirror_glass", "cornell_whale"] {
        let scene = load(name);
        let Light::Area {
            center,
            edge_x,
            edge_y,
            direction,
            ..
        } = scene.lights[0].light
        else {
            panic!("{name}: {:?}", scene.lights[0]);
        };
        let near = |a: Vec3, b: Vec3| a.distance(b) < 1e-12;
        assert!(near(center, Vec3::new(0.0, 1.49, 0.0)), "{name}");
        assert!(near(direction, Vec3::NEG_Y), "{name}");
        assert!(
            near(edge_x.abs(), 0.8 * Vec3::X) && near(edge_y.abs(), 0.6 * Vec3::Z),
            "{name}"
        );
    }
}

#[test]
fn sun_is_above_and_sky_is_a_hemisphere() {
    let Light::Directional { direction, .. } = load("stones_sun").lights[0].light else {
        panic!("expected a directional light");
    };
    assert!(direction.y < 0.0);
    assert!(matches!(
        load("stairs_sky").lights[0].light,
        Light::Hemisphere { .. }
    ));
}

#[test]
fn steps_of_the_stairs_have_equal_angles() {
    let scene = load("stairs_sky");
    let steps: Vec<Vec3> = (0..scene.objects.len())
        .filter(|i| scene.objects[*i].name.starts_with("step-"))
        .map(|object| {
            let first = scene
                .object_of
                .iter()
                .position(|o| *o as usize == object)
                .unwrap();
            scene.triangles[first].p0
        })
        .collect();
    assert_eq!(steps.len(), 18);
    for pair in steps.windows(2) {
        assert!((pair[1].y - pair[0].y - 0.155).abs() < 1e-12);
        assert!(
            (pair[1]
                .with_y(0.0)
                .angle_between(pair[0].with_y(0.0))
                .to_degrees()
                - 24.0)
                .abs()
                < 1e-9
        );
    }
}
