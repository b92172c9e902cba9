// BEGIN SOLUTION(part6.task1)
//! Splits triangles whose boxes are mostly empty before the tree is built.
//!
//! The box of a long thin triangle that is not along an axis is nearly empty, and rays that enter
//! it test the triangle in vain. Two boxes, one for each half, have half its surface, four a
//! quarter. So such a triangle is divided into parts, and the tree is built over the boxes of the
//! parts (Karras, Aila, "Fast parallel construction of high-quality bounding volume hierarchies",
//! 2013, section 4.4). A triangle may then be in several leaves; each of them tests all of it, so
//! the hits are the same.

use crate::sah::BuildPrimitive;
use kit::{Aabb, Vec3};
use std::collections::BinaryHeap;

/// A part is divided if the surface of its box is more than this many times the surface that
/// infinitely small boxes around it would have together. Triangles without a small angle have a
/// ratio of 2 to 5.
const SPARSE: f64 = 10.0;

/// There is at most one additional part for this many triangles. With one for each triangle, a ray
/// through a mesh of needles takes a tenth less time, and the tree a third more memory.
const TRIANGLES_PER_SPLIT: usize = 2;

/// Parts are enlarged by this share of the triangle's largest edge. Clipping has rounding errors,
/// and the triangle test may report a hit at such a distance from the triangle, but a part's box
/// may be much smaller than the triangle's.
const MARGIN: f64 = 1.0 / (1_u64 << 40) as f64;

/// Adds the boxes of `triangles`, given in the tree's space with their ids, to `prims`: one box for
/// each, or those of its parts. The parts with the largest boxes are divided first.
pub(crate) fn add_triangles(
    prims: &mut Vec<BuildPrimitive>,
    triangles: impl ExactSizeIterator<Item = (u32, [Vec3; 3])>,
) {
    let mut splits_left = triangles.len() / TRIANGLES_PER_SPLIT;
    let mut parts = Vec::new();
    // The bits of two numbers that are not negative have the same order as the numbers.
    let mut largest_first: BinaryHeap<(u64, usize)> = BinaryHeap::new();
    for (id, vertices) in triangles {
        let extent = Extent::of(&vertices);
        if extent.is_sparse() {
            largest_first.push((extent.excess().to_bits(), parts.len()));
            parts.push(Part::whole(id, vertices, extent));
        } else {
            prims.push(BuildPrimitive::new(id, extent.bounds));
        }
    }
    while splits_left > 0
        && let Some((_, number)) = largest_first.pop()
    {
        let Some([below, above]) = parts[number].halves() else {
            continue;
        };
        splits_left -= 1;
        for (half, place) in [(below, number), (above, parts.len())] {
            if half.extent.is_sparse() {
                largest_first.push((half.extent.excess().to_bits(), place));
            }
            match parts.get_mut(place) {
                Some(part) => *part = half,
                None => parts.push(half),
            }
        }
    }
    prims.extend(parts.iter().map(Part::primitive));
}

/// How much space a polygon takes.
struct Extent {
    bounds: Aabb,
    /// Half the surface of the box.
    area: f64,
    /// Half the surface of infinitely small boxes around the polygon.
    tight_area: f64,
}

impl Extent {
    fn of(polygon: &[Vec3]) -> Extent {
        let bounds = Aabb {
            min: polygon.iter().copied().fold(Vec3::INFINITY, Vec3::min),
            max: polygon.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max),
        };
        let e = bounds.extent();
        let first = polygon[0];
        let normal: Vec3 = polygon[1..]
            .windows(2)
            .map(|edge| (edge[0] - first).cross(edge[1] - first))
            .sum();
        Extent {
            bounds,
            area: e.x * e.y + e.y * e.z + e.z * e.x,
            tight_area: 0.5 * normal.abs().element_sum(),
        }
    }

    fn is_sparse(&self) -> bool {
        self.area > SPARSE * self.tight_area
    }

    /// What dividing the polygon can gain.
    fn excess(&self) -> f64 {
        self.area - self.tight_area
    }
}

/// A convex part of triangle number `id`.
struct Part {
    id: u32,
    polygon: Vec<Vec3>,
    extent: Extent,
    margin: f64,
}

