//! Counting right and wrong answers, aspect by aspect.

use super::errors::{ErrorSpread, NumberError};
use kit::Vec3;
use serde::Serialize;
use std::fmt;

/// One side of an answer that is scored by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Aspect {
    /// How often the student's code called its neighbours.
    Calls,
    /// Where samples fall in the pixel.
    Placement,
    /// How samples spread over the pixel.
    Spread,
    /// What the samples are averaged to.
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
    Decision,
    /// Which primitive.
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
    /// Whether the tree is one, and holds every primitive once.
    Structure,
    /// Whether boxes hold what is below them.
    Bounds,
    /// Whether leaves are as small as asked.
    LeafSize,
    /// Whether the same input gives the same tree.
    Repeatable,
    /// Work done against work recorded for the reference.
    Work,
    /// The value of a BSDF.
    Bsdf,
    /// A density, or the probability of a choice.
    Pdf,
    /// Which way a sample goes.
    SampledDirection,
    /// What a sample says of itself.
    SampleRecord,
    /// How many rays were asked for.
    Rays,
    /// The mean of many estimates.
    Mean,
    /// The share of light that a boundary reflects.
    Fresnel,
    /// What a path multiplies light by.
    Throughput,
    /// What neighbours were asked.
    Questions,
    /// Whether a path goes on.
    Survival,
    /// Whether there are samples enough.
    Stop,
}

impl Aspect {
    /// For people.
    pub fn label(self) -> &'static str {
        match self {
            Aspect::Calls => "number of samples",
            Aspect::Placement => "sample positions",
            Aspect::Spread => "sample distribution",
            Aspect::Radiance => "radiance",
            Aspect::Origin => "ray origin",
            Aspect::Direction => "ray direction",
            Aspect::UnitLength => "unit length",
            Aspect::Range => "min_t and max_t",
            Aspect::Decision => "hit or miss",
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
            Aspect::Repeatable => "same tree again",
            Aspect::Work => "work",
            Aspect::Bsdf => "BSDF",
            Aspect::Pdf => "pdf",
            Aspect::SampledDirection => "sampled direction",
            Aspect::SampleRecord => "record of the sample",
            Aspect::Rays => "number of rays",
            Aspect::Mean => "mean of estimates",
            Aspect::Fresnel => "reflected share",
            Aspect::Throughput => "throughput",
            Aspect::Questions => "what neighbours are asked",
            Aspect::Survival => "which paths go on",
            Aspect::Stop => "when to stop",
        }
    }
}

/// The class of a wrong answer: what the same mistake shows whatever formula it is made in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// Nothing more is known than that it is wrong.
    Wrong,
    /// Off by about 2 to this power.
    Off(i8),
    /// A hit where there is none.
    FalseHit,
    /// No hit where there is one.
    FalseMiss,
    /// A number that is not one.
    NotANumber,
    /// The right number or direction with its sign turned.
    Negated,
    /// The right direction with another length.
    WrongLength,
    /// A number whose ratio to the right one is about 2 to this power.
    Ratio(i8),
    /// A colour whose channels have about these ratios to the right ones, in `PER_OCTAVE`ths of a
    /// power of 2; `BLACK_CHANNEL` for channels that are black, and rightly so.
    Colour([i8; 3]),
    /// A direction that goes this way instead, or many whose middle lies there, in small fractions
    /// of its length along each axis.
    Towards([i8; 3]),
    /// An infinite number.
    Infinite,
    /// 0 where the right number is another.
    Zero,
    /// The right numbers in each other's places.
    Swapped,
    /// A fault with a name of its own; several of them stand beside each other, whatever else is
    /// wrong.
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
        } else if ratio.is_finite() && ratio > 0.0 {
            Class::Ratio(ratio.log2().round().clamp(-99.0, 99.0) as i8)
        } else {
            Class::Wrong
        }
    }

    /// The class of a wrong colour that is not black instead of another, nor another instead of
    /// black.
    pub fn of_colour(answered: [f64; 3], right: [f64; 3]) -> Class {
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

    /// The class of an answer that is off by `size`, in whatever unit.
    pub fn of_size(size: f64) -> Class {
        if size.is_nan() {
            Class::NotANumber
        } else if size == f64::INFINITY {
            Class::Infinite
        } else {
            Class::Off(size.log2().round().clamp(-99.0, 99.0) as i8)
        }
    }

    /// The class of a ray's origin that is off by `off`: what a fixed offset from the surface makes
    /// has a name.
    pub fn of_offset(off: f64) -> Class {
        match off {
            EPSILONS_FROM..=EPSILONS_TO => Class::Named("an epsilon away"),
            _ => Class::of_size(off),
        }
    }

    /// The class of a wrong unit vector.
    pub fn of_direction(answered: Vec3, right: Vec3) -> Class {
        if answered.is_nan() {
            Class::NotANumber
        } else if (answered + right).length() < SAME {
            Class::Negated
        } else if (answered.normalize_or_zero() - right).length() < SAME {
            Class::WrongLength
        } else {
            Class::of_size((answered - right).length())
        }
    }

    /// The same for a direction that no chance has a part in: also where it goes.
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

/// Wrong answers this close to the right one, but for sign or length or place, are of that class.
pub(crate) const SAME: f64 = 1e-6;

/// Origins that are off by so much are meant to be,
const EPSILONS_FROM: f64 = 1e-9;

/// up to the largest fixed offset from a surface that anybody would take.
const EPSILONS_TO: f64 = 0.1;

/// A wrong answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Which call of the case.
    pub call: u32,
    /// Which function gave it, where the calls of a case are calls of several.
    pub function: Option<&'static str>,
    /// How it is wrong.
    pub class: Class,
}

