//! Tests of the stopping rule that waits.

use super::judge;
use crate::repro::numbers::float;
use crate::tasks::part5_task1::repro::samples;
use std::fmt::Write;
use wire::adaptive::StopCall;

/// What the mended rule says and asks.
pub(crate) fn mended(call: &StopCall) -> Option<String> {
    let (tolerance, may_ask) = (float(call.tolerance), judge::may_ask(call));
    let mut text = String::from("use kit::Tally;\n");
    samples(&mut text, call)?;
    let _ = write!(
        text,
        "let mut asked = Vec::new();
let mut rule = |samples: &Tally, tolerance: f64| {{
    asked.push((samples.count(), samples.mean(), tolerance));
    {}
}};
let stop = adaptive::has_surely_converged(&samples, {tolerance}, &mut rule);
assert_eq!(stop, {});
let right = (samples.count(), samples.mean(), {tolerance});
assert!(asked.iter().all(|asked| *asked == right), \"{{asked:?}}\");
",
        call.rule,
        may_ask && call.rule
    );
    if may_ask {
        text.push_str("assert!(!asked.is_empty(), \"the rule has the last word\");\n");
    }
    Some(text)
}
