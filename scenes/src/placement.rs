//! The default view of a scene, and the angles of view for a film.
//!
//! A camera has the angles `h_fov` and `v_fov` of its file. They define a frame. A film of another
//! aspect ratio shows at least this frame, and more at two sides ([`for_film`]).
//!
//! The original course program extends the frame in the same way, but always for its first window
//! of 800x600 pixels. Then it keeps `screenDist` (the focal length in pixels) when the window is
//! resized to `-r`. So its images of 480x360 pixels show the central 60 % of the frame: for `xfov`
//! 49.13 in the scene file, its camera files have `hFov = 2 atan(480/800 · tan(49.13°/2)) = 30.68`.
//! It also uses only the direction of the file's camera and always frames the scene ([`frame`]).
//! Here an image shows the frame of the file's camera at any size, unless this camera sees the
//! scene edge-on ([`is_edge_on`]). The course's box scenes have such cameras, in the plane of the
//! floor, because they were made for the original program.

use kit::camera::{half_tan, scale_fov};
use kit::{Camera, FilmSize, Mat3, Scene, Vec3};

/// Far clip distance of a camera that clips nothing.
pub const FAR_AWAY: f64 = 1e30;

/// Horizontal angle of view in degrees if there is no camera: the original's.
const DEFAULT_H_FOV: f64 = 50.0;
/// Vertical angle of view in degrees if there is no camera: the original's.
const DEFAULT_V_FOV: f64 = 35.0;

/// Distance from which a scene is framed, relative to the diagonal of its bounding box.
const FRAMING_DISTANCE: f64 = 1.5;

/// Tolerance for [`is_edge_on`]: of the distance to the plane of a face, relative to the diagonal,
/// and of the slope to it. It allows for rounding by exporters.
const EDGE_ON_TOLERANCE: f64 = 1e-6;

/// Relative tolerance for a film to have the aspect ratio of the camera. It allows for rounded
/// angles in files.
const ASPECT_TOLERANCE: f64 = 1e-9;

/// A camera and its target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The camera, with angles of view that fit the film.
    pub camera: Camera,
    /// The point on the camera's axis that an interactive camera orbits, in world space.
    pub target: Vec3,
}

/// The default view of a scene on a film.
///
/// This is the camera of the file. If that sees the scene edge-on, the scene is framed from its
/// direction; without a camera, it is framed from +z, or where that shows a flat scene edge-on from
/// +x or +y.
pub fn place(scene: &Scene, film: FilmSize) -> View {
    match &scene.camera {
        Some(camera) if is_edge_on(scene) => frame(scene, camera.c2w.z_axis, film),
        Some(camera) => View {
            camera: for_film(camera, film),
            target: target_of(camera, scene),
        },
        None => frame(scene, framing_direction(scene), film),
    }
}

/// The direction from which a scene without a camera is framed.
fn framing_direction(scene: &Scene) -> Vec3 {
    let extent = scene.bounds().extent();
    let is_flat = |axis: usize| extent[axis] <= EDGE_ON_TOLERANCE * extent.length();
    match [is_flat(0), is_flat(1)] {
        [true, false] => Vec3::X,
        [false, true] => Vec3::Y,
        _ => Vec3::Z,
    }
}

/// Whether the camera of the file lies in the plane of a face of the scene's bounding box and looks
/// along this plane. Half of its image would then be empty, whatever the scene.
pub fn is_edge_on(scene: &Scene) -> bool {
    let Some(camera) = scene.camera else {
        return false;
    };
    let looks_along = |axis: &usize| camera.c2w.z_axis[*axis].abs() <= EDGE_ON_TOLERANCE;
    let mut axes = (0..3).filter(looks_along).peekable();
    // Most cameras look along no face, and the box of a large mesh takes time.
    if axes.peek().is_none() {
        return false;
    }
    let bounds = scene.bounds();
    let near = EDGE_ON_TOLERANCE * bounds.extent().length();
    axes.any(|axis| {
        let distance_to = |face: Vec3| (camera.pos[axis] - face[axis]).abs();
        !bounds.is_empty() && distance_to(bounds.min).min(distance_to(bounds.max)) <= near
    })
}

