//! Tests eight rays against triangles that share vertices.

use super::PacketTest;
use crate::ray_packet::RayPacket;
use crate::vec3x8::{LANES, Vec3x8};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::Vec3;
use lanes::triangle::{Axes, Edges, project};

/// A vertex, projected along each of eight rays.
pub(super) type ProjectedVertex = [[f64; LANES]; 3];

/// Eight rays whose axes are permuted, so that the z component of each direction has the largest
/// absolute value.
pub(super) struct AxisPermutedRays<S: Simd> {
    axes: Axes<f64x8<S>>,
    o: Vec3x8<S>,
    d: Vec3x8<S>,
}

impl<S: Simd> AxisPermutedRays<S> {
    #[inline(always)]
    pub(super) fn new(rays: &RayPacket<S>) -> AxisPermutedRays<S> {
        let axes = Axes::of(rays.d);
        AxisPermutedRays {
            axes,
            o: axes.permute(rays.o),
            d: axes.permute(rays.d),
        }
    }

    /// Projects `vertices` along the rays.
    #[inline(always)]
    pub(super) fn project(&self, simd: S, vertices: &[Vec3], projected: &mut Vec<ProjectedVertex>) {
        projected.resize(vertices.len(), ProjectedVertex::default());
        for (vertex, projected) in vertices.iter().zip(projected) {
            let p = self.axes.permute(Vec3x8::splat(simd, *vertex)) - self.o;
            let p = project(p, self.d);
            p.x.store_array(&mut projected[0]);
            p.y.store_array(&mut projected[1]);
            p.z.store_array(&mut projected[2]);
        }
    }

    /// Tests a triangle for hits up to `max_t`. Returns `None` if all lanes in `active` certainly
    /// miss.
    #[inline(always)]
    pub(super) fn test(
        &self,
        simd: S,
        [a, b, c]: [&ProjectedVertex; 3],
        rays: &RayPacket<S>,
        max_t: f64x8<S>,
        active: u64,
    ) -> Option<PacketTest<S>> {
        let (a, b, c) = (load(simd, a), load(simd, b), load(simd, c));
        let edges = Edges::of([a, b, c]);
        let misses = edges.agreement().simd_lt(f64x8::splat(simd, 0.0));
        let candidates = active & !misses.to_bitmask();
        if candidates == 0 {
            return None;
        }
        let crossing = edges.crossing([a.z, b.z, c.z], self.d.z);
        let hit = crossing.is_certain & RayPacket { max_t, ..*rays }.in_range(crossing.t);
        Some(PacketTest {
            hit: hit & mask64x8::from_bitmask(simd, candidates),
            undecided: candidates & !crossing.is_certain.to_bitmask(),
            t: crossing.t,
            v: crossing.v,
            w: crossing.w,
            det: crossing.det,
        })
    }
}

#[inline(always)]
fn load<S: Simd>(simd: S, vertex: &ProjectedVertex) -> Vec3x8<S> {
    Vec3x8 {
        x: f64x8::load_array_ref(simd, &vertex[0]),
        y: f64x8::load_array_ref(simd, &vertex[1]),
        z: f64x8::load_array_ref(simd, &vertex[2]),
    }
}
