//! The triangles of a block as planes through the apex of a tile, and rays tested against them in
//! single precision.
//!
//! # Why no hit is lost
//!
//! Let `a b c` be the vertices of a triangle of the block relative to the apex. A ray along `d`
//! passes the triangle inside if `u = d·(b×c)`, `v = d·(c×a)` and `w = d·(a×b)` have the same sign.
//! It crosses the triangle's plane at `t = V/D` with `V = a·(b×c)` and `D = u + v + w = d·N` for the
//! normal `N = b×c + c×a + a×b`.
//!
//! The scalar kernel reports a hit exactly if 0 is inside the triangle of the *rounded* projected
//! vertices, edges included (see `kernels::triangle_filter`). Its rounding moves a vertex by at most
//! `n` on two axes, where `n` is the noise of [`RayInTree`](crate::kernels::ray_in_tree). A vertex
//! of the block is within half a unit of the true one on each axis. So the kernel decides about a
//! triangle of which each vertex is at most `δ = 0.87·unit + 2n` from that of the block, since
//! `√3/2 < 0.87` and `√2 < 2`; the rest of `2n` covers the double precision parts below.
//!
//! 1. *Edges.* For `b' = b + β` and `c' = c + γ` with `|β|, |γ| <= δ` the value changes by
//!    `β·(c×d) + γ·(d×b) + d·(β×γ)`, and `|c×d|` is `|d|` times the distance of `c` from the ray. If
//!    the ray passes the one triangle, this distance is at most the longest edge of that triangle,
//!    and so at most `L + 2δ` for the longest edge `L` of the other. So the change is at most
//!    `Q = |d|·δ·(2L + 5δ)`.
//! 2. *Rounding.* With `e = 2⁻²⁴`: normals and `d` are rounded to single precision, and a product of
//!    three components has three operations; together at most `5.1e·|d|·Σ|nᵢ|`. The normals are
//!    computed in double precision with an error of at most `2⁻⁵¹·far²` on an axis, for the farthest
//!    vertex. Sum: `F = |d|·(5.1e·Σ|nᵢ| + 2⁻⁴⁹·far²)`.
//! 3. *Decision.* With `E = Q + F`: if two of `u v w` are beyond `E` on different sides of 0, the
//!    kernel reports no hit; a lane that does not have this is *possible*. If all three are beyond
//!    `E` on one side, the kernel finds the ray inside.
//! 4. *Distance.* The kernel's hit `t·d` is a mean of its vertices with weights that are not
//!    negative, so it is within `δ` of a point of the block's plane: `t·D = V ± δ·|N|`, exactly, for
//!    the true `D`. Rounding the kernel's weights moves the point by less than `δ/100` if `D > 4E`,
//!    because that is at least `8·δ·L·|d|`, and `δ` is at least 2⁻¹⁷ of `L`. The computed `D` is
//!    within `3F + D·2⁻²²·1.1` of the true one (for a possible lane the sum of the three absolute
//!    values is at most `2D`). `V` is computed in double precision with an error of at most
//!    `2⁻⁴⁹·far³`, and `far³ <= far²·(1 + far²)`, then rounded. So `t` is between `(V - G)/(D + H)`
//!    and `(V + G)/(D - H)` with `H = 3F + 2⁻²⁰·D`, where three roundings of `e` are included. If a
//!    numerator is negative, the quotient is, too, which is all that is used of it.
//! 5. Without `D > 4E` the lane is possible at any distance and never sure.
//!
//! A comparison with NaN or infinity leaves a lane possible and not sure. Numbers too small for
//! single precision are far below `E`, which is at least `5|d|·δ²` with `δ > 2⁻³⁹`.

use crate::kernels::fused::mul_add;
use crate::kernels::triangle_filter::widened;
use crate::layout::LANES;
use crate::layout::triangle_block::TriangleBlock;
use fearless_simd::{Simd, f32x8, f64x8, prelude::*};
use kit::Vec3;

/// What the bounds of a tile depend on beside the triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileBounds {
    /// `2n`.
    pub(crate) noise: f64,
    /// At least the length of every direction.
    pub(crate) longest: f64,
}

/// The columns of [`PlaneBlock`] after the nine of the normals.
const ERROR: usize = 9;
const DET_ERROR: usize = 10;
const VOLUME: usize = 11;
const VOLUME_ERROR: usize = 12;
const COLUMNS: usize = 14;

/// The planes of the triangles of a block, by component and triangle.
#[repr(C, align(64))]
pub(crate) struct PlaneBlock([[f32; LANES]; COLUMNS]);

/// The planes of one triangle for many rays, or of eight triangles for one.
#[derive(Clone, Copy)]
pub(crate) struct Planes<F> {
    /// `b×c`, `c×a` and `a×b`.
    normals: [[F; 3]; 3],
    /// `E`.
    error: F,
    /// `3F`.
    det_error: F,
    /// `V` and `G`.
    volume: F,
    volume_error: F,
}

