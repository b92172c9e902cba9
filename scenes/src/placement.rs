//! Where to look from, and how a camera's frame fits a film.
//!
//! A camera carries the frame that its file asks for: the angles `h_fov` and `v_fov`. Films of another shape
//! show at least that frame, the same in the middle and more at two sides ([`for_film`]).
//!
//! The original course program widens the frame in the same way, but always for its first window of 800x600
//! pixels; then it keeps the length `screenDist` (focal length in pixels) when the window gets its size from
//! `-r`. So its pictures of 480x360 show the middle 60 % of the frame: `xfov` 49.13 in the file is
//! `hFov = 2 atan(480/800 · tan(49.13°/2)) = 30.68` in the camera files it wrote. Also it takes only the
//! direction from the file's camera and always frames the scene ([`frame`]). Here a picture shows what the
//! file's camera frames, at any size, unless that is half empty ([`is_edge_on`]): the boxes of the course were made
//! for a program that frames them, with cameras that stand in the plane of their floor.

use kit::camera::{half_tan, scale_fov};
use kit::{Camera, FilmSize, Mat3, Scene, Vec3};

/// Farthest distance of a camera that clips nothing.
pub const FAR_AWAY: f64 = 1e30;

/// Angles of view of a camera that no file describes, in degrees: the original's.
const DEFAULT_H_FOV: f64 = 50.0;
/// See [`DEFAULT_H_FOV`].
const DEFAULT_V_FOV: f64 = 35.0;

/// Distance from which a scene is framed, in diagonals of its box.
const FRAMING_DISTANCE: f64 = 1.5;

/// How near a face of the box a camera is in its plane, as a share of the diagonal, and how small the slope is along it: what
/// exporters round.
const EDGE_ON: f64 = 1e-6;

/// How much the shape of a film may differ from the camera's, relatively, and still count as the same:
/// angles in files are rounded.
const SAME_SHAPE: f64 = 1e-9;

/// A camera and the point it looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The camera, with angles that fit the film.
    pub camera: Camera,
    /// The point on the camera's axis that it turns about, in world space.
    pub target: Vec3,
}

/// The default view of a scene on a film: the file's camera; if that sees the scene edge-on, the scene is framed from its
/// direction, and without a camera from +z.
pub fn place(scene: &Scene, film: FilmSize) -> View {
    match &scene.camera {
        Some(camera) if is_edge_on(scene) => frame(scene, camera.c2w.z_axis, film),
        Some(camera) => View {
            camera: for_film(camera, film),
            target: target_of(camera, scene),
        },
        None => frame(scene, Vec3::Z, film),
    }
}

/// Whether the file has a camera in the plane of a face of the scene's box that looks along it: half of its picture is
/// empty, whatever is in the box.
pub fn is_edge_on(scene: &Scene) -> bool {
    let bounds = scene.bounds();
    let Some(camera) = scene.camera.filter(|_| !bounds.is_empty()) else {
        return false;
    };
    let near = EDGE_ON * bounds.extent().length();
    (0..3).any(|axis| {
        let off = |face: Vec3| (camera.pos[axis] - face[axis]).abs();
        let along = camera.c2w.z_axis[axis].abs() <= EDGE_ON;
        along && off(bounds.min).min(off(bounds.max)) <= near
    })
}

/// Looks at the middle of the scene's box from `direction` (not zero; y is up) at 1.5 times the length of
/// the box's diagonal. Angles and clip distances are the file camera's if there is one.
pub fn frame(scene: &Scene, direction: Vec3, film: FilmSize) -> View {
    let bounds = scene.bounds();
    let (target, diagonal) = match bounds.is_empty() {
        true => (Vec3::ZERO, 0.0),
        false => (bounds.centroid(), bounds.extent().length()),
    };
    // A single point is looked at from a unit away.
    let distance = if diagonal > 0.0 {
        FRAMING_DISTANCE * diagonal
    } else {
        1.0
    };
    let backward = direction.normalize_or(Vec3::Z);
    let c2w = Camera::look_at(backward, Vec3::ZERO, Vec3::Y)
        // Straight from above or below: the film's up is -z.
        .or_else(|_| Camera::look_at(backward, Vec3::ZERO, Vec3::NEG_Z))
        .unwrap_or(Mat3::IDENTITY);
    let optics = scene.camera.unwrap_or(Camera {
        pos: Vec3::ZERO,
        c2w,
        h_fov: DEFAULT_H_FOV,
        v_fov: DEFAULT_V_FOV,
        n_clip: 0.0,
        f_clip: FAR_AWAY,
    });
    let camera = Camera {
        pos: target + distance * backward,
        c2w,
        ..optics
    };
    View {
        camera: for_film(&camera, film),
        target,
    }
}

/// The camera with its smaller angle widened so that `tan(h_fov/2) / tan(v_fov/2) = w / h`. Everything
/// in the camera's frame stays in the picture. A camera of the film's shape is given back as it is.
pub fn for_film(camera: &Camera, film: FilmSize) -> Camera {
    let aspect = f64::from(film.w) / f64::from(film.h);
    let frame_aspect = half_tan(camera.h_fov) / half_tan(camera.v_fov);
    let mut fitted = *camera;
    if frame_aspect < aspect * (1.0 - SAME_SHAPE) {
        fitted.h_fov = scale_fov(camera.v_fov, aspect);
    } else if frame_aspect > aspect * (1.0 + SAME_SHAPE) {
        fitted.v_fov = scale_fov(camera.h_fov, 1.0 / aspect);
    }
    fitted
}

