//! Makes a case of one of the calls of another case.

use super::Spec;
use crate::tasks;
use std::sync::Arc;
use wire::Work;
use wire::work::{BoxWork, BruteForceWork, CameraWork, PixelWork, SphereWork, TriangleWork};

impl Spec {
    /// The number of calls of the student's functions that the case makes.
    pub fn calls(&self) -> usize {
        tasks::check_of(&self.work).calls()
    }

    /// The same case with its call number `call` only, as call 0; `None` where calls depend on each
    /// other or on their number (of which random numbers are made), or where there is no such call.
    pub fn only_call(&self, call: usize) -> Option<Spec> {
        Some(Spec {
            work: only(&self.work, call)?,
            picture: None,
            expected_cache: Arc::default(),
            ..self.clone()
        })
    }
}

fn only(work: &Work, call: usize) -> Option<Work> {
    fn one<T: Clone>(calls: &[T], call: usize) -> Option<Vec<T>> {
        Some(vec![calls.get(call)?.clone()])
    }
    Some(match work {
        Work::Triangles(work) => Work::Triangles(TriangleWork {
            triangles: work.triangles.clone(),
            probes: one(&work.probes, call)?,
        }),
        Work::Spheres(work) => Work::Spheres(SphereWork {
            spheres: work.spheres.clone(),
            probes: one(&work.probes, call)?,
        }),
        Work::Boxes(work) => Work::Boxes(BoxWork {
            boxes: work.boxes.clone(),
            probes: one(&work.probes, call)?,
        }),
        Work::BruteForce(work) => Work::BruteForce(BruteForceWork {
            rays: one(&work.rays, call)?,
            ..work.clone()
        }),
        Work::Pixels(work) => {
            let ([x, y], seed) = work.calls().nth(call)?;
            Work::Pixels(PixelWork {
                pixels: vec![[x, y]],
                seeds: vec![seed],
                ..work.clone()
            })
        }
        Work::CameraRays(work) => {
            let points = work.sensor.len().max(1);
            Work::CameraRays(CameraWork {
                cameras: one(&work.cameras, call / points)?,
                sensor: one(&work.sensor, call % points)?,
            })
        }
        Work::Lambert(calls) => Work::Lambert(one(calls, call)?),
        Work::Specular(calls) => Work::Specular(one(calls, call)?),
        Work::Stop(calls) => Work::Stop(one(calls, call)?),
        Work::SureStop(calls) => Work::SureStop(one(calls, call)?),
        Work::AdaptivePixels(calls) => Work::AdaptivePixels(one(calls, call)?),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use crate::cases;

    #[test]
    fn a_single_call_is_that_call_of_the_case() {
        let text = |work: &wire::Work| format!("{work:?}");
        let mut cut = 0;
        for spec in cases::all(0) {
            assert!(spec.only_call(spec.calls()).is_none(), "{}", spec.name);
            let Some(alone) = spec.only_call(spec.calls() - 1) else {
                continue;
            };
            cut += 1;
            assert_eq!(alone.calls(), 1, "{} {}", spec.task, spec.name);
            // The last call of what is left of it is itself.
            let again = alone.only_call(0).expect("it has a call");
            assert_eq!(text(&again.work), text(&alone.work));
            assert!(spec.calls() == 1 || text(&spec.work) != text(&alone.work));
        }
        assert!(cut > 100, "{cut}");
    }
}
