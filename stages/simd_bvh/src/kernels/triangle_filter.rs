//! Tests a ray against eight triangles at once in single precision: which it may hit, and which it
//! hits for certain.
//!
//! # Why the filter never drops a hit
//!
//! The scalar kernel (`intersect::test_triangle`) projects the vertices `a b c` along the ray into
//! the plane in which the ray is the point 0. It reports a hit exactly if 0 is inside the triangle
//! of the *rounded* projected vertices, edges included: a difference of two rounded products has
//! the exact sign or is 0, and then the careful variant finds the exact sign. The filter projects
//! the vertices of a [`TriangleBlock`], and measures in its units: coordinates are integers `q` of
//! at most 2¹⁶, within 1/2 of the true ones.
//!
//! Let `e = 2⁻²⁴`, the largest relative rounding error, `S` the larger absolute value of `d.x/d.z`
//! and `d.y/d.z`, which is at most 1, and `n` the error of the scalar kernel and of the double
//! precision parts below ([`TriangleFilter::noise`]), in units.
//!
//! 1. *Projected vertices.* `x' = (q.x - S·q.z) + k` with `k = (g.x - o.x) - S·(g.z - o.z)` for the
//!    block's origin `g`, computed in double precision. If 0 is inside the triangle, `|x'|` is at
//!    most the extent of the projection, 2¹⁷, and `|k|` at most 2¹⁸. Errors: `(1 + S)/2` from the
//!    integers, `2¹⁶e` from rounding `S`, `2¹⁷e` from the first operation, `2¹⁸e` from rounding
//!    `k`, `2¹⁷e` from the second operation, and `n`. Sum: less than `f = 0.51·(1 + S) + 0.04 + n`.
//! 2. *Edge functions.* `u = c'.x·b'.y - c'.y·b'.x` with factors of at most `m`, the largest
//!    absolute value of the block's six coordinates in the lane. The errors of the factors add
//!    `4f·m + 2f²`, the rounding of the two operations less than `3.1e·m²`. So `u`, `v` and `w`
//!    have an error of less than `E = m·(4f + 20e·m) + 2f²`. If the kernel reports a hit, no two of
//!    them are beyond `E` on different sides of 0: the lane is *possible*. If all are beyond `E` on
//!    one side, then 0 is inside the filter's triangle, so `m` is at most 2¹⁷, with it all of the
//!    above holds, and the kernel's `u`, `v` and `w` are on this side, too: the lane is *sure*, and
//!    the kernel reports a hit if its `t` is in the range.
//! 3. *Depth.* The hit is at `z = a.z + (v·(b.z - a.z) + w·(c.z - a.z))/det`; the differences are
//!    exact, and at most `h`. The true weights are those of 0 in the true triangle; in the filter's
//!    triangle they belong to a point within `f` of 0 on each axis. So the error is at most `f`
//!    times the sum of the two slopes of the filter's triangle, which are at most `4h·m/|det|`
//!    each. Rounding `u`, `v` and `w` adds at most `25e·m²·h/|det|`; both together are less than
//!    `2E·h/|det|`, and 1/8 of that is left for the rounding of the determinant. The other
//!    operations add at most `16e·2¹⁶ + 2¹⁷e` and the integers 1/2, so 0.7 with a margin, and `n`.
//!    The depth of a possible lane that is not sure differs from `a.z` by at most `h`, as the
//!    weights of a hit are not negative and their sum is 1.
//! 4. *Distance.* `t = z·T + R` with `T = unit/d.z` and `R = (g.z - o.z)/d.z`. Rounding both, the
//!    operation and the ends of the interval adds at most `4e·(|R| + 2¹⁷·|T|)`; a factor of `1.001`
//!    of the error in depth covers its own rounding.
//!
//! A comparison with NaN or infinity leaves a lane possible and not sure. The tests of the crate
//! compare with brute force, bit for bit, also at the borders of these bounds.

use crate::kernels::fused::mul_add;
use crate::kernels::ray_in_tree::RayInTree;
use crate::kernels::woop::axes_along;
use crate::layout::triangle_block::TriangleBlock;
use crate::rounding::{at_least, at_most};
use fearless_simd::{Simd, f32x8, i32x8, prelude::*, u16x8};

