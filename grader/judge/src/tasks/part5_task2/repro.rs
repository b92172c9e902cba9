//! Rust tests of the stopping rule that waits.

use super::truth;
use crate::tools::kinds::stopping::define_samples;
use crate::tools::repro::numbers::float;
use std::fmt::Write;
use wire::adaptive::StopCall;

/// A test of the result of the waiting rule, and of its calls of the plain rule.
pub(crate) fn waiting_rule(call: &StopCall) -> Option<String> {
    let (tolerance, plain_decides) = (float(call.tolerance), truth::plain_decides(call));
    let mut text = String::from("use kit::Tally;\n");
    define_samples(&mut text, call)?;
    let _ = write!(
        text,
        "let mut rule_args = Vec::new();
let mut rule = |samples: &Tally, tolerance: f64| {{
    rule_args.push((samples.count(), samples.mean(), tolerance));
    {}
}};
let stop = adaptive::has_surely_converged(&samples, {tolerance}, &mut rule);
assert_eq!(stop, {});
let right = (samples.count(), samples.mean(), {tolerance});
assert!(rule_args.iter().all(|rule_args| *rule_args == right), \"{{rule_args:?}}\");
",
        call.rule,
        plain_decides && call.rule
    );
    if plain_decides {
        text.push_str("assert!(!rule_args.is_empty(), \"expected a call of the plain rule\");\n");
    }
    Some(text)
}
