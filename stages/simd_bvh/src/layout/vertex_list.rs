//! The exact vertices of the triangles, each stored about once.

use crate::layout::LANES;
use kit::{PrimId, Triangle, Vec3};

/// A vertex in world space and double precision.
pub(crate) type ExactVertex = [f64; 3];

/// How much of a block's vertices is loaded ahead: five cache lines. Eight neighbours of a mesh
/// have 9 or 10 vertices of 24 bytes, but some of them are farther away.
pub(crate) const BLOCK_BYTES: usize = 320;

/// Where the exact vertices of a block's triangles are. Apart from the block, because few blocks
/// need them; in one cache line.
#[derive(Clone, Debug)]
#[repr(C, align(32))]
pub(crate) struct BlockVertices {
    /// The place of the first of them in the tree's list.
    pub(crate) first: u32,
    /// How far behind it those of each triangle are.
    corners: [[u8; 3]; LANES],
}

impl BlockVertices {
    /// The same if there are `before` more vertices before them.
    pub(crate) fn moved(self, before: u32) -> BlockVertices {
        BlockVertices {
            first: self.first + before,
            ..self
        }
    }

    /// The places of a triangle's vertices in the tree's list.
    #[inline(always)]
    pub(crate) fn corners(&self, lane: usize) -> [usize; 3] {
        self.corners[lane & (LANES - 1)].map(|corner| self.first as usize + usize::from(corner))
    }
}

/// A list of vertices for blocks in the tree's order, while it is written.
///
/// A mesh has about half as many vertices as triangles, and parts of a divided triangle are in
/// several blocks, most often near each other in the order. A vertex that is among the last ones of
/// the list is not added again. So a block has its vertices close together, and one byte each says
/// where.
pub(crate) struct VertexList {
    pub(crate) vertices: Vec<ExactVertex>,
    /// For each hash the last vertex that has it. Where two vertices have the same, the first may
    /// be added again, which only takes memory.
    last: Box<[u32; 1 << HASH_BITS]>,
}

/// A block may share this many vertices with the blocks before it: together with its own, which are
/// at most three a lane, they have numbers of one byte.
const WINDOW: usize = 256 - 3 * LANES;

const HASH_BITS: u32 = 12;

impl VertexList {
    /// An empty list with space for `capacity` vertices.
    pub(crate) fn new(capacity: usize) -> VertexList {
        VertexList {
            vertices: Vec::with_capacity(capacity),
            last: Box::new([0; 1 << HASH_BITS]),
        }
    }

    /// Adds those vertices of the one to eight triangles `prims` that are not among the last ones.
    #[inline(always)]
    pub(crate) fn add(&mut self, triangles: &[Triangle], prims: &[PrimId]) -> BlockVertices {
        let window = self.vertices.len().saturating_sub(WINDOW);
        let mut places = [[0; 3]; LANES];
        let places = &mut places[..prims.len()];
        for (places, &id) in places.iter_mut().zip(prims) {
            let triangle = &triangles[id.0 as usize];
            *places = [triangle.p0, triangle.p1, triangle.p2].map(|p| self.place_of(p, window));
        }
        let first = places.as_flattened().iter().copied().min().unwrap_or(0);
        let mut corners = [[0; 3]; LANES];
        for (corners, places) in corners.iter_mut().zip(places) {
            *corners = places.map(|place| (place - first) as u8);
        }
        BlockVertices {
            first: first as u32,
            corners,
        }
    }

    /// The place of a vertex at or behind `first`, where it is added if it is not there. The bits
    /// are compared: zeros of different signs are two vertices.
    #[inline(always)]
    fn place_of(&mut self, vertex: Vec3, first: usize) -> usize {
        let vertex = vertex.to_array();
        let bits = vertex.map(f64::to_bits);
        let last = &mut self.last[hash(bits)];
        let place = *last as usize;
        if place >= first
            && let Some(other) = self.vertices.get(place)
            && other.map(f64::to_bits) == bits
        {
            return place;
        }
        *last = self.vertices.len() as u32;
        self.vertices.push(vertex);
        self.vertices.len() - 1
    }
}

#[inline(always)]
fn hash([x, y, z]: [u64; 3]) -> usize {
    const ODD: u64 = 0x9e37_79b9_7f4a_7c15;
    let sum = x
        .wrapping_add(y.rotate_left(21))
        .wrapping_add(z.rotate_left(42));
    (sum.wrapping_mul(ODD) >> (64 - HASH_BITS)) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_vertices_are_stored_once_and_with_all_bits() {
        let at = |x: f64, y: f64| Vec3::new(x, y, 0.1);
        let points = [at(0.1, 0.2), at(0.0, 0.7), at(-0.0, 0.7), at(0.3, 1e-9)];
        let [a, b, c, d] = points;
        let triangles = [Triangle::flat(a, b, d), Triangle::flat(d, c, a)];
        let mut exact = VertexList::new(0);
        let numbers = [PrimId(0), PrimId(1)];
        let both = exact.add(&triangles, &numbers);
        let second = exact.add(&triangles, &numbers[1..]);
        assert_eq!(exact.vertices.len(), points.len());
        for (block, lane, t) in [(&both, 0, 0), (&both, 1, 1), (&second, 0, 1)] {
            let Triangle { p0, p1, p2, .. } = triangles[t];
            for (place, p) in block.corners(lane).into_iter().zip([p0, p1, p2]) {
                let (stored, p) = (exact.vertices[place], p.to_array());
                assert_eq!(stored.map(f64::to_bits), p.map(f64::to_bits));
            }
        }
    }

    /// Every triangle shares a vertex with the first one, which soon is too far back in the list.
    #[test]
    fn vertices_far_back_in_the_list_are_added_again() {
        let at = |i: u32, z: f64| Vec3::new(f64::from(i), 0.5, z);
        let fan = (0..400).map(|i| Triangle::flat(Vec3::ZERO, at(i, 1.0), at(i, 2.0)));
        let triangles: Vec<Triangle> = fan.collect();
        let mut exact = VertexList::new(0);
        let numbers: Vec<PrimId> = (0..400).map(PrimId).collect();
        for prims in numbers.chunks(LANES) {
            let block = exact.add(&triangles, prims);
            for (lane, &id) in prims.iter().enumerate() {
                let corners = block.corners(lane).map(|place| exact.vertices[place]);
                let Triangle { p0, p1, p2, .. } = triangles[id.0 as usize];
                assert_eq!(corners, [p0, p1, p2].map(|p| p.to_array()));
            }
        }
        assert!((802..830).contains(&exact.vertices.len()));
    }
}