/// What rays and triangles have in common; masks have one bit a lane.
pub(crate) struct PlaneHits<F> {
    /// The lanes that may have a hit in the range.
    pub(crate) possible: u64,
    /// Those that have one for certain.
    pub(crate) sure: u64,
    /// For lanes of `sure`: the interval that contains `t`.
    pub(crate) nearest: F,
    pub(crate) farthest: F,
}

const E: f64 = 1.0 / (1 << 24) as f64;

/// `2⁻ⁿ`.
const fn negative_power(n: u32) -> f64 {
    1.0 / (1_u64 << n) as f64
}

/// Share of `D` in `H`, and margin at the ends of a range.
const SHARE: f32 = negative_power(20) as f32;

/// Enlarges a number by more than rounding it to single precision diminishes it.
const ROUND_UP: f64 = 1.0 + negative_power(22);

type Vector<S> = [f64x8<S>; 3];

#[inline(always)]
fn cross<S: Simd>(p: Vector<S>, q: Vector<S>) -> Vector<S> {
    [
        p[1] * q[2] - p[2] * q[1],
        p[2] * q[0] - p[0] * q[2],
        p[0] * q[1] - p[1] * q[0],
    ]
}

#[inline(always)]
fn dot<S: Simd>(p: Vector<S>, q: Vector<S>) -> f64x8<S> {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

#[inline(always)]
fn difference2<S: Simd>(p: Vector<S>, q: Vector<S>) -> f64x8<S> {
    let edge = [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    dot(edge, edge)
}

#[inline(always)]
fn abs_sum<S: Simd>(p: Vector<S>) -> f64x8<S> {
    p[0].abs() + p[1].abs() + p[2].abs()
}

/// The vertices number `vertex` of the triangles relative to the apex.
#[inline(always)]
fn vertices<S: Simd>(simd: S, block: &TriangleBlock, vertex: usize, apex: Vec3) -> Vector<S> {
    let o = apex.to_array();
    let mut vertices = [f64x8::splat(simd, 0.0); 3];
    for axis in 0..3 {
        let (low, high) = widened(simd, &block.vertices[vertex][axis]).widen();
        let start = f64::from(block.origin[axis]) - o[axis];
        vertices[axis] = low.combine(high) * f64::from(block.unit) + start;
    }
    vertices
}

impl PlaneBlock {
    /// The planes of the triangles of `block` through `apex`.
    #[inline(always)]
    pub(crate) fn new<S: Simd>(
        simd: S,
        block: &TriangleBlock,
        apex: Vec3,
        bounds: &TileBounds,
    ) -> PlaneBlock {
        let a = vertices(simd, block, 0, apex);
        let b = vertices(simd, block, 1, apex);
        let c = vertices(simd, block, 2, apex);
        let (bc, ca, ab) = (cross(b, c), cross(c, a), cross(a, b));
        let normal = [
            bc[0] + ca[0] + ab[0],
            bc[1] + ca[1] + ab[1],
            bc[2] + ca[2] + ab[2],
        ];
        let volume = dot(a, bc);
        let far2 = dot(a, a).max(dot(b, b)).max(dot(c, c));
        let edge2 = difference2(a, b)
            .max(difference2(b, c))
            .max(difference2(c, a));
        let shift = 0.87 * f64::from(block.unit) + bounds.noise;
        // The formulas of the module, 1, 2 and 4.
        let inexact = edge2.sqrt() * 2.0 + 5.0 * shift;
        let sum = abs_sum(bc).max(abs_sum(ca)).max(abs_sum(ab));
        let rounded = (sum * (5.1 * E) + far2 * negative_power(49)) * bounds.longest;
        let error = inexact * (shift * bounds.longest) + rounded;
        let moved = (dot(normal, normal).sqrt() + far2 * negative_power(48)) * (1.01 * shift);
        let volume_error =
            moved + far2 * (far2 + 1.0) * negative_power(49) + volume.abs() * negative_power(22);
        let columns = [
            [bc[0], bc[1]],
            [bc[2], ca[0]],
            [ca[1], ca[2]],
            [ab[0], ab[1]],
            [ab[2], error * ROUND_UP],
            [rounded * (3.0 * ROUND_UP), volume],
            [volume_error * ROUND_UP, volume],
        ];
        let mut block = PlaneBlock([[0.0; LANES]; COLUMNS]);
        let pairs = block.0.as_flattened_mut().chunks_exact_mut(2 * LANES);
        for (pair, [low, high]) in pairs.zip(columns) {
            low.narrow(high).store_slice(pair);
        }
        block
    }

    /// Those of all triangles, one in each lane.
    #[inline(always)]
    pub(crate) fn all<S: Simd>(&self, simd: S) -> Planes<f32x8<S>> {
        let zero = f32x8::splat(simd, 0.0);
        let mut planes = Planes::filled(zero);
        for edge in 0..3 {
            for axis in 0..3 {
                planes.normals[edge][axis] = f32x8::load_array_ref(simd, &self.0[3 * edge + axis]);
            }
        }
        planes.error = f32x8::load_array_ref(simd, &self.0[ERROR]);
        planes.det_error = f32x8::load_array_ref(simd, &self.0[DET_ERROR]);
        planes.volume = f32x8::load_array_ref(simd, &self.0[VOLUME]);
        planes.volume_error = f32x8::load_array_ref(simd, &self.0[VOLUME_ERROR]);
        planes
    }

    /// Those of triangle number `lane`, in all lanes.
    #[inline(always)]
    pub(crate) fn one<S: Simd, F: SimdFloat<S, Element = f32>>(
        &self,
        simd: S,
        lane: usize,
    ) -> Planes<F> {
        let lane = lane & (LANES - 1);
        let mut planes = Planes::filled(F::splat(simd, 0.0));
        for edge in 0..3 {
            for axis in 0..3 {
                planes.normals[edge][axis] = F::splat(simd, self.0[3 * edge + axis][lane]);
            }
        }
        planes.error = F::splat(simd, self.0[ERROR][lane]);
        planes.det_error = F::splat(simd, self.0[DET_ERROR][lane]);
        planes.volume = F::splat(simd, self.0[VOLUME][lane]);
        planes.volume_error = F::splat(simd, self.0[VOLUME_ERROR][lane]);
        planes
    }
}

/// The edge functions, and whether they exclude a hit.
pub(crate) struct EdgeValues<F> {
    pub(crate) possible: u64,
    least: F,
    most: F,
    det: F,
}

impl<F: Copy> Planes<F> {
    #[inline(always)]
    fn filled(x: F) -> Planes<F> {
        Planes {
            normals: [[x; 3]; 3],
            error: x,
            det_error: x,
            volume: x,
            volume_error: x,
        }
    }

    /// The triangles, one bit each, that no direction between `corners` can hit; `factor` is at
    /// least the ratio of a corner's errors to those of a ray.
    ///
    /// A direction between them is a mean of the corners, times its component along `w`, and so are
    /// its edge functions. So it is enough to look at the corners, with larger errors.
    #[inline(always)]
    pub(crate) fn outside<S: Simd>(&self, simd: S, corners: &[[f32; 3]; 4], factor: f32) -> u64
    where
        F: SimdFloat<S, Element = f32>,
    {
        let error = self.error * factor;
        let (mut below, mut above) = (0, 0);
        for normal in &self.normals {
            let (mut all_below, mut all_above) = (u64::MAX, u64::MAX);
            for corner in corners {
                let value = product(simd, normal, &corner.map(|x| F::splat(simd, x)));
                all_below &= value.simd_lt(-error).to_bitmask();
                all_above &= error.simd_lt(value).to_bitmask();
            }
            below |= all_below;
            above |= all_above;
        }
        below & above
    }

    /// Step 1 to 3 of the module.
    #[inline(always)]
    pub(crate) fn edges<S: Simd>(&self, simd: S, d: &[F; 3]) -> EdgeValues<F>
    where
        F: SimdFloat<S, Element = f32>,
    {
        let u = product(simd, &self.normals[0], d);
        let v = product(simd, &self.normals[1], d);
        let w = product(simd, &self.normals[2], d);
        let (least, most) = (u.min(v.min(w)), u.max(v.max(w)));
        let missed = least.simd_lt(-self.error) & self.error.simd_lt(most);
        EdgeValues {
            possible: !missed.to_bitmask(),
            least,
            most,
            det: u + v + w,
        }
    }

    /// Step 4 and 5: the hits in the range from `start`, which is not negative, to `end`.
    #[inline(always)]
    pub(crate) fn hits<S: Simd>(
        &self,
        simd: S,
        edges: &EdgeValues<F>,
        start: F,
        end: F,
    ) -> PlaneHits<F>
    where
        F: SimdFloat<S, Element = f32>,
    {
        let det = edges.det.abs();
        let volume = self.volume * F::splat(simd, 1.0).copysign(edges.det);
        let slack = mul_add(simd, det, F::splat(simd, SHARE), self.det_error);
        let nearest = (volume - self.volume_error) / (det + slack);
        let farthest = (volume + self.volume_error) / (det - slack);
        let is_bounded = (self.error * 4.0).simd_lt(det);
        let is_outside = is_bounded & (nearest.simd_gt(end) | farthest.simd_lt(start));
        let is_inside = self.error.simd_lt(edges.least) | edges.most.simd_lt(-self.error);
        let first = mul_add(
            simd,
            start,
            F::splat(simd, 1.0 + SHARE),
            F::splat(simd, f32::MIN_POSITIVE),
        );
        let last = end * (1.0 - SHARE);
        let sure = is_bounded & is_inside & nearest.simd_gt(first) & farthest.simd_lt(last);
        let possible = edges.possible & !is_outside.to_bitmask();
        PlaneHits {
            possible,
            sure: possible & sure.to_bitmask(),
            nearest,
            farthest,
        }
    }
}

#[inline(always)]
fn product<S: Simd, F: SimdFloat<S, Element = f32>>(simd: S, normal: &[F; 3], d: &[F; 3]) -> F {
    mul_add(
        simd,
        normal[0],
        d[0],
        mul_add(simd, normal[1], d[1], normal[2] * d[2]),
    )
}
