//! The picture of Part 2, task 2.

use super::{Eye, Panel, nearness, two_panels};
use crate::convert;
use crate::stages::Bbox;
use wire::picture::View;
use wire::work::Xyz;

/// The nearest distance at which a box is entered, then the length of the ray inside of all boxes.
pub(super) fn boxes(
    stage: &Bbox,
    size: [u32; 2],
    boxes: &[[Xyz; 2]],
    view: &View,
    range: [f64; 2],
) -> Vec<Panel> {
    /// The length inside of boxes that is white.
    const WHITE: f64 = 4.0;
    let boxes: Vec<_> = boxes.iter().map(convert::aabb).collect();
    let eye = Eye::new(view);
    two_panels(size, |x, y| {
        let ray = eye.through(x, y);
        let hits = boxes
            .iter()
            .zip(0_u32..)
            .filter_map(|(b, i)| Some(((stage.intersect_bbox)(b, &ray)?, i)));
        let (mut inside, mut nearest) = (0.0, None);
        for (interval, i) in hits {
            inside += interval.max - interval.min;
            if nearest.is_none_or(|(t, _)| interval.min < t) {
                nearest = Some((interval.min, i));
            }
        }
        let entered = nearest.map_or([0.0; 3], |(t, i)| {
            tint(i).map(|channel| channel * nearness(t, range))
        });
        [entered, [inside / WHITE; 3]]
    })
}

/// The colours of the boxes, in turn.
fn tint(number: u32) -> [f64; 3] {
    const TINTS: [[f64; 3]; 4] = [
        [0.9, 0.55, 0.2],
        [0.3, 0.75, 0.9],
        [0.5, 0.85, 0.4],
        [0.9, 0.5, 0.7],
    ];
    TINTS[number as usize % TINTS.len()]
}
