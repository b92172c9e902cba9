//! Texts that contain what students' programs and files say.

use grader::build::compile_errors::plain;

/// The text without colours and without control characters other than line breaks and tabs.
pub(crate) fn printable(text: &str) -> String {
    let is_printable = |c: &char| matches!(c, '\n' | '\t') || !c.is_control();
    plain(text).chars().filter(is_printable).collect()
}

/// At most `most` bytes of the text, with a last line that says so if there are more.
pub(crate) fn limited(text: &str, most: usize) -> String {
    if text.len() <= most {
        return text.to_owned();
    }
    let end = (0..=most).rev().find(|at| text.is_char_boundary(*at));
    let kept = &text[..end.unwrap_or(0)];
    format!("{kept}\n... and {} more bytes", text.len() - kept.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_cut_between_characters() {
        assert_eq!(limited("öäü", 3), "ö\n... and 4 more bytes");
        assert_eq!(limited("abc", 3), "abc");
    }

    #[test]
    fn control_characters_are_left_out() {
        assert_eq!(printable("\x1b[31mred\x1b[0m\0\r\n\tx\u{7}"), "red\n\tx");
    }
}
