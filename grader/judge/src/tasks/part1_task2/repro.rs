//! Rust tests of camera rays.

use super::truth::direction;
use crate::tools::repro::numbers::{float, vec3};
use std::fmt::Write;
use wire::work::Camera;

pub(crate) fn ray(camera: &Camera, [x, y]: [f64; 2]) -> String {
    let mut text = String::from("use kit::{Camera, Mat3, Vec2, Vec3};\n");
    let _ = writeln!(
        text,
        "let camera = Camera {{\n    pos: {},",
        vec3(camera.pos)
    );
    let columns = camera.c2w.map(vec3).join(", ");
    let _ = writeln!(text, "    c2w: Mat3::from_cols({columns}),");
    let _ = writeln!(
        text,
        "    h_fov: {},\n    v_fov: {},",
        float(camera.h_fov),
        float(camera.v_fov)
    );
    let _ = writeln!(
        text,
        "    n_clip: {},\n    f_clip: {},\n}};",
        float(camera.n_clip),
        float(camera.f_clip)
    );
    let _ = writeln!(
        text,
        "let ray = raygen::generate_ray(&camera, Vec2::new({}, {}));",
        float(x),
        float(y)
    );
    let _ = writeln!(text, "assert_eq!(ray.o, camera.pos);");
    let d = vec3(direction(camera, [x, y]).into());
    let _ = writeln!(
        text,
        "assert!((ray.d - {d}).abs().max_element() <= 1e-9, \"d = {{}}\", ray.d);"
    );
    let _ = writeln!(
        text,
        "assert!((ray.d.length() - 1.0).abs() <= 1e-12, \"d has length {{}}\", ray.d.length());"
    );
    let _ = writeln!(
        text,
        "assert_eq!((ray.min_t, ray.max_t), (camera.n_clip, camera.f_clip));"
    );
    text
}
