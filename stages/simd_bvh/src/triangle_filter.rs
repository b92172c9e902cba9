// BEGIN SOLUTION(part6.task1)
//! Tests a ray against eight triangles at once in single precision: which it may hit, and which it
//! hits for certain.
//!
//! # Why the filter never drops a hit
//!
//! The scalar kernel (`intersect::test_triangle`) projects the vertices `a b c` along the ray into
//! the plane in which the ray is the point 0. It reports a hit exactly if 0 is inside the triangle
//! of the *rounded* projected vertices, edges included: a difference of two rounded products has
//! the exact sign or is 0, and then the careful variant finds the exact sign. The filter projects
//! in the tree's space and single precision. All lengths below are in this space.
//!
//! Let `A` be a bound of all coordinates ([`TreeSpace::size`](crate::space::TreeSpace::size)), `C`
//! the larger absolute value of the two intercepts ([`TriangleFilter::intercepts`]), `R` the largest
//! edge of a triangle's box ([`TriangleBlock::sizes`]), `S` the larger absolute value of `d.x/d.z`
//! and `d.y/d.z`, which is at most 1, and `e = 2⁻²⁴`, the largest relative rounding error.
//!
//! 1. *Projected vertices.* `x' = (x - S·z) - c`. The errors are `e·A` from rounding `x`, twice
//!    `e·S·A` from rounding `S` and `z`, `e·|x - S·z|` and `e·|x'|` from the operations, `e·C` from
//!    rounding `c`. If the kernel reports a hit, a point of the triangle is projected to 0, so
//!    `|x'| <= 2R`, and `|x - S·z| <= 2R + C`. Sum: at most `e·(A + 2S·A + 2C + 4R)`. The rounding
//!    errors of the kernel are those of double precision, relative to the distance of the origin,
//!    which is at most 2¹⁸: less than `2⁻⁸·e`. So kernel and filter differ by less than
//!    `δ + 4e·R` with `δ = e·(1.1·A + 2S·A + 2C)`.
//! 2. *Edge functions.* `u = c'.x·b'.y - c'.y·b'.x` with factors of at most `2R`. The errors `f` of
//!    the factors add `8f·R + 2f²`, which is at most `R·(8δ + 33e·R) + 3δ²`; the rounding of the two
//!    operations adds `12e·(R + f)²`. So `u`, `v` and `w` have an error of less than
//!    `E = R·(9δ + 50e·R) + 4δ²`. If the kernel reports a hit, no two of them are beyond `E` on
//!    different sides of 0: the lane is *possible*. If all are beyond `E` on one side, the kernel's
//!    are on this side, too: the ray passes the inside of the triangle, the lane is *sure*, and the
//!    kernel reports a hit if its `t` is in the range.
//! 3. *Depth.* The hit is at `z = a.z + (v·(b.z - a.z) + w·(c.z - a.z))/det`. The true weights are
//!    those of 0 in the true triangle; in the filter's triangle they belong to a point within `f` of
//!    0 on each axis. So the error is at most `f` times the sum of the two slopes of the filter's
//!    triangle, which are at most `4R·(R + f)/|det|` each. Rounding `u`, `v` and `w` adds at most
//!    `40e·R³/|det|`, the sum of both is less than `2E·R/|det|`. The weights of the hit are not
//!    negative, and their sum is 1, so the rounding of the vertices adds at most `e·A`, the other
//!    operations less than `8e·R`, the last one `e·A`. For any possible lane that is not sure the
//!    error of `a.z` is at most `R + 2e·A`.
//! 4. *Distance.* `t = (z - o.z)/d.z`: rounding `o.z` adds `e·|o.z|`, the difference and the
//!    product with a rounded factor `3e·(|o.z| + A)`, the ends of the interval `e·(|o.z| + A)`, all
//!    divided by `|d.z|`.
//!
//! A comparison with NaN or infinity leaves a lane possible and not sure. The tests of the crate
//! compare with brute force, bit for bit, also at the borders of these bounds.

use crate::ray_in_tree::RayInTree;
use crate::triangle_block::TriangleBlock;
use fearless_simd::{Simd, f32x8, prelude::*};

/// One ray, in the tree's space with permuted axes, such that z is the largest component of its
/// direction.
///
/// The fields are scalars: broadcasting them from memory costs nothing.
pub(crate) struct TriangleFilter {
    /// The axes that become x, y and z.
    pub(crate) axes: [usize; 3],
    /// `-d.x/d.z` and `-d.y/d.z`.
    shear: [f32; 2],
    /// Where the ray crosses the plane `z = 0`.
    intercepts: [f32; 2],
    /// `E = (RESOLUTION·R + slope)·R + offset`.
    slope: f32,
    offset: f32,
    /// The error of a depth without the share of the triangle.
    depth_error: f32,
    /// `t = (z - depth)·inverse`.
    depth: f32,
    inverse: f32,
    /// The absolute value of `inverse`, with a margin.
    stretch: f32,
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
    /// The first `count` lanes, without a test.
    #[inline(always)]
    pub(crate) fn all(simd: S, count: u32) -> FilterHits<S> {
        let zero = f32x8::splat(simd, 0.0);
        FilterHits {
            possible: first_lanes(count),
            sure: 0,
            nearest: zero,
            farthest: zero,
        }
    }

