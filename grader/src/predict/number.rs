//! A number as people write it.

/// The largest relative error of a typed number, absolute if the truth is 0: three digits are asked
/// for.
const TOLERANCE: f64 = 2e-3;

/// Reads `0.25`, `-3`, `1/4`, `1e-3` or `2,5`. `None` for what is no finite number.
pub fn parse(text: &str) -> Option<f64> {
    let text = text.trim().replace(',', ".");
    let value = match text.split_once('/') {
        None => text.parse().ok()?,
        Some((above, below)) => {
            let (above, below): (f64, f64) =
                (above.trim().parse().ok()?, below.trim().parse().ok()?);
            above / below
        }
    };
    Some(value).filter(|value: &f64| value.is_finite())
}

/// Whether `typed` is the number `truth`, rounded to three digits or more.
pub fn is_near(typed: f64, truth: f64) -> bool {
    let scale = if truth == 0.0 { 1.0 } else { truth.abs() };
    (typed - truth).abs() <= TOLERANCE * scale
}

/// `x` with at most five decimals.
pub fn shown(x: f64) -> String {
    let text = format!("{x:.5}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" {
        "0".into()
    } else {
        short.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_people_write_them() {
        for (text, value) in [
            ("0.25", 0.25),
            (" 1/4 ", 0.25),
            ("-3", -3.0),
            ("2,5", 2.5),
            ("1e-3", 1e-3),
            (".5", 0.5),
        ] {
            assert_eq!(parse(text), Some(value), "{text}");
        }
        for text in ["", "b", "1/0", "nan", "inf", "1 2", "1/2/3"] {
            assert_eq!(parse(text), None, "{text}");
        }
    }

    #[test]
    fn three_digits_are_enough_and_two_are_not() {
        assert!(is_near(2.134, 2.133_974_6) && is_near(0.0, 0.0));
        assert!(!is_near(2.1, 2.133_974_6) && !is_near(0.01, 0.0) && !is_near(-2.134, 2.134));
    }

    #[test]
    fn numbers_are_shown_without_zeros_at_the_end() {
        assert_eq!(shown(0.25), "0.25");
        assert_eq!(shown(-0.0), "0");
        assert_eq!(shown(2.0 / 3.0), "0.66667");
        assert_eq!(shown(100.0), "100");
    }
}
