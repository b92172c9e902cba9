// BEGIN SOLUTION(part6.task2)
//! A room: so few primitives that eight rays ask all of them sooner than any box.

mod sphere;
#[cfg(test)]
mod tests;
mod triangle;

use crate::Neighbours;
use crate::lanes::lanes;
use crate::rays::{Hits, Rays};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{PrimId, Ray, Scene, Sphere, Vec3};
use triangle::{Seen, Turned};

/// Triangles by their corners, each of which is looked at once for all triangles that share it, and spheres.
#[derive(Clone, Debug)]
pub(crate) struct Room {
    corners: Vec<Vec3>,
    triangles: Vec<[usize; 3]>,
    spheres: Vec<Sphere>,
}

/// So many triangles and spheres at most: so few have no tree either.
const MOST_TRIANGLES: usize = 16;
const MOST_SPHERES: usize = 8;

/// Memory for a thread to work in: the corners as eight rays see them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch(Vec<Seen>);

/// What testing eight rays against a primitive says.
struct Verdict<S: Simd> {
    /// Hit at `t`, for certain.
    hit: mask64x8<S>,
    /// Not to be decided in lanes, one bit each: too close a call.
    unsure: u64,
    t: f64x8<S>,
    /// The weights of a triangle's second and third vertex, times `det`.
    v: f64x8<S>,
    w: f64x8<S>,
    det: f64x8<S>,
}

impl Room {
    /// `None` if `scene` is too large.
    pub(crate) fn new(scene: &Scene) -> Option<Room> {
        if scene.triangles.len() > MOST_TRIANGLES || scene.spheres.len() > MOST_SPHERES {
            return None;
        }
        let mut corners: Vec<Vec3> = Vec::new();
        let mut number = |p: Vec3| {
            let bits = |v: Vec3| v.to_array().map(f64::to_bits);
            let known = corners.iter().position(|&c| bits(c) == bits(p));
            known.unwrap_or_else(|| {
                corners.push(p);
                corners.len() - 1
            })
        };
        let triangles = scene.triangles.iter();
        let triangles = triangles.map(|t| [number(t.p0), number(t.p1), number(t.p2)]);
        Some(Room {
            triangles: triangles.collect(),
            corners,
            spheres: scene.spheres.clone(),
        })
    }

    /// How many primitives there are.
    pub(crate) fn len(&self) -> usize {
        self.triangles.len() + self.spheres.len()
    }

    /// The closest hits of the lanes in `asked`; of hits at equal `t` the one with the lowest number. `left` is passed over.
    #[inline(always)]
    pub(crate) fn closest<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        asked: u64,
        left: f64x8<S>,
        scratch: &mut Scratch,
        others: &impl Neighbours,
    ) -> Hits<S> {
        let turned = Turned::new(rays);
        turned.look(simd, &self.corners, &mut scratch.0);
        let mut hits = Hits::none(simd, rays.max_t);
        for i in 0..self.len() {
            let number = f64x8::splat(simd, i as f64);
            let asked = asked & left.simd_ne(number).to_bitmask();
            let Some(verdict) = self.test(simd, i, &turned, rays, hits.t, asked, scratch) else {
                continue;
            };
            // In the order of their numbers: the first of equals stays.
            let closer = verdict.hit & (verdict.t.simd_lt(hits.t) | hits.is_none());
            hits.prim = closer.select(number, hits.prim);
            hits.t = closer.select(verdict.t, hits.t);
            hits.v = closer.select(verdict.v, hits.v);
            hits.w = closer.select(verdict.w, hits.w);
            hits.det = closer.select(verdict.det, hits.det);
            for lane in lanes(verdict.unsure) {
                let ray = Ray {
                    max_t: hits.t[lane],
                    ..rays.lane(lane)
                };
                let id = PrimId(i as u32);
                if let Some(hit) = others.test(id, &ray)
                    && (hit.t < hits.t[lane] || hits.prim[lane] < 0.0)
                {
                    hits.set(lane, id, hit);
                }
            }
        }
        hits
    }

    /// Which of the lanes in `asked` hit anything but `left`, one bit each; and how many tests that took.
    #[inline(always)]
    pub(crate) fn occluded<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        asked: u64,
        left: f64x8<S>,
        scratch: &mut Scratch,
        others: &impl Neighbours,
    ) -> (u64, u64) {
        let turned = Turned::new(rays);
        turned.look(simd, &self.corners, &mut scratch.0);
        let (mut open, mut tests) = (asked, 0);
        for i in 0..self.len() {
            if open == 0 {
                break;
            }
            tests += u64::from(open.count_ones());
            let number = f64x8::splat(simd, i as f64);
            let asked = open & left.simd_ne(number).to_bitmask();
            let Some(verdict) = self.test(simd, i, &turned, rays, rays.max_t, asked, scratch)
            else {
                continue;
            };
            open &= !verdict.hit.to_bitmask();
            for lane in lanes(verdict.unsure) {
                if others.test(PrimId(i as u32), &rays.lane(lane)).is_some() {
                    open &= !(1 << lane);
                }
            }
        }
        (asked & !open, tests)
    }

    /// Primitive number `i`, of which the corners have been looked at.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "inlined into one loop each")]
    fn test<S: Simd>(
        &self,
        simd: S,
        i: usize,
        turned: &Turned<S>,
        rays: &Rays<S>,
        max_t: f64x8<S>,
        asked: u64,
        scratch: &Scratch,
    ) -> Option<Verdict<S>> {
        match self.triangles.get(i) {
            Some(&[a, b, c]) => {
                let seen = &scratch.0;
                turned.test(simd, [&seen[a], &seen[b], &seen[c]], rays, max_t, asked)
            }
            None => {
                let sphere = &self.spheres[i - self.triangles.len()];
                sphere::test(simd, sphere, rays, max_t, asked)
            }
        }
    }
}
// END SOLUTION(part6.task2)
