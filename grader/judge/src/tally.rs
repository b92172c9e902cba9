//! Counts right and wrong answers, aspect by aspect.

use super::errors::{ErrorSpread, NumberError};
use super::whole::NotJudged;
use kit::Vec3;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A part of an answer that is judged separately.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Aspect {
    /// How often the student's code calls `camera_ray` and `trace_ray`.
    Calls,
    /// Where the samples lie in the pixel.
    Placement,
    /// How samples are distributed.
    Spread,
    /// Whether the samples of a pixel differ from those of other pixels, and from those with
    /// another seed.
    Independence,
    /// The radiance of a pixel or an estimate.
    Radiance,
    /// The origin of a camera ray.
    Origin,
    /// The direction of a camera ray.
    Direction,
    /// The length of a camera ray's direction.
    UnitLength,
    /// The range of a camera ray.
    Range,
    /// Hit or miss.
    // Reports and signatures have had this name from the start.
    #[serde(rename = "decision")]
    HitOrMiss,
    /// The index of the primitive.
    Primitive,
    /// Distance along the ray.
    T,
    /// Barycentric weights.
    Barycentrics,
    /// The hit point.
    Position,
    /// The shading normal.
    Normal,
    /// The geometric normal.
    GeometricNormal,
    /// The ray after the call.
    RayAfter,
    /// The interval inside a box.
    Interval,
    /// Whether the nodes form a tree whose leaves hold every primitive once.
    Structure,
    /// Whether the box of each node contains the primitives below it.
    Bounds,
    /// Whether leaves hold at most `max_leaf_size` primitives.
    LeafSize,
    /// Whether the same input gives the same tree.
    Repeatable,
    /// The number of tests compared with that of the reference.
    Work,
    /// Whether the tree saves tests at all.
    Savings,
    /// How the time to build a tree grows with its size.
    BuildTime,
    /// The value of a BSDF.
    Bsdf,
    /// A density, or the probability of a choice.
    Pdf,
    /// The direction of a sample.
    SampledDirection,
    /// The other fields of a sample: its value, density and delta flag.
    SampleRecord,
    /// The number of traced rays.
    Rays,
    /// The mean of many estimates.
    Mean,
    /// The Fresnel reflectance of a boundary.
    Fresnel,
    /// The throughput of a path.
    Throughput,
    /// The arguments of calls to other functions, such as direct light or the stopping rule.
    Questions,
    /// Whether a path continues.
    Survival,
    /// Whether a pixel has enough samples.
    Stop,
}

impl Aspect {
    /// Whether only an answer that is a hit, or a sample, has the aspect. A false miss lacks it, so
    /// a case about the aspect is also about hit or miss.
    pub(crate) fn needs_a_hit(self) -> bool {
        matches!(
            self,
            Aspect::Primitive
                | Aspect::T
                | Aspect::Barycentrics
                | Aspect::Position
                | Aspect::Normal
                | Aspect::GeometricNormal
                | Aspect::Interval
                | Aspect::SampledDirection
                | Aspect::SampleRecord
        )
    }

    /// Whether the aspect is one of all answers of a case together. Its faults are recorded at one
    /// call, but no call is to blame alone.
    pub(crate) fn is_of_all_calls(self) -> bool {
        matches!(
            self,
            Aspect::Mean
                | Aspect::Spread
                | Aspect::Work
                | Aspect::Savings
                | Aspect::BuildTime
                | Aspect::Structure
                | Aspect::Bounds
                | Aspect::LeafSize
                | Aspect::Repeatable
        )
    }

