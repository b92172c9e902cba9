//! The primitives of a convex region.

use crate::intersect::TestCounts;
use crate::layout::node::{Child, ChildKind, Node, Side};
use crate::layout::space::TreeSpace;
use crate::rounding::at_least;
use crate::wide::{Subset, WideBvh};
use fearless_simd::{Simd, f32x8, prelude::*};
use kit::{PrimId, Vec3};

/// A half-space in the tree's space, in single precision: all points `p` of the tree that are in
/// the half-space have `normal·p <= offset`.
struct LocalHalfSpace {
    /// The absolute values of its coordinates have a sum of 1.
    normal: [f32; 3],
    /// By axis the side of a box that is deepest in the half-space.
    sides: [Side; 3],
    offset: f32,
}

/// The share of a sum's terms by which half-spaces are enlarged: much more than the rounding
/// errors in double precision.
const MARGIN: f64 = 1e-10;

/// The share of the tree's size by which half-spaces are enlarged: four times the rounding errors
/// of `normal·p` in single precision.
const SINGLE_MARGIN: f64 = 1.0 / (1 << 20) as f64;

impl LocalHalfSpace {
    fn new((normal, offset): (Vec3, f64), space: &TreeSpace) -> LocalHalfSpace {
        // A point p in world space is at p·scale - shift.
        let (shifted, scaled) = (normal * space.shift, offset * space.scale);
        let size = scaled.abs() + shifted.abs().element_sum();
        let offset = scaled - shifted.element_sum() + MARGIN * size;
        // With a normal of length 0 this is not a number. Then no box is outside.
        let unit = 1.0 / normal.abs().element_sum();
        LocalHalfSpace {
            normal: (normal * unit).to_array().map(|n| n as f32),
            sides: normal.to_array().map(|n| Side::crossed(n)[0]),
            offset: at_least(offset * unit + SINGLE_MARGIN * space.size),
        }
    }

    /// The children of `node`, one bit each, whose boxes are outside for certain.
    #[inline(always)]
    fn outside<S: Simd>(&self, simd: S, node: &Node) -> u32 {
        let mut least = f32x8::splat(simd, 0.0);
        for axis in 0..3 {
            let planes = f32x8::load_array_ref(simd, node.planes(axis, self.sides[axis]));
            least += planes * self.normal[axis];
        }
        least.simd_gt(self.offset).to_bitmask() as u32
    }
}

/// Adds the primitives of the boxes in `region` to `ids`, as [`WideBvh::primitives_in`] describes.
#[inline(always)]
pub(crate) fn find<S: Simd>(
    simd: S,
    tree: &WideBvh,
    most: usize,
    region: &[(Vec3, f64)],
    subset: Subset,
    counts: &mut TestCounts,
    ids: &mut Vec<PrimId>,
) -> bool {
    let local = |half_space: &(Vec3, f64)| LocalHalfSpace::new(*half_space, &tree.space);
    let region: Vec<LocalHalfSpace> = region.iter().map(local).collect();
    let mut pending: Vec<Child> = tree.roots_of(subset).to_vec();
    let mut visited = 0;
    while let Some(child) = pending.pop() {
        match child.kind() {
            ChildKind::Node { index, count } => {
                visited += 1;
                if visited > most {
                    return false;
                }
                let node = &tree.nodes[index];
                counts.box_tests += u64::from(count);
                let mut inside = (1_u32 << count) - 1;
                for half_space in &region {
                    inside &= !half_space.outside(simd, node);
                }
                while inside != 0 {
                    pending.push(Child(node.children[inside.trailing_zeros() as usize]));
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

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::Level;
    use kit::{PixelSampler, Sphere, Triangle};

    /// Small triangles and spheres in a cube of edge 2 around `center`.
    fn scene(center: Vec3, sampler: &mut PixelSampler) -> (Vec<Triangle>, Vec<Sphere>) {
        let mut point = || {
            let p = sampler.next_2d();
            2.0 * Vec3::new(p.x, p.y, sampler.next_1d()) - 1.0
        };
        let triangles = (0..3000).map(|_| {
            let p = center + point();
            Triangle::flat(p, p + 0.03 * point(), p + 0.03 * point())
        });
        let triangles = triangles.collect();
        let spheres = (0..300).map(|_| Sphere {
            center: center + point(),
            radius: 0.02,
        });
        (triangles, spheres.collect())
    }

    /// The half-spaces of a box that is turned: points at most `size` from `p` along each axis.
    fn turned_box(p: Vec3, size: f64, sampler: &mut PixelSampler) -> Vec<(Vec3, f64)> {
        let axis = kit::warp::uniform_sphere(sampler.next_2d());
        let frame = kit::Frame::around(axis);
        let sides = [frame.s, frame.t, frame.n].into_iter();
        sides
            .flat_map(|n| [n, -n])
            .map(|n| (3.0 * n, 3.0 * (n.dot(p) + size)))
            .collect()
    }

    #[test]
    fn a_region_finds_all_its_primitives_and_few_others() {
        let mut sampler = PixelSampler::new(0, 0, 1);
        for center in [Vec3::ZERO, Vec3::new(5000.0, -300.0, 0.25)] {
            let (triangles, spheres) = scene(center, &mut sampler);
            let tree = WideBvh::build(&triangles, &spheres);
            let (mut inside, mut found) = (0, 0);
            for i in 0..200 {
                let p = triangles[13 * i].p0;
                let mut region = turned_box(p, 0.1, &mut sampler);
                region.push((Vec3::X, f64::INFINITY));
                let is_inside = |p: Vec3| region.iter().all(|&(n, c)| n.dot(p) <= c);
                let mut expected: Vec<PrimId> = (0..)
                    .map(PrimId)
                    .zip(&triangles)
                    .filter(|(_, t)| is_inside(t.p0) || is_inside(t.p1) || is_inside(t.p2))
                    .map(|(id, _)| id)
                    .collect();
                let ids = (triangles.len() as u32..).map(PrimId);
                let in_region = ids.zip(&spheres).filter(|(_, s)| is_inside(s.center));
                expected.extend(in_region.map(|(id, _)| id));
                for level in [Level::new(), Level::baseline()] {
                    let tree = tree.clone().at_level(level);
                    let (mut ids, mut counts) = (Vec::new(), TestCounts::default());
                    assert!(tree.primitives_in(Subset::All, &region, 1000, &mut ids, &mut counts));
                    let missing = expected.iter().find(|id| !ids.contains(id));
                    assert_eq!(missing, None, "{level:?}, region {i}");
                    assert!(counts.box_tests > 0 && counts.prim_tests == 0);
                    found += ids.len();
                    inside += expected.len();
                    let few = &mut Vec::new();
                    let most = ids.len() - 1;
                    assert!(!tree.primitives_in(Subset::All, &region, most, few, &mut counts));
                }
            }
            assert!(inside > 1000 && found < 20 * inside, "{found} {inside}");
        }
    }
}
