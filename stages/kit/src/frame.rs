//! Orthonormal bases around surface normals.

use crate::Vec3;

/// An orthonormal basis in world space; `n` is the surface normal.
///
/// In the local space of the frame the normal is `(0, 0, 1)`, so the cosine between a unit
/// direction `w` and the normal is `w.z`.
///
/// ```
/// use kit::{Frame, Vec3};
/// let frame = Frame::around(Vec3::Y);
/// assert_eq!(frame.to_local(Vec3::Y), Vec3::Z);
/// let w = Vec3::new(1.0, 2.0, 3.0);
/// assert!((frame.to_world(frame.to_local(w)) - w).length() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Local x axis.
    pub s: Vec3,
    /// Local y axis.
    pub t: Vec3,
    /// Local z axis: the normal.
    pub n: Vec3,
}

impl Frame {
    /// A right-handed frame around the unit vector `n`, finite for every `n`.
    ///
    /// Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin: "Building an orthonormal basis,
    /// revisited" (JCGT 2017). Frisvad's older formula divides by `1 + n.z` and loses all
    /// significant digits for normals near -z. Here the divisor is `sign(n.z) + n.z`, whose
    /// magnitude is at least 1.
    #[inline]
    pub fn around(n: Vec3) -> Frame {
        let sign = 1.0_f64.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        Frame {
            s: Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            t: Vec3::new(b, sign + n.y * n.y * a, -n.y),
            n,
        }
    }

    /// Transforms a direction from world space to local space.
    #[inline]
    pub fn to_local(&self, w: Vec3) -> Vec3 {
        Vec3::new(w.dot(self.s), w.dot(self.t), w.dot(self.n))
    }

    /// Transforms a direction from local space to world space.
    #[inline]
    pub fn to_world(&self, w: Vec3) -> Vec3 {
        w.x * self.s + w.y * self.t + w.z * self.n
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four rounding errors of numbers up to 1 in each component.
    const ROUNDING: f64 = 1e-15;

    fn assert_orthonormal(f: Frame) {
        for (a, b, dot) in [
            (f.s, f.s, 1.0),
            (f.t, f.t, 1.0),
            (f.s, f.t, 0.0),
            (f.s, f.n, 0.0),
            (f.t, f.n, 0.0),
        ] {
            assert!((a.dot(b) - dot).abs() < ROUNDING, "{f:?}: {a} . {b}");
        }
        assert!(
            (f.s.cross(f.t) - f.n).length() < ROUNDING,
            "left-handed: {f:?}"
        );
    }

    /// Hard case 74: the older formula divides by `1 + n.z`.
    #[test]
    fn normals_near_minus_z_have_a_finite_basis() {
        for k in 0..60 {
            let x = 0.5_f64.powi(k);
            for z in [1.0, -1.0] {
                assert_orthonormal(Frame::around(Vec3::new(x, 0.3 * x, z).normalize()));
            }
        }
        assert_orthonormal(Frame::around(-Vec3::Z));
        assert_orthonormal(Frame::around(Vec3::new(0.0, 1.0, -0.0)));
    }

    #[test]
    fn to_local_inverts_to_world() {
        let f = Frame::around(Vec3::new(0.6, -0.48, 0.64));
        let w = Vec3::new(0.36, 0.48, -0.8);
        assert!((f.to_local(f.to_world(w)) - w).length() < ROUNDING);
        assert!((f.to_local(f.n) - Vec3::Z).length() < ROUNDING);
    }
}
