//! Fits text into lines of a given width.

use base::digits::decimals;

/// Breaks `text` at spaces into lines of at most `width` columns. Lines after the first begin with
/// `indent` spaces, as many as the text itself begins with if it begins with more. A longer word
/// is broken, and code between backticks only if it is longer: a command can be copied.
pub(crate) fn wrap(text: &str, indent: usize, width: usize) -> Vec<String> {
    let margin = text.len() - text.trim_start().len();
    let indent = " ".repeat(indent.max(margin).min(width / 2));
    let mut lines = Vec::new();
    let mut line = " ".repeat(margin.min(width / 2));
    let mut is_empty = true;
    for word in words(text, width - indent.len()) {
        let mut word = word.as_str();
        let fits = |line: &str| columns(line) + usize::from(!is_empty) + columns(word) <= width;
        if !is_empty && !fits(&line) {
            lines.push(std::mem::replace(&mut line, indent.clone()));
            is_empty = true;
        }
        while columns(&line) + columns(word) > width {
            let at = word
                .char_indices()
                .nth((width - columns(&line)).max(1))
                .map_or(word.len(), |(at, _)| at);
            line.push_str(&word[..at]);
            lines.push(std::mem::replace(&mut line, indent.clone()));
            word = &word[at..];
        }
        if !is_empty {
            line.push(' ');
        }
        line.push_str(word);
        is_empty = false;
    }
    if !is_empty {
        lines.push(line);
    }
    lines
}

/// The words of `text`; code between backticks is one word if it has at most `width` columns, and
/// so is the command that opens a chapter.
fn words(text: &str, width: usize) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut pending = text.split_whitespace();
    while let Some(word) = pending.next() {
        let mut rest = pending.clone();
        let opens = [word, rest.next().unwrap_or(""), rest.next().unwrap_or("")];
        if opens == ["cargo", "grader", "book"] {
            let command = format!("cargo grader book {}", rest.next().unwrap_or(""));
            if columns(&command) <= width {
                words.push(command);
                pending = rest;
                continue;
            }
        }
        words.push(word.to_owned());
        let is_code = |word: &str| word.matches('`').count() % 2 == 1;
        if !is_code(word) {
            continue;
        }
        let mut rest = pending.clone();
        if let Some(end) = rest.position(is_code) {
            let code: Vec<&str> = std::iter::once(word)
                .chain(pending.clone().take(end + 1))
                .collect();
            let code = code.join(" ");
            if columns(&code) <= width {
                words.pop();
                words.push(code);
                pending = rest;
            }
        }
    }
    words
}

/// At most `most` lines of `text`, wrapped as by [`wrap`]; the last ends with `…` if text is left
/// out.
pub(crate) fn wrap_to(text: &str, indent: usize, width: usize, most: usize) -> Vec<String> {
    let mut lines = wrap(text, indent, width);
    if lines.len() > most {
        lines.truncate(most);
        if let Some(last) = lines.last_mut() {
            *last = cut(&format!("{last} …"), width, true);
        }
    }
    lines
}

/// The text in one line of at most `width` columns, with `…` at the end if text is left out.
pub(crate) fn one_line(text: &str, width: usize) -> String {
    let margin = text.len() - text.trim_start().len();
    let words: Vec<&str> = text.split_whitespace().collect();
    cut(
        &format!("{}{}", " ".repeat(margin), words.join(" ")),
        width,
        false,
    )
}

/// One line whose numbers have as many digits as fit: all of them, else from ten down to three
/// significant ones.
pub(crate) fn numbers_to_fit(text: &str, width: usize) -> String {
    let with = |digits: usize| one_line(&shorten_numbers(text, digits), usize::MAX);
    let texts = [usize::MAX, 10, 6, 4, 3].map(with);
    let fitting = texts.iter().find(|text| columns(text) <= width);
    fitting.map_or_else(|| one_line(&texts[4], width), String::clone)
}

