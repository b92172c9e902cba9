//! Texts that contain what students' programs and files say. A terminal, a spreadsheet or a page
//! would obey some of their characters, and they could hide or rewrite what else is in a report.

use grader::build::compile_errors::plain;

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

/// Where a text is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// As a part of one line: ends of lines and tabs are escaped, too. What follows one in the name
    /// of a file would look like a line of the report.
    Line,
    /// With lines of its own.
    Lines,
}

/// `text` with every character that is obeyed instead of shown in the form of a Rust string, such
/// as `\u{1b}`: control characters, what turns the direction of writing, and what has no width and
/// no use in a name. Showing what was shown already changes nothing.
pub fn shown(text: &str, layout: Layout) -> String {
    let mut shown = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    let mut marks = 0;
    while let Some(c) = rest.next() {
        marks = if is_stacked(c) { marks + 1 } else { 0 };
        match (c, layout) {
            (c, _) if marks > MOST_MARKS => shown.extend(c.escape_unicode()),
            ('\n', Layout::Line) => shown.push_str("\\n"),
            ('\t', Layout::Line) => shown.push_str("\\t"),
            ('\n' | '\t', Layout::Lines) => shown.push(c),
            // The line ends of Windows.
            ('\r', Layout::Lines) if rest.peek() == Some(&'\n') => {}
            (c, _) if is_obeyed(c) => shown.extend(c.escape_unicode()),
            (c, _) => shown.push(c),
        }
    }
    shown
}

/// The most marks on one letter that are shown as marks. Vietnamese and the phonetic alphabet need
/// up to three.
const MOST_MARKS: usize = 4;

/// Whether a character is drawn above or below the letter before it. Many of them on one letter
/// reach over the lines around it.
fn is_stacked(c: char) -> bool {
    matches!(c,
        '\u{300}'..='\u{36f}' | '\u{483}'..='\u{489}' | '\u{591}'..='\u{5bd}' | '\u{610}'..='\u{61a}'
        | '\u{64b}'..='\u{65f}' | '\u{6d6}'..='\u{6ed}' | '\u{e31}'..='\u{e3a}'
        | '\u{e47}'..='\u{e4e}' | '\u{1ab0}'..='\u{1aff}' | '\u{1dc0}'..='\u{1dff}'
        | '\u{20d0}'..='\u{20ff}' | '\u{fe20}'..='\u{fe2f}')
}

/// Whether a character does something where it is shown: control characters (ESC, CR and U+009B
/// among them), the ends of lines and paragraphs of Unicode, marks and overrides of direction, byte
/// order marks, fillers that show nothing, selectors of variants, tags, and what is no character in
/// XML. Joiners stay: Persian and Indian names need them.
fn is_obeyed(c: char) -> bool {
    let is_no_character = u32::from(c) & 0xfffe == 0xfffe;
    c.is_control()
        || is_no_character
        || matches!(c,
            '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{115f}' | '\u{1160}' | '\u{17b4}' | '\u{17b5}'
            | '\u{180b}'..='\u{180f}' | '\u{3164}' | '\u{fe00}'..='\u{fe0f}' | '\u{ffa0}'
            | '\u{fff9}'..='\u{fffc}' | '\u{200b}' | '\u{200e}' | '\u{200f}'
            | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
            | '\u{feff}' | '\u{e0000}'..='\u{e007f}')
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

    #[test]
    fn only_what_is_obeyed_is_escaped() {
        let lines = |text: &str| shown(text, Layout::Lines);
        assert_eq!(lines("a\tb é …\n"), "a\tb é …\n");
        // The tower of marks of a name, which would cover the rows above it.
        let tower = format!("o{}n", "\u{301}".repeat(6));
        let cut = format!("o{}\\u{{301}}\\u{{301}}n", "\u{301}".repeat(4));
        assert_eq!(
            (lines(&tower), lines("e\u{302}\u{301}")),
            (cut, "e\u{302}\u{301}".into())
        );
        assert_eq!(lines("a\r\nb"), "a\nb");
        assert_eq!(lines("\u{1b}[2Jx\r\u{7}"), "\\u{1b}[2Jx\\u{d}\\u{7}");
        assert_eq!(
            shown("a\nscore 80 of 80\t\r\n", Layout::Line),
            "a\\nscore 80 of 80\\t\\u{d}\\n"
        );
        assert_eq!(lines("\u{202e}08 fo 08\u{9b}"), "\\u{202e}08 fo 08\\u{9b}");
        // A name with a joiner, and one that looks like another one.
        assert_eq!(lines("می\u{200c}خواهم"), "می\u{200c}خواهم");
        for hidden in [
            '\u{ad}', '\u{34f}', '\u{115f}', '\u{1160}', '\u{180e}', '\u{200b}', '\u{3164}',
            '\u{fe0f}', '\u{ffa0}', '\u{fff9}', '\u{fffc}',
        ] {
            let name = format!("an{hidden}na");
            assert_eq!(lines(&name), format!("an{}na", hidden.escape_unicode()));
        }
    }

    #[test]
    fn what_is_shown_twice_is_shown_once() {
        for layout in [Layout::Line, Layout::Lines] {
            let once = shown("\u{1b}[31m\r\n\u{2066}a\\n", layout);
            assert_eq!(shown(&once, layout), once);
        }
    }
}