    /// The name of the aspect in reports.
    pub fn label(self) -> &'static str {
        match self {
            Aspect::Calls => "number of samples",
            Aspect::Placement => "sample positions",
            Aspect::Spread => "sample distribution",
            Aspect::Independence => "independence of samples",
            Aspect::Radiance => "radiance",
            Aspect::Origin => "ray origin",
            Aspect::Direction => "ray direction",
            Aspect::UnitLength => "unit length",
            Aspect::Range => "min_t and max_t",
            Aspect::HitOrMiss => "hit or miss",
            Aspect::Primitive => "primitive",
            Aspect::T => "t",
            Aspect::Barycentrics => "barycentric weights",
            Aspect::Position => "hit point",
            Aspect::Normal => "normal",
            Aspect::GeometricNormal => "geometric normal",
            Aspect::RayAfter => "ray after the call",
            Aspect::Interval => "interval",
            Aspect::Structure => "tree structure",
            Aspect::Bounds => "bounding boxes",
            Aspect::LeafSize => "leaf size",
            Aspect::Repeatable => "same tree on a second build",
            Aspect::Work => "number of tests",
            Aspect::Savings => "saved tests",
            Aspect::BuildTime => "growth of the build time",
            Aspect::Bsdf => "BSDF",
            Aspect::Pdf => "pdf",
            Aspect::SampledDirection => "sampled direction",
            Aspect::SampleRecord => "fields of the sample",
            Aspect::Rays => "number of rays",
            Aspect::Mean => "mean of estimates",
            Aspect::Fresnel => "Fresnel reflectance",
            Aspect::Throughput => "throughput",
            Aspect::Questions => "arguments of calls",
            Aspect::Survival => "which paths continue",
            Aspect::Stop => "when to stop",
        }
    }
}

/// The class of a wrong answer: the same mistake gives the same class, whatever formula contains
/// it. Signatures store the `Debug` text of a class.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// Wrong in a way that no other class describes.
    Wrong,
    /// Off by about 2 to this power.
    Off(i8),
    /// A hit where there is none.
    FalseHit,
    /// No hit where there is one.
    FalseMiss,
    /// NaN.
    NotANumber,
    /// The negated right number or direction.
    Negated,
    /// The right direction with another length.
    WrongLength,
    /// A number that is about 2 to this power times the right one.
    Ratio(i8),
    /// A colour whose channels are about 2 to the power of these numbers over `PER_OCTAVE` times
    /// the right ones; `BLACK_CHANNEL` for channels that are rightly black.
    Colour([i8; 3]),
    /// A wrong direction, or the mean of many, quantised along each axis.
    Towards([i8; 3]),
    /// An infinite number.
    Infinite,
    /// 0 where the right number is not 0.
    Zero,
    /// Off by the rounding of single precision, or of a constant that is typed with few digits.
    Rounded,
    /// The right numbers, swapped.
    Swapped,
    /// A fault with a name of its own. A finding may have several of them.
    Named(&'static str),
}

impl Class {
    /// The class of a wrong number.
    pub fn of_number(answered: f64, right: f64) -> Class {
        let ratio = answered / right;
        if answered.is_nan() {
            Class::NotANumber
        } else if answered.is_infinite() {
            Class::Infinite
        } else if answered == 0.0 {
            Class::Zero
        } else if (ratio + 1.0).abs() < SAME {
            Class::Negated
        } else if (ratio - 1.0).abs() < ROUNDED {
            Class::Rounded
        } else if ratio.is_finite() && ratio > 0.0 {
            Class::Ratio(ratio.log2().round().clamp(-99.0, 99.0) as i8)
        } else {
            Class::Wrong
        }
    }

    /// The class of a wrong colour where neither it nor the right one is black.
    pub fn of_colour(answered: [f64; 3], right: [f64; 3]) -> Class {
        let is_rounded = |(a, r): (f64, f64)| a == r || (a / r - 1.0).abs() < ROUNDED;
        if answered.into_iter().zip(right).all(is_rounded) {
            return Class::Rounded;
        }
        let mut ratios = [0; 3];
        for ((ratio, a), r) in ratios.iter_mut().zip(answered).zip(right) {
            if a == 0.0 && r == 0.0 {
                *ratio = BLACK_CHANNEL;
            } else if (a / r).is_finite() && a / r > 0.0 {
                let steps = PER_OCTAVE * (a / r).log2();
                *ratio = steps.round().clamp(-99.0, 99.0) as i8;
            } else {
                return Class::of_number(a, r);
            }
        }
        Class::Colour(ratios)
    }

