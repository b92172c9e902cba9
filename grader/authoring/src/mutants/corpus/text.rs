//! The text of a list of mistakes: a mistake, its hint, and below it the forms that make it.
//!
//! ```text
//! # A comment.
//! mistake one_bounce_early: starts the roulette one bounce too early
//!   hint: Up to MIN_BOUNCES bounces the path continues unchanged.
//!   reference: bounces {{<= ~> <}} MIN_BOUNCES
//! also one_bounce_late: starts the roulette one bounce too late
//!   reference: bounces <= {{MIN_BOUNCES ~> MIN_BOUNCES + 1}}
//! ```
//!
//! A form is the code that it changes (`reference` or a variant), a colon, and an edit: a text that
//! occurs in the code, with what changes as `{{OLD ~> NEW}}`, once or several times; or the whole
//! text to find, `~>` and its replacement. `also` begins a mistake with the hint of the one above.
//! Before the colon may stand, in this order: `with MISTAKE` if the form makes a second mistake,
//! too; a name in quotes; `held out`; `in FUNCTION` if the text occurs in several:
//!
//! ```text
//!   half_b with normal_inward "near root" held out: let a = {{d.dot(d) ~> 1.0}}; and: a * c ~> c
//!     and in intersect_sphere: center - p ~> p - center
//! ```
//!
//! `and` begins a further edit of the same form. The replacement may also be below the text to
//! find, in one or more lines that begin with `~>`. `\n` is the end of a line in the code, `\s` a
//! space at an end of a text, `\{` and `\}` are braces, `\\` is a backslash.
//! A form may also be a whole file, indented by four spaces below `code:`, or edits of the file of
//! a mistake above, after `code like "MISTAKE":`. `symptom` marks a mistake that is only a symptom,
//! `seen:` has its numbers in the list of observed mistakes.
//!
//! Lines below `each`, indented by two spaces, are a template: they are read once for each set of
//! values of the signs `@`, `$`, `%`, `^`. They may be mistakes, forms or further edits:
//!
//! ```text
//! each @ $: x y, y z, z x
//!   mistake @_from_$: subtracts o.$ in the @ slab
//!     hint: Each axis has an origin of its own.
//!     java_style: (b.min.@ - ray.o.{{@ ~> $}})
//! ```

mod write;

pub(crate) use write::form_text;

use super::{Corpus, Edit, Mistake, Mutant, REFERENCE};
use std::borrow::Cow;
use std::fmt;
use std::path::PathBuf;

/// The word before a mistake.
const MISTAKE: &str = "mistake ";

/// The word before a mistake that has the hint of the one above.
const ALSO: &str = "also ";

/// The words that begin a mistake.
pub(crate) const BEGINNINGS: [&str; 2] = [MISTAKE, ALSO];

/// What separates the text to find from its replacement. Rust has no such operator.
const BECOMES: &str = "~>";

/// What stands around a change in a text that stays as it is.
const CHANGE: [&str; 2] = ["{{", "}}"];

/// The word before the sets of a template.
const EACH: &str = "each ";

/// What may stand for a value in a template.
const SIGNS: &str = "@$%^";

/// The word in the place of a variant where a form is a whole file.
const CODE: &str = "code";

/// What stands before the name of the mistake whose file a form changes.
const LIKE: &str = "code like \"";

/// The indentation of the lines of such a file.
const CODE_INDENT: &str = "    ";

/// The indentation of what is read once for each set of a template.
const EACH_INDENT: &str = "  ";

/// A line that a list of mistakes cannot contain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct FormatError {
    /// Counted from 1.
    line: usize,
    expected: String,
}

impl fmt::Display for FormatError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let FormatError { line, expected } = self;
        write!(f, "line {line}: expected {expected}")
    }
}

/// Reads a list of mistakes.
pub(super) fn read(text: &str) -> Result<Corpus, FormatError> {
    let mut reader = Reader::default();
    // Some editors begin a file with the mark of its encoding.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let lines: Vec<Line> = (1..).zip(text.lines().map(Cow::from)).collect();
    reader.block(&lines)?;
    reader.end_form()?;
    Ok(reader.corpus)
}

/// A line and its number. In a template, its signs are replaced.
type Line<'a> = (usize, Cow<'a, str>);

