//! The tree that is walked: nodes of eight children, leaves of eight triangles, both laid out for lanes.

// BEGIN SOLUTION(part6.task1)
use crate::block::Block;
use crate::node::{Child, Node};
use crate::sah::{self, LANES};
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
    /// The root is the first one; none if there is nothing to hit.
    pub(crate) nodes: Vec<Node>,
    /// The triangles, eight at a time.
    pub(crate) blocks: Vec<Block>,
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
        let binary = sah::build(&bounds);
        let mut builder = Builder {
            binary: &binary,
            bounds: &bounds,
            triangles,
            nodes: Vec::new(),
            blocks: Vec::new(),
        };
        if let Some(root) = binary.nodes.first() {
            builder.widen(vec![Part::of(root)]);
        }
        WideBvh {
            nodes: builder.nodes,
            blocks: builder.blocks,
            level: Level::new(),
        }
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

    /// How many blocks of up to eight triangles there are.
    pub fn block_count(&self) -> usize {
        // BEGIN SOLUTION(part6.task1)
        self.blocks.len()
        // STUB: kit::hole!("part6.task1", self)
        // END SOLUTION(part6.task1)
    }
}

// BEGIN SOLUTION(part6.task1)
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
    binary: &'a Bvh,
    bounds: &'a [Aabb],
    triangles: &'a [Triangle],
    nodes: Vec<Node>,
    blocks: Vec<Block>,
}

impl Builder<'_> {
    /// Makes a node with `parts` as its children, as long as there is room with those that rays meet most opened up:
    /// the ones with the largest surfaces. Returns its number.
    fn widen(&mut self, mut parts: Vec<Part>) -> u32 {
        loop {
            let widest = (0..parts.len())
                .filter(|&i| self.can_be_opened(&parts[i]))
                .max_by(|&a, &b| {
                    let area = |i: usize| parts[i].bounds.surface_area();
                    area(a).total_cmp(&area(b))
                });
            let Some(widest) = widest.filter(|_| parts.len() < LANES) else {
                break;
            };
            let [left, right] = self.opened(&parts[widest]);
            parts[widest] = left;
            parts.push(right);
        }
        let number = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        let mut node = Node::EMPTY;
        for part in &parts {
            let child = self.child(part);
            node.push(&part.bounds, child);
        }
        self.nodes[number] = node;
        number as u32
    }

    fn child(&mut self, part: &Part) -> Child {
        let prims = match part.kind {
            NodeKind::Leaf { first, count } => self.binary.leaf(first, count),
            NodeKind::Interior { .. } => return Child::node(self.widen(vec![*part])),
        };
        match *prims {
            [id] if self.is_sphere(id) => Child::sphere(id),
            _ if prims.iter().any(|&id| self.is_sphere(id)) => Child::node(self.widen(vec![*part])),
            _ => {
                self.blocks.push(Block::of(self.triangles, prims));
                Child::block(self.blocks.len() as u32 - 1)
            }
        }
    }

    fn is_sphere(&self, id: PrimId) -> bool {
        id.0 as usize >= self.triangles.len()
    }

    /// Whether a part is two: a node of the binary tree, or a leaf that is not triangles alone or one sphere.
    fn can_be_opened(&self, part: &Part) -> bool {
        match part.kind {
            NodeKind::Interior { .. } => true,
            NodeKind::Leaf { first, count } => {
                let prims = self.binary.leaf(first, count);
                prims.len() > 1 && prims.iter().any(|&id| self.is_sphere(id))
            }
        }
    }

    /// The two halves of a part that can be opened. Of a leaf: its triangles and its spheres, or half of its spheres.
    fn opened(&self, part: &Part) -> [Part; 2] {
        match part.kind {
            NodeKind::Interior { left, right } => {
                [left, right].map(|child| Part::of(&self.binary.nodes[child as usize]))
            }
            NodeKind::Leaf { first, count } => {
                let prims = self.binary.leaf(first, count);
                // Ids ascend, and triangles come first.
                let triangles = prims.iter().take_while(|&&id| !self.is_sphere(id)).count() as u32;
                let middle = if triangles == 0 { count / 2 } else { triangles };
                [(first, middle), (first + middle, count - middle)].map(|(first, count)| Part {
                    bounds: self
                        .binary
                        .leaf(first, count)
                        .iter()
                        .fold(Aabb::EMPTY, |all, id| all.union(self.bounds[id.0 as usize])),
                    kind: NodeKind::Leaf { first, count },
                })
            }
        }
    }
}
// END SOLUTION(part6.task1)