    /// The class of an answer that is off by `size`, in any unit.
    pub fn of_size(size: f64) -> Class {
        if size.is_nan() {
            Class::NotANumber
        } else if size == f64::INFINITY {
            Class::Infinite
        } else {
            Class::Off(size.log2().round().clamp(-99.0, 99.0) as i8)
        }
    }

    /// The class of a ray's origin that is off by `off`: a fixed offset from the surface has a
    /// name.
    pub fn of_offset(off: f64) -> Class {
        match off {
            MIN_FIXED_OFFSET..=MAX_FIXED_OFFSET => Class::Named("an epsilon away"),
            _ => Class::of_size(off),
        }
    }

    /// The class of a wrong unit vector.
    pub fn of_direction(answered: Vec3, right: Vec3) -> Class {
        if answered.is_nan() {
            Class::NotANumber
        } else if (answered + right).length() < SAME {
            Class::Negated
        } else if (answered.normalize_or_zero() - right).length() < SAME
            && (answered.length() - 1.0).abs() > SAME
        {
            Class::WrongLength
        } else if (answered - right).length() < ROUNDED {
            Class::Rounded
        } else {
            Class::of_size((answered - right).length())
        }
    }

    /// The class of a wrong unit vector that does not depend on random numbers: a direction that is
    /// wrong in another way than sign or length is itself part of the class.
    pub fn of_certain_direction(answered: Vec3, right: Vec3) -> Class {
        match Class::of_direction(answered, right) {
            Class::Off(_) => {
                let way = 16.0 * answered.normalize_or_zero();
                Class::Towards(way.to_array().map(|along| along.round() as i8))
            }
            class => class,
        }
    }
}

/// Answers that match the right one to this bound after a change of sign, length or order have the
/// class of that change.
pub(crate) const SAME: f64 = 1e-6;

/// A smaller relative error comes from rounding: f32 has a precision of 6e-8, and a few operations
/// multiply it; 3.14159 for π is off by 8e-7.
const ROUNDED: f64 = 1e-5;

/// The smallest error of an origin that counts as a fixed offset. Rounding errors are smaller.
const MIN_FIXED_OFFSET: f64 = 1e-9;

/// The largest error of an origin that counts as a fixed offset from the surface.
const MAX_FIXED_OFFSET: f64 = 0.1;

/// A wrong answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Which call of the case.
    pub call: u32,
    /// The function that returned it, in cases that call several.
    pub function: Option<&'static str>,
    /// How it is wrong.
    pub class: Class,
}

/// Number of classes of colour ratios in a factor of 2.
pub(crate) const PER_OCTAVE: f64 = 4.0;

/// The ratio of a black channel to a right one that is also black.
pub const BLACK_CHANNEL: i8 = i8::MAX;

/// The result of judging one aspect in one case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Which aspect.
    pub aspect: Aspect,
    /// In how many calls a right answer has the aspect.
    pub expected: u32,
    /// In how many calls the answer has the aspect.
    pub judged: u32,
    /// How many of those were wrong.
    pub wrong: u32,
    /// Whether it is of a main answer of the case, without which the case gives no points.
    pub main: bool,
    /// The counts of each function, in cases of tasks with several.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub functions: Vec<FunctionCount>,
    /// The worst wrong answer.
    pub worst: Option<Worst>,
    /// All wrong answers.
    #[serde(skip)]
    pub faults: Vec<Fault>,
    /// In statistical tests: the smallest relative bias or deviation that is always detected.
    #[serde(rename = "sure", skip_serializing_if = "Option::is_none")]
    pub detectable: Option<f64>,
    /// The distribution of numerical errors, where they are measured.
    pub spread: Option<ErrorSpread>,
    /// The error of each number.
    #[serde(skip)]
    pub errors: Vec<NumberError>,
    /// The calls that were judged, in order.
    #[serde(skip)]
    pub judged_calls: Vec<u32>,
}

