//! Simple trees to build: a few boxes in a row.

use wire::work::{BuildWork, Xyz};

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
    // Deep enough that a tree that is not balanced, or that never splits, shows.
    let long: Vec<f64> = (0..16).map(f64::from).collect();
    questions.extend((0..3).map(|axis| work(&long, axis, 1)));
    questions.extend((0..3).map(|axis| work(&long, axis, 4)));
    questions
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