    /// For a lane of `sure`: the interval that contains its `t`.
    #[inline(always)]
    pub(crate) fn interval(&self, lane: usize) -> [f32; 2] {
        [self.nearest[lane & 7], self.farthest[lane & 7]]
    }
}

/// The bits of the first `count` lanes.
#[inline(always)]
fn first_lanes(count: u32) -> u32 {
    (1 << count) - 1
}

/// The largest relative rounding error.
const E: f64 = 1.0 / (1 << 24) as f64;

/// The factor of `R` in the error of a depth.
const ROUNDING: f32 = 8.0 / (1 << 24) as f32;

/// The factor of `R²` in the error of an edge function.
const RESOLUTION: f32 = 50.0 / (1 << 24) as f32;

// All of this is inlined into the traversal, which is compiled for the instruction set. Closures
// may not be inlined, so there are none.
impl TriangleFilter {
    #[inline(always)]
    pub(crate) fn new(ray: &RayInTree) -> TriangleFilter {
        let size = ray.d.abs();
        let z = if size.z >= size.x && size.z >= size.y {
            2
        } else {
            usize::from(size.y >= size.x)
        };
        const NEXT: [usize; 4] = [1, 2, 0, 1];
        let axes = [NEXT[z], NEXT[z + 1], z];
        // Arrays: indexing a vector would branch, unpredictably.
        let (o, d) = (ray.o.to_array(), ray.d.to_array());
        let inverse = 1.0 / d[z];
        let shear = [d[axes[0]] * inverse, d[axes[1]] * inverse];
        let intercepts = [o[axes[0]] - shear[0] * o[z], o[axes[1]] - shear[1] * o[z]];
        let reach = intercepts[0].abs().max(intercepts[1].abs());
        let slant = shear[0].abs().max(shear[1].abs());
        let delta = E * (ray.size * (1.1 + 2.0 * slant) + 2.0 * reach);
        TriangleFilter {
            axes,
            shear: [-shear[0] as f32, -shear[1] as f32],
            intercepts: [intercepts[0] as f32, intercepts[1] as f32],
            slope: (9.0 * delta) as f32,
            offset: (4.0 * delta * delta) as f32,
            depth_error: (E * (6.0 * ray.size + 5.0 * o[z].abs())) as f32,
            depth: o[z] as f32,
            inverse: inverse as f32,
            stretch: (inverse.abs() * 1.001) as f32,
            min_t: [(ray.min_t as f32).next_down(), (ray.min_t as f32).next_up()],
            max_t: (ray.max_t as f32).next_down(),
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
        let [a, b, c] = [
            self.project(simd, &block.vertices[0]),
            self.project(simd, &block.vertices[1]),
            self.project(simd, &block.vertices[2]),
        ];
        let u = c[0].mul_sub_precise(b[1], c[1] * b[0]);
        let v = a[0].mul_sub_precise(c[1], a[1] * c[0]);
        let w = b[0].mul_sub_precise(a[1], b[1] * a[0]);
        let size = f32x8::load_array_ref(simd, &block.sizes);
        let error = size.mul_add_precise(RESOLUTION, self.slope);
        let error = size.mul_add_precise(error, self.offset);
        let (least, most) = (u.min(v.min(w)), u.max(v.max(w)));
        let missed = least.simd_lt(-error) & error.simd_lt(most);
        let possible = !missed.to_bitmask() as u32 & first_lanes(count);
        if possible == 0 {
            return FilterHits::all(simd, 0);
        }
        let z = self.axes[2];
        let a_z = f32x8::load_array_ref(simd, &block.vertices[0][z]);
        let b_z = f32x8::load_array_ref(simd, &block.vertices[1][z]) - a_z;
        let c_z = f32x8::load_array_ref(simd, &block.vertices[2][z]) - a_z;
        let det = u + v + w;
        let reciprocal = 1.0 / det;
        let inside = error.simd_lt(least) | most.simd_lt(-error);
        let depth = v.mul_add_precise(b_z, w * c_z);
        let depth = depth.mul_add_precise(reciprocal, a_z);
        let depth = inside.select(depth, a_z);
        let sure_error = (error * 2.0).mul_add_precise(reciprocal.abs(), ROUNDING) * size;
        let depth_error = inside.select(sure_error, size) + self.depth_error;
        let t = (depth - self.depth) * self.inverse;
        let t_error = depth_error * self.stretch;
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
    fn project<S: Simd>(&self, simd: S, coordinates: &[[f32; 8]; 3]) -> [f32x8<S>; 2] {
        let z = f32x8::load_array_ref(simd, &coordinates[self.axes[2]]);
        let x = f32x8::load_array_ref(simd, &coordinates[self.axes[0]]);
        let y = f32x8::load_array_ref(simd, &coordinates[self.axes[1]]);
        [
            z.mul_add_precise(self.shear[0], x) - self.intercepts[0],
            z.mul_add_precise(self.shear[1], y) - self.intercepts[1],
        ]
    }
}
// END SOLUTION(part6.task1)