/// How many answers of one function were judged in an aspect.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct FunctionCount {
    /// The function.
    pub function: &'static str,
    /// In how many calls its answer has the aspect.
    pub judged: u32,
    /// How many of those were wrong.
    pub wrong: u32,
    #[serde(skip)]
    last_judged: Option<u32>,
    #[serde(skip)]
    last_wrong: Option<u32>,
}

impl FunctionCount {
    fn count(&mut self, call: u32, wrong: bool) {
        // Each call counts once.
        self.judged += u32::from(self.last_judged.replace(call) != Some(call));
        if wrong {
            self.wrong += u32::from(self.last_wrong.replace(call) != Some(call));
        }
    }
}

/// The worst wrong answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Worst {
    /// Which call of the case, counted from 0.
    pub call: u32,
    /// Rank among wrong answers; larger is worse.
    pub badness: f64,
    /// The student's result, the expected one and the input.
    pub message: String,
}

impl Finding {
    /// Whether the aspect earns its points: never wrong, and judged at least once if a right answer
    /// has it.
    pub fn passed(&self) -> bool {
        self.wrong == 0 && (self.judged > 0 || self.expected == 0)
    }

    /// As [`Finding::passed`], for the answers of one function. An aspect that is judged in the
    /// answers of no function counts for all of them; `None` if it is judged in those of others
    /// only.
    pub fn passed_by(&self, function: &str) -> Option<bool> {
        if self.functions.is_empty() {
            return Some(self.passed());
        }
        let own = self.functions.iter().find(|own| own.function == function)?;
        Some(own.wrong == 0)
    }

    /// Whether `function` has the aspect right at all: on more than half of its answers, or, in an
    /// aspect of all answers together, on all. `None` as in [`Finding::passed_by`].
    pub fn mostly_right_by(&self, function: &str) -> Option<bool> {
        if self.aspect.is_of_all_calls() {
            return self.passed_by(function);
        }
        if self.functions.is_empty() {
            let of = self.judged.max(self.expected);
            return Some(of == 0 || self.judged > 0 && 2 * self.wrong < of);
        }
        let own = self.functions.iter().find(|own| own.function == function)?;
        Some(own.judged == 0 || 2 * own.wrong < own.judged)
    }
}

impl Finding {
    fn of_function(&mut self, function: &'static str) -> &mut FunctionCount {
        let same = |own: &FunctionCount| own.function == function;
        let at = self.functions.iter().position(same).unwrap_or_else(|| {
            self.functions.push(FunctionCount {
                function,
                judged: 0,
                wrong: 0,
                last_judged: None,
                last_wrong: None,
            });
            self.functions.len() - 1
        });
        &mut self.functions[at]
    }
}

impl fmt::Display for Finding {
    /// The number of wrong answers and the worst one.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = self.judged.max(self.expected);
        write!(f, "{} wrong on {} of {of}", self.aspect.label(), self.wrong)?;
        match &self.worst {
            Some(worst) => write!(f, ": {}", worst.message),
            None => Ok(()),
        }
    }
}

/// A wrong aspect of the answer to one call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongAnswer {
    /// Which call of the case, counted from 0.
    pub call: u32,
    /// Which aspect.
    pub aspect: Aspect,
    /// The student's result, the expected one and the input.
    pub message: String,
}

/// Collects the findings of a case.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    findings: Vec<Finding>,
    /// Every wrong answer with its message, if they are kept.
    wrong_answers: Option<Vec<WrongAnswer>>,
    not_judged: Vec<NotJudged>,
    function: Option<&'static str>,
    counted_for: Option<&'static str>,
    not_written: Vec<String>,
}

impl Tally {
    /// The tally of a case in which some functions have holes: their answers mean nothing.
    pub fn without(not_written: &[String]) -> Tally {
        Tally {
            not_written: not_written.to_vec(),
            ..Tally::default()
        }
    }

    /// The same tally, but it keeps the message of every wrong answer, not only that of the worst
    /// ones.
    pub(crate) fn with_messages(self) -> Tally {
        Tally {
            wrong_answers: Some(Vec::new()),
            ..self
        }
    }

