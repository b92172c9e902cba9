//! Many primitives: the closest hit, ties, and any hit.

use kit::scene::Primitive;
use kit::{PrimId, Ray};

use super::real::Real;
use super::sphere::sphere;
use super::triangle::triangle;
use super::verdict::{Answers, Candidate, Judgement, Kernel, PerKernel};

/// What a ray truly hits first, and which answers score.
#[derive(Clone, Debug, PartialEq)]
pub struct Closest {
    /// The exact closest hit; of exactly equal ones the lowest number.
    pub nearest: Option<(PrimId, Real)>,
    /// All primitives at that `t`, to 126 bits.
    pub ties: Vec<PrimId>,
    /// The answers that score.
    pub answers: PerKernel<ClosestAnswers>,
}

/// The primitives that may be answered.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ClosestAnswers {
    /// Which primitive where, by number. More than one where `f64` cannot tell which is first.
    pub hits: Vec<(PrimId, Candidate)>,
    /// Whether "no hit" scores.
    pub miss: bool,
}

/// What an answer for the closest hit is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClosestJudgement {
    /// The primitive scores; its `t` is judged apart.
    Primitive(Judgement),
    /// There is a hit, but not of this primitive.
    WrongPrimitive,
    /// A miss was answered where it scores.
    Miss,
    /// There is no hit.
    FalseHit,
    /// There is a hit.
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
        // A sphere may be there twice, once by root.
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
    pub fn judge(&self, kernel: Kernel, answer: Option<(PrimId, f64)>) -> ClosestJudgement {
        self.answers.get(kernel).judge(answer)
    }

    /// Whether "something is in the way" scores, and whether "nothing" does.
    pub fn judge_any(&self, kernel: Kernel, blocked: bool) -> bool {
        let answers = self.answers.get(kernel);
        match blocked {
            true => !answers.hits.is_empty(),
            false => answers.miss,
        }
    }
}

/// The exact answer and the answers that score, for one primitive.
fn one(primitive: Primitive<'_>, ray: &Ray) -> (Option<Real>, PerKernel<Answers>) {
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

/// The closest hit of `ray` among `primitives`, which are numbered from 0, by testing each.
pub fn closest<'a>(primitives: impl IntoIterator<Item = Primitive<'a>>, ray: &Ray) -> Closest {
    let mut nearest: Option<(PrimId, Real)> = None;
    let mut ties = Vec::new();
    let mut seen: PerKernel<Vec<(PrimId, Answers)>> = PerKernel::default();
    for (id, primitive) in (0..).map(PrimId).zip(primitives) {
        let (t, answers) = one(primitive, ray);
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
        for kernel in [Kernel::Textbook, Kernel::Robust] {
            let answers = *answers.get(kernel);
            if answers != Answers::MISS {
                let seen = match kernel {
                    Kernel::Textbook => &mut seen.textbook,
                    Kernel::Robust => &mut seen.robust,
                };
                seen.push((id, answers));
            }
        }
    }
    Closest {
        nearest,
        ties,
        answers: PerKernel::each(|kernel| scoring(seen.get(kernel))),
    }
}

/// The hits that may come first: those that can start before every sure hit must have been found.
fn scoring(seen: &[(PrimId, Answers)]) -> ClosestAnswers {
    let latest = |answers: &Answers| {
        let hits = answers.hits.iter().flatten();
        hits.map(|c| c.t.to_f64() + c.tolerance)
            .fold(f64::NEG_INFINITY, f64::max)
    };
    let sure = seen.iter().filter(|(_, answers)| !answers.miss);
    let limit = sure
        .clone()
        .map(|(_, answers)| latest(answers))
        .fold(f64::INFINITY, f64::min);
    let hits = seen.iter().flat_map(|(id, answers)| {
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

/// Whether anything is truly in the way of `ray`.
pub fn any<'a>(primitives: impl IntoIterator<Item = Primitive<'a>>, ray: &Ray) -> bool {
    primitives.into_iter().any(|p| one(p, ray).0.is_some())
}