/// The text with every decimal number of more than `digits` significant digits rounded to these.
pub(crate) fn shorten_numbers(text: &str, digits: usize) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let number = &rest[start..];
        let end = number
            .find(|c: char| !c.is_ascii_digit() && c != '.')
            .unwrap_or(number.len());
        let mantissa = number[..end].trim_end_matches('.');
        let count = mantissa
            .trim_start_matches(['0', '.'])
            .matches(|c: char| c.is_ascii_digit());
        out.push_str(&rest[..start]);
        match mantissa.parse::<f64>() {
            Ok(value) if mantissa.contains('.') && count.count() > digits => {
                out.push_str(&significant(value, digits));
            }
            _ => out.push_str(mantissa),
        }
        rest = &number[mantissa.len()..];
    }
    out.push_str(rest);
    out
}

/// A positive number with this many significant digits, without zeros at the end.
fn significant(value: f64, digits: usize) -> String {
    let text = format!("{value:.*}", decimals(value, digits));
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// The number of columns that a text takes: one for each character, since reports have no wide
/// ones.
pub(crate) fn columns(text: &str) -> usize {
    text.chars().count()
}

/// The first `width` columns; `…` ends what is cut off, or what is `incomplete` anyway.
fn cut(text: &str, width: usize, incomplete: bool) -> String {
    if columns(text) <= width {
        return text.to_owned();
    }
    let text = match incomplete {
        true => text.trim_end_matches([' ', '…']),
        false => text,
    };
    let kept: String = text.chars().take(width.saturating_sub(1)).collect();
    format!("{}…", kept.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_line_is_longer_than_the_width() {
        let word = "x".repeat(50);
        for text in [
            "a b c",
            "  indented words that go on",
            &word,
            "π is a sign of one column",
        ] {
            for width in [10, 17, 30] {
                let lines = wrap(text, 4, width);
                assert!(lines.iter().all(|line| columns(line) <= width), "{lines:?}");
                let letters = |text: &str| text.replace(' ', "");
                assert_eq!(letters(&lines.concat()), letters(text));
            }
        }
        assert_eq!(wrap("  one two", 4, 8), ["  one", "    two"]);
    }

    #[test]
    fn commands_stay_in_one_line() {
        let text = "Run `cargo grader part1`, now.";
        assert_eq!(wrap(text, 0, 22), ["Run", "`cargo grader part1`,", "now."]);
        assert_eq!(wrap(text, 0, 12), ["Run `cargo", "grader", "part1`, now."]);
        assert_eq!(wrap("a ` b c", 0, 4), ["a `", "b c"]);
        let chapter = "Its chapter: cargo grader book rust#errors";
        let lines = ["Its chapter:", "  cargo grader book rust#errors"];
        assert_eq!(wrap(chapter, 2, 32), lines);
        assert!(wrap(chapter, 2, 16).len() > 3);
    }

    #[test]
    fn what_does_not_fit_ends_with_an_ellipsis() {
        assert_eq!(wrap_to("one two three", 0, 6, 2), ["one", "two …"]);
        assert_eq!(wrap_to("one two", 0, 7, 1), ["one two"]);
        assert_eq!(one_line("one two three", 9), "one two…");
        assert_eq!(wrap_to("123456 789", 0, 6, 1), ["12345…"]);
    }

    #[test]
    fn numbers_lose_digits_before_text_is_cut() {
        let text = "t = 11.622849631242309, n = (0.000123456789, 1)";
        assert_eq!(numbers_to_fit(text, 80), text);
        assert_eq!(
            numbers_to_fit(text, 39),
            "t = 11.6228, n = (0.000123457, 1)"
        );
        assert_eq!(
            shorten_numbers("1.23456789e-7 and 123456789", 6),
            "1.23457e-7 and 123456789"
        );
        assert_eq!(columns(&numbers_to_fit(text, 20)), 20);
    }
}