    /// The wrong answers, in the order in which they were judged, if they are kept.
    pub(crate) fn take_wrong_answers(&mut self) -> Vec<WrongAnswer> {
        self.wrong_answers.take().unwrap_or_default()
    }

    /// Whether the answers of `function` are to be judged: it has no hole. If they are not, its
    /// share of `aspects` is lost.
    pub fn is_written(&mut self, function: &'static str, aspects: &[Aspect]) -> bool {
        let is_written = self.not_written.iter().all(|hole| hole != function);
        if !is_written {
            for &aspect in aspects {
                self.entry(aspect).of_function(function);
            }
        }
        is_written
    }

    /// Sets the function that the next answers count for, in tasks with several functions.
    pub fn count_for(&mut self, function: &'static str) {
        self.counted_for = Some(function);
    }

    /// Sets the function whose answers are judged next, in a case that calls several.
    pub fn answers_of(&mut self, function: &'static str) {
        self.function = Some(function);
    }

    /// Counts a call whose right answer has `aspect`.
    pub fn expect(&mut self, aspect: Aspect) {
        self.entry(aspect).expected += 1;
    }

    /// Judges `aspect` of the answer to call number `call`; `badness` ranks the wrong answers.
    pub fn judge(
        &mut self,
        aspect: Aspect,
        call: usize,
        right: bool,
        badness: f64,
        message: impl FnOnce() -> String,
    ) {
        let class = (!right).then(|| Class::of_size(badness));
        self.judge_class(aspect, call, class, badness, message);
    }

    /// Judges `aspect` of the answer to call number `call`, with the class of a wrong answer;
    /// `None` if it is right.
    pub fn judge_class(
        &mut self,
        aspect: Aspect,
        call: usize,
        class: Option<Class>,
        badness: f64,
        message: impl FnOnce() -> String,
    ) {
        let call = u32::try_from(call).unwrap_or(u32::MAX);
        let (function, counted_for) = (self.function, self.counted_for);
        let keeps_messages = self.wrong_answers.is_some();
        let finding = self.entry(aspect);
        // Two functions may be judged on the same aspect in one call: it counts once.
        if finding.judged_calls.last() != Some(&call) {
            finding.judged += 1;
            finding.judged_calls.push(call);
        }
        if let Some(function) = counted_for {
            finding.of_function(function).count(call, class.is_some());
        }
        let Some(class) = class else { return };
        let again = finding.faults.last().is_some_and(|last| last.call == call);
        finding.wrong += u32::from(!again);
        finding.faults.push(Fault {
            call,
            function,
            class,
        });
        // NaN ranks as the worst.
        let badness = if badness.is_nan() {
            f64::INFINITY
        } else {
            badness
        };
        let is_worst = finding
            .worst
            .as_ref()
            .is_none_or(|worst| badness > worst.badness);
        if !is_worst && !keeps_messages {
            return;
        }
        let message = message();
        if is_worst {
            finding.worst = Some(Worst {
                call,
                badness,
                message: message.clone(),
            });
        }
        if let Some(all) = &mut self.wrong_answers {
            all.push(WrongAnswer {
                call,
                aspect,
                message,
            });
        }
    }

    /// Records that `aspect` of the answer to call number `call` is not judged, because of `why`:
    /// no answer, or none within wide limits, would count as wrong.
    pub(crate) fn not_judged(&mut self, aspect: Aspect, call: usize, why: &'static str) {
        let call = Some(u32::try_from(call).unwrap_or(u32::MAX));
        self.not_judged.push(NotJudged { aspect, call, why });
    }

    /// Records that `aspect` is judged in no answer of the case, because of `why`.
    pub(crate) fn never_judged(&mut self, aspect: Aspect, why: &'static str) {
        let call = None;
        self.not_judged.push(NotJudged { aspect, call, why });
    }

