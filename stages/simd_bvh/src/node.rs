// BEGIN SOLUTION(part6.task1)
//! A node of eight children: their boxes in single precision, and what is below.

use crate::sah::LANES;
use kit::{Aabb, Vec3};

/// The boxes of up to eight children in the tree's space, one a lane, and the children.
///
/// The boxes are rounded outwards, so nothing sticks out of them; single precision halves the memory and the lanes'
/// width, and hits are decided by the primitives, never by a box.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// By axis the lower and the upper planes. Lanes without a child have an empty box.
    pub(crate) planes: [[[f32; LANES]; 2]; 3],
    pub(crate) children: [Child; LANES],
    /// How many lanes have a child.
    pub(crate) count: u32,
}

/// How far boxes are widened, as a share of their largest edge, before they are rounded.
///
/// Whether a ray passes a triangle's edge is decided on points that were rounded at the scale of the triangle, 2⁻⁵³ of it a
/// few times. So a ray may hit that passes beside by as much; the box must not say no to it.
const WIDENING: f64 = 1.0 / (1_u64 << 40) as f64;

/// And by so much at least, in the tree's space, whose size is 1: so flat boxes are met by rays within them, too.
const LEAST_WIDENING: f64 = 1.0 / (1_u64 << 60) as f64;

impl Node {
    /// No children.
    pub(crate) const EMPTY: Node = Node {
        planes: [[[f32::INFINITY; LANES], [f32::NEG_INFINITY; LANES]]; 3],
        children: [Child(0); LANES],
        count: 0,
    };

    /// Adds a child; there must be room.
    pub(crate) fn push(&mut self, bounds: &Aabb, child: Child) {
        let lane = self.count as usize;
        let margin = WIDENING * bounds.extent().max_element() + LEAST_WIDENING;
        for axis in 0..3 {
            let [lower, upper] = &mut self.planes[axis];
            lower[lane] = below(bounds.min[axis] - margin);
            upper[lane] = above(bounds.max[axis] + margin);
        }
        self.children[lane] = child;
        self.count += 1;
    }

    /// The box of a child as it is tested.
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

/// A single precision number below `x`, next to it or one further.
fn below(x: f64) -> f32 {
    (x as f32).next_down()
}

/// A single precision number above `x`, next to it or one further.
fn above(x: f64) -> f32 {
    (x as f32).next_up()
}

/// What is below a node: its number and, in the two highest bits, what it is a number of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(pub(crate) u32);

/// A [`Child`], spelled out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Below {
    /// A node, by its number.
    Node(u32),
    /// A block of triangles, by its number.
    Block(u32),
    /// A block of spheres, by its number.
    Spheres(u32),
}

impl Child {
    /// The first node.
    pub(crate) const ROOT: Child = Child(0);
    const BLOCK: u32 = 1 << 30;
    const SPHERES: u32 = 1 << 31;
    const NUMBER: u32 = Child::BLOCK - 1;

    pub(crate) fn node(number: u32) -> Child {
        Child(Child::checked(number))
    }

    pub(crate) fn block(number: u32) -> Child {
        Child(Child::checked(number) | Child::BLOCK)
    }

    pub(crate) fn spheres(number: u32) -> Child {
        Child(Child::checked(number) | Child::SPHERES)
    }

    fn checked(number: u32) -> u32 {
        assert!(number <= Child::NUMBER, "a tree of more than 2^30 parts");
        number
    }

    #[inline(always)]
    pub(crate) fn below(self) -> Below {
        let number = self.0 & Child::NUMBER;
        if self.0 <= Child::NUMBER {
            Below::Node(number)
        } else if self.0 & Child::BLOCK != 0 {
            Below::Block(number)
        } else {
            Below::Spheres(number)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_are_rounded_outwards_and_never_by_nothing() {
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
    fn children_keep_what_they_are() {
        assert_eq!(Child::node(7).below(), Below::Node(7));
        assert_eq!(Child::block(0).below(), Below::Block(0));
        assert_eq!(Child::spheres(9).below(), Below::Spheres(9));
    }
}
// END SOLUTION(part6.task1)
