//! Texts that contain what students' programs and files say.

use grader::build::compile_errors::plain;
use submission::{Layout, shown};

/// The text without colours, as text that was handed in is shown.
pub(crate) fn printable(text: &str) -> String {
    shown(&plain(text), Layout::Lines)
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
    fn colours_are_left_out_and_control_characters_shown() {
        let text = "\x1b[31mred\x1b[0m\0\r\n\tx\u{7}\u{202e}";
        assert_eq!(printable(text), "red\\u{0}\n\tx\\u{7}\\u{202e}");
    }
}
