//! Numbers in sentences, with fewer digits.

/// The significant digits of numbers in the window. The rest is shown over them and copied.
const DIGITS: usize = 6;

/// `text` with at most six significant digits in every number.
pub fn shortened(text: &str) -> String {
    with_digits(text, DIGITS)
}

/// Two texts that are compared, with as few digits as show that they differ, but at least six.
pub fn compared(a: &str, b: &str) -> [String; 2] {
    let shown = (DIGITS..17).map(|digits| [a, b].map(|text| with_digits(text, digits)));
    let mut differing = shown.filter(|[a, b]| a != b);
    match differing.next() {
        Some(shown) if a != b => shown,
        _ if a == b => [shortened(a), shortened(b)],
        _ => [a.to_owned(), b.to_owned()],
    }
}

/// `text` with at most `digits` significant digits in every number with a point or an exponent.
fn with_digits(text: &str, digits: usize) -> String {
    let mut shown = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let (before, number) = rest.split_at(start);
        shown += before;
        let (number, after) = number.split_at(length_of_number(number));
        // A digit in a name such as `part1` or `f64` is no number.
        let is_in_name = before
            .chars()
            .next_back()
            .is_some_and(|c| c.is_alphabetic() || c == '_');
        match number.parse::<f64>() {
            Ok(value) if !is_in_name && number.contains('.') => {
                shown += &rounded(number, value, digits);
            }
            _ => shown += number,
        }
        rest = after;
    }
    shown + rest
}

/// The length of the number at the start of `text`: digits, a point with digits, an exponent.
fn length_of_number(text: &str) -> usize {
    let digits =
        |text: &str| text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let mut length = digits(text);
    if let Some(fraction) = text[length..].strip_prefix('.')
        && digits(fraction) > 0
    {
        length += 1 + digits(fraction);
    }
    if let Some(exponent) = text[length..].strip_prefix('e') {
        let unsigned = exponent.strip_prefix('-').unwrap_or(exponent);
        if digits(unsigned) > 0 {
            length += 1 + exponent.len() - unsigned.len() + digits(unsigned);
        }
    }
    length
}

/// `number` with at most `digits` significant digits, which has the value `value`.
fn rounded(number: &str, value: f64, digits: usize) -> String {
    let significant = number
        .split('e')
        .next()
        .unwrap_or_default()
        .chars()
        .filter(char::is_ascii_digit)
        .skip_while(|c| *c == '0')
        .count();
    if significant <= digits || value == 0.0 {
        return number.to_owned();
    }
    // The exponent of the rounded number: 9.9999999 has six digits as 10.0000.
    let scientific = format!("{value:.*e}", digits - 1);
    let exponent: i32 = scientific
        .split('e')
        .nth(1)
        .and_then(|exponent| exponent.parse().ok())
        .unwrap_or(0);
    let after_point = digits as i32 - 1 - exponent;
    if number.contains('e') || !(0..=20).contains(&after_point) {
        return scientific;
    }
    format!("{value:.*}", after_point as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_numbers_are_rounded_and_all_else_stays() {
        for (text, expected) in [
            (
                "box 2: entered, t in [3.3193608779478883, 5.331094743370855]",
                "box 2: entered, t in [3.31936, 5.33109]",
            ),
            (
                "o = (-0.5, 0.25, 100.0), t = inf",
                "o = (-0.5, 0.25, 100.0), t = inf",
            ),
            (
                "part1.task3 has 123456789 of 2.5 points",
                "part1.task3 has 123456789 of 2.5 points",
            ),
            (
                "1.2345678901e-9 and 0.00012345678",
                "1.23457e-9 and 0.000123457",
            ),
            (
                "9.99999999 1234567.891 x1.23456789",
                "10.0000 1.23457e6 x1.23456789",
            ),
            ("-0.10516596664624272.", "-0.105166."),
            ("", ""),
        ] {
            assert_eq!(shortened(text), expected);
        }
    }

    #[test]
    fn compared_numbers_have_the_digits_that_differ() {
        assert_eq!(
            compared("13.421663694237695", "13.421663694237697"),
            ["13.421663694237695", "13.421663694237697"]
        );
        assert_eq!(compared("1.5", "2.0123456789"), ["1.5", "2.01235"]);
        assert_eq!(
            compared("0.123456789", "0.123456789"),
            ["0.123457", "0.123457"]
        );
        assert_eq!(
            compared("0.12345671", "0.12345679"),
            ["0.1234567", "0.1234568"]
        );
    }
}
