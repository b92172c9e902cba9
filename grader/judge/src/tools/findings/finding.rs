//! The result of judging one aspect in one case.

use super::{Aspect, Class, Message};
use crate::tools::errors::{ErrorSpread, NumberError};
use serde::Serialize;
use std::collections::BTreeSet;
use std::fmt;

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
    /// Why it cannot be judged in this run, as a sentence without a full stop: it costs nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub undecided: Option<&'static str>,
    /// The distribution of numerical errors, where they are measured.
    pub spread: Option<ErrorSpread>,
    /// The error of each number.
    #[serde(skip)]
    pub errors: Vec<NumberError>,
    /// The calls that were judged, in order.
    #[serde(skip)]
    pub judged_calls: Vec<u32>,
    /// The numbers of the wrong answers of each function.
    #[serde(skip)]
    pub numbers: Vec<WrongNumbers>,
    /// Some numbers of the right answers of each function.
    #[serde(skip)]
    pub right_numbers: Vec<RightNumbers>,
}

/// The numbers of a function's wrong answers in one aspect, as long as all answers have the same.
#[derive(Clone, Debug, PartialEq)]
pub struct WrongNumbers {
    /// The function, in cases or tasks with several.
    pub function: Option<&'static str>,
    /// The wrong answers so far.
    pub count: u32,
    /// The code's numbers in each of them, and in the right answers after the first wrong one;
    /// `None` if they differ.
    pub same: Option<Vec<f64>>,
    /// The numbers that are expected in the first.
    pub expected: Vec<f64>,
    /// Whether other numbers are expected in others.
    pub expected_differ: bool,
}

/// Numbers of a function's right answers in one aspect: the first two that are not the same,
/// without those that are all 0, which code may give where there is nothing to compute.
#[derive(Clone, Debug, PartialEq)]
pub struct RightNumbers {
    /// The function, in cases or tasks with several.
    pub function: Option<&'static str>,
    different: Vec<Vec<f64>>,
    /// How many more answers are looked at.
    left: u32,
}

/// So many right answers of a case are looked at: most differ at once.
const RIGHT_ANSWERS: u32 = 16;

impl RightNumbers {
    /// Whether a right answer of `function` has as many numbers, and others.
    pub fn differ_from(&self, function: Option<&str>, numbers: &[f64]) -> bool {
        let others = self.different.iter();
        self.function == function
            && others
                .filter(|other| other.len() == numbers.len())
                .any(|other| !are_equal(other, numbers))
    }
}

/// Numbers that differ by less than this share are the same: their difference is rounding.
const SAME_NUMBER: f64 = 1e-9;

impl WrongNumbers {
    /// Those of one answer, each number with the expected one.
    fn of(function: Option<&'static str>, compared: &[[f64; 2]]) -> WrongNumbers {
        WrongNumbers {
            function,
            count: 1,
            same: (!compared.is_empty())
                .then(|| compared.iter().map(|[yours, _]| *yours).collect()),
            expected: compared.iter().map(|[_, expected]| *expected).collect(),
            expected_differ: false,
        }
    }

    /// Adds the wrong answers of another case. Both have as many numbers.
    pub fn add(&mut self, other: &WrongNumbers) {
        self.count += other.count;
        self.same = self.same.take().filter(|same| {
            let others = other.same.as_ref();
            others.is_some_and(|others| are_equal(same, others))
        });
        self.expected_differ |=
            other.expected_differ || !are_equal(&self.expected, &other.expected);
    }
}

