//! Error bounds of correct kernels for one ray and sphere.
//!
//! With `f = o - center`, the ray is on the sphere where `a t² + 2 b t + c = 0`, `a = d·d`,
//! `b = f·d`, `c = f·f - r²`. There are real roots if the discriminant `D = b² - a c` is not
//! negative.

use kit::{Ray, Sphere, Vec3};

use super::roundoff::{U, fits_f64, gamma, max_abs};
use super::verdict::KernelClass;

/// Rounding error of `b² - a c` in textbook code: `b²` has 2 · 4 + 1 roundings, `a c` has 3 + 6 +
/// 1, and the difference has one; each is at most `a (f² + r²)`. Rounded up to 16 and doubled.
const TEXTBOOK_D: f64 = 32.0 * U;

/// Rounding error of each coordinate of `l = f - (b/a) d`, the vector from the centre to the
/// nearest point of the line: `b` has 4 roundings, `a` 3, their quotient 1, its product 1, the
/// difference 1, and `f` itself 1; each is at most `|f|`. Rounded up to 12 and doubled.
const ROBUST_L: f64 = 24.0 * U;

/// The bounds of `t` are doubled, as for triangles.
const DOUBLED: f64 = 2.0;

/// The rounded numbers that the error bounds are computed from.
pub(super) struct SphereErrorBounds {
    /// `|d|²`, `f·d`, `|f|²` and `r²`.
    a: f64,
    b: f64,
    ff: f64,
    rr: f64,
    /// `|f|²` without its part along the ray: the squared distance of the centre from the line.
    ll: f64,
    /// Largest coordinate of the centre or the origin, radius included; and largest component of
    /// `d`.
    extent: f64,
    direction: f64,
    /// See [`fits_f64`].
    pub(super) fits_f64: bool,
}

impl SphereErrorBounds {
    pub(super) fn new(s: &Sphere, ray: &Ray) -> SphereErrorBounds {
        let f = ray.o - s.center;
        let (a, b) = (ray.d.length_squared(), f.dot(ray.d));
        SphereErrorBounds {
            a,
            b,
            ff: f.length_squared(),
            rr: s.radius * s.radius,
            ll: (f - b / a * ray.d).length_squared(),
            extent: max_abs(ray.o).max(max_abs(s.center)).max(s.radius),
            direction: max_abs(ray.d),
            fits_f64: fits_f64(&[ray.o, s.center, ray.d, Vec3::splat(s.radius)]),
        }
    }

    /// Bounds the error of the discriminant `D`.
    ///
    /// Textbook code subtracts two numbers of the size `a f²`; if the sphere is far away, their
    /// rounding errors exceed `a r²`. A robust kernel (Haines, Günther, Akenine-Möller, *Ray
    /// Tracing Gems*, ch. 7) computes `D = a (r² - |l|²)`, whose error near the rim, `|l| = r`, is
    /// `2 r δl + δl²`.
    pub(super) fn discriminant(&self, kernel: KernelClass) -> f64 {
        match kernel {
            KernelClass::Textbook => TEXTBOOK_D * self.a * (self.ff + self.rr),
            KernelClass::Robust => {
                let l = ROBUST_L * self.ff.sqrt();
                self.a * (l * (2.0 * self.rr.sqrt() + l) + gamma(8.0) * self.rr)
            }
        }
    }

    /// Whether the discriminant is certainly negative, in exact arithmetic and for every correct
    /// kernel of this class. This is the filter: most rays miss, and need no integers. The
    /// discriminant is computed here as such a kernel does, so its bound is doubled: once for this
    /// computation, once for the kernel. Robust bounds are smaller: what surely misses for textbook
    /// code does so for both.
    ///
    /// The robust bound `2 r δl + δl²` holds at the rim. Four times this bound beyond it, `|l|` is
    /// more than `r + 2 δl`: one `δl` for this computation, one for the kernel.
    pub(super) fn surely_misses(&self, kernel: KernelClass) -> bool {
        let (d, bounds) = match kernel {
            KernelClass::Textbook => (self.b * self.b - self.a * (self.ff - self.rr), 2.0),
            KernelClass::Robust => (self.a * (self.rr - self.ll), 4.0),
        };
        self.fits_f64 && d < -bounds * self.discriminant(kernel)
    }

    /// Bounds the error of `√D`: `δD / √D`, but at most `√δD`.
    fn root(&self, kernel: KernelClass, d: f64) -> f64 {
        let error = self.discriminant(kernel);
        let root = d.max(0.0).sqrt();
        (error / root).min(error.sqrt()) + gamma(3.0) * root
    }

    /// Bounds the errors of the two roots, `t`.
    ///
    /// Textbook code computes `(-b ∓ √D) / a` for both, and one of them cancels. A robust kernel
    /// computes the one that adds, `q / a` with `q = -(b + sgn(b) √D)`, and `c / q` for the other.
    pub(super) fn roots(&self, kernel: KernelClass, b: f64, d: f64, t: [f64; 2]) -> [f64; 2] {
        let root = d.max(0.0).sqrt();
        let b_error = gamma(5.0) * (self.a * self.ff).sqrt();
        let q_error = b_error + self.root(kernel, d) + U * (b.abs() + root);
        let added = DOUBLED * q_error / self.a;
        let q = b.abs() + root;
        let c_error = gamma(6.0) * (self.ff + self.rr);
        t.map(|t| {
            let divisions = DOUBLED * gamma(5.0) * t.abs();
            let is_added = (t < 0.0) == (b > 0.0) && (t * self.a).abs() >= 0.5 * q;
            match kernel {
                KernelClass::Robust if !is_added => {
                    // At the rim `q` also cancels, but if D >= 0, |c/q| never exceeds √|c/a|.
                    let divided = DOUBLED * (c_error + t.abs() * q_error) / q;
                    let rim = added + DOUBLED * (c_error / self.a).sqrt();
                    divided.min(rim) + divisions
                }
                _ => added + divisions,
            }
        })
    }

    /// Bounds the error of each coordinate of a hit point, given the error of its `t`.
    ///
    /// Textbook code computes `o + t·d`. Robust code projects the point back onto the sphere, which
    /// removes the error along the normal but not the error along the surface.
    pub(super) fn position(&self, t: f64) -> f64 {
        t * self.direction + DOUBLED * gamma(8.0) * self.extent
    }
}
