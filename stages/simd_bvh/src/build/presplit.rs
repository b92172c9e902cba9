//! Splits triangles whose boxes are mostly empty before the tree is built.
//!
//! The box of a long thin triangle that is not along an axis is nearly empty, and rays that enter
//! it test the triangle in vain. Two boxes, one for each half, have half its surface, four a
//! quarter. So such a triangle is divided into parts, and the tree is built over the boxes of the
//! parts (Karras, Aila, "Fast parallel construction of high-quality bounding volume hierarchies",
//! 2013, section 4.4). A triangle may then be in several leaves; each of them tests all of it, so
//! the hits are the same.

use crate::build::sah::BuildPrimitive;
use kit::{Aabb, Vec3};
use rayon::prelude::*;
use std::collections::BTreeMap;

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

/// Triangle number `id` as one primitive, with these vertices in the tree's space.
#[inline(always)]
pub(crate) fn whole_triangle(id: u32, vertices: &[Vec3; 3]) -> BuildPrimitive {
    let extent = Extent::of(vertices);
    BuildPrimitive::new(id, extent.bounds, extent.excess())
}

/// Divides those primitives that have an excess, the parts with the largest excess first, and adds
/// the new parts at the end. There are `triangle_count` triangles, and `vertices` returns those of
/// a triangle in the tree's space.
///
/// Parts whose excess differs by less than a quarter are divided at the same time, in parallel: no
/// half of a part has as much. The result does not depend on the number of threads.
pub(crate) fn divide(
    prims: &mut Vec<BuildPrimitive>,
    triangle_count: usize,
    vertices: impl Fn(u32) -> [Vec3; 3] + Sync,
) {
    let mut splits_left = triangle_count / TRIANGLES_PER_SPLIT;
    let mut classes: BTreeMap<u32, Vec<Part>> = BTreeMap::new();
    let numbered = prims.par_iter().enumerate().with_min_len(1 << 12);
    let sparse = numbered.filter(|(_, prim)| prim.excess() > 0.0);
    let sparse: Vec<usize> = sparse.map(|(place, _)| place).collect();
    for place in sparse {
        let prim = &prims[place];
        let class = classes.entry(size_class(prim.excess())).or_default();
        class.push(Part::whole(place, prim.id()));
    }
    while splits_left > 0
        && let Some((class, mut parts)) = classes.pop_last()
    {
        let rest = parts.split_off(splits_left.min(parts.len()));
        if !rest.is_empty() {
            classes.insert(class, rest);
        }
        let halves: Vec<_> = parts
            .par_iter()
            .with_min_len(MIN_PARALLEL)
            .map_init(Polygons::default, |polygons, part| {
                part.halves(&vertices(part.id), polygons)
            })
            .collect();
        for (mut part, halves) in parts.into_iter().zip(halves) {
            let Some(halves) = halves else {
                continue;
            };
            splits_left -= 1;
            for (number, (cell, prim)) in halves.into_iter().enumerate() {
                if number == 0 {
                    prims[part.place] = prim;
                } else {
                    part.place = prims.len();
                    prims.push(prim);
                }
                if prim.excess() > 0.0 {
                    let class = classes.entry(size_class(prim.excess())).or_default();
                    class.push(Part { cell, ..part });
                }
            }
        }
    }
}

/// A thread divides at least this many parts at once.
const MIN_PARALLEL: usize = 64;

/// The class of a positive excess: four for each power of two.
fn size_class(excess: f32) -> u32 {
    excess.to_bits() >> 21
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
    #[inline(always)]
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

    /// What dividing the polygon can gain; 0 if its box is not mostly empty.
    #[inline(always)]
    fn excess(&self) -> f32 {
        if self.area > SPARSE * self.tight_area {
            (self.area - self.tight_area) as f32
        } else {
            0.0
        }
    }
}

/// The part of a triangle in a cell.
#[derive(Clone, Copy)]
struct Part {
    /// Its index among the primitives.
    place: usize,
    /// The number of the triangle.
    id: u32,
    cell: Aabb,
}

