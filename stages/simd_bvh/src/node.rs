// BEGIN SOLUTION(part6.task1)
//! A node: the boxes of up to eight children in single precision, and the children.

use crate::sah::LANES;
use kit::{Aabb, Vec3};

/// The boxes of up to eight children in the tree's space, one per lane, and the children.
///
/// The boxes are rounded outwards, so they contain their primitives. Single precision halves the
/// memory and the width of the lanes. It cannot change a hit: boxes only cull, and hits come from
/// the tests of the primitives.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// For each axis the lower and the upper planes. Lanes without a child have an empty box.
    pub(crate) planes: [[[f32; LANES]; 2]; 3],
    pub(crate) children: [Child; LANES],
    /// The number of children.
    pub(crate) count: u32,
}

/// The margin of a box as a share of its largest edge, added before rounding.
///
/// The triangle test has a few rounding errors, each of about 2⁻⁵³ of the triangle's size, so it
/// may report a hit for a ray that passes the triangle at such a distance. The margin makes this
/// ray hit the box as well.
const MARGIN: f64 = 1.0 / (1_u64 << 40) as f64;

/// The smallest margin of a box, in the tree's space, where the tree has a size of about 1. It
/// gives a flat box a thickness, so that a ray in the plane of the box hits it.
const MIN_MARGIN: f64 = 1.0 / (1_u64 << 60) as f64;

impl Node {
    /// A node without children.
    pub(crate) const EMPTY: Node = Node {
        planes: [[[f32::INFINITY; LANES], [f32::NEG_INFINITY; LANES]]; 3],
        children: [Child(0); LANES],
        count: 0,
    };

    /// Adds a child. The node must have fewer than eight children.
    pub(crate) fn push(&mut self, bounds: &Aabb, child: Child) {
        let lane = self.count as usize;
        let margin = MARGIN * bounds.extent().max_element() + MIN_MARGIN;
        for axis in 0..3 {
            let [lower, upper] = &mut self.planes[axis];
            lower[lane] = below(bounds.min[axis] - margin);
            upper[lane] = above(bounds.max[axis] + margin);
        }
        self.children[lane] = child;
        self.count += 1;
    }

    /// The box of a child, with its margin.
    pub(crate) fn bounds(&self, lane: usize) -> Aabb {
        let corner = |side: usize| {
            Vec3::from(std::array::from_fn(|axis| {
                f64::from(self.planes[axis][side][lane])
            }))
        };
        Aabb {
            min: corner(0),
            max: corner(1),
        }
    }
}

/// A single precision number less than `x`: the nearest or the second nearest.
fn below(x: f64) -> f32 {
    (x as f32).next_down()
}

/// A single precision number greater than `x`: the nearest or the second nearest.
fn above(x: f64) -> f32 {
    (x as f32).next_up()
}

/// A child of a node: its index, in the two highest bits its kind, and for blocks in the three bits
/// below the number of primitives less one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(pub(crate) u32);

/// The kind, the index and the number of primitives of a [`Child`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ChildKind {
    /// A node.
    Node { index: usize },
    /// A block of triangles.
    Triangles { index: usize, count: u32 },
    /// A block of spheres.
    Spheres { index: usize, count: u32 },
}

impl Child {
    /// The root node.
    pub(crate) const ROOT: Child = Child(0);
    const TRIANGLES: u32 = 1 << 30;
    const SPHERES: u32 = 1 << 31;
    const LAST_NODE: u32 = Child::TRIANGLES - 1;
    const COUNT_BIT: u32 = 27;
    const LAST_BLOCK: u32 = (1 << Child::COUNT_BIT) - 1;

    pub(crate) fn node(index: usize) -> Child {
        assert!(
            index <= Child::LAST_NODE as usize,
            "a tree has at most 2^30 nodes"
        );
        Child(index as u32)
    }

    /// A block of `count` triangles, one to eight.
    pub(crate) fn triangles(index: usize, count: usize) -> Child {
        Child(Child::block(index, count) | Child::TRIANGLES)
    }

    /// A block of `count` spheres, one to eight.
    pub(crate) fn spheres(index: usize, count: usize) -> Child {
        Child(Child::block(index, count) | Child::SPHERES)
    }

    fn block(index: usize, count: usize) -> u32 {
        assert!(
            index <= Child::LAST_BLOCK as usize,
            "a tree has at most 2^27 blocks of each kind"
        );
        index as u32 | (count as u32 - 1) << Child::COUNT_BIT
    }

    #[inline(always)]
    pub(crate) fn kind(self) -> ChildKind {
        if self.0 <= Child::LAST_NODE {
            let index = self.0 as usize;
            return ChildKind::Node { index };
        }
        let index = (self.0 & Child::LAST_BLOCK) as usize;
        let count = (self.0 >> Child::COUNT_BIT & 7) + 1;
        if self.0 & Child::TRIANGLES != 0 {
            ChildKind::Triangles { index, count }
        } else {
            ChildKind::Spheres { index, count }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_are_always_rounded_outwards() {
        for x in [
            0.0, 1.0, -1.0, 0.1, -0.1, 1e-300, -1e-300, 1e300, -1e300, 3.5e38,
        ] {
            assert!(f64::from(below(x)) < x, "{x}");
            assert!(f64::from(above(x)) > x, "{x}");
        }
        assert_eq!(above(f64::INFINITY), f32::INFINITY);
        assert_eq!(below(f64::NEG_INFINITY), f32::NEG_INFINITY);
    }

    #[test]
    fn children_keep_their_kind_and_index() {
        let kinds = [
            Child::node(7).kind(),
            Child::triangles(0, 8).kind(),
            Child::spheres(9, 1).kind(),
        ];
        let expected = [
            ChildKind::Node { index: 7 },
            ChildKind::Triangles { index: 0, count: 8 },
            ChildKind::Spheres { index: 9, count: 1 },
        ];
        assert_eq!(kinds, expected);
    }
}
// END SOLUTION(part6.task1)
