//! Error bounds of correct kernels for one ray and triangle.
//!
//! With the vertices relative to the ray's origin, `A B C = p0-o, p1-o, p2-o`, a ray hits if the
//! *edge functions* `e0 = d·(B×C)`, `e1 = d·(C×A)`, `e2 = d·(A×B)` have the sign of their sum, the
//! determinant `det = d·n`, `n = (p1-p0)×(p2-p0)`; then `t = A·n/det` and `b_i = e_i/det`. Every
//! kernel computes these numbers in some way, with rounding errors. This module bounds the errors.
//! All bounds are computed in plain `f64`: they are sums of positive numbers, accurate to a few
//! 1e-16, and each is doubled or rounded up by much more.

use kit::{Ray, Triangle, Vec3};

use super::roundoff::{U, abs_cross, fits_f64, gamma, max_abs, sum_abs};
use super::verdict::KernelClass;

/// Rounding error of textbook code in an edge function, relative to `thinness · |d| · extent²`.
///
/// Möller-Trumbore has most roundings: its third edge is decided by `u + v <= 1`, three triple
/// products of 9 roundings each (differences 2, products 2, sums 3, times a rounded reciprocal 2).
/// An edge is at most `2 extent` long and a vertex is at most `extent` away from `o`, so the
/// absolute products sum to `4 + 4 + 8` times `|d| · extent²`: 144 in all. A triangle covers at
/// most half of its bounding rectangle, so `thinness` is at least 2, and 128 is enough.
const TEXTBOOK_EDGE: f64 = 128.0 * U;

/// Rounding error of textbook code in `t`: two triple products of 7 roundings and their quotient,
/// 16, doubled.
const TEXTBOOK_T: f64 = 2.0 * 16.0 * U;

/// Triangles thinner than this are decided in integers: their normal in `f64` has no correct
/// digits.
const THIN: f64 = 1e6;

/// Roundings of a sheared coordinate `x' = A_x - (d_x/d_z) A_z`: a difference, a quotient, a
/// product and a difference.
const SHEARED: f64 = 4.0;

/// Bounds of a robust kernel are doubled: this allows a few more roundings than the kernel of Woop,
/// Benthin and Wald has.
const DOUBLED: f64 = 2.0;

/// Largest error of `t` for a robust kernel if the hit is certain, relative to the depth of the
/// farthest vertex. It holds however thin the triangle and however grazing the ray.
const T_CAP: f64 = 1e-3;

/// The rounded numbers that the error bounds are computed from.
pub(super) struct TriangleErrorBounds {
    /// The vertices relative to the ray's origin.
    pub(super) relative: [Vec3; 3],
    /// The ray's direction.
    pub(super) d: Vec3,
    sizes: TriangleSizes,
    /// Largest coordinate in world space, of a vertex plus that of the ray's origin.
    extent: f64,
    /// See [`fits_f64`].
    pub(super) fits_f64: bool,
}

/// Those of them that depend on the triangle alone.
#[derive(Clone, Copy)]
pub(super) struct TriangleSizes {
    /// The sums of the absolute products in a normal, for the longest edges, so that they hold for
    /// every base vertex.
    normal_sizes: Vec3,
    /// Largest component of an edge.
    max_edge: f64,
    /// Largest absolute coordinate of a vertex on each axis.
    outmost: Vec3,
    /// See [`thinness`]; of the normal `(p1-p0) × (p2-p0)`, computed in `f64`.
    thinness: f64,
    fits_f64: bool,
}

impl TriangleSizes {
    pub(super) fn of(tri: &Triangle) -> TriangleSizes {
        let edges = [tri.p1 - tri.p0, tri.p2 - tri.p0, tri.p2 - tri.p1];
        let longest = edges[0].abs().max(edges[1].abs()).max(edges[2].abs());
        let normal_sizes = abs_cross(longest, longest);
        TriangleSizes {
            normal_sizes,
            max_edge: longest.max_element(),
            outmost: tri.p0.abs().max(tri.p1.abs()).max(tri.p2.abs()),
            thinness: thinness(normal_sizes, edges[0].cross(edges[1])),
            fits_f64: fits_f64(&[tri.p0, tri.p1, tri.p2]),
        }
    }
}

/// Returns how thin a triangle is, at least 2: the sum of the absolute products in its normal over
/// the normal. A kernel that first intersects the plane and then tests the sides of the edges has
/// an error that grows by this factor. `normal` must be accurate to a few digits.
fn thinness(normal_sizes: Vec3, normal: Vec3) -> f64 {
    sum_abs(normal_sizes) / max_abs(normal)
}

