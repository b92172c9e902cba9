//! The few large primitives of a scene, such as the walls of a room.
//!
//! A ray in a room meets its walls far more often than what stands in the room. The walls are a
//! short list, which lanes test in less time than a tree, and only rays that also cross one of a
//! few boxes around all other primitives need the tree.

use crate::primitive_list::PrimitiveList;
use crate::ray_packet::RayPacket;
use crate::vec3x8::{LANES, Vec3x8};
use fearless_simd::{Simd, f64x8, prelude::*};
use kit::{Aabb, PrimId, Scene, Vec3};

/// The large primitives of a scene, and where all others are.
#[derive(Clone, Debug)]
pub(crate) struct LargePrimitives {
    /// The large primitives.
    pub(crate) list: PrimitiveList,
    /// Boxes that together contain all others.
    others: Vec<Aabb>,
    /// The largest absolute value of their coordinates.
    reach: f64,
}

/// The largest number of boxes around the others.
const MAX_BOXES: usize = 8;

/// The time of testing one box against the time of tracing a ray through a tree (measured in a room
/// with a mesh of 30,000 triangles).
const COST_OF_BOX: f64 = 0.004;

/// The share of the coordinates by which the boxes are enlarged: much more than the rounding errors
/// of an intersection.
const MARGIN: f64 = 1e-10;

impl LargePrimitives {
    /// The primitives `ids` of `scene`, in ascending order; `None` if there are none.
    pub(crate) fn new(scene: &Scene, ids: &[PrimId]) -> Option<LargePrimitives> {
        if ids.is_empty() {
            return None;
        }
        let whole = boxes(scene).fold(Aabb::EMPTY, |sum, (_, bounds)| sum.union(bounds));
        let others = || boxes(scene).filter(|(id, _)| !ids.contains(id));
        let others = clusters(|| others().map(|(_, bounds)| bounds), whole.surface_area());
        let all = others.iter().fold(Aabb::EMPTY, |sum, b| sum.union(*b));
        Some(LargePrimitives {
            list: PrimitiveList::with(scene, ids),
            others,
            reach: all.min.abs().max(all.max.abs()).max_element(),
        })
    }

    /// Whether primitive `id` is one of them.
    pub(crate) fn has(&self, id: PrimId) -> bool {
        self.list.ids().any(|other| other == id.0)
    }

    /// The lanes, one bit each, in which a ray may hit one of the other primitives.
    #[inline(always)]
    pub(crate) fn may_hit_others<S: Simd>(&self, simd: S, rays: &RayPacket<S>) -> u64 {
        let (o, d) = (rays.o, rays.d);
        let inverse = Vec3x8 {
            x: 1.0 / d.x,
            y: 1.0 / d.y,
            z: 1.0 / d.z,
        };
        let margin = (o.x.abs() + o.y.abs() + o.z.abs() + self.reach) * MARGIN;
        // Relative to `t`, too, because the `t` of a hit is rounded.
        let end = rays.max_t + rays.max_t.abs() * MARGIN;
        let all = (1 << LANES) - 1;
        let mut missed = all;
        for bounds in &self.others {
            let low = Vec3x8::splat(simd, bounds.min) - o;
            let high = Vec3x8::splat(simd, bounds.max) - o;
            let x = slab(low.x - margin, high.x + margin, inverse.x);
            let y = slab(low.y - margin, high.y + margin, inverse.y);
            let z = slab(low.z - margin, high.z + margin, inverse.z);
            let entry = x[0]
                .max_precise(y[0])
                .max_precise(z[0].max_precise(rays.min_t));
            let exit = x[1].min_precise(y[1]).min_precise(z[1].min_precise(end));
            missed &= exit.simd_lt(entry).to_bitmask();
        }
        all & !missed
    }
}

/// The distances at which rays enter and leave the slab between two planes, which are at `low` and
/// `high` from the origin. A ray inside a plane gives NaN, which the comparisons leave out.
#[inline(always)]
fn slab<S: Simd>(low: f64x8<S>, high: f64x8<S>, inverse: f64x8<S>) -> [f64x8<S>; 2] {
    let (a, b) = (low * inverse, high * inverse);
    [a.min_precise(b), a.max_precise(b)]
}

/// All primitives and their boxes, without the empty ones, which no ray can hit.
fn boxes(scene: &Scene) -> impl Iterator<Item = (PrimId, Aabb)> {
    (0..)
        .map(PrimId)
        .zip(scene.primitive_bounds())
        .filter(|(_, bounds)| !bounds.is_empty())
}

/// A few boxes that together contain all `boxes`; `whole` is the surface area of the scene.
///
/// First there is one for each cell of a grid with boxes' centres in it. Then those whose union
/// costs least are united, until this would cost more than it saves.
fn clusters<I: Iterator<Item = Aabb>>(boxes: impl Fn() -> I, whole: f64) -> Vec<Aabb> {
    const CELLS: usize = 4;
    let bounds = boxes().fold(Aabb::EMPTY, Aabb::union);
    let mut cells = vec![Aabb::EMPTY; CELLS.pow(3)];
    let per_length = CELLS as f64 / bounds.extent().max(Vec3::splat(f64::MIN_POSITIVE));
    for member in boxes() {
        let at = (member.centroid() - bounds.min) * per_length;
        let [x, y, z] = at.to_array().map(|x| (x as usize).min(CELLS - 1));
        let cell = &mut cells[(z * CELLS + y) * CELLS + x];
        *cell = cell.union(member);
    }
    cells.retain(|cell| !cell.is_empty());
    while let Some((a, b, growth)) = closest_pair(&cells) {
        if cells.len() <= MAX_BOXES && growth > COST_OF_BOX * whole {
            break;
        }
        let removed = cells.swap_remove(b);
        cells[a] = cells[a].union(removed);
    }
    cells
}