/// The lines that a template `SIGNS: SET, SET` stands for: those `below`, once for each set, with
/// its values.
fn filled<'a>(each: &str, below: &[Line<'a>]) -> Result<Vec<Line<'a>>, String> {
    let (signs, sets) = each.split_once(':').unwrap_or((each, ""));
    let signs: Vec<&str> = signs.split_whitespace().collect();
    let is_sign = |sign: &&str| sign.chars().count() == 1 && SIGNS.contains(sign);
    if signs.is_empty() || !signs.iter().all(is_sign) {
        let expected = "and values, such as `each @ $: x y, y z`";
        return Err(format!("one or more of the signs `{SIGNS}` {expected}"));
    }
    let is_used = |sign: &&&str| below.iter().any(|(_, line)| line.contains(**sign));
    if let Some(unused) = signs.iter().find(|sign| !is_used(sign)) {
        return Err(format!("`{unused}` in a line below that is indented more"));
    }
    let mut lines = Vec::new();
    for set in sets.split(", ").map(str::trim) {
        let values: Vec<&str> = match signs.len() {
            1 => vec![set],
            _ => set.split_whitespace().collect(),
        };
        let is_whole = !set.is_empty() && !set.ends_with(',');
        if values.len() != signs.len() || !is_whole || tears_brackets(set) {
            let (number, signs) = (signs.len(), signs.join(" "));
            return Err(format!(
                "a value for each sign of `{signs}` in each set ({number}), sets separated by `, `, which no value \
                 contains; found `{set}`"
            ));
        }
        let value_of = |letter: char| {
            let sign = signs.iter().position(|sign| sign.starts_with(letter));
            sign.map_or_else(|| letter.to_string(), |sign| values[sign].to_string())
        };
        lines.extend(below.iter().map(|(number, line)| {
            let line = line.strip_prefix(EACH_INDENT).unwrap_or(line);
            (*number, line.chars().map(value_of).collect())
        }));
    }
    Ok(lines)
}

/// Whether a set was torn inside of round brackets, as `f(a, b)` would be.
fn tears_brackets(set: &str) -> bool {
    set.matches('(').count() > set.matches(')').count() && !set.trim().ends_with('(')
}

#[derive(Default)]
struct Reader {
    corpus: Corpus,
    /// The form that is being read, and the number of its last line.
    form: Option<(Mutant, usize)>,
    /// The file that the form changes, instead of the reference or a variant.
    like: Option<String>,
    /// The function and the text to find, if the replacement is in the next line.
    find: Option<(String, String)>,
}

impl Reader {
    /// Reads lines; those below a line `each` once for each of its sets.
    fn block(&mut self, lines: &[Line]) -> Result<(), FormatError> {
        let indent = |line: &str| line.len() - line.trim_start().len();
        let mut rest = lines;
        while let [(number, line), after @ ..] = rest {
            rest = after;
            let Some(each) = line.trim().strip_prefix(EACH) else {
                self.line(line, *number)?;
                continue;
            };
            let is_below =
                |(_, below): &&Line| below.trim().is_empty() || indent(below) > indent(line);
            let (below, after) = after.split_at(after.iter().take_while(is_below).count());
            let filled = filled(each, below).map_err(|expected| FormatError {
                line: *number,
                expected,
            })?;
            self.block(&filled)?;
            rest = after;
        }
        Ok(())
    }

    fn line(&mut self, line: &str, number: usize) -> Result<(), FormatError> {
        if self.continue_code(line, number) {
            return Ok(());
        }
        let content = line.trim();
        if content.is_empty() || content.starts_with('#') {
            return Ok(());
        }
        let error = |expected| FormatError {
            line: number,
            expected,
        };
        if let Some(replace) = content.strip_prefix(BECOMES) {
            return self.replacement(replace, number).map_err(error);
        }
        if let Some(edit) = content
            .strip_prefix("and")
            .filter(|rest| rest.starts_with([' ', ':']))
        {
            return self.edit(edit, number).map_err(error);
        }
        self.end_form()?;
        self.start(content, number).map_err(error)
    }

    /// Reads a line of the file that the form consists of; `false` if there is no such file.
    fn continue_code(&mut self, line: &str, number: usize) -> bool {
        let Some((form, last)) = &mut self.form else {
            return false;
        };
        let Some(code) = &mut form.code else {
            return false;
        };
        let is_in_it = line.starts_with(CODE_INDENT) || line.is_empty();
        if is_in_it {
            code.push_str(line.strip_prefix(CODE_INDENT).unwrap_or(line));
            code.push('\n');
            *last = number;
        }
        is_in_it
    }

