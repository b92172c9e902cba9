//! Runs Part 2, task 2: probes of single boxes.

use crate::convert;
use wire::work::BoxWork;

pub(crate) fn boxes(work: &BoxWork) -> Vec<Option<[f64; 2]>> {
    harness::each_call(&work.probes, |_, probe| {
        let b = convert::aabb(&work.boxes[probe.shape as usize]);
        bbox::intersect_bbox(&b, &convert::ray(&probe.ray))
            .map(|interval| [interval.min, interval.max])
    })
}
