//! One call in words.

use wire::adaptive::StopCall;

/// The minimum number of samples, as the stage names it.
const FEWEST_SAMPLES: (&str, i64) = ("FEWEST_SAMPLES", 256);

/// How far from the minimum a number of samples is written as its distance.
const NEAR: i64 = 50;

pub(super) fn input(call: &StopCall) -> String {
    let runs: Vec<String> = call
        .runs
        .iter()
        .map(|&(samples, luminance)| format!("{} of {luminance:?}", count(samples)))
        .collect();
    format!(
        "samples: {}; tolerance = {:?}; the plain rule returns {}",
        runs.join(", "),
        call.tolerance,
        call.rule
    )
}

/// A number of samples, relative to the minimum if it is near.
fn count(samples: u32) -> String {
    let (name, fewest) = FEWEST_SAMPLES;
    let beyond = i64::from(samples) - fewest;
    match beyond {
        0 => name.into(),
        1..=NEAR => format!("{name} + {beyond}"),
        _ if (-NEAR..0).contains(&beyond) => format!("{name} - {}", -beyond),
        _ => samples.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_samples_are_relative_to_the_minimum() {
        let counts = [256, 255, 257, 300, 1, 1000].map(count);
        let expected = ["", " - 1", " + 1", " + 44"].map(|by| format!("FEWEST_SAMPLES{by}"));
        assert_eq!(counts[..4], expected);
        assert_eq!(counts[4..], ["1", "1000"]);
    }
}
