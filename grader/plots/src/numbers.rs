//! Formats numbers and lists for captions.

use base::digits::decimals;

/// Joins a list: "a", "a and b", "a, b and c"; "none" if it is empty.
pub fn list<S: AsRef<str>>(things: &[S]) -> String {
    let things: Vec<&str> = things.iter().map(AsRef::as_ref).collect();
    match things.as_slice() {
        [] => "none".into(),
        [one] => (*one).into(),
        [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
    }
}

/// Returns the text with its first letter in upper case.
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}

/// Formats with two significant digits, as a decimal number from 0.001 to a million and else with
/// an exponent.
pub fn figures(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let power = x.abs().log10().floor();
    if !(-3.0..6.0).contains(&power) {
        return format!("{x:.1e}");
    }
    format!("{x:.*}", decimals(x, 2))
}

/// Formats a factor with two significant digits and, from a thousand on, groups of three: "870,000".
pub fn rounded(x: f64) -> String {
    let unit = 10.0_f64.powf((x.log10().floor() - 1.0).max(0.0));
    if unit <= 1.0 {
        return figures(x);
    }
    grouped((x / unit).round() * unit)
}

/// Formats a whole number with groups of three: "868,623".
pub fn grouped(x: f64) -> String {
    let digits = format!("{x:.0}");
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i) % 3 == 0 {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Formats a fraction in percent.
pub fn percent(share: f64) -> String {
    format!("{} %", figures(100.0 * share))
}

/// Formats a tick label: as a decimal number if it is short, such as 0.01, else with an exponent,
/// such as 1e-9.
pub fn tick(value: f64) -> String {
    if (1e-3..1e5).contains(&value) {
        let text = format!("{value:.3}");
        text.trim_end_matches('0').trim_end_matches('.').into()
    } else {
        format!("{value:.0e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_joined_with_commas_and_and() {
        assert_eq!(list::<&str>(&[]), "none");
        assert_eq!(list(&["a"]), "a");
        assert_eq!(list(&["a", "b", "c"]), "a, b and c");
    }

    #[test]
    fn capital_changes_only_the_first_letter() {
        assert_eq!(
            ["direct light", "", "éclat"].map(capital),
            ["Direct light", "", "Éclat"]
        );
    }

    #[test]
    fn numbers_have_two_significant_digits() {
        assert_eq!(
            [0.0, 1.234, 0.0456, 123.4, 4.5e-9].map(figures),
            ["0", "1.2", "0.046", "123", "4.5e-9"]
        );
        assert_eq!(percent(0.034), "3.4 %");
        assert_eq!(
            [2.34, 868_623.0, 1234.0, 99.6].map(rounded),
            ["2.3", "870,000", "1,200", "100"]
        );
        assert_eq!(
            [0.0, 999.6, 1234567.0].map(grouped),
            ["0", "1,000", "1,234,567"]
        );
        assert_eq!(
            [0.01, 1.0, 500.0, 1e-9].map(tick),
            ["0.01", "1", "500", "1e-9"]
        );
    }
}
