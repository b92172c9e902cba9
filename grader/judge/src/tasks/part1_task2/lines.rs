//! Writes camera rays to a snapshot.

use crate::tools::snapshot::lines::{each, ray_fields};
use crate::tools::snapshot::{Forms, field, forms, number, vector};
use wire::work::{CameraWork, Ray};

/// The direction; full lines have the whole ray.
pub(super) fn rays(work: &CameraWork, rays: &[Ray]) -> Vec<Forms> {
    let cameras = 0..work.cameras.len();
    let calls = cameras.flat_map(|camera| work.sensor.iter().map(move |point| (camera, point)));
    each(calls, rays, |(camera, point), ray| {
        let question = vec![
            number("camera", camera as f64),
            field("sensor", vector(point)),
        ];
        forms(question, vec![field("d", vector(&ray.d))], ray_fields(ray))
    })
}
