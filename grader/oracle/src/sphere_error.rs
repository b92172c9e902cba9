//! How far a correct kernel may be off on one ray and sphere.
//!
//! With `f = o - center`, the ray is on the sphere where `a t² + 2 b t + c = 0`, `a = d·d`,
//! `b = f·d`, `c = f·f - r²`; it is at all where the discriminant `D = b² - a c` is not negative.

use kit::{Ray, Sphere, Vec3};

use super::roundoff::{U, gamma, in_reach, largest};
use super::verdict::Kernel;

/// Roundings in `b² - a c` as a textbook writes it: `b²` has 2 · 4 + 1 and `a c` has 3 + 6 + 1, and
/// one difference; each is at most `a (f² + r²)`. Rounded up to 16 and doubled.
const TEXTBOOK_D: f64 = 32.0 * U;

/// Roundings in each coordinate of `l = f - (b/a) d`, the vector from the centre to the line: `b` has
/// 4, `a` 3, their quotient 1, its product 1, the difference 1, and `f` itself 1; each is at most `|f|`.
/// Rounded up to 12 and doubled.
const ROBUST_L: f64 = 24.0 * U;

/// The bounds of `t` are doubled, as for triangles.
const DOUBLED: f64 = 2.0;

/// The numbers that the bounds are made of, rounded.
pub(super) struct Frame {
    /// `|d|²`, `f·d`, `|f|²` and `r²`.
    a: f64,
    b: f64,
    ff: f64,
    rr: f64,
    /// Largest coordinate of the centre or the origin, radius included; and largest component of `d`.
    world: f64,
    direction: f64,
    /// See [`in_reach`].
    pub(super) in_reach: bool,
}

impl Frame {
    pub(super) fn new(s: &Sphere, ray: &Ray) -> Frame {
        let f = ray.o - s.center;
        Frame {
            a: ray.d.length_squared(),
            b: f.dot(ray.d),
            ff: f.length_squared(),
            rr: s.radius * s.radius,
            world: largest(ray.o).max(largest(s.center)).max(s.radius),
            direction: largest(ray.d),
            in_reach: in_reach(&[ray.o, s.center, ray.d, Vec3::splat(s.radius)]),
        }
    }

    /// Bounds the error of the discriminant `D`.
    ///
    /// The textbook subtracts two numbers of the size `a f²`, which drowns `a r²` when the sphere is
    /// far. A robust kernel (Haines, Günther, Akenine-Möller, *Ray Tracing Gems*, ch. 7) takes
    /// `D = a (r² - |l|²)`, whose error near the rim, `|l| = r`, is `2 r δl + δl²`.
    pub(super) fn discriminant(&self, kernel: Kernel) -> f64 {
        match kernel {
            Kernel::Textbook => TEXTBOOK_D * self.a * (self.ff + self.rr),
            Kernel::Robust => {
                let l = ROBUST_L * self.ff.sqrt();
                self.a * (l * (2.0 * self.rr.sqrt() + l) + gamma(8.0) * self.rr)
            }
        }
    }

    /// Whether the discriminant is negative for certain, in exact arithmetic and for every correct
    /// kernel. This is the filter: most rays miss, and need no integers. The textbook's discriminant is
    /// computed here, so its bound is added once for the exact value to be below it, too; robust
    /// bounds are smaller.
    pub(super) fn surely_misses(&self) -> bool {
        let d = self.b * self.b - self.a * (self.ff - self.rr);
        self.in_reach && d < -2.0 * self.discriminant(Kernel::Textbook)
    }

    /// Bounds the error of `√D`: `δD / √D`, but never more than `√δD`.
    fn root(&self, kernel: Kernel, d: f64) -> f64 {
        let error = self.discriminant(kernel);
        let root = d.max(0.0).sqrt();
        (error / root).min(error.sqrt()) + gamma(3.0) * root
    }

    /// Bounds the errors of the two roots, `t`.
    ///
    /// The textbook takes `(-b ∓ √D) / a` for both, and one of them cancels. A robust kernel
    /// takes the one that adds, `q / a` with `q = -(b + sgn(b) √D)`, and `c / q` for the other.
    pub(super) fn roots(&self, kernel: Kernel, b: f64, d: f64, t: [f64; 2]) -> [f64; 2] {
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
                Kernel::Robust if !is_added => {
                    // On the rim `q` cancels too; but where D >= 0, |c/q| never exceeds √|c/a|.
                    let divided = DOUBLED * (c_error + t.abs() * q_error) / q;
                    let rim = added + DOUBLED * (c_error / self.a).sqrt();
                    divided.min(rim) + divisions
                }
                _ => added + divisions,
            }
        })
    }

    /// Bounds the error of a hit point, by component, given that of its `t`.
    ///
    /// Textbook code walks the ray. Robust code pulls the point back to the sphere, which
    /// mends the error across the surface but not the one along it.
    pub(super) fn position(&self, t: f64) -> f64 {
        t * self.direction + DOUBLED * gamma(8.0) * self.world
    }
}