    /// Reads a line that continues no form.
    fn start(&mut self, content: &str, number: usize) -> Result<(), String> {
        let begun = match content.strip_prefix(MISTAKE) {
            Some(mistake) => Some((mistake, String::new())),
            None => {
                let above = self.corpus.mistakes.last();
                let hint = above.map(|above| above.hint.clone());
                content.strip_prefix(ALSO).zip(hint)
            }
        };
        if let Some((mistake, hint)) = begun {
            let (id, description) = mistake.split_once(": ").unwrap_or((mistake, ""));
            let is_named = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
            if id.is_empty() || !id.chars().all(is_named) {
                return Err("a name of small letters, digits and `_`, and after it `: `".into());
            }
            self.corpus.mistakes.push(Mistake {
                id: id.into(),
                description: description.trim().into(),
                hint,
                ..Mistake::default()
            });
            return Ok(());
        }
        let mistake = self.corpus.mistakes.last_mut();
        let mistake = mistake.ok_or("`mistake NAME: what the code does` before anything else")?;
        match content.split_once(':') {
            None if content == "symptom" => mistake.symptom = true,
            Some(("hint", hint)) => mistake.hint = hint.trim().into(),
            Some(("seen", all)) => {
                mistake.references = all.split_whitespace().map(str::to_string).collect();
            }
            _ => {
                let (form, edit) = match content.strip_prefix(LIKE) {
                    Some(like) => {
                        let (of, edit) = like.split_once('"').unwrap_or((like, ""));
                        self.like = Some(file_of(&self.corpus.mutants, of)?);
                        form_of(REFERENCE, edit, &mistake.id)?
                    }
                    None => form(content, &mistake.id)?,
                };
                let has_edit = form.code.is_none() || edit != ":";
                self.form = Some((form, number));
                if has_edit {
                    self.edit(edit, number)?;
                }
            }
        }
        Ok(())
    }

    /// Reads an edit of the form that is being read, or only the text that it finds: a colon, or
    /// ` in FUNCTION:`, and the texts.
    fn edit(&mut self, edit: &str, number: usize) -> Result<(), String> {
        let (form, last) = self
            .form
            .as_mut()
            .ok_or("`and:` below a form; a hint is one line")?;
        let (edit, next) = split_and(edit);
        let (within, edit) = edit.split_once(':').ok_or_else(expected_form)?;
        let within = match within.strip_prefix(" in ") {
            Some(function) => function.trim(),
            None if within.is_empty() => "",
            None => return Err(expected_form()),
        };
        if self.find.is_some() {
            return Err(format!("`{BECOMES} REPLACEMENT` after the text to find"));
        }
        *last = number;
        let (find, replace) = texts(edit.trim())?;
        if find.is_empty() {
            return Err(format!("`TEXT TO FIND {BECOMES} REPLACEMENT`"));
        }
        match replace {
            None => self.find = Some((within.into(), find)),
            Some(replace) => form.edits.push(Edit {
                within: within.into(),
                find,
                replace,
            }),
        }
        next.map_or(Ok(()), |next| self.edit(next, number))
    }

    /// Reads the replacement of the text in the line before, or its next line.
    fn replacement(&mut self, text: &str, number: usize) -> Result<(), String> {
        let expected = || format!("the text to find before `{BECOMES}`");
        let (form, last) = self.form.as_mut().ok_or_else(expected)?;
        *last = number;
        match self.find.take() {
            Some((within, find)) => form.edits.push(Edit {
                within,
                find,
                replace: unescaped(text.trim())?,
            }),
            None => {
                let edit = form.edits.last_mut().ok_or_else(expected)?;
                let text = text.strip_prefix(' ').unwrap_or(text);
                edit.replace.push('\n');
                edit.replace.push_str(&unescaped(text)?);
            }
        }
        Ok(())
    }