    /// What is not judged, in the order in which it was recorded.
    pub(crate) fn take_not_judged(&mut self) -> Vec<NotJudged> {
        std::mem::take(&mut self.not_judged)
    }

    /// Whether no answer so far has a wrong `aspect`.
    pub fn is_right(&mut self, aspect: Aspect) -> bool {
        self.entry(aspect).wrong == 0
    }

    /// Records that a statistical test of `aspect` always detects a relative deviation of `share`;
    /// of several tests the largest value counts.
    pub fn set_detectable(&mut self, aspect: Aspect, share: f64) {
        let weakest = &mut self.entry(aspect).detectable;
        *weakest = Some(weakest.map_or(share, |other| other.max(share)));
    }

    /// Records the error of a number that belongs to `aspect`, right or wrong.
    pub fn measure(&mut self, aspect: Aspect, error: NumberError) {
        self.entry(aspect).errors.push(error);
    }

    /// The findings, in the order in which their aspects were first judged or expected.
    pub fn into_findings(mut self) -> Vec<Finding> {
        for finding in &mut self.findings {
            finding.spread = ErrorSpread::of(&finding.errors);
        }
        self.findings
    }

    fn entry(&mut self, aspect: Aspect) -> &mut Finding {
        let at = self
            .findings
            .iter()
            .position(|finding| finding.aspect == aspect)
            .unwrap_or_else(|| {
                self.findings.push(Finding {
                    aspect,
                    expected: 0,
                    judged: 0,
                    wrong: 0,
                    main: false,
                    functions: Vec::new(),
                    worst: None,
                    detectable: None,
                    faults: Vec::new(),
                    spread: None,
                    errors: Vec::new(),
                    judged_calls: Vec::new(),
                });
                self.findings.len() - 1
            });
        &mut self.findings[at]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two functions answer each of four calls; the second is wrong from `wrong_from` on.
    fn judged(wrong_from: usize) -> Finding {
        let mut tally = Tally::default();
        for call in 0..4 {
            tally.count_for("test");
            tally.judge(Aspect::T, call, true, 0.0, String::new);
            tally.count_for("record");
            for _ in 0..2 {
                tally.judge(Aspect::T, call, call < wrong_from, 1.0, String::new);
            }
        }
        tally.into_findings().remove(0)
    }

    #[test]
    fn each_function_is_counted_by_itself_and_each_call_once() {
        let finding = judged(3);
        assert_eq!((finding.judged, finding.wrong), (4, 1));
        let counts = finding.functions.iter();
        let counts: Vec<_> = counts.map(|f| (f.function, f.judged, f.wrong)).collect();
        assert_eq!(counts, [("test", 4, 0), ("record", 4, 1)]);
        assert_eq!(finding.passed_by("test"), Some(true));
        assert_eq!(finding.passed_by("record"), Some(false));
        assert_eq!(finding.passed_by("other"), None);
    }

    #[test]
    fn half_of_the_answers_is_not_most_of_them() {
        assert_eq!(judged(3).mostly_right_by("record"), Some(true));
        assert_eq!(judged(2).mostly_right_by("record"), Some(false));
        assert_eq!(judged(2).mostly_right_by("test"), Some(true));
    }

    #[test]
    fn an_aspect_of_all_answers_together_is_right_or_wrong() {
        let mut tally = Tally::default();
        for call in 0..9 {
            tally.judge(Aspect::Mean, call, call > 0, 1.0, String::new);
        }
        let finding = tally.into_findings().remove(0);
        assert_eq!(finding.mostly_right_by(""), Some(false));
    }

    #[test]
    fn a_function_with_a_hole_has_a_share_of_its_aspects() {
        let mut tally = Tally::without(&["record".to_string()]);
        assert!(tally.is_written("test", &[Aspect::T]));
        assert!(!tally.is_written("record", &[Aspect::T]));
        let findings = tally.into_findings();
        assert_eq!(findings.len(), 1, "{findings:?}");
        assert_eq!(findings[0].functions[0].function, "record");
        assert_eq!(findings[0].judged, 0);
    }
}
