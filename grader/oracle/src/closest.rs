//! Closest hit, ties and any hit among many primitives.

use kit::scene::Primitive;
use kit::{PrimId, Ray};

use super::big_float::BigFloat;
use super::sphere::sphere;
use super::triangle::triangle;
use super::verdict::{Answers, Candidate, Judgement, KernelClass, PerKernel};

/// The exact closest hit of a ray, and which answers score.
///
/// ```
/// use kit::{PrimId, Primitive, Ray, Triangle, Vec3};
/// use oracle::{KernelClass, closest};
/// let at = |z| Triangle::flat(Vec3::new(0.0, 0.0, z), Vec3::new(4.0, 0.0, z), Vec3::new(0.0, 4.0, z));
/// let triangles = [at(0.0), at(1.0), at(1.0)];
/// let ray = Ray::new(Vec3::new(1.0, 1.0, 3.0), Vec3::NEG_Z);
/// let closest = closest(triangles.iter().map(Primitive::Triangle), &ray);
/// // Two triangles at the same distance: either scores, the lower id is named.
/// assert_eq!(closest.nearest.map(|(id, t)| (id, t.to_f64())), Some((PrimId(1), 2.0)));
/// assert_eq!(closest.ties, [PrimId(1), PrimId(2)]);
/// assert!(closest.judge(KernelClass::Textbook, Some((PrimId(2), 2.0))).scores());
/// assert!(!closest.judge(KernelClass::Textbook, Some((PrimId(0), 3.0))).scores());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Closest {
    /// The exact closest hit; of equal ones the one with the lowest id.
    pub nearest: Option<(PrimId, BigFloat)>,
    /// All primitives whose `t` equals the closest one in 126 bits.
    pub ties: Vec<PrimId>,
    /// The answers that score.
    pub answers: PerKernel<ClosestAnswers>,
}

/// The set of answers for the closest hit that score.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ClosestAnswers {
    /// Primitives that score with their `t`, by id. More than one if `f64` cannot decide which is
    /// first.
    pub hits: Vec<(PrimId, Candidate)>,
    /// Whether "no hit" scores.
    pub miss: bool,
}

/// The result of judging an answer for the closest hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClosestJudgement {
    /// The primitive is one that scores; its `t` is judged separately.
    Primitive(Judgement),
    /// The ray hits, but the primitive is not one that scores.
    WrongPrimitive,
    /// The answer is a miss, and a miss scores.
    Miss,
    /// The answer is a hit; the ray misses.
    FalseHit,
    /// The answer is a miss; the ray hits.
    FalseMiss,
}

impl ClosestJudgement {
    /// Whether the answer scores in full.
    pub fn scores(&self) -> bool {
        match self {
            ClosestJudgement::Primitive(t) => t.scores(),
            other => *other == ClosestJudgement::Miss,
        }
    }
}

impl ClosestAnswers {
    /// Whether more than one answer scores.
    pub fn undecidable(&self) -> bool {
        self.hits.len() + usize::from(self.miss) > 1
    }

    /// Judges an answer: primitive and `t` of a hit, or `None` for a miss.
    pub fn judge(&self, answer: Option<(PrimId, f64)>) -> ClosestJudgement {
        let Some((id, t)) = answer else {
            return match self.miss {
                true => ClosestJudgement::Miss,
                false => ClosestJudgement::FalseMiss,
            };
        };
        if self.hits.is_empty() {
            return ClosestJudgement::FalseHit;
        }
        // A sphere may appear twice, once per root.
        let own = self.hits.iter().filter(|(known, _)| *known == id);
        own.map(|(_, candidate)| judge_t(candidate, t, self.undecidable()))
            .reduce(|a, b| if a.scores() { a } else { b })
            .map_or(
                ClosestJudgement::WrongPrimitive,
                ClosestJudgement::Primitive,
            )
    }
}

fn judge_t(candidate: &Candidate, t: f64, undecidable: bool) -> Judgement {
    let answers = Answers {
        hits: [Some(*candidate), None],
        miss: undecidable,
    };
    answers.judge(Some(t))
}

