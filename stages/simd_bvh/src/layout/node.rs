//! A node: the boxes of up to eight children in single precision, the children, and their orders
//! from near to far.

use crate::layout::LANES;
use crate::layout::packed_box::PackedBox;
use kit::{Aabb, Vec3};

/// The boxes of up to eight children in the tree's space, one per lane, and the children.
///
/// The boxes contain their primitives with a margin, as [`PackedBox`] describes. Single precision
/// halves the memory and the width of the lanes. It cannot change a hit: boxes only cull, and hits
/// come from the tests of the primitives.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// For each axis the lower planes and then the upper ones. Lanes without a child have an empty
    /// box.
    planes: [[f32; 2 * LANES]; 3],
    /// The bits of the children.
    pub(crate) children: [u32; LANES],
    /// For each of [`ORDER_DIRECTIONS`] four times the numbers of the lanes, the nearest first.
    pub(crate) orders: [[u8; LANES]; 4],
}

/// A side of a box along an axis: the index of its first plane in a [`Node`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(usize)]
pub(crate) enum Side {
    #[default]
    Lower = 0,
    Upper = LANES,
}

impl Side {
    /// The sides by which a line with direction component `d` enters and leaves.
    #[inline(always)]
    pub(crate) fn crossed(d: f64) -> [Side; 2] {
        if d.is_sign_negative() {
            [Side::Upper, Side::Lower]
        } else {
            [Side::Lower, Side::Upper]
        }
    }
}

/// The planes of an axis of empty boxes.
const EMPTY_PLANES: [f32; 2 * LANES] = {
    let mut planes = [f32::INFINITY; 2 * LANES];
    let mut lane = LANES;
    while lane < 2 * LANES {
        planes[lane] = f32::NEG_INFINITY;
        lane += 1;
    }
    planes
};

/// The directions for which a node orders its children: one for each pair of opposite octants. For
/// the opposite direction the order is reversed.
const ORDER_DIRECTIONS: [[f32; 3]; 4] = [
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [1.0, -1.0, 1.0],
    [-1.0, -1.0, 1.0],
];

/// The number of the order for rays along `d`, and whether it is reversed.
#[inline(always)]
pub(crate) fn order_along(d: Vec3) -> (usize, bool) {
    let sign = |x: f64| (x.to_bits() >> 63) as usize;
    let z = sign(d.z);
    ((sign(d.x) ^ z) | (sign(d.y) ^ z) << 1, z == 1)
}

impl Node {
    /// A node with these children, at most eight, and their boxes, which have their margins.
    pub(crate) fn new(children: &[(PackedBox, Child)]) -> Node {
        let mut node = Node {
            planes: [EMPTY_PLANES; 3],
            children: [0; LANES],
            orders: [[0; LANES]; 4],
        };
        for (lane, (bounds, child)) in children.iter().enumerate() {
            for axis in 0..3 {
                node.planes[axis][lane] = bounds.min(axis);
                node.planes[axis][LANES + lane] = bounds.max(axis);
            }
            node.children[lane] = child.0;
        }
        for (order, direction) in node.orders.iter_mut().zip(ORDER_DIRECTIONS) {
            let mut keys = [(f32::INFINITY, 0); LANES];
            for (lane, key) in keys.iter_mut().enumerate() {
                if let Some((bounds, _)) = children.get(lane) {
                    let centroid = |axis| bounds.min(axis) + bounds.max(axis);
                    key.0 = (0..3).map(|axis| centroid(axis) * direction[axis]).sum();
                }
                key.1 = 4 * lane as u8;
            }
            keys.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            *order = keys.map(|key| key.1);
        }
        node
    }

    /// The box of a child, with its margin.
    pub(crate) fn bounds(&self, lane: usize) -> Aabb {
        let [min, max] = self.corners(lane).map(|p| Vec3::from(p.map(f64::from)));
        Aabb { min, max }
    }

    /// The lower and the upper corner of a child's box.
    #[inline(always)]
    pub(crate) fn corners(&self, lane: usize) -> [[f32; 3]; 2] {
        [Side::Lower, Side::Upper].map(|side| [0, 1, 2].map(|axis| self.planes(axis, side)[lane]))
    }

    /// The planes of the eight boxes on one side.
    #[inline(always)]
    pub(crate) fn planes(&self, axis: usize, side: Side) -> &[f32; LANES] {
        let first = side as usize;
        (&self.planes[axis][first..first + LANES])
            .try_into()
            .expect("eight planes")
    }
}

