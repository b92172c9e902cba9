//! The given camera of the pictures.

use kit::{Camera, Mat3, Ray, Vec3, camera::half_tan};
use wire::picture::View;

/// Generates the rays of a [`View`].
pub(super) struct Eye {
    position: Vec3,
    to_world: Mat3,
    /// Tangents of half the horizontal and the vertical field of view.
    half: [f64; 2],
    size: [f64; 2],
}

impl Eye {
    pub(super) fn new(view: &View, size: [u32; 2]) -> Eye {
        let [position, target] = [view.eye, view.target].map(Vec3::from);
        let size = size.map(f64::from);
        let half = half_tan(view.h_fov);
        Eye {
            position,
            to_world: Camera::look_at(position, target, Vec3::Y)
                .expect("no picture looks along +y"),
            half: [half, half * size[1] / size[0]],
            size,
        }
    }

    /// The ray through the point `x`, `y` of the panel, in pixels from the bottom left.
    pub(super) fn ray(&self, x: f64, y: f64) -> Ray {
        let [right, up] = [(x, 0), (y, 1)]
            .map(|(place, axis)| (2.0 * place / self.size[axis] - 1.0) * self.half[axis]);
        let d = self.to_world * Vec3::new(right, up, -1.0);
        Ray::new(self.position, d.normalize())
    }

    /// The ray through the centre of a pixel.
    #[cfg(any(
        feature = "intersect",
        feature = "bbox",
        feature = "direct",
        feature = "global"
    ))]
    pub(super) fn through(&self, x: u32, y: u32) -> Ray {
        self.ray(f64::from(x) + 0.5, f64::from(y) + 0.5)
    }
}