impl TriangleErrorBounds {
    pub(super) fn new(tri: &Triangle, ray: &Ray) -> TriangleErrorBounds {
        TriangleErrorBounds::with(TriangleSizes::of(tri), tri, ray)
    }

    /// The same with the sizes of the triangle.
    pub(super) fn with(sizes: TriangleSizes, tri: &Triangle, ray: &Ray) -> TriangleErrorBounds {
        TriangleErrorBounds {
            relative: [tri.p0 - ray.o, tri.p1 - ray.o, tri.p2 - ray.o],
            d: ray.d,
            sizes,
            extent: (sizes.outmost + ray.o.abs()).max_element(),
            fits_f64: sizes.fits_f64 && fits_f64(&[ray.o, ray.d]),
        }
    }

    /// Bounds the error of textbook code in every edge function:
    /// `128 U · thinness · |d| · extent²`.
    ///
    /// Lengths are measured in world space, not from the ray's origin: a plane test rounds its hit
    /// point there, and Plücker coordinates are products of positions. A triangle without area has
    /// no bound: its normal has no correct digits, and a test with weights from dot products may
    /// accept points far from it.
    pub(super) fn textbook_edge(&self, normal: Vec3) -> f64 {
        self.textbook_edge_of(thinness(self.sizes.normal_sizes, normal))
    }

    fn textbook_edge_of(&self, thinness: f64) -> f64 {
        TEXTBOOK_EDGE * thinness * sum_abs(self.d) * self.extent * self.extent
    }

    /// Whether two edge functions certainly have opposite signs, in exact arithmetic and for every
    /// correct kernel of this class. This is the filter: most rays miss, and need no integers.
    ///
    /// A triple product in `f64` has an error of at most `γ_7` times the sum of its absolute
    /// products, which is at most `2 |d| extent²`: less than half the textbook bound, so twice that
    /// bound is enough. Robust bounds are smaller than textbook bounds (doubled,
    /// `20 U · |d_z| · 4 extent²` at most): what surely misses for textbook code does so for both.
    ///
    /// For a robust kernel the edge functions are computed as it does. Their own error is half the
    /// bound, which is doubled: twice the bound is enough here, too.
    pub(super) fn surely_misses(&self, kernel: KernelClass) -> bool {
        let differ = |e: [f64; 3], bounds: [f64; 3]| {
            let is_beyond = |sign: f64| (0..3).any(|i| sign * e[i] > 2.0 * bounds[i]);
            is_beyond(1.0) && is_beyond(-1.0)
        };
        if !self.fits_f64 {
            return false;
        }
        match kernel {
            KernelClass::Textbook if self.sizes.thinness < THIN => {
                let [a, b, c] = self.relative;
                let e = [b.cross(c), c.cross(a), a.cross(b)].map(|normal| self.d.dot(normal));
                differ(e, [self.textbook_edge_of(self.sizes.thinness); 3])
            }
            KernelClass::Textbook => false,
            KernelClass::Robust => {
                let [a, b, c] = self.sheared();
                let edges = [(&b, &c), (&c, &a), (&a, &b)];
                let d_z = max_abs(self.d);
                let e = edges.map(|(p, q)| d_z * (p.x * q.y - p.y * q.x));
                differ(e, edges.map(|(p, q)| DOUBLED * d_z * p.cross_error(q)))
            }
        }
    }

    /// Bounds the error of textbook code in `t`.
    ///
    /// `A·n` and `d·n` sum the products `|A|·|n|` and `|d|·|n|` (a plane equation does not even
    /// subtract the origin first: `extent`). An edge function sums `|d| extent²`, and a `t` that is
    /// interpolated from the vertices' depths has that error times the edge's depth.
    pub(super) fn textbook_t(&self, det: f64, t: f64) -> f64 {
        let sizes = sum_abs(self.sizes.normal_sizes);
        let det_error = TEXTBOOK_T * self.d.abs().dot(self.sizes.normal_sizes);
        let interpolated = self.extent * self.extent * self.sizes.max_edge;
        let num_error = TEXTBOOK_T * (self.extent * sizes + interpolated);
        (num_error + t.abs() * det_error) / (det.abs() - det_error).max(0.0) + TEXTBOOK_T * t.abs()
    }

    /// Bounds the error of textbook code in a barycentric weight.
    pub(super) fn textbook_b(&self, normal: Vec3, det: f64) -> f64 {
        2.0 * self.textbook_edge(normal) / det.abs() + TEXTBOOK_T
    }

