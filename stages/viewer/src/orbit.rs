//! The camera that the mouse moves: it orbits a target.

use kit::{Camera, Mat3, Vec3};
use scenes::placement::View;

/// A camera and its target. It is changed only by its own methods, so a camera that was not moved
/// is that of its file, bit for bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    view: View,
    /// The view to return to.
    home: View,
    /// The distance that one step of the wheel depends on: that of the view at the start.
    canonical: f64,
}

/// The share of the canonical distance that one step of the wheel moves the camera.
const ZOOM_STEP: f64 = 0.1;
/// The smallest distance from the target, relative to the canonical one.
const MIN_DISTANCE: f64 = 0.1;
/// The largest distance from the target, relative to the canonical one.
const MAX_DISTANCE: f64 = 20.0;
/// The smallest angle to the vertical in radians: straight from above, "up" would be undefined.
const MIN_POLAR_ANGLE: f64 = 1e-3;

impl Orbit {
    /// A camera at its home view.
    pub fn new(home: View) -> Orbit {
        let distance = home.camera.pos.distance(home.target);
        Orbit {
            view: home,
            home,
            canonical: if distance > 0.0 { distance } else { 1.0 },
        }
    }

    /// The camera and its target.
    pub fn view(&self) -> View {
        self.view
    }

    /// The camera.
    pub fn camera(&self) -> Camera {
        self.view.camera
    }

    /// Rotates about the target: `right` about the vertical axis, `up` towards it; in radians of a
    /// drag in these directions, so the scene follows the mouse. Stops at the poles.
    pub fn rotate(&mut self, right: f64, up: f64) {
        let camera = self.view.camera;
        let polar = camera.c2w.z_axis.angle_between(Vec3::Y);
        // Dragging up looks from further below.
        let largest = std::f64::consts::PI - MIN_POLAR_ANGLE;
        let target = (polar + up).clamp(MIN_POLAR_ANGLE.min(polar), largest.max(polar));
        let about_right = Mat3::from_axis_angle(camera.c2w.x_axis, target - polar);
        let rotation = Mat3::from_axis_angle(Vec3::Y, -right) * about_right;
        let offset = rotation * (camera.pos - self.view.target);
        self.view.camera.pos = self.view.target + offset;
        self.view.camera.c2w = orthonormal(rotation * camera.c2w);
    }

    /// Moves camera and target along the film, in fractions of the film's height: what is at the
    /// distance of the target follows the mouse.
    pub fn pan(&mut self, right: f64, up: f64) {
        let View { camera, target } = self.view;
        let height = 2.0 * kit::camera::half_tan(camera.v_fov) * camera.pos.distance(target);
        let shift = -height * (right * camera.c2w.x_axis + up * camera.c2w.y_axis);
        self.view.camera.pos += shift;
        self.view.target += shift;
    }

    /// Moves the camera towards the target by `steps` steps of the wheel (away if negative).
    pub fn zoom(&mut self, steps: f64) {
        let View { camera, target } = self.view;
        let offset = camera.pos - target;
        let distance = offset.length();
        let (min, max) = (MIN_DISTANCE * self.canonical, MAX_DISTANCE * self.canonical);
        // A camera that starts outside of the range may stay there, but not move further away.
        let wanted = (distance - steps * ZOOM_STEP * self.canonical)
            .clamp(min.min(distance), max.max(distance));
        if distance > 0.0 {
            self.view.camera.pos = target + offset * (wanted / distance);
        }
    }

    /// Sets another view. The home view stays.
    pub fn go_to(&mut self, view: View) {
        self.view = view;
    }

    /// Returns to the home view, in every respect.
    pub fn reset(&mut self) {
        self.view = self.home;
    }
}

/// The rotation nearest to `m`, a rotation with rounding errors.
fn orthonormal(m: Mat3) -> Mat3 {
    let z = m.z_axis.normalize();
    let x = m.y_axis.cross(z).normalize();
    Mat3::from_cols(x, z.cross(x), z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn orbit() -> Orbit {
        let pos = Vec3::new(0.0, 0.0, 10.0);
        Orbit::new(View {
            camera: Camera {
                pos,
                c2w: Mat3::IDENTITY,
                h_fov: 60.0,
                v_fov: 40.0,
                n_clip: 0.0,
                f_clip: 1e30,
            },
            target: Vec3::ZERO,
        })
    }

    #[test]
    fn dragging_to_the_right_turns_the_front_of_the_scene_to_the_right() {
        let mut orbit = orbit();
        orbit.rotate(0.1, 0.0);
        // A point in front of the target moves to the right of the camera.
        let camera = orbit.camera();
        let front = camera.c2w.transpose() * (Vec3::Z - camera.pos);
        assert!(front.x > 0.05, "{front}");
        assert!((camera.pos.length() - 10.0).abs() < 1e-12);
        assert!(camera.c2w.z_axis.distance(camera.pos / 10.0) < 1e-12);
    }

    #[test]
    fn dragging_up_looks_from_below_and_stops_at_the_pole() {
        let mut orbit = orbit();
        orbit.rotate(0.0, 0.2);
        assert!(orbit.camera().pos.y < -1.0);
        for _ in 0..100 {
            orbit.rotate(0.0, 0.2);
        }
        let camera = orbit.camera();
        assert!(camera.c2w.y_axis.y > 0.0, "up stays up: {camera:?}");
        let square = camera.c2w.transpose() * camera.c2w;
        assert!(square.abs_diff_eq(Mat3::IDENTITY, 1e-12));
    }

    #[test]
    fn pan_follows_the_mouse_at_the_target() {
        let mut orbit = orbit();
        orbit.pan(0.5, 0.25);
        let camera = orbit.camera();
        let old_target = camera.c2w.transpose() * (Vec3::ZERO - camera.pos);
        let height = 2.0 * kit::camera::half_tan(40.0) * 10.0;
        assert!((old_target.x - 0.5 * height).abs() < 1e-12);
        assert!((old_target.y - 0.25 * height).abs() < 1e-12);
        assert_eq!(orbit.view().target.z, 0.0);
    }

    #[test]
    fn zoom_has_limits_and_reset_forgets_nothing() {
        let mut orbit = orbit();
        orbit.zoom(1.0);
        assert!((orbit.camera().pos.z - 9.0).abs() < 1e-12);
        orbit.zoom(1000.0);
        assert!((orbit.camera().pos.z - 1.0).abs() < 1e-12);
        orbit.zoom(-1000.0);
        assert!((orbit.camera().pos.z - 200.0).abs() < 1e-9);
        orbit.rotate(0.3, 0.1);
        orbit.pan(0.1, 0.1);
        orbit.reset();
        assert_eq!(orbit, self::orbit());
    }
}
