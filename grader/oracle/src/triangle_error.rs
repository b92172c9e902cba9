//! How far a correct kernel may be off on one ray and triangle.
//!
//! With the vertices seen from the ray's origin, `A B C = p0-o, p1-o, p2-o`, a ray hits where the
//! *edge functions* `e0 = d·(B×C)`, `e1 = d·(C×A)`, `e2 = d·(A×B)` have the sign of their sum,
//! the determinant `det = d·n`, `n = (p1-p0)×(p2-p0)`; then `t = A·n/det` and `b_i = e_i/det`.
//! Every kernel computes these numbers in some way and errs by its roundings. Here is by how
//! much, at most. All bounds are in plain `f64`: they are sums of positive numbers, right to a
//! few parts in 1e16, and each is doubled or rounded up by far more.

use kit::{Ray, Triangle, Vec3};

use super::roundoff::{U, cross_of_sizes, gamma, in_reach, largest, sum};
use super::verdict::Kernel;

/// Roundings that textbook code may put into an edge function, over `thinness · |d| · world²`.
///
/// Möller-Trumbore needs most: its third edge is decided by `u + v <= 1`, three triple products of 9 roundings each
/// (differences 2, products 2, sums 3, times a rounded reciprocal 2). An edge is at most `2 world` long and a
/// vertex is at most `world` away from `o`, so that the absolute products sum to `4 + 4 + 8` times
/// `|d| · world²`: 144 in all. A triangle covers at most half of its bounding rectangle, so
/// `thinness` is at least 2, and 128 is enough.
const TEXTBOOK_EDGE: f64 = 128.0 * U;

/// Roundings that textbook code may put into `t`: two triple products of 7 and their quotient, 16, doubled.
const TEXTBOOK_T: f64 = 2.0 * 16.0 * U;

/// Triangles thinner than this are left to the integers: their normal in `f64` has lost its digits.
const THIN: f64 = 1e6;

/// The error of a sheared coordinate `x' = A_x - (d_x/d_z) A_z`: a difference, a quotient, a
/// product and a difference.
const SHEARED: f64 = 4.0;

/// Bounds of a robust kernel are doubled: that leaves room for a few more roundings than the kernel of
/// Woop, Benthin and Wald has.
const DOUBLED: f64 = 2.0;

/// However thin the triangle and grazing the ray, a robust `t` of a hit that is not in doubt is asked to be
/// right to this part of the farthest vertex' depth.
const T_CAP: f64 = 1e-3;

/// The numbers that the bounds are made of, rounded.
pub(super) struct Frame {
    /// The vertices seen from the origin.
    pub(super) seen: [Vec3; 3],
    /// The ray's direction.
    pub(super) d: Vec3,
    /// `(p1-p0) × (p2-p0)`.
    normal: Vec3,
    /// The products of absolute edge lengths that a normal is summed from, whatever the base vertex.
    normal_sizes: Vec3,
    /// Largest component of an edge, and of a position in world space.
    edge: f64,
    world: f64,
    /// See [`in_reach`].
    pub(super) in_reach: bool,
}

impl Frame {
    pub(super) fn new(tri: &Triangle, ray: &Ray) -> Frame {
        let seen = [tri.p0 - ray.o, tri.p1 - ray.o, tri.p2 - ray.o];
        let edges = [tri.p1 - tri.p0, tri.p2 - tri.p0, tri.p2 - tri.p1];
        let longest = edges[0].abs().max(edges[1].abs()).max(edges[2].abs());
        let outmost = tri.p0.abs().max(tri.p1.abs()).max(tri.p2.abs());
        Frame {
            seen,
            d: ray.d,
            normal: edges[0].cross(edges[1]),
            normal_sizes: cross_of_sizes(longest, longest),
            edge: longest.max_element(),
            world: (outmost + ray.o.abs()).max_element(),
            in_reach: in_reach(&[tri.p0, tri.p1, tri.p2, ray.o, ray.d]),
        }
    }

    /// How much thinner the triangle is than the lengths of its edges say, at least 2: the sum of
    /// the absolute products in its normal over the normal. A kernel that intersects the plane first and asks
    /// for the side of each edge then errs by this factor. `normal` must be right to a few digits.
    fn thinness(&self, normal: Vec3) -> f64 {
        sum(self.normal_sizes) / largest(normal)
    }

    /// Bounds the error of textbook code in every edge function: `128 U · thinness · |d| · world²`.
    ///
    /// Lengths are measured in world space, not from the ray's origin: a plane test rounds its hit point
    /// there, and Plücker coordinates are products of positions. Without area there is no bound: the
    /// normal is noise, and a test by weights from dot products may hit far beside such a triangle.
    pub(super) fn textbook_edge(&self, normal: Vec3) -> f64 {
        TEXTBOOK_EDGE * self.thinness(normal) * sum(self.d) * self.world * self.world
    }

    /// Whether two edge functions have opposite signs for certain, in exact arithmetic and for
    /// every correct kernel. This is the filter: most rays miss, and need no integers.
    ///
    /// A triple product in `f64` is right to `γ_7` times the sum of its absolute products, at
    /// most `2 |d| world²`: less than half the textbook bound, so that twice that bound is enough;
    /// and robust bounds are smaller than textbook ones (doubled, `20 U · |d_z| · 4 world²` at most).
    pub(super) fn surely_misses(&self) -> bool {
        let is_settled = self.thinness(self.normal) < THIN && self.in_reach;
        if !is_settled {
            return false;
        }
        let bound = 2.0 * self.textbook_edge(self.normal);
        let [a, b, c] = self.seen;
        let e = [
            self.d.dot(b.cross(c)),
            self.d.dot(c.cross(a)),
            self.d.dot(a.cross(b)),
        ];
        e.iter().any(|e| *e > bound) && e.iter().any(|e| *e < -bound)
    }

