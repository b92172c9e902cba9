//! Compares a kernel's results with the oracle's.

use super::report::{Accuracy, Errors, Quantiles, RayFamily};
use super::truth::{Answer, OracleShape, Truth};
use kernels::Precision;
use kit::Ray;
use oracle::bbox::SLACK;

/// Pairs of a shape and a ray of one family, rounded to a precision, with the oracle's truth.
pub(crate) struct TestSet<S> {
    family: RayFamily,
    /// The pairs that a kernel is run on.
    pub(crate) pairs: Vec<(S, Ray)>,
    truths: Vec<Truth>,
}

/// Number of quantiles stored of a distribution, at equal steps; three more are near its end.
const CDF_POINTS: usize = 48;

impl<S: OracleShape> TestSet<S> {
    /// Computes the truth of each pair with the oracle.
    pub(crate) fn new(family: RayFamily, pairs: Vec<(S, Ray)>) -> TestSet<S> {
        let truths = pairs.iter().map(|(shape, ray)| shape.truth(ray)).collect();
        TestSet {
            family,
            pairs,
            truths,
        }
    }

    /// Compares answers with the truth. There is one answer per pair, in order, computed in
    /// `precision`. `culls`: the kernel misses back faces on purpose, so pairs with a back face are
    /// skipped.
    pub(crate) fn accuracy(
        &self,
        precision: Precision,
        culls: bool,
        answers: impl Iterator<Item = Option<Answer>>,
    ) -> Accuracy {
        let mut counts = AccuracyCounts::default();
        let each = self.pairs.iter().zip(&self.truths).zip(answers);
        for (((shape, _), truth), answer) in each {
            if truth.front_facing || !culls {
                counts.add(shape, truth, answer, precision);
            }
        }
        counts.accuracy(self.family)
    }
}

/// Accumulates counts and errors.
#[derive(Default)]
struct AccuracyCounts {
    rays: usize,
    false_hits: usize,
    false_misses: usize,
    undecidable: usize,
    undecidable_differing: usize,
    beyond_bound: usize,
    t: ErrorSamples,
    position: ErrorSamples,
    off_surface: ErrorSamples,
    bounds: Vec<f64>,
}

impl AccuracyCounts {
    fn add<S: OracleShape>(
        &mut self,
        shape: &S,
        truth: &Truth,
        answer: Option<Answer>,
        precision: Precision,
    ) {
        self.rays += 1;
        // Bounds are derived for `f64`; they are proportional to the unit roundoff.
        let unit = precision.epsilon() / f64::EPSILON;
        let is_wrong = answer.is_some() != truth.hits;
        if truth.undecidable || (!truth.hits && truth.gap <= SLACK * unit) {
            self.undecidable += 1;
            self.undecidable_differing += usize::from(is_wrong);
        } else if is_wrong {
            *(if truth.hits {
                &mut self.false_misses
            } else {
                &mut self.false_hits
            }) += 1;
        }
        let Some(answer) = answer.filter(|_| truth.hits) else {
            return;
        };
        let mut is_beyond = false;
        for (end, t) in truth.ends.iter().zip(answer.ends) {
            let Some(end) = end else { continue };
            let size = end.t.to_f64().abs();
            let off = end.t.ulps(t);
            // If the truth is 0, the relative error is 0 or infinite.
            let relative = if off == 0.0 {
                0.0
            } else {
                off * (end.t.ulp() / size)
            };
            self.t.add(off / unit, relative, precision);
            let bound = (end.bound * unit / size).min(1.0);
            self.bounds.push(bound);
            is_beyond |= relative.min(1.0) > bound;
        }
        self.beyond_bound += usize::from(is_beyond);
        if let Some((p, truth)) = answer.p.zip(truth.p) {
            let reach = shape.reach();
            let add = |samples: &mut ErrorSamples, off: f64| {
                let relative = off / reach;
                samples.add(off / ulp_of(reach, precision), relative, precision);
            };
            add(&mut self.position, (p - truth).abs().max_element());
            add(&mut self.off_surface, shape.off_surface(p));
        }
    }

    fn accuracy(mut self, family: RayFamily) -> Accuracy {
        let per_million = |count: usize| 1e6 * count as f64 / self.rays.max(1) as f64;
        let t = self.t.errors();
        Accuracy {
            family,
            rays: self.rays,
            false_hits_per_million: per_million(self.false_hits),
            false_misses_per_million: per_million(self.false_misses),
            undecidable_per_million: per_million(self.undecidable),
            undecidable_differing_per_million: per_million(self.undecidable_differing),
            beyond_bound_per_million: per_million(self.beyond_bound),
            cdf: distribution(&self.t.relative),
            t,
            position: self.position.errors(),
            off_surface: self.off_surface.errors(),
            forward_bound: {
                self.bounds.sort_unstable_by(f64::total_cmp);
                distribution(&self.bounds)
            },
        }
    }
}

/// Returns one unit in the last place of a number of this size.
fn ulp_of(size: f64, precision: Precision) -> f64 {
    let power_of_two = f64::from_bits(size.to_bits() & 0x7ff0_0000_0000_0000);
    power_of_two * precision.epsilon()
}