    /// Stores the form that was read, if it is whole.
    fn end_form(&mut self) -> Result<(), FormatError> {
        let Some((mut form, line)) = self.form.take() else {
            return Ok(());
        };
        if let Some(code) = &mut form.code {
            code.truncate(code.trim_end().len());
            code.push('\n');
        }
        let (is_whole, expected) = match &form.code {
            Some(code) => (
                code.len() > 1 && form.edits.is_empty(),
                format!("only `{CODE}:`, and below it a file, indented by four spaces"),
            ),
            None => (
                self.find.is_none(),
                format!("`TEXT TO FIND {BECOMES} REPLACEMENT`"),
            ),
        };
        if !is_whole {
            return Err(FormatError { line, expected });
        }
        if let Some(like) = self.like.take() {
            let changed = form.apply(&[(PathBuf::new(), like)].into());
            let file = changed.map_err(|e| FormatError {
                line,
                expected: format!("edits of that file: {e}"),
            })?;
            form.code = file.into_values().next();
            form.edits.clear();
        }
        form.line = line;
        self.corpus.mutants.push(form);
        Ok(())
    }
}

fn expected_form() -> String {
    format!(
        "`hint: WHERE TO LOOK`, `symptom`, `seen: NUMBERS`, or a form: `VARIANT [with MISTAKE] \
         [\"NAME\"] [held out] [in FUNCTION]: TEXT TO FIND {BECOMES} REPLACEMENT`, or with \
         `{{{{OLD {BECOMES} NEW}}}}` in a text"
    )
}

/// The file of the first form of the mistake `id` that is a whole file.
fn file_of(mutants: &[Mutant], id: &str) -> Result<String, String> {
    let mut own = mutants.iter().filter(|form| form.mistakes[0] == id);
    own.find_map(|form| form.code.clone())
        .ok_or_else(|| format!("`{LIKE}MISTAKE\"`, of a mistake above with a form `{CODE}:`"))
}

/// Reads the head of a form of the mistake `id`: the form, and the text that [`Reader::edit`] reads.
fn form<'a>(content: &'a str, id: &str) -> Result<(Mutant, &'a str), String> {
    let end = content.find([' ', ':']).ok_or_else(expected_form)?;
    let (on, rest) = content.split_at(end);
    form_of(on, rest, id)
}

/// Reads what stands between the code that a form changes and its first edit.
fn form_of<'a>(on: &str, mut rest: &'a str, id: &str) -> Result<(Mutant, &'a str), String> {
    let mut form = Mutant {
        mistakes: vec![id.to_string()],
        on: if on == CODE { REFERENCE } else { on }.to_string(),
        code: (on == CODE).then(String::new),
        ..Mutant::default()
    };
    if let Some(after) = rest.strip_prefix(" with ") {
        let end = after.find([' ', ':']).ok_or_else(expected_form)?;
        form.mistakes.push(after[..end].to_string());
        rest = &after[end..];
    }
    if let Some(after) = rest.strip_prefix(" \"") {
        let (how, after) = after
            .split_once('"')
            .ok_or("`\"` at the end of the form's name")?;
        form.how = how.to_string();
        rest = after;
    }
    if let Some(after) = rest.strip_prefix(" held out") {
        form.held_out = true;
        rest = after;
    }
    match rest.starts_with(':') || rest.starts_with(" in ") {
        true => Ok((form, rest)),
        false => Err(expected_form()),
    }
}

/// Splits the edit of a form from what follows the next ` and` in its line.
fn split_and(edit: &str) -> (&str, Option<&str>) {
    let is_name = |name: &str| name.chars().all(|c| c.is_alphanumeric() || c == '_');
    for (at, and) in edit.match_indices(" and") {
        let next = &edit[at + and.len()..];
        let within = next
            .strip_prefix(" in ")
            .and_then(|next| next.split_once(": "));
        if next.starts_with(": ") || within.is_some_and(|(name, _)| is_name(name)) {
            return (&edit[..at], Some(next));
        }
    }
    (edit, None)
}