    /// Bounds the error of textbook code in `t`.
    ///
    /// `A·n` and `d·n` sum the products `|A|·|n|` and `|d|·|n|` (a plane's equation does not even
    /// subtract the origin first: `world`), an edge function sums `|d| world²`, and a `t` that is mixed from
    /// the vertices' depths errs by that times the edge's depth.
    pub(super) fn textbook_t(&self, det: f64, t: f64) -> f64 {
        let sizes = sum(self.normal_sizes);
        let det_error = TEXTBOOK_T * self.d.abs().dot(self.normal_sizes);
        let mixed = self.world * self.world * self.edge;
        let num_error = TEXTBOOK_T * (self.world * sizes + mixed);
        (num_error + t.abs() * det_error) / (det.abs() - det_error).max(0.0) + TEXTBOOK_T * t.abs()
    }

    /// Bounds the error of textbook code in a barycentric weight.
    pub(super) fn textbook_b(&self, normal: Vec3, det: f64) -> f64 {
        2.0 * self.textbook_edge(normal) / det.abs() + TEXTBOOK_T
    }

    /// Bounds the errors of a robust kernel: see [`Robust`].
    pub(super) fn robust(&self) -> Robust {
        let z = self.d.abs().max_position();
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let d = self.d.to_array();
        let (shear_x, shear_y) = (d[x] / d[z], d[y] / d[z]);
        let sheared = self.seen.map(|v| {
            let v = v.to_array();
            let error = |i: usize, shear: f64| gamma(SHEARED) * (v[i].abs() + (shear * v[z]).abs());
            Sheared {
                x: (v[x] - shear_x * v[z]).abs(),
                y: (v[y] - shear_y * v[z]).abs(),
                x_error: error(x, shear_x),
                y_error: error(y, shear_y),
            }
        });
        let edge = |i: usize, j: usize| DOUBLED * d[z].abs() * sheared[i].cross_error(&sheared[j]);
        Robust {
            edges: [edge(1, 2), edge(2, 0), edge(0, 1)],
            depths: self.seen.map(|v| (v.to_array()[z] / d[z]).abs()),
        }
    }

    /// Bounds the error of a hit point, by component, given that of its `t` and its weights.
    ///
    /// Textbook code walks the ray, `o + t·d`; robust code mixes the vertices, which keeps the
    /// point on the triangle's plane but slides it along by the error of the weights.
    pub(super) fn position(&self, kernel: Kernel, t: f64, b: f64) -> f64 {
        let mixed = DOUBLED * (2.0 * b * self.edge + gamma(8.0) * self.world);
        match kernel {
            Kernel::Textbook => mixed + t * largest(self.d) + gamma(4.0) * self.world,
            Kernel::Robust => mixed,
        }
    }
}

/// A vertex after the shear that lays the ray along the z axis: sizes of its coordinates and their errors.
struct Sheared {
    x: f64,
    y: f64,
    x_error: f64,
    y_error: f64,
}

impl Sheared {
    /// Bounds the error of `x1·y2 - y1·x2`: each factor's error times the other factor, and a
    /// rounding of each product and of the difference.
    fn cross_error(&self, other: &Sheared) -> f64 {
        let (a, b) = (self, other);
        let carried = |x: f64, x_error: f64, y: f64, y_error: f64| {
            x * y_error
                + y * x_error
                + x_error * y_error
                + gamma(2.0) * (x + x_error) * (y + y_error)
        };
        carried(a.x, a.x_error, b.y, b.y_error) + carried(b.x, b.x_error, a.y, a.y_error)
    }
}

/// The error bounds of a kernel that translates, shears and then takes 2D edge functions (Woop,
/// Benthin and Wald, *Watertight Ray/Triangle Intersection*, JCGT 2013), after PBRT §6.8.7 and doubled.
pub(super) struct Robust {
    /// Of each edge function.
    pub(super) edges: [f64; 3],
    /// Of each vertex, its distance along the ray: `|A_z / d_z|`.
    depths: [f64; 3],
}

impl Robust {
    /// Bounds the error of `t = Σ e_i z_i / det`: PBRT's δt, doubled.
    pub(super) fn t(&self, e: [f64; 3], det: f64, t: f64) -> f64 {
        let z = self.depths;
        let by_edges: f64 = (0..3).map(|i| self.edges[i] * (z[i] + t.abs())).sum();
        let by_depths: f64 = (0..3).map(|i| e[i].abs() * z[i]).sum();
        let by_sums = DOUBLED * gamma(8.0) * by_depths;
        (by_edges + by_sums) / det.abs() + DOUBLED * gamma(4.0) * t.abs()
    }

    /// The most that a `t` may be off where the hit itself is not in doubt, whatever its bound: see [`T_CAP`].
    pub(super) fn t_cap(&self) -> f64 {
        T_CAP * self.depths.iter().fold(0.0, |most, z| z.max(most))
    }

    /// Bounds the error of a barycentric weight, `e_i / det`.
    pub(super) fn b(&self, det: f64) -> f64 {
        let det_error: f64 = self.edges.iter().sum();
        2.0 * det_error / det.abs() + DOUBLED * gamma(4.0)
    }
}
