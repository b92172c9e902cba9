// BEGIN SOLUTION(part6.task1)
//! The primitives of a convex region.

use crate::intersect::TestCounts;
use crate::node::{Child, ChildKind, Node};
use crate::sah::LANES;
use crate::space::TreeSpace;
use crate::wide::WideBvh;
use kit::{PrimId, Vec3};

/// A half-space in the tree's space: the points `p` with `normal·p <= offset`.
struct LocalHalfSpace {
    normal: [f64; 3],
    offset: f64,
}

/// The share of a sum's terms by which half-spaces are enlarged: much more than the rounding
/// errors.
const MARGIN: f64 = 1e-10;

impl LocalHalfSpace {
    fn new((normal, offset): (Vec3, f64), space: &TreeSpace) -> LocalHalfSpace {
        // A point p in world space is at p·scale - shift.
        let (shifted, scaled) = (normal * space.shift, offset * space.scale);
        let size = scaled.abs() + shifted.abs().element_sum();
        LocalHalfSpace {
            normal: normal.to_array(),
            offset: scaled - shifted.element_sum() + MARGIN * size,
        }
    }

    /// The children of `node`, one bit each, whose boxes are outside for certain.
    #[inline(always)]
    fn outside(&self, node: &Node) -> u32 {
        let (mut least, mut size) = ([0.0; LANES], [0.0; LANES]);
        for axis in 0..3 {
            // The corner that is deepest in the half-space.
            let planes = &node.planes[axis][usize::from(self.normal[axis] < 0.0)];
            for lane in 0..LANES {
                let term = self.normal[axis] * f64::from(planes[lane]);
                least[lane] += term;
                size[lane] += term.abs();
            }
        }
        let mut outside = 0;
        for lane in 0..LANES {
            outside |= u32::from(self.offset < least[lane] - MARGIN * size[lane]) << lane;
        }
        outside
    }
}

/// Adds the primitives of the boxes in `region` to `ids`, as [`WideBvh::primitives_in`] describes.
#[inline(always)]
pub(crate) fn find(
    tree: &WideBvh,
    region: &[(Vec3, f64)],
    most: usize,
    ids: &mut Vec<PrimId>,
    counts: &mut TestCounts,
) -> bool {
    let local = |half_space: &(Vec3, f64)| LocalHalfSpace::new(*half_space, &tree.space);
    let region: Vec<LocalHalfSpace> = region.iter().map(local).collect();
    let mut pending: Vec<Child> = tree.roots.clone();
    let mut visited = 0;
    while let Some(child) = pending.pop() {
        match child.kind() {
            ChildKind::Node { index, .. } => {
                visited += 1;
                if visited > most {
                    return false;
                }
                let node = &tree.nodes[index];
                counts.box_tests += u64::from(node.count);
                let mut inside = (1_u32 << node.count) - 1;
                for half_space in &region {
                    inside &= !half_space.outside(node);
                }
                while inside != 0 {
                    pending.push(node.children[inside.trailing_zeros() as usize]);
                    inside &= inside - 1;
                }
            }
            ChildKind::Triangles { index, count } => {
                let block = &tree.blocks[index];
                ids.extend((0..count as usize).map(|lane| block.id(lane)));
            }
            ChildKind::Spheres { index, count } => {
                let block = &tree.spheres[index];
                ids.extend((0..count as usize).map(|lane| block.id(lane)));
            }
        }
        if ids.len() > most {
            return false;
        }
    }
    true
}
// END SOLUTION(part6.task1)