/// The two boxes whose union has the least surface area beyond their own, the first one before the
/// second one, and this area.
fn closest_pair(boxes: &[Aabb]) -> Option<(usize, usize, f64)> {
    let pairs = (0..boxes.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
    pairs
        .map(|(a, b)| {
            let union = boxes[a].union(boxes[b]).surface_area();
            (
                a,
                b,
                union - boxes[a].surface_area() - boxes[b].surface_area(),
            )
        })
        .min_by(|a, b| a.2.total_cmp(&b.2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ray_packet::RayPacket;
    use kit::{PixelSampler, Ray, Sphere, Triangle};
    use lanes::dispatch;
    use lanes::instruction_sets;

    /// A floor, and above it two heaps of small triangles and a sphere. `scale` is the size of all.
    fn scene(sampler: &mut PixelSampler, scale: f64, shift: Vec3) -> Scene {
        let mut point = || {
            let p = sampler.next_2d();
            2.0 * Vec3::new(p.x, p.y, sampler.next_1d()) - 1.0
        };
        let at = |p: Vec3| scale * (p + shift);
        let corner = |x: f64, z: f64| at(Vec3::new(x, -1.0, z));
        let mut triangles = vec![Triangle::flat(
            corner(-3.0, -3.0),
            corner(3.0, -3.0),
            corner(0.0, 3.0),
        )];
        for i in 0..100 {
            let p = Vec3::X * f64::from(2 * (i % 2) - 1) + 0.2 * point();
            let [b, c] = [0.05, 0.05].map(|size| at(p + size * point()));
            triangles.push(Triangle::flat(at(p), b, c));
        }
        let spheres = vec![Sphere {
            center: at(Vec3::new(0.0, 0.5, 1.0)),
            radius: 0.2 * scale,
        }];
        Scene {
            triangles,
            spheres,
            ..Scene::default()
        }
    }

    /// The lanes' answer for one ray, the same at every instruction set.
    fn may_hit(large: &LargePrimitives, ray: &Ray) -> bool {
        let mut answers = instruction_sets().into_iter().map(|level| {
            dispatch!(level, simd => {
                let rays = RayPacket {
                    o: Vec3x8::splat(simd, ray.o),
                    d: Vec3x8::splat(simd, ray.d),
                    min_t: f64x8::splat(simd, ray.min_t),
                    max_t: f64x8::splat(simd, ray.max_t),
                };
                large.may_hit_others(simd, &rays)
            })
        });
        let first = answers.next().expect("an instruction set");
        assert!(answers.all(|answer| answer == first), "{ray:?}");
        assert!(first == 0 || first == 0xff, "{first:b}");
        first != 0
    }

    #[test]
    fn no_ray_that_hits_another_primitive_is_left_out() {
        let mut sampler = PixelSampler::new(1, 2, 3);
        for (scale, shift) in [(1.0, 0.0), (1e-6, 0.0), (1e5, 0.0), (0.01, 4e4)] {
            let scene = scene(&mut sampler, scale, Vec3::splat(shift));
            let large = LargePrimitives::new(&scene, &[PrimId(0)]).expect("a floor");
            assert_eq!((large.list.len(), large.others.len()), (1, 3));
            let (mut hits, mut misses) = (0, 0);
            for i in 0..20_000 {
                let t = &scene.triangles[1 + i % 100];
                let u = sampler.next_2d();
                // Points of the triangle and its vertices, seen from elsewhere and along axes.
                let b = [0.0, u.x, 1.0][i % 3];
                let target = t.p0 + b * (t.p1 - t.p0) + (1.0 - b) * u.y * (t.p2 - t.p0);
                let mut d = kit::warp::uniform_sphere(sampler.next_2d());
                if i % 5 == 0 {
                    d[i / 5 % 3] = 0.0;
                }
                if i % 7 == 0 {
                    d = [Vec3::X, Vec3::Y, -Vec3::Z][i / 7 % 3];
                }
                let mut ray = Ray::new(target - 3.0 * scale * u.x * d, d);
                let triangles = scene.triangles[1..].iter();
                let hits_of_triangles =
                    triangles.filter_map(|t| Some(intersect::test_triangle(t, &ray)?.t));
                let on_sphere = intersect::test_sphere(&scene.spheres[0], &ray);
                if let Some(t) = hits_of_triangles.chain(on_sphere).reduce(f64::min) {
                    // Exactly as far as the hit.
                    (ray.min_t, ray.max_t) = [(0.0, t), (t, f64::INFINITY)][i % 2];
                    hits += 1;
                    assert!(may_hit(&large, &ray), "{ray:?}");
                }
                let back = Ray::new(ray.o - 9.0 * scale * d, -d);
                misses += usize::from(!may_hit(&large, &back));
            }
            assert!(hits > 8_000 && misses > 15_000, "{hits} hit, {misses} miss");
        }
    }
}
