//! Which primitives of a scene are so large that they are better apart from the tree: the walls of
//! a room, the floor below an object.
//!
//! Most rays pass the boxes of such primitives whichever way they go, so below a node they save
//! nothing. As a list they can be tested in lanes, many rays at a time, and the rest of the tree
//! only where a ray also crosses the boxes of the rest.

use kit::{Aabb, PrimId};
use rayon::prelude::*;

/// The largest number of primitives that are apart.
const MAX_APART: usize = 16;

/// The time of testing one primitive of a list against the time of tracing a ray through the tree
/// (measured in a room with a mesh of 30,000 triangles).
const COST_OF_TEST: f64 = 0.01;

/// All tests and the share of the rays that need the tree as well have to cost less than this,
/// where tracing all rays through the tree costs 1.
const WORTHWHILE: f64 = 0.75;

/// The primitives to be apart, in ascending order: the largest ones, as many as make the expected
/// time least. None if that would not save time. `boxes` are those of all primitives, in ascending
/// order.
///
/// A ray that crosses the scene crosses a box in it with the probability that the surface area
/// heuristic assumes: the ratio of the surface areas.
pub(crate) fn choose(
    boxes: impl IndexedParallelIterator<Item = (PrimId, Option<Aabb>)>,
) -> Vec<PrimId> {
    let all = boxes
        .with_min_len(MIN_PARALLEL)
        .fold(Largest::default, Largest::with_box);
    let Largest {
        mut largest,
        mut others,
    } = all.reduce(Largest::default, Largest::with_all);
    if others.is_empty() {
        return Vec::new();
    }
    let whole = largest.iter().fold(others, |sum, (_, b)| sum.union(*b));
    let (mut least_cost, mut best) = (WORTHWHILE, 0);
    for count in (1..=largest.len()).rev() {
        let cost = COST_OF_TEST * count as f64 + others.surface_area() / whole.surface_area();
        if cost < least_cost {
            (least_cost, best) = (cost, count);
        }
        others = others.union(largest[count - 1].1);
    }
    largest.truncate(best);
    let mut ids: Vec<PrimId> = largest.into_iter().map(|(id, _)| id).collect();
    ids.sort_unstable();
    ids
}

/// A thread looks at this many boxes at once, or more.
const MIN_PARALLEL: usize = 1 << 12;

/// The primitives with the largest boxes, the largest first, and the box of all others.
struct Largest {
    largest: Vec<(PrimId, Aabb)>,
    others: Aabb,
}

impl Default for Largest {
    fn default() -> Largest {
        Largest {
            largest: Vec::with_capacity(MAX_APART + 1),
            others: Aabb::EMPTY,
        }
    }
}

impl Largest {
    /// With one more primitive, behind all that it has; without its box it does not count.
    fn with_box(mut self, (id, bounds): (PrimId, Option<Aabb>)) -> Largest {
        let Some(bounds) = bounds else {
            return self;
        };
        let area = bounds.surface_area();
        let is_larger = |(_, other): &(PrimId, Aabb)| other.surface_area() >= area;
        let place = match self.largest.last() {
            Some(last) if self.largest.len() == MAX_APART && is_larger(last) => MAX_APART,
            _ => self.largest.partition_point(is_larger),
        };
        if place == MAX_APART {
            self.others = self.others.union(bounds);
            return self;
        }
        self.largest.insert(place, (id, bounds));
        if self.largest.len() > MAX_APART
            && let Some((_, bounds)) = self.largest.pop()
        {
            self.others = self.others.union(bounds);
        }
        self
    }

    /// With those of the primitives behind.
    fn with_all(mut self, behind: Largest) -> Largest {
        self.others = self.others.union(behind.others);
        let boxes = behind.largest.into_iter();
        boxes.fold(self, |all, (id, bounds)| all.with_box((id, Some(bounds))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::Vec3;
    use meshes::{MeshKind, generate};

    fn chosen(boxes: &[Aabb]) -> Vec<u32> {
        let numbered = boxes.par_iter().enumerate();
        let chosen = choose(numbered.map(|(i, bounds)| (PrimId(i as u32), Some(*bounds))));
        chosen.iter().map(|id| id.0).collect()
    }

    #[test]
    fn nothing_is_apart_in_a_mesh() {
        for kind in MeshKind::ALL {
            let mesh = generate(kind, 2000);
            let boxes: Vec<Aabb> = mesh.iter().map(|t| t.bounds()).collect();
            assert_eq!(chosen(&boxes), [], "{kind:?}");
        }
        assert_eq!(chosen(&[]), []);
    }

    #[test]
    fn only_what_is_large_is_apart() {
        // Several threads look at parts of so many.
        let mesh = generate(MeshKind::Knot, 20_000);
        let mut boxes: Vec<Aabb> = mesh.iter().map(|t| t.bounds()).collect();
        let size = boxes
            .iter()
            .fold(Aabb::EMPTY, |sum, &b| sum.union(b))
            .extent();
        let wall = |at: f64| Aabb {
            min: Vec3::new(-5.0, -5.0, at) * size,
            max: Vec3::new(5.0, 5.0, at) * size,
        };
        boxes.insert(7, wall(-5.0));
        boxes.push(wall(5.0));
        let last = boxes.len() as u32 - 1;
        assert_eq!(chosen(&boxes), [7, last]);
        // With twenty walls most would stay in the tree.
        boxes.extend((0..18).map(|i| wall(f64::from(i) / 2.0)));
        assert_eq!(chosen(&boxes), []);
    }
}
