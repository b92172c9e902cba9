//! Orthonormal bases around normals, as [`kit::Frame`].

use crate::real::Real;
use crate::vec3::Vec3;

/// An orthonormal basis in world space: the local axes x, y and z. z is the normal.
///
/// ```
/// use lanes::{Vec3, frame::Frame};
/// let n = Vec3 { x: 0.0, y: -1.0, z: 0.0_f64 };
/// let local = Frame::around(n).to_local(n);
/// assert_eq!((local.x, local.y, local.z), (0.0, 0.0, 1.0));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Frame<R> {
    s: Vec3<R>,
    t: Vec3<R>,
    n: Vec3<R>,
}

impl<R: Real> Frame<R> {
    /// A right-handed frame around the unit vector `n` (Duff et al., "Building an orthonormal
    /// basis, revisited", JCGT 2017).
    #[inline(always)]
    pub fn around(n: Vec3<R>) -> Frame<R> {
        let one = n.z.constant(1.0);
        let sign = one.copysign(n.z);
        let a = -one / (sign + n.z);
        let b = n.x * n.y * a;
        Frame {
            s: Vec3 {
                x: one + sign * n.x * n.x * a,
                y: sign * b,
                z: -sign * n.x,
            },
            t: Vec3 {
                x: b,
                y: sign + n.y * n.y * a,
                z: -n.y,
            },
            n,
        }
    }

    /// Transforms a direction from world space to local space.
    #[inline(always)]
    pub fn to_local(&self, w: Vec3<R>) -> Vec3<R> {
        Vec3 {
            x: w.dot(self.s),
            y: w.dot(self.t),
            z: w.dot(self.n),
        }
    }

    /// Transforms a direction from local space to world space.
    #[inline(always)]
    pub fn to_world(&self, w: Vec3<R>) -> Vec3<R> {
        self.s * w.x + self.t * w.y + self.n * w.z
    }
}
