//! Text of a submission as it may be shown in a terminal.

/// `text` with its control characters in the form of a Rust string, such as `\u{1b}`: a terminal
/// would obey them, and they could hide or rewrite what else is in a report. Ends of lines and tabs
/// stay.
pub fn visible(text: &str) -> String {
    let mut visible = String::with_capacity(text.len());
    for c in text.chars() {
        match is_harmless(c) {
            true => visible.push(c),
            false => visible.extend(c.escape_unicode()),
        }
    }
    visible
}

/// `text` as a part of one line: also its ends of lines and tabs are escaped. A file's name may
/// contain them, and what follows would look like a line of the report.
pub fn visible_in_line(text: &str) -> String {
    let text = visible(text);
    text.replace('\n', "\\n").replace('\t', "\\t")
}

fn is_harmless(c: char) -> bool {
    // The characters of the second range change the direction of what follows.
    let turns =
        matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    matches!(c, '\n' | '\t') || !c.is_control() && !turns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_a_terminal_obeys_is_escaped() {
        assert_eq!(visible("a\tb é …\n"), "a\tb é …\n");
        assert_eq!(visible("\u{1b}[2Jx\r\u{7}"), "\\u{1b}[2Jx\\u{d}\\u{7}");
        assert_eq!(
            visible_in_line("a\nscore 80 of 80\t"),
            "a\\nscore 80 of 80\\t"
        );
        assert_eq!(
            visible("\u{202e}08 fo 08\u{9b}"),
            "\\u{202e}08 fo 08\\u{9b}"
        );
    }
}
