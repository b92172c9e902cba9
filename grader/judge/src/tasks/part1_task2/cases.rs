//! Cases of camera rays.

use crate::tools::findings::Aspect::{Direction, Origin, Range, UnitLength};
use crate::tools::questions::probes::ProbeRng;
use crate::tools::spec::Spec;
use kit::{Mat3, Vec3};
use wire::kind;
use wire::work::{Camera, CameraWork};

/// The cases of `part1.task2`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        case(
            "sensor_corners",
            "A camera without rotation: sensor point (0, 0) is the bottom left corner, (1, 1) the \
             top right. Points beyond the film lie in the same plane.",
            vec![camera(Vec3::new(1.0, 2.0, 3.0), Mat3::IDENTITY, 60.0, 40.0)],
            [nine_points(), beyond_the_film()].concat(),
        ),
        case(
            "fields_of_view",
            "The fields of view are angles in degrees, h_fov across and v_fov up; half the extent \
             of the sensor is tan(fov / 2).",
            fields_of_view(),
            nine_points(),
        )
        .only(&[Direction, UnitLength]),
        case(
            "camera_to_world",
            "Rotated and rolled cameras: c2w rotates the direction to world space. Pitfall: the \
             transpose of c2w rotates the other way.",
            rotated(),
            nine_points(),
        )
        .only(&[Direction]),
        case(
            "pinhole",
            "All rays of a camera start at pos, close to the world's origin and far from it, for \
             any n_clip.",
            positions(),
            grid([3, 3]),
        )
        .only(&[Origin]),
        case(
            "clip_distances",
            "The range of the ray is n_clip to f_clip, measured along the unit direction: the \
             same in the corners as in the centre.",
            clipped(),
            nine_points(),
        )
        .only(&[Range]),
        case(
            "fresh_cameras",
            "Random cameras that depend on the seed.",
            fresh(seed),
            nine_points(),
        ),
        Spec {
            picture: Some(PICTURE),
            ..case(
                "picture_of_directions",
                "The directions of all rays of a picture, shown as colours.",
                vec![Camera {
                    h_fov: 80.0,
                    v_fov: 64.0,
                    ..placed(Vec3::new(4.0, 3.0, 5.0), Vec3::ZERO, Vec3::Y)
                }],
                grid(PICTURE),
            )
            .only(&[Direction, UnitLength])
            .mainly(&[Direction, UnitLength])
        },
        case(
            "extreme_lenses",
            "Fields of view from a millionth of a degree to 180 degrees: directions are finite \
             and have length 1, and the ray of the sensor's centre points straight ahead.",
            extreme_lenses(),
            nine_points(),
        )
        .only(&[Direction, UnitLength]),
    ]
}

/// Width and height of the picture.
const PICTURE: [u32; 2] = [128, 96];

fn case(
    name: &'static str,
    about: &'static str,
    cameras: Vec<Camera>,
    sensor: Vec<[f64; 2]>,
) -> Spec {
    Spec::new::<kind::CameraRays>("part1.task2", name, about, CameraWork { cameras, sensor })
}

fn camera(pos: Vec3, c2w: Mat3, h_fov: f64, v_fov: f64) -> Camera {
    Camera {
        pos: pos.into(),
        c2w: [c2w.x_axis, c2w.y_axis, c2w.z_axis].map(Vec3::into),
        h_fov,
        v_fov,
        n_clip: 0.0,
        f_clip: f64::INFINITY,
    }
}

fn placed(pos: Vec3, target: Vec3, up: Vec3) -> Camera {
    let c2w = kit::Camera::look_at(pos, target, up).expect("no case looks along its up direction");
    camera(pos, c2w, 50.0, 35.0)
}

/// The corners, the middles of the edges and the centre.
fn nine_points() -> Vec<[f64; 2]> {
    let ends = [0.0, 0.5, 1.0];
    let mut points: Vec<[f64; 2]> = ends.iter().flat_map(|v| ends.map(|u| [u, *v])).collect();
    // Points on no axis of symmetry.
    points.extend([[0.2, 0.9], [0.7, 0.3], [0.05, 0.15]]);
    points
}