/// A view of the centre of the scene's bounding box from `direction` (not zero; +y is up), at 1.5
/// times the diagonal of the box. Angles of view and clip distances are those of the file's camera,
/// if there is one.
pub fn frame(scene: &Scene, direction: Vec3, film: FilmSize) -> View {
    let bounds = scene.bounds();
    let (target, diagonal) = match bounds.is_empty() {
        true => (Vec3::ZERO, 0.0),
        false => (bounds.centroid(), bounds.extent().length()),
    };
    // A single point is seen from a distance of 1.
    let distance = if diagonal > 0.0 {
        FRAMING_DISTANCE * diagonal
    } else {
        1.0
    };
    let backward = direction.normalize_or(Vec3::Z);
    let c2w = Camera::look_at(backward, Vec3::ZERO, Vec3::Y)
        // From straight above or below: -z is up.
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

/// The camera with its smaller angle extended so that `tan(h_fov/2) / tan(v_fov/2) = w / h`. The
/// image contains the whole frame of the camera. A camera with the film's aspect ratio is returned
/// unchanged.
pub fn for_film(camera: &Camera, film: FilmSize) -> Camera {
    let aspect = f64::from(film.w) / f64::from(film.h);
    let frame_aspect = half_tan(camera.h_fov) / half_tan(camera.v_fov);
    let mut fitted = *camera;
    if frame_aspect < aspect * (1.0 - ASPECT_TOLERANCE) {
        fitted.h_fov = scale_fov(camera.v_fov, aspect);
    } else if frame_aspect > aspect * (1.0 + ASPECT_TOLERANCE) {
        fitted.v_fov = scale_fov(camera.h_fov, 1.0 / aspect);
    }
    fitted
}

/// The point on the camera's axis nearest to the centre of the scene. If that is behind the camera:
/// the point at a distance of one diagonal in front of it.
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

    fn sphere_scene(center: Vec3, radius: f64) -> Scene {
        scene(Vec::new(), vec![Sphere { center, radius }])
    }

    /// A sphere of radius 1 with a camera at z = 5 and the given height, whose viewing direction
    /// has the given slope.
    fn sphere_with_camera(height: f64, slope: f64) -> Scene {
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
            ..sphere_scene(Vec3::ZERO, 1.0)
        }
    }

    #[test]
    fn edge_on_cameras_frame_the_scene() {
        for (height, slope, edge_on) in [
            (-1.0, 0.0, true),
            (1.0 + 1e-9, 0.0, true),
            (-1.0, 0.01, false),
            (-0.99, 0.0, false),
            (0.0, 0.0, false),
            (-3.0, 0.0, false),
        ] {
            let scene = sphere_with_camera(height, slope);
            assert_eq!(is_edge_on(&scene), edge_on, "{height} {slope}");
            let pos = place(&scene, FILM).camera.pos;
            let distance = FRAMING_DISTANCE * 12.0_f64.sqrt();
            let framed = (pos - Vec3::new(0.0, 0.0, distance)).length() < 1e-12;
            assert_eq!(framed, edge_on, "{pos}");
        }
        assert!(!is_edge_on(&sphere_scene(Vec3::ZERO, 1.0)));
    }

    fn aspect(camera: &Camera) -> f64 {
        half_tan(camera.h_fov) / half_tan(camera.v_fov)
    }

    #[test]
    fn scene_without_camera_is_framed_from_plus_z() {
        let center = Vec3::new(1.0, 2.0, 3.0);
        let view = place(&sphere_scene(center, 1.0), FILM);
        assert_eq!(view.target, center);
        let distance = 1.5 * 12.0_f64.sqrt();
        assert!((view.camera.pos - center).distance(Vec3::new(0.0, 0.0, distance)) < 1e-12);
        assert!((aspect(&view.camera) - 4.0 / 3.0).abs() < 1e-12);
    }

    #[test]
    fn a_flat_scene_without_camera_is_not_seen_edge_on() {
        for (normal, expected) in [
            (Vec3::X, Vec3::X),
            (Vec3::Y, Vec3::Y),
            (Vec3::Z, Vec3::Z),
            (Vec3::new(1.0, 1.0, 0.0), Vec3::Z),
        ] {
            let (u, v) = normal.normalize().any_orthonormal_pair();
            let scene = Scene {
                triangles: vec![Triangle::flat(u, v, -u)],
                ..Scene::default()
            };
            let view = place(&scene, FILM);
            assert_eq!(view.camera.c2w.z_axis, expected, "{normal}");
        }
    }

    #[test]
    fn points_and_empty_scenes_are_framed_from_distance_one() {
        let point = place(&sphere_scene(Vec3::ONE, 0.0), FILM);
        assert_eq!(
            (point.target, point.camera.pos),
            (Vec3::ONE, Vec3::ONE + Vec3::Z)
        );
        let empty = place(&Scene::default(), FILM);
        assert_eq!((empty.target, empty.camera.pos), (Vec3::ZERO, Vec3::Z));
    }

    #[test]
    fn framing_from_straight_above_has_a_finite_up() {
        for direction in [Vec3::Y, Vec3::NEG_Y] {
            let camera = frame(&sphere_scene(Vec3::ZERO, 1.0), direction, FILM).camera;
            assert!(camera.c2w.is_finite());
            assert_eq!(camera.c2w.z_axis, direction);
        }
    }

    /// A camera with angles of view of 60 by 40 degrees.
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
    fn film_of_another_aspect_ratio_shows_the_whole_frame() {
        let wide = for_film(&camera(), FilmSize { w: 800, h: 200 });
        assert_eq!(wide.v_fov, 40.0);
        assert!(wide.h_fov > 60.0 && (aspect(&wide) - 4.0).abs() < 1e-12);
        let high = for_film(&camera(), FilmSize { w: 200, h: 800 });
        assert_eq!(high.h_fov, 60.0);
        assert!(high.v_fov > 40.0 && (aspect(&high) - 0.25).abs() < 1e-12);
    }

    #[test]
    fn film_of_the_same_aspect_ratio_changes_nothing() {
        let fitted = for_film(&camera(), FILM);
        assert_eq!(for_film(&fitted, FilmSize { w: 1600, h: 1200 }), fitted);
    }

    #[test]
    fn target_is_the_point_on_the_axis_nearest_to_the_centre() {
        let target_for = |center: Vec3| {
            let scene = Scene {
                camera: Some(camera()),
                ..sphere_scene(center, 0.5)
            };
            place(&scene, FILM).target
        };
        assert_eq!(
            target_for(Vec3::new(3.0, 1.0, -2.0)),
            Vec3::new(0.0, 0.0, -2.0)
        );
        // Behind the camera: at a distance of one diagonal in front.
        assert!(
            target_for(Vec3::new(0.0, 0.0, 20.0)).distance(Vec3::new(
                0.0,
                0.0,
                9.0 - 3.0_f64.sqrt()
            )) < 1e-12
        );
    }
}
