//! Examples of camera rays.
//!
//! A direction is right if the ray passes through the given point of the film: the direction is
//! turned into the camera's space, and the point of the film on it is compared. So a handout judges
//! examples without the formula that makes a ray.

use super::by_hand::BY_HAND;
use kit::camera::half_tan;
use kit::{Vec2, Vec3};
use wire::Work;
use wire::work::{Camera, CameraWork};

/// A camera, a point of the film, and the direction that a student expects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraExample {
    /// The columns of the rotation: right, up, backward.
    pub axes: [Vec3; 3],
    /// The fields of view in degrees.
    pub fov: Vec2,
    /// The point of the film, from (0, 0), at the bottom left, to (1, 1).
    pub film: Vec2,
    /// The unit direction in the world.
    pub expected: Vec3,
}

/// The situations of camera rays.
pub(super) const SITUATIONS: &[&str] = &[
    "through the centre",
    "left or right of the centre",
    "above or below the centre",
    "through a corner",
    "different fields of view",
    "a field of view that is not 90 degrees",
    "a turned camera",
];

pub(super) fn verdict(example: &CameraExample) -> Option<String> {
    let CameraExample {
        axes,
        fov,
        film,
        expected,
    } = *example;
    let are_unit = axes.iter().all(|axis| (axis.length() - 1.0).abs() < 1e-6);
    let pairs = [(0, 1), (1, 2), (2, 0)];
    if !are_unit
        || pairs
            .iter()
            .any(|&(a, b)| axes[a].dot(axes[b]).abs() > 1e-6)
    {
        return Some("its axes are no unit vectors that are perpendicular to each other".into());
    }
    if !(fov.cmpgt(Vec2::ZERO).all() && fov.cmplt(Vec2::splat(180.0)).all()) {
        return Some("its fields of view are not between 0 and 180 degrees".into());
    }
    let length = expected.length();
    let is_unit = (length - 1.0).abs() <= BY_HAND;
    if !is_unit {
        return Some(format!(
            "its direction has the length {length:.4}; a camera ray has the length 1"
        ));
    }
    let [across, up, depth] = axes.map(|axis| axis.dot(expected));
    if depth >= 0.0 {
        return Some("its direction points backward: the camera looks along -axes[2]".into());
    }
    let on_sensor = Vec2::new(across, up) / -depth;
    let size = Vec2::new(half_tan(fov.x), half_tan(fov.y));
    let met = 0.5 * (on_sensor / size + 1.0);
    // A digit of the direction is one of the film, where the picture is not wide.
    let allowed = 3.0 * BY_HAND / (size.min_element() * depth * depth);
    let passes = (met - film).length() <= allowed;
    (!passes).then(|| {
        format!(
            "its direction passes through the point ({:.3}, {:.3}) of the film, not through ({}, {})",
            met.x, met.y, film.x, film.y
        )
    })
}

impl CameraExample {
    pub(super) fn situations(&self) -> Vec<&'static str> {
        let Vec2 { x, y } = self.film;
        let is_end = |x: f64| x == 0.0 || x == 1.0;
        let straight = [Vec3::X, Vec3::Y, Vec3::Z];
        let touched = [
            x == 0.5 && y == 0.5,
            x != 0.5,
            y != 0.5,
            is_end(x) && is_end(y),
            self.fov.x != self.fov.y,
            self.fov != Vec2::splat(90.0),
            self.axes != straight,
        ];
        let each = SITUATIONS.iter().zip(touched);
        each.filter(|(_, is)| *is).map(|(name, _)| *name).collect()
    }

    pub(super) fn work(&self) -> Work {
        Work::CameraRays(CameraWork {
            cameras: vec![Camera {
                pos: [0.0; 3],
                c2w: self.axes.map(Into::into),
                h_fov: self.fov.x,
                v_fov: self.fov.y,
                n_clip: 1.0,
                f_clip: 10.0,
            }],
            sensor: vec![self.film.into()],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example(film: [f64; 2], expected: [f64; 3]) -> CameraExample {
        CameraExample {
            axes: [Vec3::X, Vec3::Y, Vec3::Z],
            fov: Vec2::splat(90.0),
            film: film.into(),
            expected: expected.into(),
        }
    }

    #[test]
    fn a_direction_is_right_if_it_passes_through_the_point() {
        let centre = example([0.5, 0.5], [0.0, 0.0, -1.0]);
        assert_eq!(verdict(&centre), None);
        assert_eq!(centre.situations(), ["through the centre"]);
        let side = example([1.0, 0.5], [0.707, 0.0, -0.707]);
        assert_eq!(verdict(&side), None);
        assert_eq!(side.situations(), ["left or right of the centre"]);
        let half = example([0.75, 0.5], [0.707, 0.0, -0.707]);
        let why = verdict(&half).expect("it is wrong");
        assert!(
            why.contains("the point (1.000, 0.500) of the film"),
            "{why}"
        );
    }

    #[test]
    fn turned_cameras_and_other_fields_of_view_are_judged() {
        let wide = CameraExample {
            fov: Vec2::new(120.0, 60.0),
            // The corner is at (√3, 1/√3) on the sensor.
            ..example([1.0, 1.0], [0.832, 0.277, -0.480])
        };
        assert_eq!(verdict(&wide), None);
        // Looks along +x.
        let turned = CameraExample {
            axes: [Vec3::Z, Vec3::Y, -Vec3::X],
            ..example([1.0, 0.5], [0.707, 0.0, 0.707])
        };
        assert_eq!(verdict(&turned), None);
        let inverse = CameraExample {
            expected: Vec3::new(-0.707, 0.0, -0.707),
            ..turned
        };
        assert!(verdict(&inverse).is_some_and(|why| why.contains("backward")));
        // No comparison with NaN holds.
        let unknown = example([f64::NAN, 0.5], [0.0, 0.0, -1.0]);
        assert!(verdict(&unknown).is_some());
        assert!(verdict(&example([0.5, 0.5], [f64::NAN; 3])).is_some());
        let long = example([1.0, 0.5], [1.0, 0.0, -1.0]);
        assert!(verdict(&long).is_some_and(|why| why.contains("length 1.4142")));
    }
}
