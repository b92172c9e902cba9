//! Runs Part 2, task 2: probes of single boxes.

use crate::convert;
use crate::stages::Bbox;
use wire::work::BoxWork;

pub(crate) fn boxes(stage: &Bbox, work: &BoxWork) -> Vec<Option<[f64; 2]>> {
    harness::each_call(&work.probes, |_, probe| {
        let b = convert::aabb(&work.boxes[probe.shape as usize]);
        (stage.intersect_bbox)(&b, &convert::ray(&probe.ray))
            .map(|interval| [interval.min, interval.max])
    })
}