/// A child of a node: its index, in the two highest bits its kind, and in the three bits below the
/// number of its children or primitives less one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(pub(crate) u32);

/// The kind, the index and the number of children or primitives, one to eight, of a [`Child`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ChildKind {
    /// A node.
    Node { index: usize, count: u32 },
    /// A block of triangles.
    Triangles { index: usize, count: u32 },
    /// A block of spheres.
    Spheres { index: usize, count: u32 },
}

impl Child {
    const TRIANGLES: u32 = 1 << 30;
    const SPHERES: u32 = 1 << 31;
    const COUNT_BIT: u32 = 27;
    const LAST: u32 = (1 << Child::COUNT_BIT) - 1;
    /// Stands for no child; none of the kinds.
    pub(crate) const NONE: Child = Child(u32::MAX);

    pub(crate) fn node(index: usize, count: usize) -> Child {
        Child(Child::numbered(index, count))
    }

    pub(crate) fn triangles(index: usize, count: usize) -> Child {
        Child(Child::numbered(index, count) | Child::TRIANGLES)
    }

    pub(crate) fn spheres(index: usize, count: usize) -> Child {
        Child(Child::numbered(index, count) | Child::SPHERES)
    }

    fn numbered(index: usize, count: usize) -> u32 {
        assert!(
            index <= Child::LAST as usize,
            "a tree has at most 2^27 nodes and blocks of each kind"
        );
        index as u32 | (count as u32 - 1) << Child::COUNT_BIT
    }

    #[inline(always)]
    pub(crate) fn is_node(self) -> bool {
        self.0 < Child::TRIANGLES
    }

    #[inline(always)]
    pub(crate) fn is_triangles(self) -> bool {
        self.0 >> 30 == Child::TRIANGLES >> 30
    }

    #[inline(always)]
    pub(crate) fn is_spheres(self) -> bool {
        self.0 >> 30 == Child::SPHERES >> 30
    }

    #[inline(always)]
    pub(crate) fn index(self) -> usize {
        (self.0 & Child::LAST) as usize
    }

    #[inline(always)]
    pub(crate) fn count(self) -> u32 {
        (self.0 >> Child::COUNT_BIT & 7) + 1
    }

    #[inline(always)]
    pub(crate) fn kind(self) -> ChildKind {
        let (index, count) = (self.index(), self.count());
        if self.0 < Child::TRIANGLES {
            ChildKind::Node { index, count }
        } else if self.0 < Child::SPHERES {
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
    fn children_are_ordered_from_near_to_far() {
        let at = |x: f64, y: f64, z: f64| {
            let min = Vec3::new(x, y, z);
            let max = min + 0.1;
            (PackedBox::around(Aabb { min, max }), Child::node(0, 1))
        };
        let children = [at(1.0, 0.0, 0.0), at(0.0, 2.0, 0.0), at(0.0, 0.0, -3.0)];
        let node = Node::new(&children);
        for d in [
            Vec3::new(0.1, 0.2, 0.3),
            Vec3::new(-0.1, 0.2, 0.3),
            Vec3::new(0.1, -0.2, 0.3),
            Vec3::new(0.1, -0.2, -0.3),
            Vec3::new(-0.1, -0.2, -0.3),
        ] {
            let (order, is_reversed) = order_along(d);
            let mut lanes = node.orders[order].map(|byte| usize::from(byte) / 4);
            if is_reversed {
                lanes.reverse();
            }
            let octant = d.signum();
            let present = lanes.into_iter().filter(|&lane| lane < children.len());
            let along: Vec<f64> = present
                .map(|lane| node.bounds(lane).centroid().dot(octant))
                .collect();
            assert_eq!(along.len(), 3);
            assert!(along.is_sorted(), "{d}: {along:?}");
        }
    }

    #[test]
    fn children_keep_their_kind_and_index() {
        let kinds = [
            Child::node(7, 2).kind(),
            Child::triangles(0, 8).kind(),
            Child::spheres(9, 1).kind(),
        ];
        let expected = [
            ChildKind::Node { index: 7, count: 2 },
            ChildKind::Triangles { index: 0, count: 8 },
            ChildKind::Spheres { index: 9, count: 1 },
        ];
        assert_eq!(kinds, expected);
    }
}
