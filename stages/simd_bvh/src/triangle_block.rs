// BEGIN SOLUTION(part6.task1)
//! A leaf of up to eight triangles, which a ray tests at once.

use crate::sah::LANES;
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{PrimId, Ray, Triangle, TriangleHit};

/// Up to eight triangles, one per lane, in double precision: hits come from their tests, not from
/// the boxes.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(crate) struct TriangleBlock {
    /// Coordinates by vertex and axis. Lanes without a triangle repeat the first one.
    vertices: [[[f64; LANES]; 3]; 3],
    ids: [u32; LANES],
    count: u32,
}

impl TriangleBlock {
    /// A block of the triangles `prims` of `triangles`, one to eight.
    pub(crate) fn of(triangles: &[Triangle], prims: &[PrimId]) -> TriangleBlock {
        let id = |lane: usize| prims.get(lane).unwrap_or(&prims[0]).0;
        let vertex = |lane: usize, vertex: usize| {
            let t = &triangles[id(lane) as usize];
            [t.p0, t.p1, t.p2][vertex]
        };
        TriangleBlock {
            vertices: std::array::from_fn(|v| {
                std::array::from_fn(|axis| std::array::from_fn(|lane| vertex(lane, v)[axis]))
            }),
            ids: std::array::from_fn(id),
            count: prims.len() as u32,
        }
    }

    /// The number of triangles.
    #[inline(always)]
    pub(crate) fn len(&self) -> u32 {
        self.count
    }

    #[inline(always)]
    pub(crate) fn id(&self, lane: usize) -> PrimId {
        PrimId(self.ids[lane])
    }
}

/// The result of testing a block; masks have one bit a lane.
pub(crate) struct BlockHits<S: Simd> {
    /// The lanes with a certain hit, at `t`.
    pub(crate) hit: u32,
    /// The lanes that need the scalar kernel: rounding errors may be too large.
    pub(crate) undecided: u32,
    t: f64x8<S>,
    /// The barycentric weights of the second and third vertex, times `det`.
    v: f64x8<S>,
    w: f64x8<S>,
    det: f64x8<S>,
}

impl<S: Simd> BlockHits<S> {
    /// The hit in a lane of `hit`.
    #[inline(always)]
    pub(crate) fn at(&self, lane: usize) -> TriangleHit {
        let det = self.det[lane];
        TriangleHit {
            t: self.t[lane],
            b1: self.v[lane] / det,
            b2: self.w[lane] / det,
        }
    }
}

/// A ray whose axes are permuted cyclically, so that the z component of its direction has the
/// largest absolute value.
///
/// The fields are scalars: broadcasting them from memory costs nothing.
pub(crate) struct AxisPermutedRay {
    /// The axes that become x, y and z.
    axes: [usize; 3],
    o: [f64; 3],
    d: [f64; 3],
    min_t: f64,
}

/// A determinant below this share of its terms has lost too many digits by cancellation.
const CANCELLATION: f64 = 1.0 / 1024.0;

/// Below this, a factor of a product may have underflowed.
const SMALLEST: f64 = 1e-290;

// All of this is inlined into the traversal, which is compiled for the instruction set. Closures
// may not be inlined, so there are none, not even those of `array::map`.
impl AxisPermutedRay {
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> AxisPermutedRay {
        let size = ray.d.abs();
        let z = if size.z >= size.x && size.z >= size.y {
            2
        } else {
            usize::from(size.y >= size.x)
        };
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        // Arrays: indexing a vector would branch, unpredictably.
        let (o, d) = (ray.o.to_array(), ray.d.to_array());
        AxisPermutedRay {
            axes,
            o: [o[axes[0]], o[axes[1]], o[axes[2]]],
            d: [d[axes[0]], d[axes[1]], d[axes[2]]],
            min_t: ray.min_t,
        }
    }

    /// Tests all lanes for hits up to `max_t`. Repeats the arithmetic of `intersect::test_triangle`
    /// operation by operation (Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT
    /// 2013); where that switches to its careful variant, the lane is undecided.
    #[inline(always)]
    pub(crate) fn test<S: Simd>(&self, simd: S, block: &TriangleBlock, max_t: f64) -> BlockHits<S> {
        let [a, b, c] = [
            self.project(simd, &block.vertices[0]),
            self.project(simd, &block.vertices[1]),
            self.project(simd, &block.vertices[2]),
        ];
        let (cb, ac, ba) = (c.x * b.y, a.x * c.y, b.x * a.y);
        let u = cb - c.y * b.x;
        let v = ac - a.y * c.x;
        let w = ba - b.y * a.x;
        let agreement = u.min(v.min(w)) * u.max(v.max(w));
        let zero = f64x8::splat(simd, 0.0);
        let filled = (1 << block.count) - 1;
        let missed = agreement.simd_lt(zero).to_bitmask() as u32;
        let candidates = filled & !missed;
        if candidates == 0 {
            return BlockHits {
                hit: 0,
                undecided: 0,
                t: zero,
                v,
                w,
                det: zero,
            };
        }
        let det = u + v + w;
        let numerator = u * a.z + v * b.z + w * c.z;
        let denominator = det * self.d[2];
        let terms = cb.abs() + ac.abs() + ba.abs();
        let is_sound = zero.simd_lt(agreement)
            & (terms * CANCELLATION).simd_lt(det.abs())
            & is_ordinary(simd, numerator)
            & is_ordinary(simd, denominator);
        let is_sound = is_sound.to_bitmask() as u32;
        let t = numerator / denominator;
        let in_range =
            f64x8::splat(simd, self.min_t).simd_le(t) & t.simd_le(f64x8::splat(simd, max_t));
        BlockHits {
            hit: candidates & is_sound & in_range.to_bitmask() as u32,
            undecided: candidates & !is_sound,
            t,
            v,
            w,
            det,
        }
    }

    /// Projects one vertex of each triangle along the ray.
    #[inline(always)]
    fn project<S: Simd>(&self, simd: S, coordinates: &[[f64; LANES]; 3]) -> ProjectedVertex<S> {
        let d = [
            f64x8::splat(simd, self.d[0]),
            f64x8::splat(simd, self.d[1]),
            f64x8::splat(simd, self.d[2]),
        ];
        let x = f64x8::load_array_ref(simd, &coordinates[self.axes[0]]) - self.o[0];
        let y = f64x8::load_array_ref(simd, &coordinates[self.axes[1]]) - self.o[1];
        let z = f64x8::load_array_ref(simd, &coordinates[self.axes[2]]) - self.o[2];
        ProjectedVertex {
            x: x * d[2] - d[0] * z,
            y: y * d[2] - d[1] * z,
            z,
        }
    }
}

/// One vertex of each triangle, projected along the ray: relative to the ray's origin and with
/// permuted axes, x and y where the line through it along the ray crosses the plane z = 0, times
/// `d.z`, and its own z.
struct ProjectedVertex<S: Simd> {
    x: f64x8<S>,
    y: f64x8<S>,
    z: f64x8<S>,
}

/// Whether a product of several factors has neither underflowed nor overflowed.
#[inline(always)]
fn is_ordinary<S: Simd>(simd: S, x: f64x8<S>) -> mask64x8<S> {
    let size = x.abs();
    f64x8::splat(simd, SMALLEST).simd_lt(size) & size.simd_lt(f64x8::splat(simd, f64::INFINITY))
}
// END SOLUTION(part6.task1)
