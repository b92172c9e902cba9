//! Writes the nodes of the wide tree, in parallel: every subtree knows how many nodes and blocks it
//! adds, so its place is known before those to its left are written.

use crate::build::binary::{BinaryTree, NodeRef, WideSize};
use crate::build::collapse::{WideChild, wide_children};
use crate::build::sah::BuildPrimitive;
use crate::layout::LANES;
use crate::layout::node::{Child, Node};
use crate::layout::packed_box::PackedBox;
use rayon::prelude::*;
use std::ops::Range;

/// From this many nodes on, the subtrees below a node are written in parallel.
const MIN_PARALLEL: usize = 256;

/// The nodes of a wide tree, the root first, and the places in the tree's order of the primitives
/// of each block.
#[derive(Default)]
pub(crate) struct WideNodes {
    pub(crate) nodes: Vec<Node>,
    pub(crate) triangle_blocks: Vec<Range<u32>>,
    pub(crate) sphere_blocks: Vec<Range<u32>>,
}

impl WideNodes {
    /// Adds blocks that are below no node: of the triangles and the spheres at these places.
    /// Returns them.
    pub(crate) fn add_blocks(
        &mut self,
        triangles: Range<usize>,
        spheres: Range<usize>,
    ) -> Vec<Child> {
        let mut blocks = Vec::new();
        for range in ranges(triangles) {
            blocks.push(Child::triangles(self.triangle_blocks.len(), range.len()));
            self.triangle_blocks.push(range);
        }
        for range in ranges(spheres) {
            blocks.push(Child::spheres(self.sphere_blocks.len(), range.len()));
            self.sphere_blocks.push(range);
        }
        blocks
    }
}

/// The ranges of blocks: [`LANES`] each, the last one may have fewer.
fn ranges(all: Range<usize>) -> impl Iterator<Item = Range<u32>> {
    all.clone().step_by(LANES).map(move |start| {
        let end = all.end.min(start + LANES);
        start as u32..end as u32
    })
}

/// The wide tree for `tree`, whose root is not a leaf of one block. `prims` are in the tree's
/// order.
pub(crate) fn widen(tree: &BinaryTree, prims: &[BuildPrimitive]) -> (WideNodes, Child) {
    let root = tree.root();
    let size = root.get().size;
    let mut wide = WideNodes {
        nodes: vec![Node::new(&[]); size.nodes as usize],
        triangle_blocks: vec![0..0; size.triangle_blocks as usize],
        sphere_blocks: vec![0..0; size.sphere_blocks as usize],
    };
    let children = wide_children(root);
    let child = Child::node(0, children.len());
    let place = Place {
        first: WideSize::default(),
        nodes: &mut wide.nodes,
        triangle_blocks: &mut wide.triangle_blocks,
        sphere_blocks: &mut wide.sphere_blocks,
    };
    write(children, place, prims);
    (wide, child)
}

/// Where a subtree is written.
struct Place<'w> {
    /// The numbers of the first node and of the first blocks.
    first: WideSize,
    nodes: &'w mut [Node],
    triangle_blocks: &'w mut [Range<u32>],
    sphere_blocks: &'w mut [Range<u32>],
}

impl<'w> Place<'w> {
    /// Cuts off the front, for a subtree of this size.
    fn take(&mut self, size: WideSize) -> Place<'w> {
        let first = self.first;
        self.first = first + size;
        Place {
            first,
            nodes: take(&mut self.nodes, size.nodes),
            triangle_blocks: take(&mut self.triangle_blocks, size.triangle_blocks),
            sphere_blocks: take(&mut self.sphere_blocks, size.sphere_blocks),
        }
    }
}

fn take<'w, T>(slice: &mut &'w mut [T], count: u32) -> &'w mut [T] {
    slice
        .split_off_mut(..count as usize)
        .expect("a subtree is not larger than the tree")
}

/// Writes the wide node with these children and the nodes below it.
fn write(children: Vec<WideChild<'_>>, mut place: Place<'_>, prims: &[BuildPrimitive]) {
    let own = WideSize {
        nodes: 1,
        ..WideSize::default()
    };
    let node = place.take(own).nodes;
    let is_large = place.nodes.len() >= MIN_PARALLEL;
    let mut entries = Vec::with_capacity(LANES);
    let mut below = Vec::with_capacity(LANES);
    for child in children {
        let place = place.take(size_of(child));
        entries.push(match child {
            WideChild::Node(node) => {
                let children = wide_children(node);
                let child = Child::node(place.first.nodes as usize, children.len());
                below.push((children, place));
                (node.get().bounds, child)
            }
            WideChild::Triangles(leaf) => {
                let range = leaf.get().triangles();
                let entry = (bounds(leaf, &range, prims), range.len());
                place.triangle_blocks[0] = range;
                let number = place.first.triangle_blocks as usize;
                (entry.0, Child::triangles(number, entry.1))
            }
            WideChild::Spheres(leaf) => {
                let range = leaf.get().spheres();
                let entry = (bounds(leaf, &range, prims), range.len());
                place.sphere_blocks[0] = range;
                let number = place.first.sphere_blocks as usize;
                (entry.0, Child::spheres(number, entry.1))
            }
        });
    }
    node[0] = Node::new(&entries);
    if is_large {
        let below = below.into_par_iter();
        below.for_each(|(children, place)| write(children, place, prims));
    } else {
        for (children, place) in below {
            write(children, place, prims);
        }
    }
}

/// What a child adds to the tree.
fn size_of(child: WideChild<'_>) -> WideSize {
    let none = WideSize::default();
    match child {
        WideChild::Node(node) => node.get().size,
        WideChild::Triangles(_) => WideSize {
            triangle_blocks: 1,
            ..none
        },
        WideChild::Spheres(_) => WideSize {
            sphere_blocks: 1,
            ..none
        },
    }
}

/// The box of the primitives of a leaf in `range`, which are all of one kind.
fn bounds(leaf: NodeRef<'_>, range: &Range<u32>, prims: &[BuildPrimitive]) -> PackedBox {
    let leaf = leaf.get();
    if leaf.size.triangle_blocks + leaf.size.sphere_blocks == 1 {
        return leaf.bounds;
    }
    let prims = &prims[range.start as usize..range.end as usize];
    let boxes = prims.iter().map(BuildPrimitive::bounds);
    boxes.fold(PackedBox::EMPTY, PackedBox::union)
}