    /// The vertices after the shear that maps the ray to the z axis.
    fn sheared(&self) -> [Sheared; 3] {
        let z = self.d.abs().max_position();
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let d = self.d.to_array();
        let (shear_x, shear_y) = (d[x] / d[z], d[y] / d[z]);
        self.relative.map(|v| {
            let v = v.to_array();
            let error = |i: usize, shear: f64| gamma(SHEARED) * (v[i].abs() + (shear * v[z]).abs());
            Sheared {
                x: v[x] - shear_x * v[z],
                y: v[y] - shear_y * v[z],
                x_error: error(x, shear_x),
                y_error: error(y, shear_y),
            }
        })
    }

    /// Returns the error bounds of a robust kernel: see [`RobustBounds`].
    pub(super) fn robust(&self) -> RobustBounds {
        let z = self.d.abs().max_position();
        let d_z = self.d.to_array()[z];
        let sheared = self.sheared();
        let edge = |i: usize, j: usize| DOUBLED * d_z.abs() * sheared[i].cross_error(&sheared[j]);
        RobustBounds {
            edges: [edge(1, 2), edge(2, 0), edge(0, 1)],
            depths: self.relative.map(|v| (v.to_array()[z] / d_z).abs()),
        }
    }

    /// Bounds the error of each coordinate of a hit point, given the errors of its `t` and its
    /// weights.
    ///
    /// Textbook code computes `o + t·d`. Robust code interpolates the vertices, which keeps the
    /// point on the triangle's plane but moves it within the plane by the error of the weights.
    pub(super) fn position(&self, kernel: KernelClass, t: f64, b: f64) -> f64 {
        let interpolated = DOUBLED * (2.0 * b * self.sizes.max_edge + gamma(8.0) * self.extent);
        match kernel {
            KernelClass::Textbook => interpolated + t * max_abs(self.d) + gamma(4.0) * self.extent,
            KernelClass::Robust => interpolated,
        }
    }
}

/// A vertex after the shear that maps the ray to the z axis: its coordinates and their errors.
struct Sheared {
    x: f64,
    y: f64,
    x_error: f64,
    y_error: f64,
}

impl Sheared {
    /// Bounds the error of `x1·y2 - y1·x2`: the error of each factor times the other factor, and a
    /// rounding of each product and of the difference.
    fn cross_error(&self, other: &Sheared) -> f64 {
        let (a, b) = (self, other);
        let carried = |x: f64, x_error: f64, y: f64, y_error: f64| {
            x * y_error
                + y * x_error
                + x_error * y_error
                + gamma(2.0) * (x + x_error) * (y + y_error)
        };
        carried(a.x.abs(), a.x_error, b.y.abs(), b.y_error)
            + carried(b.x.abs(), b.x_error, a.y.abs(), a.y_error)
    }
}

/// The error bounds of a kernel that translates and shears the vertices and then computes 2D edge
/// functions (Woop, Benthin and Wald, *Watertight Ray/Triangle Intersection*, JCGT 2013), after
/// PBRT §6.8.7 and doubled.
pub(super) struct RobustBounds {
    /// Bound of each edge function.
    pub(super) edges: [f64; 3],
    /// Distance of each vertex along the ray: `|A_z / d_z|`.
    depths: [f64; 3],
}

impl RobustBounds {
    /// Bounds the error of `t = Σ e_i z_i / det`: PBRT's δt, doubled.
    pub(super) fn t(&self, e: [f64; 3], det: f64, t: f64) -> f64 {
        let z = self.depths;
        let by_edges: f64 = (0..3).map(|i| self.edges[i] * (z[i] + t.abs())).sum();
        let by_depths: f64 = (0..3).map(|i| e[i].abs() * z[i]).sum();
        let by_sums = DOUBLED * gamma(8.0) * by_depths;
        (by_edges + by_sums) / det.abs() + DOUBLED * gamma(4.0) * t.abs()
    }

    /// Returns the largest error of `t` if the hit is certain: see [`T_CAP`].
    pub(super) fn t_cap(&self) -> f64 {
        T_CAP * self.depths.iter().fold(0.0, |most, z| z.max(most))
    }

    /// Bounds the error of a barycentric weight, `e_i / det`.
    pub(super) fn b(&self, det: f64) -> f64 {
        let det_error: f64 = self.edges.iter().sum();
        2.0 * det_error / det.abs() + DOUBLED * gamma(4.0)
    }
}
