//! The given eye of the pictures.

use kit::{Ray, Vec3};
use wire::picture::View;

/// Generates the rays of a [`View`].
pub(super) struct Eye {
    position: Vec3,
    corner: Vec3,
    right: Vec3,
    up: Vec3,
}

impl Eye {
    pub(super) fn new(view: &View) -> Eye {
        Eye {
            position: view.eye.into(),
            corner: view.corner.into(),
            right: view.right.into(),
            up: view.up.into(),
        }
    }

    /// The ray through the point `x`, `y` of the panel, in pixels from the bottom left.
    pub(super) fn ray(&self, x: f64, y: f64) -> Ray {
        let d = self.corner + x * self.right + y * self.up;
        Ray::new(self.position, d.normalize())
    }

    /// The ray through the centre of a pixel.
    pub(super) fn through(&self, x: u32, y: u32) -> Ray {
        self.ray(f64::from(x) + 0.5, f64::from(y) + 0.5)
    }
}