/// How many classes of ratios of colours there are between a number and its double.
pub(crate) const PER_OCTAVE: f64 = 4.0;

/// Stands for the ratio of black to black.
pub const BLACK_CHANNEL: i8 = i8::MAX;

/// What was found about one aspect in one case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Which aspect.
    pub aspect: Aspect,
    /// On how many calls a right answer would have shown it.
    pub expected: u32,
    /// On how many calls the answer showed it.
    pub judged: u32,
    /// How many of those were wrong.
    pub wrong: u32,
    /// The worst of them.
    pub worst: Option<Worst>,
    /// Each of them.
    #[serde(skip)]
    pub faults: Vec<Fault>,
    /// Where many answers are judged by chance: the smallest bias or deviation, as a share, that is
    /// sure to be seen.
    #[serde(rename = "sure", skip_serializing_if = "Option::is_none")]
    pub detectable: Option<f64>,
    /// How far off its numbers are, where that is measured.
    pub spread: Option<ErrorSpread>,
    /// The same number by number.
    #[serde(skip)]
    pub errors: Vec<NumberError>,
    #[serde(skip)]
    last_judged: Option<u32>,
}

/// The worst wrong answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Worst {
    /// Which call of the case, counted from 0.
    pub call: u32,
    /// How bad, to rank by; larger is worse.
    pub badness: f64,
    /// What was asked, what came, what was right.
    pub message: String,
}

impl Finding {
    /// Whether the aspect earns its points: shown at all where it could be, and never wrong.
    pub fn passed(&self) -> bool {
        self.wrong == 0 && (self.judged > 0 || self.expected == 0)
    }
}

impl fmt::Display for Finding {
    /// What is wrong, in a sentence, with the worst answer.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = self.judged.max(self.expected);
        write!(f, "{} wrong on {} of {of}", self.aspect.label(), self.wrong)?;
        match &self.worst {
            Some(worst) => write!(f, ": {}", worst.message),
            None => Ok(()),
        }
    }
}

/// Findings in the making.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    findings: Vec<Finding>,
    function: Option<&'static str>,
}

impl Tally {
    /// What is judged from here on are answers of `function`, in a case that calls several.
    pub fn answers_of(&mut self, function: &'static str) {
        self.function = Some(function);
    }

    /// A right answer to this call shows `aspect`.
    pub fn expect(&mut self, aspect: Aspect) {
        self.entry(aspect).expected += 1;
    }

    /// The answer to call number `call` shows `aspect`, rightly or not; `badness` ranks the wrong
    /// ones.
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

    /// The same for an answer that is wrong in a way that has a class; `None` if it is right.
    pub fn judge_class(
        &mut self,
        aspect: Aspect,
        call: usize,
        class: Option<Class>,
        badness: f64,
        message: impl FnOnce() -> String,
    ) {
        let call = u32::try_from(call).unwrap_or(u32::MAX);
        let function = self.function;
        let finding = self.entry(aspect);
        // Two functions may show the same aspect in one call: it still counts once.
        finding.judged += u32::from(finding.last_judged.replace(call) != Some(call));
        let Some(class) = class else { return };
        let again = finding.faults.last().is_some_and(|last| last.call == call);
        finding.wrong += u32::from(!again);
        finding.faults.push(Fault {
            call,
            function,
            class,
        });
        // NaN is as bad as it gets.
        let badness = if badness.is_nan() {
            f64::INFINITY
        } else {
            badness
        };
        if finding
            .worst
            .as_ref()
            .is_none_or(|worst| badness > worst.badness)
        {
            finding.worst = Some(Worst {
                call,
                badness,
                message: message(),
            });
        }
    }

    /// Whether no answer so far is wrong about `aspect`.
    pub fn is_right(&mut self, aspect: Aspect) -> bool {
        self.entry(aspect).wrong == 0
    }

    /// What is judged of `aspect` by chance is sure to be seen from this share on; of several tests
    /// the weakest counts.
    pub fn set_detectable(&mut self, aspect: Aspect, share: f64) {
        let weakest = &mut self.entry(aspect).detectable;
        *weakest = Some(weakest.map_or(share, |other| other.max(share)));
    }

    /// A number that shows `aspect` is so far off, rightly or not.
    pub fn measure(&mut self, aspect: Aspect, error: NumberError) {
        self.entry(aspect).errors.push(error);
    }

    /// The findings in the order in which their aspects first came up.
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
                    worst: None,
                    detectable: None,
                    faults: Vec::new(),
                    spread: None,
                    errors: Vec::new(),
                    last_judged: None,
                });
                self.findings.len() - 1
            });
        &mut self.findings[at]
    }
}
