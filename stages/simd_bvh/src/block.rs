// BEGIN SOLUTION(part6.task1)
//! A leaf: eight triangles, tested at once.

use crate::sah::LANES;
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{PrimId, Ray, Triangle, TriangleHit};

/// Up to eight triangles, one a lane, in double precision: what counts is decided here.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(crate) struct Block {
    /// Coordinates by vertex and axis. Lanes without a triangle repeat the first one.
    vertices: [[[f64; LANES]; 3]; 3],
    ids: [u32; LANES],
    count: u32,
}

impl Block {
    /// The triangles `prims` of `triangles`, one to eight.
    pub(crate) fn of(triangles: &[Triangle], prims: &[PrimId]) -> Block {
        let id = |lane: usize| prims.get(lane).unwrap_or(&prims[0]).0;
        let vertex = |lane: usize, vertex: usize| {
            let t = &triangles[id(lane) as usize];
            [t.p0, t.p1, t.p2][vertex]
        };
        Block {
            vertices: std::array::from_fn(|v| {
                std::array::from_fn(|axis| std::array::from_fn(|lane| vertex(lane, v)[axis]))
            }),
            ids: std::array::from_fn(id),
            count: prims.len() as u32,
        }
    }

    /// How many triangles there are.
    #[inline(always)]
    pub(crate) fn len(&self) -> u32 {
        self.count
    }

    #[inline(always)]
    pub(crate) fn id(&self, lane: usize) -> PrimId {
        PrimId(self.ids[lane])
    }
}

/// What testing a block says, one bit a lane.
pub(crate) struct Tested<S: Simd> {
    /// Hit at `t`, for certain.
    pub(crate) hit: u32,
    /// Not to be decided in lanes: too close a call.
    pub(crate) unsure: u32,
    /// Where, for the lanes with a hit.
    t: f64x8<S>,
    /// The weights of the second and the third vertex, times `det`.
    v: f64x8<S>,
    w: f64x8<S>,
    det: f64x8<S>,
}

impl<S: Simd> Tested<S> {
    /// The hit in a lane that has one.
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

/// A ray as the lanes want it.
///
/// Numbers are kept, not lanes of them: filling lanes from memory costs nothing.
pub(crate) struct BlockRay {
    /// The axes that the kernel calls x, y and z: in a circle, z the one along which the ray is longest.
    axes: [usize; 3],
    o: [f64; 3],
    d: [f64; 3],
    min_t: f64,
}

/// Below this share of its terms the determinant has lost too many digits.
const CANCELLATION: f64 = 1.0 / 1024.0;

/// Products below may have underflowed on the way.
const SMALLEST: f64 = 1e-290;

// All of this is inlined into the walk, which is compiled for the instruction set: so there are no closures here, not
// even those of `array::map`.
impl BlockRay {
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> BlockRay {
        let size = ray.d.abs();
        let z = if size.z >= size.x && size.z >= size.y {
            2
        } else {
            usize::from(size.y >= size.x)
        };
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        // Arrays: a vector's index branches, and which axis it is is anyone's guess.
        let (o, d) = (ray.o.to_array(), ray.d.to_array());
        BlockRay {
            axes,
            o: [o[axes[0]], o[axes[1]], o[axes[2]]],
            d: [d[axes[0]], d[axes[1]], d[axes[2]]],
            min_t: ray.min_t,
        }
    }

    /// Tests all lanes by the arithmetic of the plain kernel, `intersect::test_triangle`, operation by operation: Woop,
    /// Benthin, Wald, "Watertight Ray/Triangle Intersection" (JCGT 2013). Where that one goes on to its careful twin,
    /// the lane is unsure, and it has to be asked.
    #[inline(always)]
    pub(crate) fn test<S: Simd>(&self, simd: S, block: &Block, max_t: f64) -> Tested<S> {
        let [a, b, c] = [
            self.vertex(simd, &block.vertices[0]),
            self.vertex(simd, &block.vertices[1]),
            self.vertex(simd, &block.vertices[2]),
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
            return Tested {
                hit: 0,
                unsure: 0,
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
        Tested {
            hit: candidates & is_sound & in_range.to_bitmask() as u32,
            unsure: candidates & !is_sound,
            t,
            v,
            w,
            det,
        }
    }

    /// One vertex of each triangle, as the kernel looks at it.
    #[inline(always)]
    fn vertex<S: Simd>(&self, simd: S, coordinates: &[[f64; LANES]; 3]) -> Vertex<S> {
        let d = [
            f64x8::splat(simd, self.d[0]),
            f64x8::splat(simd, self.d[1]),
            f64x8::splat(simd, self.d[2]),
        ];
        let x = f64x8::load_array_ref(simd, &coordinates[self.axes[0]]) - self.o[0];
        let y = f64x8::load_array_ref(simd, &coordinates[self.axes[1]]) - self.o[1];
        let z = f64x8::load_array_ref(simd, &coordinates[self.axes[2]]) - self.o[2];
        Vertex {
            x: x * d[2] - d[0] * z,
            y: y * d[2] - d[1] * z,
            z,
        }
    }
}

/// Where the lines through a vertex of each triangle along the ray cross the plane z = 0, seen from the ray's origin and
/// times the direction's z; and how far the vertices are from that plane.
struct Vertex<S: Simd> {
    x: f64x8<S>,
    y: f64x8<S>,
    z: f64x8<S>,
}

/// Whether products of several factors have neither underflowed nor overflowed on the way.
#[inline(always)]
fn is_ordinary<S: Simd>(simd: S, x: f64x8<S>) -> mask64x8<S> {
    let size = x.abs();
    f64x8::splat(simd, SMALLEST).simd_lt(size) & size.simd_lt(f64x8::splat(simd, f64::INFINITY))
}
// END SOLUTION(part6.task1)