impl Closest {
    /// Judges an answer: primitive and `t` of a hit, or `None` for a miss.
    pub fn judge(&self, kernel: KernelClass, answer: Option<(PrimId, f64)>) -> ClosestJudgement {
        self.answers.get(kernel).judge(answer)
    }

    /// Whether the answer of an any-hit query scores.
    pub fn judge_any(&self, kernel: KernelClass, blocked: bool) -> bool {
        let answers = self.answers.get(kernel);
        match blocked {
            true => !answers.hits.is_empty(),
            false => answers.miss,
        }
    }
}

/// Returns the exact `t` of the hit with one primitive, and the answers that score.
fn test_primitive(primitive: Primitive<'_>, ray: &Ray) -> (Option<BigFloat>, PerKernel<Answers>) {
    match primitive {
        Primitive::Triangle(tri) => {
            let verdict = triangle(tri, ray);
            let t = verdict.crossing.map(|at| at.t);
            (t.filter(|_| verdict.hits()), verdict.answers)
        }
        Primitive::Sphere(s) => {
            let verdict = sphere(s, ray);
            (verdict.t, verdict.answers)
        }
    }
}

/// Returns the closest hit of `ray` among `primitives`, whose ids count from 0, by testing every
/// one.
pub fn closest<'a>(primitives: impl IntoIterator<Item = Primitive<'a>>, ray: &Ray) -> Closest {
    closest_of((0..).map(PrimId).zip(primitives), ray)
}

/// The same of primitives with their ids.
pub(super) fn closest_of<'a>(
    primitives: impl Iterator<Item = (PrimId, Primitive<'a>)>,
    ray: &Ray,
) -> Closest {
    let mut nearest: Option<(PrimId, BigFloat)> = None;
    let mut ties = Vec::new();
    let mut answered: PerKernel<Vec<(PrimId, Answers)>> = PerKernel::default();
    for (id, primitive) in primitives {
        let (t, answers) = test_primitive(primitive, ray);
        if let Some(t) = t {
            match nearest {
                Some((_, best)) if t > best => {}
                Some((_, best)) if t == best => ties.push(id),
                _ => {
                    nearest = Some((id, t));
                    ties = vec![id];
                }
            }
        }
        for kernel in [KernelClass::Textbook, KernelClass::Robust] {
            let answers = *answers.get(kernel);
            if answers != Answers::MISS {
                let list = match kernel {
                    KernelClass::Textbook => &mut answered.textbook,
                    KernelClass::Robust => &mut answered.robust,
                };
                list.push((id, answers));
            }
        }
    }
    Closest {
        nearest,
        ties,
        answers: PerKernel::each(|kernel| scoring_answers(answered.get(kernel))),
    }
}

/// Returns the hits that may be the closest: those whose smallest possible `t` is not larger than
/// the largest possible `t` of any certain hit.
fn scoring_answers(answered: &[(PrimId, Answers)]) -> ClosestAnswers {
    let latest = |answers: &Answers| {
        let hits = answers.hits.iter().flatten();
        hits.map(|c| c.t.to_f64() + c.tolerance)
            .fold(f64::NEG_INFINITY, f64::max)
    };
    let sure = answered.iter().filter(|(_, answers)| !answers.miss);
    let limit = sure
        .clone()
        .map(|(_, answers)| latest(answers))
        .fold(f64::INFINITY, f64::min);
    let hits = answered.iter().flat_map(|(id, answers)| {
        let hits = answers.hits.into_iter().flatten();
        hits.map(|candidate| (*id, candidate))
    });
    ClosestAnswers {
        hits: hits
            .filter(|(_, c)| {
                let is_behind = c.t.to_f64() - c.tolerance > limit;
                !is_behind
            })
            .collect(),
        miss: sure.count() == 0,
    }
}

/// Whether `ray` hits any primitive, exactly.
pub fn any<'a>(primitives: impl IntoIterator<Item = Primitive<'a>>, ray: &Ray) -> bool {
    primitives
        .into_iter()
        .any(|p| test_primitive(p, ray).0.is_some())
}
