// BEGIN SOLUTION(part2.task3)
//! Trees that store boxes and triangles in one precision and are traversed in it, with one pair of
//! tests.

use crate::bbox::BoxTest;
use crate::bbox::ize::Ize;
use crate::bbox::williams::Williams;
use crate::shapes::{Aabb, Ray, Shape, Triangle};
use crate::traversal::walk;
use crate::tree::RoundedTree;
use crate::triangle::TriangleTest;
use crate::triangle::moller_trumbore::MollerTrumbore;
use crate::triangle::woop::Woop;
use kit::Bvh;
use lanes::{Precision, Scalar};

/// Returns the same tree with different tests, the exact one first.
pub(crate) fn trees<'a>(bvh: &'a Bvh, triangles: &[kit::Triangle]) -> Vec<RoundedTree<'a>> {
    vec![
        tree::<f64, Ize, Woop>(16, bvh, triangles),
        tree::<f64, Williams, MollerTrumbore>(0, bvh, triangles),
        tree::<f32, Ize, Woop>(16, bvh, triangles),
        tree::<f32, Williams, MollerTrumbore>(0, bvh, triangles),
    ]
}

fn tree<'a, R: Scalar, B: BoxTest, T: TriangleTest>(
    slack_ulp: u32,
    bvh: &'a Bvh,
    triangles: &[kit::Triangle],
) -> RoundedTree<'a> {
    let boxes: Vec<Aabb<R>> = bvh.nodes.iter().map(|node| node.bounds.rounded()).collect();
    let triangles: Vec<Triangle<R>> = triangles.iter().map(Shape::rounded).collect();
    let slack = R::from_f64(1.0 + f64::from(slack_ulp) * R::PRECISION.epsilon());
    let mut stack = Vec::new();
    let precision = match R::PRECISION {
        Precision::F32 => "f32",
        _ => "f64",
    };
    RoundedTree {
        name: format!("{}; {}; {precision}", B::INFO.name, T::INFO.name),
        slack_ulp,
        closest: Box::new(move |ray| {
            let entry = |node: usize, ray: &Ray<R>| Some(B::intersect(&boxes[node], ray)?.near);
            let hit = |id: kit::PrimId, ray: &Ray<R>| {
                Some((T::intersect(&triangles[id.0 as usize], ray)?.t, id))
            };
            let (t, id) = walk(bvh, Ray::from_kit(ray), slack, &mut stack, entry, hit)?;
            Some((t.to_f64(), id))
        }),
    }
}
// END SOLUTION(part2.task3)