impl Part {
    fn whole(id: u32, vertices: [Vec3; 3], extent: Extent) -> Part {
        Part {
            id,
            polygon: vertices.to_vec(),
            margin: MARGIN * extent.bounds.extent().max_element(),
            extent,
        }
    }

    fn primitive(&self) -> BuildPrimitive {
        let Aabb { min, max } = self.extent.bounds;
        let bounds = Aabb {
            min: min - self.margin,
            max: max + self.margin,
        };
        BuildPrimitive::new(self.id, bounds)
    }

    /// Divides the part in the middle of the longest edge of its box. `None` if it is too small.
    fn halves(&self) -> Option<[Part; 2]> {
        let Aabb { min, max } = self.extent.bounds;
        let edges = max - min;
        let longest = |a: &usize, b: &usize| edges[*a].total_cmp(&edges[*b]);
        let axis = (0..3).max_by(longest)?;
        let middle = 0.5 * (min[axis] + max[axis]);
        if edges[axis] <= 4.0 * self.margin || middle <= min[axis] || middle >= max[axis] {
            return None;
        }
        let (mut below, mut above) = (Vec::new(), Vec::new());
        let mut previous = *self.polygon.last()?;
        for &p in &self.polygon {
            let (from, to) = (previous[axis] - middle, p[axis] - middle);
            if (from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0) {
                let mut crossing = previous + (p - previous) * (from / (from - to));
                crossing[axis] = middle;
                below.push(crossing);
                above.push(crossing);
            }
            if to <= 0.0 {
                below.push(p);
            }
            if to >= 0.0 {
                above.push(p);
            }
            previous = p;
        }
        Some([below, above].map(|polygon| Part {
            id: self.id,
            extent: Extent::of(&polygon),
            polygon,
            margin: self.margin,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use meshes::{MeshKind, generate};

    fn split(triangles: &[[Vec3; 3]]) -> Vec<BuildPrimitive> {
        let mut prims = Vec::new();
        let numbered = triangles.iter().enumerate();
        add_triangles(
            &mut prims,
            numbered.map(|(i, &vertices)| (i as u32, vertices)),
        );
        prims
    }

    #[test]
    fn the_parts_cover_the_triangle() {
        let diagonal = [
            Vec3::ZERO,
            Vec3::new(1.0, 0.9, 0.8),
            Vec3::new(1.0, 0.9, 0.801),
        ];
        let compact = [Vec3::X, Vec3::Y, Vec3::Z];
        let mut triangles = vec![compact; 40];
        triangles.push(diagonal);
        let prims = split(&triangles);
        let parts: Vec<_> = prims.iter().filter(|prim| prim.id == 40).collect();
        assert_eq!(prims.len() - parts.len(), 40);
        assert!(parts.len() > 8, "{} parts", parts.len());
        let [a, b, c] = diagonal;
        for i in 0..=200 {
            for j in 0..=10 {
                let (s, t) = (f64::from(i) / 200.0, f64::from(j) / 10.0);
                let p = a + s * ((b - a) + t * (c - b));
                let is_inside =
                    |bounds: &Aabb| p.cmpge(bounds.min).all() && p.cmple(bounds.max).all();
                assert!(parts.iter().any(|part| is_inside(&part.bounds)), "{p}");
            }
        }
    }

    #[test]
    fn only_long_thin_triangles_are_split_and_not_too_many() {
        let mesh = |kind| -> Vec<[Vec3; 3]> {
            let triangles = generate(kind, 2000);
            triangles.iter().map(|t| [t.p0, t.p1, t.p2]).collect()
        };
        let terrain = mesh(MeshKind::Terrain);
        assert!(split(&terrain).len() <= terrain.len() + terrain.len() / 100);
        let needles = mesh(MeshKind::Needles);
        let parts = split(&needles).len();
        assert_eq!(parts, needles.len() + needles.len() / TRIANGLES_PER_SPLIT);
    }

    #[test]
    fn flat_and_pointlike_triangles_end_the_division() {
        let flat = [
            Vec3::ZERO,
            Vec3::new(1.0, 1.0, 1.0),
            Vec3::new(0.5, 0.5, 0.5),
        ];
        let point = [Vec3::ONE; 3];
        let tiny = [Vec3::ONE, Vec3::ONE * (1.0 + 1e-15), Vec3::ONE];
        assert!(split(&[flat, point, tiny, flat]).len() <= 6);
    }
}
// END SOLUTION(part6.task1)
