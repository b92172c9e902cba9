//! Simple cameras: at the origin, with a field of view of 90 degrees, looking along an axis.

use wire::work::{Camera, CameraWork, Xyz};

const X: Xyz = [1.0, 0.0, 0.0];
const Y: Xyz = [0.0, 1.0, 0.0];
const Z: Xyz = [0.0, 0.0, 1.0];

/// The simple questions about cameras.
pub(crate) fn questions() -> Vec<CameraWork> {
    let plain = Camera {
        pos: [0.0; 3],
        c2w: [X, Y, Z],
        h_fov: 90.0,
        v_fov: 90.0,
        n_clip: 1.0,
        f_clip: 10.0,
    };
    let moved = Camera {
        pos: [1.0, 2.0, 3.0],
        ..plain
    };
    let wide = Camera {
        v_fov: 60.0,
        ..plain
    };
    let narrow = Camera {
        h_fov: 60.0,
        v_fov: 60.0,
        ..plain
    };
    // Looking along +x, and along -z with the right side up.
    let turned = Camera {
        c2w: [Z, Y, X.map(|x| -x)],
        ..plain
    };
    let rolled = Camera {
        c2w: [Y, X.map(|x| -x), Z],
        ..plain
    };
    let question = |camera| CameraWork {
        cameras: vec![camera],
        sensor: SENSOR.to_vec(),
    };
    [plain, moved, turned, rolled, wide, narrow]
        .map(question)
        .to_vec()
}

/// Points of the sensor: the centre, the middles of two sides, the corners, beyond the film.
const SENSOR: [[f64; 2]; 9] = [
    [0.5, 0.5],
    [1.0, 0.5],
    [0.5, 1.0],
    [1.0, 1.0],
    [0.0, 0.0],
    [0.0, 1.0],
    [1.0, 0.0],
    [1.5, 0.5],
    [0.5, 1.5],
];
