//! One ray of a case in 3D: its shape, the worst ray, what the stage answers now, and the exact answer.
//!
//! The stage's answer is computed by the stage that this program contains, not read from the
//! report: after an edit and a new start of the window it is the new one.

use super::stage_answer::answer_of;
use judge::Tier;
use judge::cases::Spec;
use judge::shown::{ShownCall, ShownRay};

/// A case with its worst ray.
#[derive(Clone, Debug)]
pub struct RayCase {
    /// The ray, its shapes, the exact answer and the stage's.
    pub shown: ShownRay,
    /// The stage has no answer, because of this.
    pub failure: Option<String>,
    /// Whether the ray is that of the report's sentence: with another seed, cases have other rays.
    pub is_of_report: bool,
}

impl RayCase {
    /// The view of call number `call` of a case; `None` if the case is not about single rays and shapes.
    /// `message` is the grader's sentence about the call.
    pub fn of(spec: &Spec, tier: Tier, call: usize, message: &str) -> Option<RayCase> {
        let alone = spec.only_call(call)?;
        // Before the stage is called: most kinds of work are not about a ray.
        let ShownCall::Ray(unanswered) = alone.shown(tier, 0, None)? else {
            return None;
        };
        let answer = answer_of(&alone).and_then(|answer| match answer.not_written.first() {
            Some(function) => Err(format!("{function} is not written yet")),
            None => Ok(answer),
        });
        let answered = answer.as_ref().ok();
        let shown = match answered.and_then(|answer| alone.shown(tier, 0, Some(&answer.answer))) {
            Some(ShownCall::Ray(shown)) => shown,
            _ => unanswered,
        };
        let o = shown.camera.map_or(shown.ray.o, |(camera, _)| camera.pos);
        Some(RayCase {
            is_of_report: message.contains(&format!("{:?}", o.x)),
            failure: answer.err(),
            shown,
        })
    }
}
