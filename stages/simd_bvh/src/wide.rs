//! The tree that is walked: nodes of eight children, leaves of eight triangles, both laid out for lanes.

// BEGIN SOLUTION(part6.task1)
use crate::binary;
use crate::block::Block;
use crate::collapse::Collapse;
use crate::node::{Child, Node};
use crate::sah::LANES;
use crate::space::Space;
use crate::sphere_block::SphereBlock;
use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId};
// END SOLUTION(part6.task1)

use fearless_simd::Level;
use kit::{Sphere, Triangle};

/// A wide bounding volume hierarchy over triangles and spheres.
///
/// It holds the triangles' vertices and nothing else of them. Primitives are numbered as in a [`kit::Scene`]:
/// triangles first, then spheres.
#[derive(Clone, Debug)]
pub struct WideBvh {
    // BEGIN SOLUTION(part6.task1)
    /// The root is the first one. None if all that there is to hit is a few blocks.
    pub(crate) nodes: Vec<Node>,
    /// The triangles, eight at a time.
    pub(crate) blocks: Vec<Block>,
    /// The spheres, eight at a time.
    pub(crate) spheres: Vec<SphereBlock>,
    /// Where boxes lie. Triangles and spheres are in the world's space.
    pub(crate) space: Space,
    /// The instructions that it is walked with.
    pub(crate) level: Level,
    // STUB: // Whatever you need.
    // END SOLUTION(part6.task1)
}

impl WideBvh {
    /// Builds the tree. A primitive with a NaN or an infinite coordinate or a negative radius is left out: no ray hits it.
    pub fn build(triangles: &[Triangle], spheres: &[Sphere]) -> WideBvh {
        // BEGIN SOLUTION(part6.task1)
        let boxes = triangles.iter().map(Triangle::bounds);
        let mut bounds: Vec<Aabb> = boxes.chain(spheres.iter().map(Sphere::bounds)).collect();
        for b in &mut bounds {
            if !(b.min.is_finite() && b.max.is_finite()) {
                *b = Aabb::EMPTY;
            }
        }
        let prims: Vec<PrimId> = (0..bounds.len() as u32)
            .map(PrimId)
            .filter(|id| !bounds[id.0 as usize].is_empty())
            .collect();
        let sound: Vec<Aabb> = prims.iter().map(|id| bounds[id.0 as usize]).collect();
        let space = Space::around(&sound);
        for b in bounds.iter_mut().filter(|b| !b.is_empty()) {
            *b = space.bounds(*b);
        }
        let mut builder = Builder {
            bounds: &bounds,
            triangles,
            spheres,
            tree: WideBvh {
                nodes: Vec::new(),
                blocks: Vec::new(),
                spheres: Vec::new(),
                space,
                level: Level::new(),
            },
        };
        let (triangles, spheres) = builder.by_kind(&prims);
        if triangles.len() <= FEW_TRIANGLES && spheres.len() <= LANES {
            for block in triangles.chunks(LANES).chain(spheres.chunks(LANES)) {
                builder.block(block);
            }
        } else {
            let halved = binary::build(&bounds);
            let is_mixed = |node: &BvhNode| builder.kinds(&halved, node).is_some();
            let collapse = Collapse::cheapest(&halved, is_mixed);
            builder.widen(&halved, &collapse, 0);
        }
        builder.tree
        // STUB: kit::hole!("part6.task1", triangles, spheres)
        // END SOLUTION(part6.task1)
    }

    /// The same tree, walked with the instructions of `level` instead of the best that this machine has. It says and
    /// counts the same.
    #[must_use]
    pub fn at_level(self, level: Level) -> WideBvh {
        // BEGIN SOLUTION(part6.task1)
        WideBvh { level, ..self }
        // STUB: kit::hole!("part6.task1", self, level)
        // END SOLUTION(part6.task1)
    }

    /// How many nodes there are.
    pub fn node_count(&self) -> usize {
        // BEGIN SOLUTION(part6.task1)
        self.nodes.len()
        // STUB: kit::hole!("part6.task1", self)
        // END SOLUTION(part6.task1)
    }

    /// How many blocks there are, of up to eight triangles or spheres.
    pub fn block_count(&self) -> usize {
        // BEGIN SOLUTION(part6.task1)
        self.blocks.len() + self.spheres.len()
        // STUB: kit::hole!("part6.task1", self)
        // END SOLUTION(part6.task1)
    }
}

// BEGIN SOLUTION(part6.task1)
/// So many triangles are asked one block after the other, without nodes: a box costs about as much as a block.
const FEW_TRIANGLES: usize = 2 * LANES;

struct Builder<'a> {
    bounds: &'a [Aabb],
    triangles: &'a [Triangle],
    spheres: &'a [Sphere],
    tree: WideBvh,
}

impl Builder<'_> {
    /// Makes node `place` of `binary` a wide one, and returns its number.
    fn widen(&mut self, binary: &Bvh, collapse: &Collapse, place: u32) -> u32 {
        let number = self.tree.nodes.len();
        self.tree.nodes.push(Node::EMPTY);
        let mut node = Node::EMPTY;
        let children = collapse.children(binary, place);
        // With room for it, both kinds of a mixed leaf become children here.
        let mut room = LANES - children.len();
        for child in children {
            let part = &binary.nodes[child as usize];
            match (part.kind, self.kinds(binary, part)) {
                (NodeKind::Leaf { .. }, Some(kinds)) if room > 0 || child == place => {
                    room = room.saturating_sub(1);
                    for prims in kinds {
                        node.push(&self.bounds_of(prims), self.block(prims));
                    }
                }
                (NodeKind::Leaf { first, count }, None) => {
                    node.push(&part.bounds, self.block(binary.leaf(first, count)));
                }
                _ => node.push(
                    &part.bounds,
                    Child::node(self.widen(binary, collapse, child)),
                ),
            }
        }
        self.tree.nodes[number] = node;
        number as u32
    }

    /// The triangles and the spheres of a leaf that has both.
    fn kinds<'b>(&self, binary: &'b Bvh, node: &BvhNode) -> Option<[&'b [PrimId]; 2]> {
        let NodeKind::Leaf { first, count } = node.kind else {
            return None;
        };
        let (triangles, spheres) = self.by_kind(binary.leaf(first, count));
        (!triangles.is_empty() && !spheres.is_empty()).then_some([triangles, spheres])
    }

    fn bounds_of(&self, prims: &[PrimId]) -> Aabb {
        let boxes = prims.iter().map(|id| self.bounds[id.0 as usize]);
        boxes.fold(Aabb::EMPTY, Aabb::union)
    }

    /// The triangles and the spheres of a list whose ids ascend.
    fn by_kind<'p>(&self, prims: &'p [PrimId]) -> (&'p [PrimId], &'p [PrimId]) {
        prims.split_at(prims.partition_point(|id| (id.0 as usize) < self.triangles.len()))
    }

    /// A block of up to eight primitives of one kind.
    fn block(&mut self, prims: &[PrimId]) -> Child {
        let first = self.triangles.len();
        if (prims[0].0 as usize) < first {
            self.tree.blocks.push(Block::of(self.triangles, prims));
            Child::block(self.tree.blocks.len() as u32 - 1)
        } else {
            let block = SphereBlock::of(self.spheres, first, prims);
            self.tree.spheres.push(block);
            Child::spheres(self.tree.spheres.len() as u32 - 1)
        }
    }
}
// END SOLUTION(part6.task1)