/// The text to find that `edit` is written for, and its replacement if it is in the same line.
fn texts(edit: &str) -> Result<(String, Option<String>), String> {
    let [start, end] = CHANGE;
    if !edit.contains(start) {
        return Ok(match edit.split_once(BECOMES) {
            Some((find, replace)) => (unescaped(find.trim())?, Some(unescaped(replace.trim())?)),
            None => (unescaped(edit)?, None),
        });
    }
    let (mut find, mut replace, mut rest) = (String::new(), String::new(), edit);
    while let Some((same, after)) = rest.split_once(start) {
        let change = after
            .split_once(end)
            .and_then(|(change, after)| Some((change.split_once(BECOMES)?, after)));
        let ((old, new), after) =
            change.ok_or_else(|| format!("`{start}OLD {BECOMES} NEW{end}`"))?;
        let same = unescaped(same)?;
        find.extend([&*same, &unescaped(old.trim())?]);
        replace.extend([&*same, &unescaped(new.trim())?]);
        rest = after;
    }
    if rest.contains(BECOMES) {
        return Err(format!("`{BECOMES}` only between `{start}` and `{end}`"));
    }
    let same = unescaped(rest)?;
    Ok((find + &same, Some(replace + &same)))
}

/// The text that `text` is written for.
fn unescaped(text: &str) -> Result<String, String> {
    let mut plain = String::new();
    let mut letters = text.chars();
    while let Some(letter) = letters.next() {
        plain.push(match letter {
            '\\' => match letters.next() {
                Some('n') => '\n',
                Some('s') => ' ',
                Some(letter @ ('\\' | '{' | '}')) => letter,
                _ => return Err("`n`, `s`, `{`, `}` or `\\` after a backslash".into()),
            },
            letter => letter,
        });
    }
    Ok(plain)
}

#[cfg(test)]
mod tests {
    use super::write::LONGEST_LINE;
    use super::*;

    fn edit(within: &str, find: &str, replace: &str) -> Edit {
        Edit {
            within: within.into(),
            find: find.into(),
            replace: replace.into(),
        }
    }

    /// What is read of `text`, without the numbers of lines.
    fn unnumbered(text: &str) -> Corpus {
        let mut corpus = read(text).expect(text);
        corpus.mutants.iter_mut().for_each(|form| form.line = 0);
        corpus
    }

    /// What is read of both, as text.
    fn assert_same(short: &str, long: &str) {
        let [short, long] = [short, long].map(unnumbered);
        assert_eq!(short.mutants, long.mutants);
        assert_eq!(
            format!("{:?}", short.mistakes),
            format!("{:?}", long.mistakes)
        );
    }

    const LIST: &str = r#"# Russian roulette: typical mistakes.

mistake early: starts the roulette one bounce too early
  hint: Up to MIN_BOUNCES bounces the path continues unchanged.
  seen: P1T3-01 P1T3-02
  reference: bounces <= MIN_BOUNCES ~> bounces < MIN_BOUNCES
  snell with late "by a count" held out in rule: a ~>
    and: (b)\n ~> \sc\\
  snell "long":
    # No comment: a file has its own.
"#;

    #[test]
    fn the_mark_of_an_encoding_and_signs_in_values_are_no_others() {
        let marked =
            "\u{feff}mistake m: does\r\n  each @ %: / %, % /\r\n    half_b: a@b ~> a%b\r\n";
        let plain = "mistake m: does\n  half_b: a/b ~> a%b\n  half_b: a%b ~> a/b\n";
        assert_same(marked, plain);
    }

    #[test]
    fn forms_are_read_below_their_mistake() {
        let text = LIST.replace(
            "  snell \"long\":\n    # No comment: a file has its own.\n",
            "",
        );
        let corpus = read(&text).unwrap();
        let [mistake] = &corpus.mistakes[..] else {
            panic!("{:?}", corpus.mistakes);
        };
        assert_eq!(mistake.id, "early");
        assert_eq!(
            mistake.description,
            "starts the roulette one bounce too early"
        );
        assert_eq!(
            mistake.hint,
            "Up to MIN_BOUNCES bounces the path continues unchanged."
        );
        assert_eq!(mistake.references, ["P1T3-01", "P1T3-02"]);
        let [plain, pair] = &corpus.mutants[..] else {
            panic!("{:?}", corpus.mutants);
        };
        assert_eq!(plain.name(), "early");
        assert_eq!(
            plain.edits,
            [edit("", "bounces <= MIN_BOUNCES", "bounces < MIN_BOUNCES")]
        );
        assert_eq!(pair.name(), "early+late on snell: by a count");
        assert!(pair.held_out && !plain.held_out);
        assert_eq!(
            pair.edits,
            [edit("rule", "a", ""), edit("", "(b)\n", " c\\")]
        );
    }

