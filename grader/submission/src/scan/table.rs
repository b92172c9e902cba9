//! Finds what may be a table of answers in a stage: more numbers, strings and names than code
//! needs.

use super::{Scanner, Token};
use crate::file_tree::Files;
use std::collections::HashSet;

/// More bytes of data than code of a stage needs: the correct versions have at most 540, most of
/// them less than 100.
const MOST_DATA: usize = 3000;

/// More bytes of data and of different names together: macros make strings of names. The correct
/// versions have at most 2,300.
const MOST_WITH_NAMES: usize = 2600;

/// More words and marks than code of a stage needs: the correct versions have at most 4,700.
const MOST_TOKENS: usize = 9000;

/// A sentence if the files of `stage` contain so much data, or so much at all, that they may
/// contain a table of answers. Honest code may, too: a person should look.
pub fn table(stage: &str, files: &Files) -> Option<String> {
    let contents = Contents::of(files);
    let what = match contents {
        Contents { data, .. } if data > MOST_DATA => format!("{data} bytes of numbers and strings"),
        Contents { data, names, .. } if data + names > MOST_WITH_NAMES => {
            format!(
                "{} bytes of numbers, strings and different names",
                data + names
            )
        }
        Contents { tokens, .. } if tokens > MOST_TOKENS => format!("{tokens} words and marks"),
        _ => return None,
    };
    Some(format!(
        "stages/{stage}/src: {what}, which may be a table of answers"
    ))
}

/// How much the code of a stage contains, without its tests.
#[derive(Clone, Copy, Debug, Default)]
struct Contents {
    /// The bytes of numbers, strings and characters, and of the comments that a macro gets as
    /// attributes.
    data: usize,
    /// The bytes of all names, each counted once.
    names: usize,
    /// The number of words and marks.
    tokens: usize,
}

impl Contents {
    fn of(files: &Files) -> Contents {
        let mut contents = Contents::default();
        let mut names = HashSet::new();
        for text in files.values() {
            contents.add(&String::from_utf8_lossy(text), &mut names);
        }
        contents.names = names.iter().map(String::len).sum();
        contents
    }

    /// Adds a file, but for its names, which are added to `names`.
    fn add(&mut self, code: &str, names: &mut HashSet<String>) {
        let mut scanner = Scanner::new(code);
        let mut tests = 0;
        let mut attribute = TEST_ATTRIBUTE.iter();
        let mut macros = Macros::default();
        while let Some(token) = scanner.next() {
            self.tokens += 1;
            let is_word = token.text.starts_with(super::is_part_of_word);
            self.data += macros.add(&token, is_word, scanner.documented);
            if token.text.starts_with(|c: char| c.is_ascii_digit()) {
                self.data += token.text.len();
            } else if is_word {
                names.insert(token.text.clone());
            }
            if attribute.as_slice().first() == Some(&token.text.as_str()) {
                attribute.next();
            } else {
                attribute = TEST_ATTRIBUTE.iter();
            }
            if attribute.len() == 0 {
                let before = scanner.quoted;
                scanner.skip_item();
                tests += scanner.quoted - before;
            }
        }
        self.data += scanner.quoted - tests;
    }
}

/// The tokens of the attribute of code that is compiled for tests only.
const TEST_ATTRIBUTE: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];

/// The arguments of macros, also of `macro_rules`.
#[derive(Default)]
struct Macros {
    /// The last two tokens.
    before: [String; 2],
    /// The brackets that are open in the arguments of a macro.
    depth: usize,
    /// The bytes of comments in front of the arguments.
    documented: usize,
}

