//! Points as the formats write them.

use crate::Settings;
use grader::report::Report;

/// Points with two decimals, as the report shows them.
pub fn rounded(points: f64) -> f64 {
    (points * 100.0).round() / 100.0
}

/// Points in hundredths, for formats with whole numbers only. What is less than all of `max` never
/// becomes all of it by rounding.
pub fn hundredths(points: f64, max: f64) -> u64 {
    let whole = |points: f64| (points * 100.0).round().max(0.0) as u64;
    match points < max {
        true => whole(points).min(whole(max).saturating_sub(1)),
        false => whole(max),
    }
}

/// The total score of a report: core points, and extra credit if `settings` add it.
pub fn total(report: &Report, settings: &Settings) -> f64 {
    match settings.add_extra {
        true => report.score + report.robust_score,
        false => report.score,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hundredths_are_full_only_if_the_points_are() {
        assert_eq!(hundredths(21.05, 30.0), 2105);
        assert_eq!(hundredths(30.0, 30.0), 3000);
        assert_eq!(hundredths(29.999, 30.0), 2999);
        assert_eq!(hundredths(0.0, 0.0), 0);
    }
}