/// One ray, in the tree's space with permuted axes, such that z is the largest component of its
/// direction.
#[derive(Clone, Debug, Default)]
pub(crate) struct TriangleFilter {
    /// The axes that become x, y and z.
    pub(crate) axes: [usize; 3],
    o: [f64; 3],
    /// `-d.x/d.z` and `-d.y/d.z`.
    shear: [f64; 2],
    /// `1/d.z`.
    inverse: f64,
    /// `f` of the proof without `n`.
    error: f32,
    /// The error of the scalar kernel in the tree's space: 2⁻⁴⁸ of the distances, where less than
    /// 25 operations have 2⁻⁵³ each.
    noise: f32,
    /// Numbers at or below and at or above `min_t`, at or below `max_t` of the ray.
    min_t: [f32; 2],
    max_t: f32,
}

/// The result of testing a block; masks have one bit a lane.
pub(crate) struct FilterHits<S: Simd> {
    /// The lanes that may have a hit in the range.
    pub(crate) possible: u32,
    /// Those that have one for certain.
    pub(crate) sure: u32,
    nearest: f32x8<S>,
    farthest: f32x8<S>,
}

impl<S: Simd> FilterHits<S> {
    /// For a lane of `sure`: the interval that contains its `t`.
    #[inline(always)]
    pub(crate) fn interval(&self, lane: usize) -> [f32; 2] {
        [self.nearest[lane & 7], self.farthest[lane & 7]]
    }
}

/// The part of a test that does not depend on the ray's range.
#[derive(Clone, Copy)]
pub(crate) struct FilterEdges<S: Simd> {
    /// The lanes that may have a hit, at any distance.
    pub(crate) possible: u32,
    /// The third coordinates of the vertices.
    z: [f32x8<S>; 3],
    /// The edge functions.
    u: f32x8<S>,
    v: f32x8<S>,
    w: f32x8<S>,
    /// `E` of the proof.
    error: f32x8<S>,
}

impl<S: Simd> FilterEdges<S> {
    /// Those of a block without triangles.
    #[inline(always)]
    pub(crate) fn none(simd: S) -> FilterEdges<S> {
        let zero = f32x8::splat(simd, 0.0);
        FilterEdges {
            possible: 0,
            z: [zero; 3],
            u: zero,
            v: zero,
            w: zero,
            error: zero,
        }
    }
}

/// The largest relative rounding error.
const E: f32 = 1.0 / (1 << 24) as f32;

// All of this is inlined into the traversal, which is compiled for the instruction set. Closures
// may not be inlined, so there are none.
impl TriangleFilter {
    #[inline(always)]
    pub(crate) fn new(ray: &RayInTree) -> TriangleFilter {
        let axes = axes_along(ray.d);
        let z = axes[2];
        // Arrays: indexing a vector would branch, unpredictably.
        let (o, d) = (ray.o.to_array(), ray.d.to_array());
        let inverse = 1.0 / d[z];
        let shear = [-d[axes[0]] * inverse, -d[axes[1]] * inverse];
        let slant = shear[0].abs().max(shear[1].abs()) as f32;
        TriangleFilter {
            axes,
            o: [o[axes[0]], o[axes[1]], o[z]],
            shear,
            inverse,
            error: 0.51 * (1.0 + slant) + 0.04,
            noise: ray.noise(),
            min_t: [at_most(ray.min_t), at_least(ray.min_t)],
            max_t: at_most(ray.max_t),
        }
    }

    /// Tests the first `count` lanes for hits at any distance.
    #[inline(always)]
    pub(crate) fn edges<S: Simd>(
        &self,
        simd: S,
        block: &TriangleBlock,
        count: u32,
    ) -> FilterEdges<S> {
        let [x, y, z] = self.axes;
        let start = [
            f64::from(block.origin[x]) - self.o[0],
            f64::from(block.origin[y]) - self.o[1],
            f64::from(block.origin[z]) - self.o[2],
        ];
        let per_unit = f64::from(block.steps_per_length());
        let offset = [
            ((start[0] + self.shear[0] * start[2]) * per_unit) as f32,
            ((start[1] + self.shear[1] * start[2]) * per_unit) as f32,
        ];
        let a_z = widened(simd, &block.vertices[0][z]);
        let b_z = widened(simd, &block.vertices[1][z]);
        let c_z = widened(simd, &block.vertices[2][z]);
        let a = self.project(simd, &block.vertices[0], a_z, offset);
        let b = self.project(simd, &block.vertices[1], b_z, offset);
        let c = self.project(simd, &block.vertices[2], c_z, offset);
        let u = mul_add(simd, c[0], b[1], -(c[1] * b[0]));
        let v = mul_add(simd, a[0], c[1], -(a[1] * c[0]));
        let w = mul_add(simd, b[0], a[1], -(b[1] * a[0]));
        let reach = a[0].abs().max(a[1].abs()).max(b[0].abs().max(b[1].abs()));
        let reach = reach.max(c[0].abs().max(c[1].abs()));
        let noise = self.noise * per_unit as f32;
        let f = self.error + noise;
        let error = mul_add(simd, reach, 20.0 * E, 4.0 * f);
        let error = mul_add(simd, reach, error, 2.0 * f * f);
        let (least, most) = (u.min(v.min(w)), u.max(v.max(w)));
        let missed = least.simd_lt(-error) & error.simd_lt(most);
        FilterEdges {
            possible: !missed.to_bitmask() as u32 & first_lanes(count),
            z: [a_z, b_z, c_z],
            u,
            v,
            w,
            error,
        }
    }