/// Points on each side of the film and at one of its corners, outside.
fn beyond_the_film() -> Vec<[f64; 2]> {
    vec![
        [1.25, 0.3],
        [-0.75, 0.6],
        [0.2, 1.5],
        [0.9, -0.125],
        [1.5, -0.5],
    ]
}

/// The centres of the pixels of a film, row by row from the bottom left.
fn grid([w, h]: [u32; 2]) -> Vec<[f64; 2]> {
    let center = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
    (0..h)
        .flat_map(|y| (0..w).map(move |x| [center(x, w), center(y, h)]))
        .collect()
}

fn fields_of_view() -> Vec<Camera> {
    let fovs = [
        (20.0, 90.0),
        (90.0, 20.0),
        (50.0, 35.0),
        (120.0, 100.0),
        (1.0, 2.0),
        (90.0, 90.0),
    ];
    fovs.map(|(h_fov, v_fov)| camera(Vec3::ZERO, Mat3::IDENTITY, h_fov, v_fov))
        .to_vec()
}

fn rotated() -> Vec<Camera> {
    let [up, tilted] = [Vec3::Y, Vec3::new(0.6, 0.8, 0.1)];
    vec![
        placed(Vec3::new(3.0, 0.0, 0.0), Vec3::ZERO, up),
        placed(Vec3::new(1.0, 2.0, -3.0), Vec3::new(0.0, 1.0, 0.0), up),
        placed(Vec3::new(-4.0, 3.0, 2.0), Vec3::new(1.0, 0.0, 0.5), tilted),
        placed(Vec3::new(0.5, -6.0, 1.0), Vec3::new(0.0, 0.0, 2.0), tilted),
    ]
}

fn positions() -> Vec<Camera> {
    let places = [
        Vec3::ZERO,
        Vec3::new(0.25, -7.5, 12.0),
        Vec3::new(-300.0, 20.0, 4000.0),
        Vec3::new(1e6, -2e6, 3e6),
    ];
    let at = |pos| Camera {
        n_clip: 0.5,
        ..placed(pos, pos + Vec3::new(1.0, -0.5, -2.0), Vec3::Y)
    };
    places.map(at).to_vec()
}

fn clipped() -> Vec<Camera> {
    let ranges = [(0.1, 100.0), (5.0, 6.0), (1e-3, 1e9), (2.0, f64::INFINITY)];
    let with_range = |(n_clip, f_clip)| Camera {
        n_clip,
        f_clip,
        ..placed(Vec3::new(1.0, 1.0, 4.0), Vec3::ZERO, Vec3::Y)
    };
    ranges.map(with_range).to_vec()
}

fn fresh(seed: u64) -> Vec<Camera> {
    let mut rng = ProbeRng::new("fresh_cameras", seed);
    let mut one = || {
        let pos = 10.0 * rng.in_cube();
        let backward = rng.direction();
        let up = loop {
            let up = rng.direction();
            if up.cross(backward).length() > 0.3 {
                break up;
            }
        };
        let n_clip = rng.range(0.0, 1.0);
        Camera {
            h_fov: rng.range(5.0, 140.0),
            v_fov: rng.range(5.0, 140.0),
            n_clip,
            f_clip: n_clip + rng.range(1.0, 1e3),
            ..placed(pos, pos - backward, up)
        }
    };
    (0..20).map(|_| one()).collect()
}

fn extreme_lenses() -> Vec<Camera> {
    let fovs = [
        (1e-6, 1e-6),
        (1e-3, 60.0),
        (170.0, 10.0),
        (179.0, 179.0),
        (179.99, 90.0),
        (179.999_999, 45.0),
        (180.0, 180.0),
    ];
    fovs.map(|(h_fov, v_fov)| camera(Vec3::ZERO, Mat3::IDENTITY, h_fov, v_fov))
        .to_vec()
}
