//! One ray of a case in 3D: its shape, the worst ray, what the stage answers now, and the exact answer.
//!
//! The stage's answer is computed by the stage that this program contains, not read from the
//! report: after an edit and a new start of the window it is the new one.

use super::stage_answer::answer_of;
use crate::project::is_drawn;
use judge::Tier;
use judge::cases::Spec;
use judge::shown::{ComparedNumber, ShownCall, ShownRay};
use kit::Aabb;
use wire::Answer;

/// A case with its worst ray.
#[derive(Clone, Debug)]
pub struct RayCase {
    /// The ray, its shapes, the exact answer and the stage's.
    pub shown: ShownRay,
    /// The stage has no answer, because of this.
    pub failure: Option<String>,
    /// The end of the ray's range after the call; `None` where no call changes it.
    pub max_t: Option<MaxT>,
    /// Whether the ray is that of the report's sentence: with another seed, cases have other rays.
    pub is_of_report: bool,
}

/// The end of a ray's range after a call: a hit ends it, a miss leaves it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaxT {
    /// The stage's.
    pub yours: f64,
    /// The right one for the hit or miss that the stage returned.
    pub right: f64,
}

impl MaxT {
    /// Whether the stage's is right.
    pub fn is_right(&self) -> bool {
        self.yours.to_bits() == self.right.to_bits()
    }

    /// Of an answer to one call with a ray whose range ended at `before`.
    fn of(answer: &Answer, before: f64) -> Option<MaxT> {
        let (yours, hit) = match answer {
            Answer::Triangles(answers) => {
                let answer = answers.first()?;
                (answer.ray_after.max_t, answer.hit)
            }
            Answer::Spheres(answers) => {
                let answer = answers.first()?;
                (answer.ray_after.max_t, answer.hit)
            }
            Answer::BruteForce(answers) => (*answers.max_t.first()?, *answers.hits.first()?),
            _ => return None,
        };
        let right = hit.map_or(before, |hit| hit.t);
        Some(MaxT { yours, right })
    }
}

/// Hits this many times the size of the shapes away are not in the middle of the picture.
const FAR: f64 = 3.0;

impl RayCase {
    /// A box around the shapes and the two answers. The ray may start far away.
    pub fn focus(&self) -> Aabb {
        let shown = &self.shown;
        let boxes = shown.boxes.iter().filter(|b| is_drawn(b));
        let shapes = boxes.fold(shown.scene.bounds(), |all, b| all.union(*b));
        if !is_drawn(&shapes) || shapes.extent().length() == 0.0 {
            return shown.bounds();
        }
        let hits = shown.yours.iter().chain(&shown.expected);
        let near = FAR * shapes.extent().length();
        hits.map(|&t| shown.ray.at(t))
            .filter(|p| p.is_finite() && p.distance(shapes.centroid()) <= near)
            .fold(shapes, Aabb::grown_by)
    }

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
        let mut shown = match answered.and_then(|answer| alone.shown(tier, 0, Some(&answer.answer)))
        {
            Some(ShownCall::Ray(shown)) => shown,
            _ => unanswered,
        };
        let max_t = answered.and_then(|answer| MaxT::of(&answer.answer, shown.ray.max_t));
        if let Some(max_t) = max_t {
            shown.rows.push(ComparedNumber {
                name: "max_t",
                yours: Some(format!("{:?}", max_t.yours)),
                expected: Some(format!("{:?}", max_t.right)),
                is_right: max_t.is_right(),
            });
        }
        let o = shown.camera.map_or(shown.ray.o, |(camera, _)| camera.pos);
        Some(RayCase {
            is_of_report: message.contains(&format!("{:?}", o.x)),
            max_t,
            failure: answer.err(),
            shown,
        })
    }
}