/// A list of errors, in both units.
#[derive(Default)]
struct ErrorSamples {
    ulp: Vec<f64>,
    relative: Vec<f64>,
}

impl ErrorSamples {
    /// Adds an error. Errors larger than the true value, and NaN, count as 100 %: no digit is
    /// correct.
    fn add(&mut self, ulp: f64, relative: f64, precision: Precision) {
        let is_finite = relative < 1.0;
        self.relative.push(if is_finite { relative } else { 1.0 });
        let whole = 1.0 / precision.epsilon();
        self.ulp
            .push(if is_finite { ulp.min(whole) } else { whole });
    }

    /// Sorts the errors and returns their quantiles; `None` if there are none.
    fn errors(&mut self) -> Option<Errors> {
        let sorted = |errors: &mut Vec<f64>| {
            errors.sort_unstable_by(f64::total_cmp);
            Some(Quantiles {
                p50: quantile(errors, 0.5)?,
                p999: quantile(errors, 0.999)?,
                max: quantile(errors, 1.0)?,
            })
        };
        Some(Errors {
            ulp: sorted(&mut self.ulp)?,
            relative: sorted(&mut self.relative)?,
        })
    }
}

/// Returns a quantile of sorted numbers (nearest rank).
fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let rank = (share * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.max(1) - 1).copied()
}

/// Returns the distribution of sorted numbers: pairs (number, fraction of numbers that are at most
/// this).
fn distribution(sorted: &[f64]) -> Vec<(f64, f64)> {
    let shares = (1..CDF_POINTS)
        .map(|i| i as f64 / CDF_POINTS as f64)
        .chain([0.99, 0.999, 1.0]);
    shares
        .filter_map(|share| Some((quantile(sorted, share)?, share)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{Triangle, Vec3};

    fn test_set() -> TestSet<Triangle> {
        let tri = Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y);
        let down = |x: f64| Ray::new(Vec3::new(x, 0.25, 2.0), Vec3::NEG_Z);
        let pairs = [0.25, 0.5, 0.75, 0.9].map(|x| (tri, down(x)));
        TestSet::new(RayFamily::Ordinary, pairs.into())
    }

    fn at(t: f64, x: f64) -> Option<Answer> {
        Some(Answer {
            ends: [t; 2],
            p: Some(Vec3::new(x, 0.25, 2.0 - t)),
        })
    }

    #[test]
    fn each_kind_of_error_is_counted() {
        let off = 2.0 + 4.0 * f64::EPSILON;
        // A hit with an error of 2 ulp, a false miss, a hit on the boundary, a false hit.
        let answers = [at(off, 0.25), None, at(2.0, 0.75), at(2.0, 0.9)];
        let accuracy = test_set().accuracy(Precision::F64, false, answers.into_iter());
        assert_eq!(accuracy.rays, 4);
        assert_eq!(accuracy.false_misses_per_million, 250_000.0);
        assert_eq!(accuracy.false_hits_per_million, 250_000.0);
        assert_eq!(accuracy.undecidable_per_million, 0.0);
        let t = accuracy.t.unwrap();
        assert_eq!(
            (t.ulp.p50, t.ulp.max, t.relative.max),
            (0.0, 2.0, 2.0 * f64::EPSILON)
        );
        let off_surface = accuracy.off_surface.unwrap();
        assert_eq!(off_surface.relative.max, 4.0 * f64::EPSILON);
        assert_eq!(accuracy.cdf.last(), Some(&(2.0 * f64::EPSILON, 1.0)));
        assert_eq!(accuracy.cdf.len(), accuracy.forward_bound.len());
    }

    #[test]
    fn back_faces_are_skipped_for_culling_kernels() {
        let mut test_set = test_set();
        // From below, the ray sees the back face.
        for (_, ray) in &mut test_set.pairs[2..] {
            *ray = Ray::new(ray.o - 4.0 * Vec3::Z, Vec3::Z);
        }
        let test_set = TestSet::new(RayFamily::Ordinary, test_set.pairs);
        let answers = [at(2.0, 0.25), at(2.0, 0.5), None, None];
        let culling = test_set.accuracy(Precision::F64, true, answers.into_iter());
        assert_eq!((culling.rays, culling.false_misses_per_million), (2, 0.0));
        let plain = test_set.accuracy(Precision::F64, false, answers.into_iter());
        assert_eq!((plain.rays, plain.false_misses_per_million), (4, 250_000.0));
    }

    #[test]
    fn nan_and_infinite_answers_give_finite_errors() {
        let answers = [at(f64::NAN, 0.25), at(f64::INFINITY, 0.5), None, None];
        let accuracy = test_set().accuracy(Precision::F32, false, answers.into_iter());
        let t = accuracy.t.unwrap();
        assert_eq!(t.relative.max, 1.0);
        assert_eq!(t.ulp.max, 1.0 / f64::from(f32::EPSILON));
        assert_eq!(accuracy.position.unwrap().relative.max, 1.0);
    }
}