/// Memory for polygons.
#[derive(Default)]
struct Polygons {
    part: Vec<Vec3>,
    half: Vec<Vec3>,
    scratch: Vec<Vec3>,
}

impl Part {
    fn whole(place: usize, id: u32) -> Part {
        let cell = Aabb {
            min: Vec3::NEG_INFINITY,
            max: Vec3::INFINITY,
        };
        Part { place, id, cell }
    }

    /// Divides the part in the middle of the longest edge of its box: the cells and the primitives
    /// of the halves. `None` if it is too small.
    fn halves(
        &self,
        vertices: &[Vec3; 3],
        polygons: &mut Polygons,
    ) -> Option<[(Aabb, BuildPrimitive); 2]> {
        let Polygons {
            part,
            half,
            scratch,
        } = polygons;
        part.clear();
        part.extend(vertices);
        let margin = MARGIN * Extent::of(part).bounds.extent().max_element();
        for axis in 0..3 {
            for (side, plane) in [(1.0, self.cell.max[axis]), (-1.0, self.cell.min[axis])] {
                if plane.is_finite() {
                    clip(part, axis, side, plane, scratch);
                    std::mem::swap(part, scratch);
                }
            }
        }
        if part.is_empty() {
            return None;
        }
        let Aabb { min, max } = Extent::of(part).bounds;
        let edges = max - min;
        let longest = |a: &usize, b: &usize| edges[*a].total_cmp(&edges[*b]);
        let axis = (0..3).max_by(longest)?;
        let middle = 0.5 * (min[axis] + max[axis]);
        if edges[axis] <= 4.0 * margin || middle <= min[axis] || middle >= max[axis] {
            return None;
        }
        let mut cells = [self.cell; 2];
        cells[0].max[axis] = middle;
        cells[1].min[axis] = middle;
        let mut on_side = |side: f64, cell: Aabb| {
            clip(part, axis, side, middle, half);
            let extent = Extent::of(half);
            let bounds = Aabb {
                min: extent.bounds.min - margin,
                max: extent.bounds.max + margin,
            };
            let prim = BuildPrimitive::new(self.id, bounds, extent.excess());
            (cell, prim)
        };
        Some([on_side(1.0, cells[0]), on_side(-1.0, cells[1])])
    }
}

/// Writes to `clipped` what of a convex polygon is at or below `plane` on `axis`; if `side` is -1,
/// what is at or above it.
fn clip(polygon: &[Vec3], axis: usize, side: f64, plane: f64, clipped: &mut Vec<Vec3>) {
    clipped.clear();
    let Some(&(mut previous)) = polygon.last() else {
        return;
    };
    for &p in polygon {
        let (from, to) = (side * (previous[axis] - plane), side * (p[axis] - plane));
        if (from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0) {
            let mut crossing = previous + (p - previous) * (from / (from - to));
            crossing[axis] = plane;
            clipped.push(crossing);
        }
        if to <= 0.0 {
            clipped.push(p);
        }
        previous = p;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use meshes::{MeshKind, generate};

    fn split(triangles: &[[Vec3; 3]]) -> Vec<BuildPrimitive> {
        let numbered = (0..).zip(triangles);
        let mut prims = numbered
            .map(|(id, vertices)| whole_triangle(id, vertices))
            .collect();
        divide(&mut prims, triangles.len(), |id| triangles[id as usize]);
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
        let parts: Vec<_> = prims.iter().filter(|prim| prim.id() == 40).collect();
        assert_eq!(prims.len() - parts.len(), 40);
        assert!(parts.len() > 8, "{} parts", parts.len());
        let [a, b, c] = diagonal;
        for i in 0..=200 {
            for j in 0..=10 {
                let (s, t) = (f64::from(i) / 200.0, f64::from(j) / 10.0);
                let p = a + s * ((b - a) + t * (c - b));
                let is_inside = |part: &BuildPrimitive| {
                    let bounds = part.bounds();
                    (0..3).all(|axis| {
                        f64::from(bounds.min(axis)) <= p[axis]
                            && p[axis] <= f64::from(bounds.max(axis))
                    })
                };
                assert!(parts.iter().any(|part| is_inside(part)), "{p}");
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
