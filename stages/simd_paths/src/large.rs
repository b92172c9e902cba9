// BEGIN SOLUTION(part6.task2)
//! The few large primitives of a scene, such as the walls of a room.
//!
//! A ray in a room meets its walls far more often than what stands in the room. The walls are a
//! short list, which lanes test in less time than a tree, and only rays that also cross one of a
//! few boxes around all other primitives need the tree.

use crate::primitive_list::PrimitiveList;
use crate::ray_packet::RayPacket;
use crate::vec3x8::Vec3x8;
use fearless_simd::{Simd, f64x8, prelude::*};
use kit::{Aabb, PrimId, Primitive, Scene, Vec3};

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

    /// The lanes, one bit each, in which a ray may hit one of the other primitives up to `max_t`.
    #[inline(always)]
    pub(crate) fn may_hit_others<S: Simd>(
        &self,
        simd: S,
        rays: &RayPacket<S>,
        max_t: f64x8<S>,
    ) -> u64 {
        let (o, d) = (rays.o, rays.d);
        let inverse = Vec3x8 {
            x: 1.0 / d.x,
            y: 1.0 / d.y,
            z: 1.0 / d.z,
        };
        let margin = (o.x.abs() + o.y.abs() + o.z.abs() + self.reach) * MARGIN;
        // Relative to `t`, too, because the `t` of a hit is rounded.
        let end = max_t + max_t.abs() * MARGIN;
        let mut may_hit = 0;
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
            may_hit |= !exit.simd_lt(entry).to_bitmask();
        }
        may_hit
    }
}

/// The distances at which rays enter and leave the slab between two planes, which are at `low` and
/// `high` from the origin. A ray inside a plane gives NaN, which the comparisons leave out.
#[inline(always)]
fn slab<S: Simd>(low: f64x8<S>, high: f64x8<S>, inverse: f64x8<S>) -> [f64x8<S>; 2] {
    let (a, b) = (low * inverse, high * inverse);
    [a.min_precise(b), a.max_precise(b)]
}

/// All primitives and their boxes, without those that no ray can hit because a coordinate is NaN.
fn boxes(scene: &Scene) -> impl Iterator<Item = (PrimId, Aabb)> {
    let boxes = scene.primitives().map(|primitive| match primitive {
        Primitive::Triangle(triangle) => triangle.bounds(),
        Primitive::Sphere(sphere) => Aabb {
            min: sphere.center - sphere.radius.abs(),
            max: sphere.center + sphere.radius.abs(),
        },
    });
    (0..)
        .map(PrimId)
        .zip(boxes)
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
// END SOLUTION(part6.task2)