    #[test]
    fn changes_inside_a_text_are_read_as_the_whole_texts() {
        let short = "mistake m: does\n  half_b in f: a {{- ~> +}} b{{~> .abs()}} \\{ {{x }~>}} and: c ~> d\n\
                     \x20   and in g: {{~> \\sa}} ~\n";
        let read = read(short).unwrap();
        let edits = [
            edit("f", "a - b { x }", "a + b.abs() { "),
            edit("", "c", "d"),
            edit("g", " ~", " a ~"),
        ];
        assert_eq!(read.mutants[0].edits, edits);
    }

    #[test]
    fn the_writer_chooses_the_shorter_notation_and_tears_no_brackets() {
        let written = |edits: &[Edit]| {
            form_text(&Mutant {
                on: "half_b".into(),
                edits: edits.into(),
                ..Mutant::default()
            })
        };
        let first = edit(
            "",
            "let t = (a.min[i] - o[i]) / d;",
            "let t = (a.min[i] + o[i]) / d;",
        );
        let second = edit("f", "0..3", "0..2");
        assert_eq!(written(&[edit("", "a", "b")]), "  half_b: a ~> b\n");
        assert_eq!(
            written(&[first, second]),
            "  half_b: let t = (a.min[i] {{- ~> +}} o[i]) / d; and in f: 0..3 ~> 0..2\n"
        );
        let brackets = edit(
            "",
            "let p = (x + 0.5) / w;",
            "let p = ((x + 0.5) as u32 / w) as f64;",
        );
        assert_eq!(
            written(&[brackets]),
            "  half_b: let p = {{(x + 0.5) / w ~> ((x + 0.5) as u32 / w) as f64}};\n"
        );
    }

    #[test]
    fn a_template_is_read_as_its_long_form() {
        let short = "each @ $: x 0, y 1\n  mistake no_@: forgets @\n    hint: All.\n\
                     \x20   each %: 1e-3, 0.5 + h\n      half_b \"%\": t$ ~> % * t$\n\
                     \x20   reference: d ~> e\n      each ^: a, b\n        and in f: ^.@ ~> ^\n\
                     also z: z\n  reference: z ~> 0\n";
        let of = |axis: &str, number: &str| {
            format!(
                "mistake no_{axis}: forgets {axis}\n  hint: All.\n  half_b \"1e-3\": t{number} ~> 1e-3 * t{number}\n\
                 \x20 half_b \"0.5 + h\": t{number} ~> 0.5 + h * t{number}\n  reference: d ~> e\n\
                 \x20   and in f: a.{axis} ~> a\n    and in f: b.{axis} ~> b\n"
            )
        };
        let long =
            of("x", "0") + &of("y", "1") + "mistake z: z\n  hint: All.\n  reference: z ~> 0\n";
        assert_same(short, &long);
    }

    #[test]
    fn a_file_like_another_is_read_as_the_whole_file() {
        let file = "mistake none: does\n  code:\n    fn f() {\n        0\n    }\n\n    fn g() {\n        0\n    }\n";
        let like =
            "mistake all: does\n  code like \"none\" \"f and g\" in f: 0 ~> 1 and in g: 0 ~> 2\n";
        let whole = "mistake all: does\n  code \"f and g\":\n    fn f() {\n        1\n    }\n\n    fn g() {\n        2\n    }\n";
        assert_same(&format!("{file}{like}"), &format!("{file}{whole}"));
    }

    #[test]
    fn written_forms_are_read_back() {
        let long = "a".repeat(LONGEST_LINE);
        let lines = format!(" {long}\n    \n\n  {long} ");
        let edits = [
            ("x ", " y"),
            ("\n", "\\"),
            ("gone", ""),
            (&*long, "short\n}"),
            ("code", &*lines),
            ("{{x}} and: y", "{{{y}} and in f: y"),
            ("if x {", "if x {{"),
        ];
        let edits = edits.map(|(find, replace)| Edit {
            within: if find == "gone" { "f" } else { "" }.into(),
            find: find.into(),
            replace: replace.into(),
        });
        let edited = Mutant {
            mistakes: vec!["one".into(), "two".into()],
            on: "snell".into(),
            how: "a way, of two".into(),
            edits: edits.into(),
            held_out: true,
            ..Mutant::default()
        };
        let whole = Mutant {
            mistakes: vec!["one".into()],
            on: REFERENCE.into(),
            code: Some("//! A file.\n\nfn f() {\n    1\n}\n".into()),
            ..Mutant::default()
        };
        let forms = [edited, whole];
        let text = forms.each_ref().map(form_text).concat();
        let corpus = unnumbered(&format!("mistake one: does\n{text}\n"));
        assert_eq!(corpus.mutants, forms);
    }

