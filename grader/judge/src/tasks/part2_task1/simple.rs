//! Simple trees to build: a few boxes in a row, and four for the axis of a split.

use crate::tools::recorded::TreeWork;
use wire::work::{BuildWork, Xyz};

/// The place of the second pair of [`pairs`].
const FAR: f64 = 90.0;

/// The simple questions about building: unit boxes at these places along an axis, in this order.
pub(crate) fn questions() -> Vec<BuildWork> {
    let rows: [&[f64]; 9] = [
        &[0.0],
        &[0.0, 2.0],
        &[2.0, 0.0],
        &[0.0, 2.0, 4.0],
        &[0.0, 2.0, 9.0],
        &[9.0, 0.0, 2.0],
        &[0.0, 0.0, 0.0],
        &[0.0, 1.0, 8.0, 9.0],
        &[8.0, 0.0, 9.0, 1.0, 4.0],
    ];
    let mut questions = vec![work(&[], 0, 1)];
    for max_leaf_size in [1, 2, 4] {
        for axis in 0..3 {
            questions.extend(rows.iter().map(|row| work(row, axis, max_leaf_size)));
        }
    }
    questions.extend((0..3).map(pairs));
    // Deep enough that a tree that is not balanced, or that never splits, shows.
    let long: Vec<f64> = (0..16).map(f64::from).collect();
    questions.extend((0..3).map(|axis| work(&long, axis, 1)));
    questions.extend((0..3).map(|axis| work(&long, axis, 4)));
    questions
}

/// Whether these boxes are a simple question. The work of a case is recorded for its own boxes: it
/// says nothing about those of a simple question, which is judged as the case is.
pub(super) fn is_simple(work: &BuildWork) -> bool {
    questions().contains(work)
}

fn work(places: &[f64], axis: usize, max_leaf_size: u32) -> BuildWork {
    let bounds = places.iter().map(|&place| {
        let mut min: Xyz = [0.0; 3];
        min[axis] = place;
        [min, min.map(|x| x + 1.0)]
    });
    BuildWork {
        bounds: bounds.collect(),
        max_leaf_size,
    }
}

/// Two pairs of unit boxes, far apart along `axis`. The boxes of a pair touch along the next axis.
/// Neighbours in the list are of different pairs, so the order of the list is no good division.
pub(super) fn pairs(axis: usize) -> BuildWork {
    let boxes = [[0.0, 0.0], [FAR, 0.0], [0.0, 1.0], [FAR, 1.0]];
    let bounds = boxes.map(|[far, near]| {
        let mut min: Xyz = [0.0; 3];
        (min[axis], min[(axis + 1) % 3]) = (far, near);
        [min, min.map(|x| x + 1.0)]
    });
    BuildWork {
        bounds: bounds.to_vec(),
        max_leaf_size: 1,
    }
}

/// The work of the tree over [`pairs`] whose root divides the pairs; `None` for other boxes.
///
/// With the areas of the boxes around everything, a pair and a box: 2 tests of the root's children,
/// twice 2 of a pair's boxes, and 4 of the primitives in their leaves, each times its chance.
pub(super) fn recorded(work: &BuildWork) -> Option<TreeWork> {
    let is_pairs = (0..3).any(|axis| pairs(axis) == *work);
    let area = |[x, y, z]: [f64; 3]| 2.0 * (x * y + y * z + z * x);
    let [all, pair, one] = [[FAR + 1.0, 2.0, 1.0], [1.0, 2.0, 1.0], [1.0; 3]].map(area);
    is_pairs.then_some(TreeWork {
        cost: 2.0 + 2.0 * 2.0 * pair / all + 4.0 * one / all,
        depth: 2,
    })
}