impl Macros {
    /// Adds a token, with the bytes of comments before it. Returns those of the arguments that end
    /// with it.
    fn add(&mut self, token: &Token, is_word: bool, documented: usize) -> usize {
        let [first, second] = &self.before;
        let is_called = second == "!" || first == "!" && second != "=";
        let mut bytes = 0;
        match token.text.as_str() {
            "(" | "[" | "{" if self.depth > 0 => self.depth += 1,
            "(" | "[" | "{" if is_called => (self.depth, self.documented) = (1, documented),
            ")" | "]" | "}" if self.depth > 0 => {
                self.depth -= 1;
                if self.depth == 0 {
                    bytes = documented - self.documented;
                }
            }
            _ => {}
        }
        let text = if is_word { "word" } else { &token.text };
        self.before = [std::mem::take(&mut self.before[1]), text.to_string()];
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::correct_versions;
    use std::path::PathBuf;

    #[test]
    fn a_table_of_answers_is_found_however_it_is_written() {
        let about = |code: String| {
            let files = Files::from([(PathBuf::from("lib.rs"), code.into_bytes())]);
            table("bbox", &files)
        };
        let numbers = |count| format!("const T: [f64; {count}] = [{}];", "0.25, ".repeat(count));
        let (few, many) = (numbers(100), numbers(2000));
        assert_eq!(about(few), None);
        assert_eq!(
            about(many),
            Some("stages/bbox/src: 6004 bytes of numbers and strings, which may be a table of answers".into())
        );
        let text = "0123456789".repeat(400);
        for table in [
            format!("const T: &str = \"{text}\";"),
            format!("const T: &[u8] = br#\"{text}\"#;"),
            format!("const T: &[char] = &[{}];", "'\\n', ".repeat(1000)),
        ] {
            assert!(about(table).is_some());
        }
        // A student's own tests, comments and code are no table.
        let tests = format!(
            "#[cfg(test)]\nmod tests {{ use super::*; const T: &str = \"{text}\"; {} }}",
            numbers(2000)
        );
        assert_eq!(about(tests.clone()), None);
        assert!(about(format!("{tests} {}", numbers(2000))).is_some());
        assert_eq!(
            about(format!("// {text}\n/* {text} */ fn f() {{}}").repeat(3)),
            None
        );
        assert_eq!(about("fn f() { g(a, b) }\n".repeat(600)), None);
    }

    /// A table without a number and without a string.
    #[test]
    fn a_table_of_names_is_found() {
        let about = |code: &str| {
            let files = Files::from([(PathBuf::from("lib.rs"), code.as_bytes().to_vec())]);
            table("bbox", &files)
        };
        let repeated = |text: &str, count| text.repeat(count);
        let words = |before: &str, after: &str| {
            let each = (0..700).map(|i| format!("{before}x{:08x}{after}", 6_364_136_u64 * i));
            each.collect::<String>()
        };
        for code in [
            format!("const T: &[bool] = &[{}];", repeated("true, false, ", 2500)),
            format!(
                "const T: &[[D; 3]] = &[{}];",
                repeated("[A, -B, C], ", 1100)
            ),
            format!(
                "fn t(q: Q) -> A {{ match q {{ {} _ => N }} }}",
                words("", " => Ab, ")
            ),
            format!("const T: &[&str] = &[{}];", words("stringify!(", "), ")),
            format!("const T: &str = stringify!({});", words("", "")),
            format!(
                "const T: &[&str] = &t! {{ {} }};",
                repeated("/// 3f77a90c 1e\n", 300)
            ),
            format!(
                "t! {{ {} struct A; }}",
                repeated("/** 3f77a90c 1e */ ", 300)
            ),
            repeated("fn f(x: f64) -> f64 { if g(x) { return A; } B }", 500),
        ] {
            assert!(about(&code).is_some(), "{}", &code[..60]);
        }
        for code in [
            // Documentation of code, a comment in a macro, short lists.
            repeated("/// Traces the ray.\nfn f() {}\n", 300),
            format!("m! {{ {} }}", repeated("// a comment\n", 300)),
            repeated("let t = [a, b, c, d]; f(a, &[b, -c], (d, e));\n", 200),
            repeated("match a { A => b, B => c, C => d }\n", 200),
        ] {
            assert_eq!(about(&code), None, "{}", &code[..40]);
        }
    }

    /// How far the correct versions of the course are from what is pointed out.
    #[test]
    fn no_correct_version_is_half_a_table() {
        let mut compared = 0;
        for stage in correct_versions::stages() {
            for (path, text) in correct_versions::variants(&stage) {
                let of = Contents::of(&Files::from([(path.clone(), text)]));
                let is_far = 2 * of.data < MOST_DATA
                    && 2 * (of.data + of.names) < MOST_WITH_NAMES
                    && 2 * of.tokens < MOST_TOKENS;
                assert!(is_far, "{stage}, {}: {of:?}", path.display());
                compared += 1;
            }
            let reference = correct_versions::reference(&stage);
            assert_eq!(table(&stage, &reference), None);
        }
        assert!(compared > 50, "{compared}");
    }
}