    /// Tests the first `count` lanes for hits up to `limit`.
    #[inline(always)]
    pub(crate) fn test<S: Simd>(
        &self,
        simd: S,
        block: &TriangleBlock,
        count: u32,
        limit: f32,
    ) -> FilterHits<S> {
        let edges = self.edges(simd, block, count);
        if edges.possible == 0 {
            let zero = f32x8::splat(simd, 0.0);
            return FilterHits {
                possible: 0,
                sure: 0,
                nearest: zero,
                farthest: zero,
            };
        }
        self.hits(simd, block, &edges, limit)
    }

    /// Tests the lanes of `edges`, which are those of `block`, for hits up to `limit`.
    #[inline(always)]
    pub(crate) fn hits<S: Simd>(
        &self,
        simd: S,
        block: &TriangleBlock,
        edges: &FilterEdges<S>,
        limit: f32,
    ) -> FilterHits<S> {
        let FilterEdges {
            possible,
            z: [a_z, b_z, c_z],
            u,
            v,
            w,
            error,
        } = *edges;
        let z = self.axes[2];
        let start = f64::from(block.origin[z]) - self.o[2];
        let noise = self.noise * block.steps_per_length();
        let (least, most) = (u.min(v.min(w)), u.max(v.max(w)));
        let (b_z, c_z) = (b_z - a_z, c_z - a_z);
        let height = b_z.abs().max(c_z.abs());
        let reciprocal = 1.0 / (u + v + w);
        let inside = error.simd_lt(least) | most.simd_lt(-error);
        let depth = mul_add(simd, v, b_z, w * c_z);
        let depth = mul_add(simd, depth, reciprocal, a_z);
        let depth = inside.select(depth, a_z);
        let slack = inside.select(error * 2.25 * reciprocal.abs(), f32x8::splat(simd, 1.0));
        let slack = mul_add(simd, slack, height, 0.7 + noise);
        let per_depth = (f64::from(block.unit) * self.inverse) as f32;
        let at_origin = (start * self.inverse) as f32;
        let rounding = 4.0 * E * (at_origin.abs() + (1 << 17) as f32 * per_depth.abs());
        let t = mul_add(simd, depth, per_depth, at_origin);
        let t_error = mul_add(simd, slack, 1.001 * per_depth.abs(), rounding);
        let (nearest, farthest) = (t - t_error, t + t_error);
        let outside = nearest.simd_gt(limit) | farthest.simd_lt(self.min_t[0]);
        let sure = inside & nearest.simd_ge(self.min_t[1]) & farthest.simd_le(self.max_t);
        let possible = possible & !outside.to_bitmask() as u32;
        FilterHits {
            possible,
            sure: possible & sure.to_bitmask() as u32,
            nearest,
            farthest,
        }
    }

    /// Projects one vertex of each triangle along the ray to the plane `z = 0`, relative to the
    /// ray.
    #[inline(always)]
    fn project<S: Simd>(
        &self,
        simd: S,
        coordinates: &[[u16; 8]; 3],
        z: f32x8<S>,
        offset: [f32; 2],
    ) -> [f32x8<S>; 2] {
        let x = widened(simd, &coordinates[self.axes[0]]);
        let y = widened(simd, &coordinates[self.axes[1]]);
        [
            mul_add(simd, z, self.shear[0] as f32, x) + offset[0],
            mul_add(simd, z, self.shear[1] as f32, y) + offset[1],
        ]
    }
}

/// Eight integers as exact numbers in single precision.
#[inline(always)]
pub(crate) fn widened<S: Simd>(simd: S, integers: &[u16; 8]) -> f32x8<S> {
    let (low, high) = u16x8::load_array_ref(simd, integers).widen();
    f32x8::float_from(low.combine(high).bitcast::<i32x8<S>>())
}

/// The bits of the first `count` lanes.
#[inline(always)]
pub(crate) fn first_lanes(count: u32) -> u32 {
    (1 << count) - 1
}