    #[test]
    fn a_malformed_line_is_an_error_with_its_place_and_what_was_expected() {
        let head = "mistake m: does\n";
        for (text, line, expected) in [
            ("  hint: No.\n", 1, "`mistake NAME: what the code does`"),
            ("mistake m: does\n  half_b a ~> b\n", 2, "a form: `VARIANT"),
            (
                "mistake m: does\n  half_b: a ~> b\n    and f: a ~> b\n",
                3,
                "[in FUNCTION]",
            ),
            (
                "mistake m: does\n  half_b: a -> b\n\nmistake n: x\n",
                2,
                "`TEXT TO FIND ~> REPLACEMENT`",
            ),
            (
                "mistake m: does\n  half_b: a -> b\n",
                2,
                "`TEXT TO FIND ~> REPLACEMENT`",
            ),
            (
                "mistake m: does\n  half_b: ~> b\n",
                2,
                "`TEXT TO FIND ~> REPLACEMENT`",
            ),
            (
                "mistake m: does\n  half_b: a ~> \\b\n",
                2,
                "after a backslash",
            ),
            (
                "mistake m: does\n    and: a ~> b\n",
                2,
                "`and:` below a form",
            ),
            ("mistake m: does\n    ~> b\n", 2, "the text to find before"),
            (
                "mistake m: does\n  half_b \"x: a ~> b\n",
                2,
                "`\"` at the end",
            ),
            (
                "mistake m: does\n  code:\nmistake n: x\n",
                2,
                "below it a file",
            ),
            (
                "mistake m: does\n  half_b: a {{b}}\n",
                2,
                "`{{OLD ~> NEW}}`",
            ),
            (
                "mistake m: does\n  half_b: }} {{a ~> b\n",
                2,
                "`{{OLD ~> NEW}}`",
            ),
            (
                "mistake m: does\n  half_b: {{a ~> b}} ~> c\n",
                2,
                "only between `{{` and `}}`",
            ),
            ("also m: does\n", 1, "`mistake NAME: what the code does`"),
            (
                "mistake m: does\n\n  each x: 1, 2\n    half_b: a ~> x\n",
                3,
                "one or more of the signs `@$%^`",
            ),
            (
                "mistake m: does\n  each @ $: 1 2, 3\n    half_b: @ ~> $\n",
                2,
                "a value for each sign of `@ $` in each set (2), sets separated by `, `, which no value contains; found `3`",
            ),
            (
                "mistake m: does\n  each @: 1, 2\n  half_b: a ~> @\n",
                2,
                "`@` in a line below",
            ),
            (
                "mistake m: does\n  each @: f(a, b), c\n    half_b \"@\": @ ~> d\n",
                2,
                "which no value contains; found `f(a`",
            ),
            (
                "mistake m: does\n  each @: a, b,\n    half_b \"@\": @ ~> d\n",
                2,
                "found `b,`",
            ),
            ("mistake two words: does\n", 1, "a name of small letters"),
            (
                "mistake m: does\n  hint: a\n  and: b ~> c\n",
                3,
                "a hint is one line",
            ),
            (
                "mistake m: does\n  each @: a, ~>\n    half_b \"1\": @ ~> b\n",
                3,
                "`TEXT TO FIND ~> REPLACEMENT`",
            ),
            (
                "mistake m: does\n  code like \"n\": a ~> b\n",
                2,
                "of a mistake above with a form `code:`",
            ),
            (
                "mistake m: does\n  code:\n    a\nmistake n: does\n  code like \"m\": b ~> a\n",
                5,
                "found it 0 times",
            ),
        ] {
            let error = read(text).expect_err(text).to_string();
            let start = format!("line {line}: expected ");
            assert!(
                error.starts_with(&start) && error.contains(expected),
                "{text}{error}"
            );
        }
        assert!(read(head).unwrap().mutants.is_empty());
    }
}
