//! The tree that is walked: nodes of eight children, leaves of eight triangles, both laid out for lanes.

// BEGIN SOLUTION(part6.task1)
use crate::block::Block;
use crate::node::{Child, Node};
use crate::sah::{self, LANES};
use crate::sphere_block::SphereBlock;
use kit::{Aabb, Bvh, NodeKind, PrimId};
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
    /// The instructions that it is walked with.
    pub(crate) level: Level,
    // STUB: // Whatever you need.
    // END SOLUTION(part6.task1)
}

impl WideBvh {
    /// Builds the tree. A primitive with an empty box (a NaN, a negative radius) is left out: no ray hits it.
    pub fn build(triangles: &[Triangle], spheres: &[Sphere]) -> WideBvh {
        // BEGIN SOLUTION(part6.task1)
        let boxes = triangles.iter().map(Triangle::bounds);
        let bounds: Vec<Aabb> = boxes.chain(spheres.iter().map(Sphere::bounds)).collect();
        let mut builder = Builder {
            bounds: &bounds,
            triangles,
            spheres,
            tree: WideBvh {
                nodes: Vec::new(),
                blocks: Vec::new(),
                spheres: Vec::new(),
                level: Level::new(),
            },
        };
        let has_box = |id: &PrimId| !bounds[id.0 as usize].is_empty();
        let prims: Vec<PrimId> = (0..bounds.len() as u32)
            .map(PrimId)
            .filter(has_box)
            .collect();
        let (triangles, spheres) = builder.by_kind(&prims);
        if triangles.len() <= FEW_TRIANGLES && spheres.len() <= LANES {
            for block in triangles.chunks(LANES).chain(spheres.chunks(LANES)) {
                builder.block(block);
            }
        } else {
            let binary = sah::build(&bounds);
            builder.widen(&binary, vec![Part::of(&binary.nodes[0])]);
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

/// What may become a child of a wide node.
#[derive(Clone, Copy)]
struct Part {
    bounds: Aabb,
    kind: NodeKind,
}

impl Part {
    fn of(node: &kit::BvhNode) -> Part {
        Part {
            bounds: node.bounds,
            kind: node.kind,
        }
    }
}

struct Builder<'a> {
    bounds: &'a [Aabb],
    triangles: &'a [Triangle],
    spheres: &'a [Sphere],
    tree: WideBvh,
}

impl Builder<'_> {
    /// Makes a node with `parts` of `binary` as its children; as long as there is room, those that rays meet most are opened:
    /// the ones with the largest surfaces. Returns its number.
    fn widen(&mut self, binary: &Bvh, mut parts: Vec<Part>) -> u32 {
        while parts.len() < LANES {
            let area = |i: &usize| parts[*i].bounds.surface_area();
            let widest = (0..parts.len())
                .filter(|&i| self.opened(binary, &parts[i]).is_some())
                .max_by(|a, b| area(a).total_cmp(&area(b)));
            let Some(widest) = widest else { break };
            let halves = self.opened(binary, &parts[widest]);
            parts.splice(widest..=widest, halves.into_iter().flatten());
        }
        let number = self.tree.nodes.len();
        self.tree.nodes.push(Node::EMPTY);
        let mut node = Node::EMPTY;
        for part in &parts {
            let child = match part.kind {
                NodeKind::Leaf { first, count } if self.opened(binary, part).is_none() => {
                    self.block(binary.leaf(first, count))
                }
                _ => Child::node(self.widen(binary, vec![*part])),
            };
            node.push(&part.bounds, child);
        }
        self.tree.nodes[number] = node;
        number as u32
    }

    /// The two halves of a part: of a node its children, of a leaf its triangles and its spheres. `None` for a leaf of
    /// one kind.
    fn opened(&self, binary: &Bvh, part: &Part) -> Option<[Part; 2]> {
        let (first, count) = match part.kind {
            NodeKind::Interior { left, right } => {
                return Some([left, right].map(|child| Part::of(&binary.nodes[child as usize])));
            }
            NodeKind::Leaf { first, count } => (first, count),
        };
        let prims = binary.leaf(first, count);
        let triangles = self.by_kind(prims).0.len() as u32;
        let halves = [(first, triangles), (first + triangles, count - triangles)];
        let part = |(first, count)| Part {
            bounds: self.bounds_of(binary.leaf(first, count)),
            kind: NodeKind::Leaf { first, count },
        };
        (0 < triangles && triangles < count).then(|| halves.map(part))
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