/// The point on the camera's axis nearest to the middle of the scene; if that lies behind the camera, the
/// point a diagonal ahead.
fn target_of(camera: &Camera, scene: &Scene) -> Vec3 {
    let bounds = scene.bounds();
    let forward = -camera.c2w.z_axis;
    let ahead = forward.dot(bounds.centroid() - camera.pos);
    let diagonal = bounds.extent().length();
    let distance = if ahead > 0.0 && ahead.is_finite() {
        ahead
    } else if diagonal > 0.0 && diagonal.is_finite() {
        diagonal
    } else {
        1.0
    };
    camera.pos + distance * forward
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{Sphere, Triangle};

    const FILM: FilmSize = FilmSize { w: 400, h: 300 };

    fn scene(triangles: Vec<Triangle>, spheres: Vec<Sphere>) -> Scene {
        Scene {
            triangles,
            spheres,
            ..Scene::default()
        }
    }

    fn ball(center: Vec3, radius: f64) -> Scene {
        scene(Vec::new(), vec![Sphere { center, radius }])
    }

    /// A ball of radius 1 whose file has a camera 5 away at this height, looking at its axis with this slope.
    fn ball_seen_from(height: f64, slope: f64) -> Scene {
        let c2w = Camera::look_at(Vec3::new(0.0, slope, 1.0), Vec3::ZERO, Vec3::Y).unwrap();
        Scene {
            camera: Some(Camera {
                pos: Vec3::new(0.0, height, 5.0),
                c2w,
                h_fov: 40.0,
                v_fov: 30.0,
                n_clip: 0.0,
                f_clip: FAR_AWAY,
            }),
            ..ball(Vec3::ZERO, 1.0)
        }
    }

    #[test]
    fn a_camera_in_the_plane_of_the_floor_frames_the_scene() {
        for (height, slope, edge_on) in [
            (-1.0, 0.0, true),
            (1.0 + 1e-9, 0.0, true),
            (-1.0, 0.01, false),
            (-0.99, 0.0, false),
            (0.0, 0.0, false),
            (-3.0, 0.0, false),
        ] {
            let scene = ball_seen_from(height, slope);
            assert_eq!(is_edge_on(&scene), edge_on, "{height} {slope}");
            let pos = place(&scene, FILM).camera.pos;
            let distance = FRAMING_DISTANCE * 12.0_f64.sqrt();
            let framed = (pos - Vec3::new(0.0, 0.0, distance)).length() < 1e-12;
            assert_eq!(framed, edge_on, "{pos}");
        }
        assert!(!is_edge_on(&ball(Vec3::ZERO, 1.0)));
    }

    fn aspect(camera: &Camera) -> f64 {
        half_tan(camera.h_fov) / half_tan(camera.v_fov)
    }

    #[test]
    fn a_scene_without_camera_is_framed_from_plus_z() {
        let center = Vec3::new(1.0, 2.0, 3.0);
        let view = place(&ball(center, 1.0), FILM);
        assert_eq!(view.target, center);
        let distance = 1.5 * 12.0_f64.sqrt();
        assert!((view.camera.pos - center).distance(Vec3::new(0.0, 0.0, distance)) < 1e-12);
        assert!((aspect(&view.camera) - 4.0 / 3.0).abs() < 1e-12);
    }

    #[test]
    fn framing_a_point_or_nothing_stands_a_unit_away() {
        let point = place(&ball(Vec3::ONE, 0.0), FILM);
        assert_eq!(
            (point.target, point.camera.pos),
            (Vec3::ONE, Vec3::ONE + Vec3::Z)
        );
        let nothing = place(&Scene::default(), FILM);
        assert_eq!((nothing.target, nothing.camera.pos), (Vec3::ZERO, Vec3::Z));
    }

    #[test]
    fn framing_from_straight_above_has_a_finite_up() {
        for direction in [Vec3::Y, Vec3::NEG_Y] {
            let camera = frame(&ball(Vec3::ZERO, 1.0), direction, FILM).camera;
            assert!(camera.c2w.is_finite());
            assert_eq!(camera.c2w.z_axis, direction);
        }
    }

    /// A camera that sees 60 by 40 degrees.
    fn camera() -> Camera {
        Camera {
            pos: Vec3::new(0.0, 0.0, 9.0),
            c2w: Mat3::IDENTITY,
            h_fov: 60.0,
            v_fov: 40.0,
            n_clip: 0.1,
            f_clip: 100.0,
        }
    }

    #[test]
    fn a_film_of_another_shape_sees_all_of_the_frame() {
        let wide = for_film(&camera(), FilmSize { w: 800, h: 200 });
        assert_eq!(wide.v_fov, 40.0);
        assert!(wide.h_fov > 60.0 && (aspect(&wide) - 4.0).abs() < 1e-12);
        let high = for_film(&camera(), FilmSize { w: 200, h: 800 });
        assert_eq!(high.h_fov, 60.0);
        assert!(high.v_fov > 40.0 && (aspect(&high) - 0.25).abs() < 1e-12);
    }

    #[test]
    fn a_film_of_the_same_shape_changes_no_bit() {
        let fitted = for_film(&camera(), FILM);
        assert_eq!(for_film(&fitted, FilmSize { w: 1600, h: 1200 }), fitted);
    }

    #[test]
    fn the_target_lies_on_the_axis_beside_the_middle_of_the_scene() {
        let looking = |center: Vec3| {
            let scene = Scene {
                camera: Some(camera()),
                ..ball(center, 0.5)
            };
            place(&scene, FILM).target
        };
        assert_eq!(
            looking(Vec3::new(3.0, 1.0, -2.0)),
            Vec3::new(0.0, 0.0, -2.0)
        );
        // Behind the camera: a diagonal of the box ahead.
        assert!(
            looking(Vec3::new(0.0, 0.0, 20.0)).distance(Vec3::new(0.0, 0.0, 9.0 - 3.0_f64.sqrt()))
                < 1e-12
        );
    }
}
