//! Prints what can be measured of scene files: one line each, for `tests/real/compare.py`.
//!
//! The columns, separated by tabs: the file; `read` or `refused`; the number of warnings;
//! triangles; spheres; the area and the signed volume of the triangles; their bounding box, 6
//! numbers; lights; cameras; for each material with a surface its name, `=` and its area. Of a
//! file that is refused: the reason.

use kit::Vec3;
use scenes::Loaded;

fn main() {
    for file in std::env::args().skip(1) {
        match scenes::load(&file) {
            Ok(loaded) => println!("{file}\tread\t{}", measured(&loaded)),
            Err(error) => println!("{file}\trefused\t{}", error.0.title()),
        }
    }
}

fn measured(loaded: &Loaded) -> String {
    let scene = &loaded.scene;
    let (mut area, mut volume) = (0.0, 0.0);
    let (mut min, mut max) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let mut areas = vec![0.0; scene.materials.len()];
    for (triangle, &object) in scene.triangles.iter().zip(&scene.object_of) {
        let (e1, e2) = (triangle.p1 - triangle.p0, triangle.p2 - triangle.p0);
        let own = e1.cross(e2).length() / 2.0;
        area += own;
        areas[scene.objects[object as usize].material as usize] += own;
        volume += triangle.p0.dot(triangle.p1.cross(triangle.p2)) / 6.0;
        for p in [triangle.p0, triangle.p1, triangle.p2] {
            (min, max) = (min.min(p), max.max(p));
        }
    }
    let lights = if loaded.added_light {
        0
    } else {
        scene.lights.len()
    };
    let mut columns = vec![
        loaded.warnings.len().to_string(),
        scene.triangles.len().to_string(),
        scene.spheres.len().to_string(),
        format!("{area:e}"),
        format!("{volume:e}"),
    ];
    let bounds = [min.to_array(), max.to_array()];
    columns.extend(bounds.as_flattened().iter().map(|x| format!("{x:e}")));
    columns.push(lights.to_string());
    columns.push(u32::from(scene.camera.is_some()).to_string());
    for (material, area) in scene.materials.iter().zip(areas) {
        if area > 0.0 {
            columns.push(format!("{}={area:e}", material.name));
        }
    }
    columns.join("\t")
}