fn are_equal(these: &[f64], those: &[f64]) -> bool {
    let is_equal = |(a, b): (&f64, &f64)| a == b || (a - b).abs() <= SAME_NUMBER * b.abs();
    these.len() == those.len() && these.iter().zip(those).all(is_equal)
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
    pub(super) fn count(&mut self, call: u32, wrong: bool) {
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
    /// The function that returned it, in cases or tasks with several.
    #[serde(skip)]
    pub function: Option<&'static str>,
    /// Rank among wrong answers; larger is worse.
    pub badness: f64,
    /// The student's result, the expected one and the input.
    pub message: Message,
}

impl Finding {
    /// The finding before anything is judged.
    pub fn new(aspect: Aspect) -> Finding {
        Finding {
            aspect,
            expected: 0,
            judged: 0,
            wrong: 0,
            main: false,
            functions: Vec::new(),
            worst: None,
            faults: Vec::new(),
            detectable: None,
            undecided: None,
            spread: None,
            errors: Vec::new(),
            judged_calls: Vec::new(),
            numbers: Vec::new(),
            right_numbers: Vec::new(),
        }
    }

    /// The finding with those wrong answers alone.
    #[must_use]
    pub fn with_only(&self, is_kept: impl Fn(&Fault) -> bool) -> Finding {
        let mut faults = self.faults.clone();
        faults.retain(is_kept);
        let calls: BTreeSet<u32> = faults.iter().map(|fault| fault.call).collect();
        let worst = self.worst.clone();
        Finding {
            wrong: calls.len() as u32,
            worst: worst.filter(|worst| calls.contains(&worst.call)),
            faults,
            ..self.clone()
        }
    }

    /// The same counts without the answers, which are many.
    pub fn counts(&self) -> Finding {
        Finding {
            functions: self.functions.clone(),
            worst: None,
            faults: Vec::new(),
            errors: Vec::new(),
            judged_calls: Vec::new(),
            numbers: Vec::new(),
            right_numbers: Vec::new(),
            ..*self
        }
    }

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
    /// Whether the numbers of the next wrong answer of `function` may be those of the ones before.
    pub(super) fn may_be_the_same(&self, function: Option<&'static str>) -> bool {
        let has_own = self.numbers.iter().any(|own| own.function == function);
        !has_own || self.is_the_same_so_far(function)
    }

    /// Whether all wrong answers of `function` have the same numbers so far, and there is one.
    pub(super) fn is_the_same_so_far(&self, function: Option<&'static str>) -> bool {
        let mut own = self.numbers.iter().filter(|own| own.function == function);
        own.any(|own| own.same.is_some())
    }

    /// Whether the numbers of the next right answer of `function` tell anything.
    pub(super) fn looks_at_right(&self, function: Option<&'static str>) -> bool {
        let mut own = self.right_numbers.iter();
        let own = own.find(|own| own.function == function);
        own.is_none_or(|own| own.left > 0) || self.is_the_same_so_far(function)
    }

    /// Adds the numbers of a right answer of `function`, and compares them with those of its wrong
    /// ones.
    pub(super) fn add_right_numbers(
        &mut self,
        function: Option<&'static str>,
        compared: &[[f64; 2]],
    ) {
        let yours: Vec<f64> = compared.iter().map(|[yours, _]| *yours).collect();
        let wrong = self.numbers.iter_mut();
        for own in wrong.filter(|own| own.function == function && own.expected.len() == yours.len())
        {
            own.same = own.same.take().filter(|same| are_equal(same, &yours));
        }
        let is_own = |right: &RightNumbers| right.function == function;
        let at = match self.right_numbers.iter().position(is_own) {
            Some(at) => at,
            None => {
                self.right_numbers.push(RightNumbers {
                    function,
                    different: Vec::new(),
                    left: RIGHT_ANSWERS,
                });
                self.right_numbers.len() - 1
            }
        };
        let right = &mut self.right_numbers[at];
        right.left = right.left.saturating_sub(1);
        let is_new = right
            .different
            .iter()
            .all(|other| !are_equal(other, &yours));
        if is_new && yours.iter().any(|number| *number != 0.0) {
            right.different.push(yours);
        }
        if compared.is_empty() || right.different.len() > 1 {
            right.left = 0;
        }
    }

    /// Adds the numbers of a wrong answer of `function`, each with the expected one. Answers with
    /// another number of them are about something else, such as a density beside a colour.
    pub(super) fn add_numbers(&mut self, function: Option<&'static str>, compared: &[[f64; 2]]) {
        let one = WrongNumbers::of(function, compared);
        let is_alike = |other: &&mut WrongNumbers| {
            other.function == function && other.expected.len() == compared.len()
        };
        match self.numbers.iter_mut().find(is_alike) {
            Some(before) => before.add(&one),
            None => self.numbers.push(one),
        }
    }

    pub(super) fn of_function(&mut self, function: &'static str) -> &mut FunctionCount {
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
/// A wrong answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Which call of the case.
    pub call: u32,
    /// The function that returned it, in cases that call several.
    pub function: Option<&'static str>,
    /// The function that it counts for, in tasks with several.
    pub counts_for: Option<&'static str>,
    /// How it is wrong.
    pub class: Class,
}

impl Fault {
    /// The function that it counts for, or else the one that returned it.
    pub fn named_function(&self) -> Option<&'static str> {
        self.counts_for.or(self.function)
    }
}

/// A wrong aspect of the answer to one call.
#[derive(Clone, Debug, PartialEq)]
pub struct WrongAnswer {
    /// Which aspect.
    pub aspect: Aspect,
    /// The call, the function and the class.
    pub fault: Fault,
    /// The student's result, the expected one and the input.
    pub message: Message,
}
