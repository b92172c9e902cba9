//! Finds what may be a table of answers in a stage: more numbers, strings and names than code
//! needs.

use super::{Scanner, Token};
use files::file_tree::Files;
use std::collections::HashSet;

/// More bytes of data than code of a stage needs: the correct versions have at most 540, most of
/// them less than 100.
const MOST_DATA: usize = 3000;

/// More bytes of data and of different names together: macros make strings of names. The correct
/// versions have at most 2,300.
const MOST_WITH_NAMES: usize = 2600;

/// More words and marks than code of a stage needs: the correct versions have at most 4,700.
const MOST_TOKENS: usize = 9000;

/// More blanks and comments, for each byte of code, than code needs that can read where it stands:
/// what lies between two places is a number.
const MOST_AROUND: usize = 4;

/// Words of code that reads its own line or column, a mark for those that are macros.
const READS_PLACES: [(&str, &str); 5] = [
    ("caller", ""),
    ("column", "!"),
    ("line", "!"),
    ("set_hook", ""),
    ("track_caller", ""),
];

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
        Contents {
            around,
            code,
            reads_places: true,
            ..
        } if around > MOST_AROUND * code => {
            format!("{around} bytes of blanks and comments whose places it reads")
        }
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
    /// Their bytes, with those of strings.
    code: usize,
    /// The bytes of blanks and comments.
    around: usize,
    /// Whether the code can read in which line or column something of it stands.
    reads_places: bool,
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
        let (mut words, mut tests, mut quoted_in_tests) = (0, 0, 0);
        let mut attribute = TEST_ATTRIBUTE.iter();
        let mut macros = Macros::default();
        while let Some(token) = scanner.next() {
            self.tokens += 1;
            words += token.text.len();
            let is_word = token.text.starts_with(super::is_part_of_word);
            self.data += macros.add(&token, is_word, scanner.documented);
            if token.text.starts_with(|c: char| c.is_ascii_digit()) {
                self.data += token.text.len();
            } else if is_word || token.text.starts_with('\'') {
                self.reads_places |= READS_PLACES.iter().any(|(word, mark)| {
                    *word == token.text && scanner.rest.trim_start().starts_with(mark)
                });
                names.insert(token.text.clone());
            }
            if attribute.as_slice().first() == Some(&token.text.as_str()) {
                attribute.next();
            } else {
                attribute = TEST_ATTRIBUTE.iter();
            }
            // A macro gets all tokens of its arguments, whatever attributes they have.
            if attribute.len() == 0 && macros.depth == 0 && is_before_module(&scanner) {
                let before = (scanner.rest.len(), scanner.quoted);
                scanner.skip_item();
                tests += before.0 - scanner.rest.len();
                quoted_in_tests += scanner.quoted - before.1;
            }
        }
        let quoted = scanner.quoted - quoted_in_tests;
        self.data += quoted;
        self.code += words + quoted;
        self.around += code.len().saturating_sub(tests + words + quoted);
    }
}

/// Whether a module with its contents is next, perhaps after more attributes. An attribute of
/// something else, such as an element of an array, ends with that.
fn is_before_module(scanner: &Scanner<'_>) -> bool {
    let mut scanner = scanner.clone();
    let mut next = || scanner.next().map_or(String::new(), |token| token.text);
    let mut word = next();
    while word == "#" {
        let mut depth = 0_usize;
        loop {
            match next().as_str() {
                "[" => depth += 1,
                "]" if depth > 1 => depth -= 1,
                "]" | "" => break,
                _ => {}
            }
        }
        word = next();
    }
    let name = next();
    word == "mod" && name.starts_with(super::is_part_of_word) && next() == "{"
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
        // What is for tests only ends where it ends, and is no such thing in a macro.
        let elements = "0.25, ".repeat(2000);
        for table in [
            format!("const T: [f64; 2000] = [#[cfg(test)] 0.5, {elements}];"),
            format!("t! {{ #[cfg(test)] mod t {{ {elements} }} }}"),
        ] {
            assert!(about(table).is_some());
        }
        let allowed = tests.replace("]\n", "]\n#[allow(unused)]\n");
        assert_ne!(allowed, tests);
        assert_eq!(about(allowed), None);
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
            // In the name of a lifetime, and between the signs of a list.
            format!(
                "const T: &str = stringify!('{});",
                repeated("x3f77a90c", 300)
            ),
            format!(
                "#[track_caller] fn neg(s: S) -> u32 {{ Location::caller().column() }} const T: [u32; 99] = [{}];",
                repeated(&format!("{}-S, ", " ".repeat(50)), 99)
            ),
            format!(
                "const T: [u32; 99] = [{}];",
                repeated(&format!("/*{}*/ column!(), ", "x".repeat(60)), 99)
            ),
        ] {
            assert!(about(&code).is_some(), "{}", &code[..60]);
        }
        for code in [
            // Documentation of code, a comment in a macro, short lists.
            repeated("/// Traces the ray.\nfn f() {}\n", 300),
            format!("m! {{ {} }}", repeated("// a comment\n", 300)),
            repeated("let t = [a, b, c, d]; f(a, &[b, -c], (d, e));\n", 200),
            repeated("match a { A => b, B => c, C => d }\n", 200),
            // Few comments of code that reads places, many of code that does not.
            repeated(
                "// Traces it.\nfn f() { assert!(a == b, \"{}\", line!()); }\n",
                9,
            ),
            repeated("// Traces the ray to the nearest hit.\nfn line() {}\n", 300),
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
