//! The text of a list of mistakes: a mistake, its hint, and below it the forms that make it.
//!
//! ```text
//! # A comment.
//! mistake one_bounce_early: starts the roulette one bounce too early
//!   hint: Up to MIN_BOUNCES bounces the path continues unchanged.
//!   reference: bounces <= MIN_BOUNCES ~> bounces < MIN_BOUNCES
//! ```
//!
//! A form is the code that it changes (`reference` or a variant), a colon, the text to find, `~>`
//! and its replacement. Before the colon may stand, in this order: `with MISTAKE` if the form makes
//! a second mistake, too; a name in quotes; `held out`; `in FUNCTION` if the text occurs in several:
//!
//! ```text
//!   half_b with normal_inward "near root" held out: let a = d.dot(d); ~> let a = 1.0;
//!     and in intersect_sphere: center - p ~> p - center
//! ```
//!
//! A line `and` is a further edit of the same form. The replacement may also be below the text to
//! find, in one or more lines that begin with `~>`. `\n` is the end of a line in the code, `\s` a
//! space at an end of a text, `\\` a backslash.
//! A form may also be a whole file, indented by four spaces below `code:`. `symptom` marks a mistake
//! that is only a symptom, `seen:` has its numbers in the list of observed mistakes.

use super::{Corpus, Edit, Mistake, Mutant, REFERENCE};
use std::borrow::Cow;
use std::fmt::{self, Write};
use std::path::PathBuf;

/// The word before a mistake.
const MISTAKE: &str = "mistake ";

/// The word before a mistake that has the hint of the one above.
const ALSO: &str = "also ";

/// What separates the text to find from its replacement. Rust has no such operator.
const BECOMES: &str = "~>";

/// What stands around a change in a text that stays as it is.
const CHANGE: [&str; 2] = ["{{", "}}"];

/// A shorter unchanged text between two changes is written as a part of one change.
const SHORTEST_UNCHANGED: usize = 9;

/// Operators of two letters.
const OPERATORS: [&str; 14] = [
    "<=", ">=", "==", "!=", "&&", "||", "..", "::", "->", "=>", "+=", "-=", "*=", "/=",
];

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

/// A form that is longer is written as two lines.
const LONGEST_LINE: usize = 120;

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
    let lines = text.lines().enumerate();
    reader.block(&lines.map(|(i, line)| (i + 1, line.into())).collect::<Vec<_>>())?;
    reader.end_form()?;
    Ok(reader.corpus)
}

/// A line and its number. In a template, its signs are replaced.
type Line<'a> = (usize, Cow<'a, str>);

/// The sets of a template: each has a value for each sign.
struct Each<'a> {
    signs: Vec<&'a str>,
    sets: Vec<Vec<&'a str>>,
}

impl Each<'_> {
    /// Reads `SIGNS: SET, SET`.
    fn read(text: &str) -> Result<Each<'_>, String> {
        let (signs, sets) = text.split_once(':').unwrap_or((text, ""));
        let signs: Vec<&str> = signs.split_whitespace().collect();
        let is_sign = |sign: &&str| sign.chars().count() == 1 && SIGNS.contains(sign);
        if signs.is_empty() || !signs.iter().all(is_sign) {
            let expected = "and values, such as `each @ $: x y, y z`";
            return Err(format!("one or more of the signs `{SIGNS}` {expected}"));
        }
        let values = |set| match signs.len() {
            1 => vec![str::trim(set)],
            _ => set.split_whitespace().collect(),
        };
        let sets: Vec<Vec<&str>> = sets.split(", ").map(values).collect();
        let is_whole = |set: &&Vec<&str>| set.len() == signs.len() && !set[0].is_empty();
        match sets.iter().find(|set| !is_whole(set)) {
            Some(set) => Err(format!(
                "{} values for `{}` in each set, found `{}`",
                signs.len(),
                signs.join(" "),
                set.join(" ")
            )),
            None => Ok(Each { signs, sets }),
        }
    }

    /// The lines below it with the values of one set, less indented.
    fn filled<'a>(&self, below: &[Line<'a>], set: &[&str]) -> Vec<Line<'a>> {
        let lines = below.iter().map(|(number, line)| {
            let mut line = line.strip_prefix(EACH_INDENT).unwrap_or(line).to_string();
            for (sign, value) in self.signs.iter().zip(set) {
                line = line.replace(sign, value);
            }
            (*number, line.into())
        });
        lines.collect()
    }
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
            let error = |expected| FormatError {
                line: *number,
                expected,
            };
            let each = Each::read(each).map_err(error)?;
            let is_below =
                |(_, below): &&Line| below.trim().is_empty() || indent(below) > indent(line);
            let (below, after) = after.split_at(after.iter().take_while(is_below).count());
            let is_used = |sign: &&&str| below.iter().any(|(_, line)| line.contains(**sign));
            if let Some(unused) = each.signs.iter().find(|sign| !is_used(sign)) {
                return Err(error(format!("`{unused}` in lines below, more indented")));
            }
            for set in &each.sets {
                self.block(&each.filled(below, set))?;
            }
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
        let above = self.corpus.mistakes.last();
        let begun = [
            (MISTAKE, Some(String::new())),
            (ALSO, above.map(|above| above.hint.clone())),
        ];
        let begun = begun
            .into_iter()
            .find_map(|(word, hint)| Some((content.strip_prefix(word)?, hint?)));
        if let Some((mistake, hint)) = begun {
            let (id, description) = mistake.split_once(": ").unwrap_or((mistake, ""));
            self.corpus.mistakes.push(Mistake {
                id: id.trim().into(),
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
                let mut content = Cow::from(content);
                if let Some(like) = content.strip_prefix(LIKE) {
                    let (of, rest) = like.split_once('"').unwrap_or((like, ""));
                    let mut files = self.corpus.mutants.iter();
                    let file = files.find(|form| form.code.is_some() && form.mistakes[0] == of);
                    let file = file.ok_or_else(|| {
                        format!("`{LIKE}MISTAKE\"`, of a mistake above with a form `{CODE}:`")
                    })?;
                    self.like = file.code.clone();
                    content = format!("{REFERENCE}{rest}").into();
                }
                let (form, edit) = form(&content, &mistake.id)?;
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
        let (form, last) = self.form.as_mut().ok_or("`and:` below a form")?;
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
            let file = form.apply(&[(PathBuf::new(), like)].into());
            let file = file.map_err(|e| FormatError {
                line,
                expected: format!("edits of that file: {e}"),
            })?;
            form.code = file.into_values().next();
            form.edits.clear();
        }
        self.corpus.mutants.push(form);
        Ok(())
    }
}

fn expected_form() -> String {
    format!(
        "`hint: WHERE TO LOOK`, `symptom`, `seen: NUMBERS`, or a form: `VARIANT [with MISTAKE] \
         [\"NAME\"] [held out] [in FUNCTION]: TEXT TO FIND {BECOMES} REPLACEMENT`"
    )
}

/// Reads the head of a form of the mistake `id`: the form, and the text that [`Reader::edit`] reads.
fn form<'a>(content: &'a str, id: &str) -> Result<(Mutant, &'a str), String> {
    let end = content.find([' ', ':']).ok_or_else(expected_form)?;
    let (on, mut rest) = content.split_at(end);
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
        let within = next.strip_prefix(" in ").and_then(|next| next.split_once(": "));
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
        let (change, after) = after.split_once(end).unwrap_or((after, ""));
        let (old, new) = change
            .split_once(BECOMES)
            .filter(|_| rest.contains(end))
            .ok_or_else(|| format!("`{start}OLD {BECOMES} NEW{end}`"))?;
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
                Some(letter @ ('\\' | '{')) => letter,
                _ => return Err("`\\n`, `\\s`, `\\{` or `\\\\` after a backslash".into()),
            },
            letter => letter,
        });
    }
    Ok(plain)
}

/// How a text is written.
fn escaped(text: &str) -> String {
    let escaped = escaped_after_indent(text);
    match escaped.strip_prefix(' ') {
        Some(rest) => format!("\\s{rest}"),
        None => escaped,
    }
}

/// How a text is written where spaces at its start are kept.
fn escaped_after_indent(text: &str) -> String {
    let escaped = escaped_inside(text);
    match escaped.strip_suffix(' ') {
        Some(rest) => format!("{rest}\\s"),
        None => escaped,
    }
}

/// How a text is written between others.
fn escaped_inside(text: &str) -> String {
    let escaped = text.replace('\\', "\\\\").replace('\n', "\\n");
    let escaped = escaped.replace("{{", "{\\{").replace("{{", "{\\{");
    let escaped = escaped.replace(" and: ", "\\sand: ");
    escaped.replace(" and in ", "\\sand in ")
}

/// How an edit is written in a line: the shorter of `OLD ~> NEW` and a text with changes inside.
fn edit_line(edit: &Edit) -> String {
    let [find, replace] = [&edit.find, &edit.replace].map(|text| escaped(text));
    let whole = format!("{find} {BECOMES} {replace}").trim_end().to_string();
    let [old, new] = [&edit.find, &edit.replace].map(|text| tokens(text));
    let changed = with_changes(&old, &new).filter(|changed| changed.len() < whole.len());
    let is_read_back = |changed: &String| {
        let read = texts(changed.trim());
        read == Ok((edit.find.clone(), Some(edit.replace.clone())))
    };
    changed.filter(is_read_back).unwrap_or(whole)
}

/// A text that becomes another one, with changes inside. `None` if brackets would be torn apart.
fn with_changes(old: &[&str], new: &[&str]) -> Option<String> {
    let same = |pairs: &mut dyn Iterator<Item = (&&str, &&str)>| {
        pairs.take_while(|(old, new)| old == new).count()
    };
    let mut start = same(&mut old.iter().zip(new));
    let mut end = same(&mut old[start..].iter().rev().zip(new[start..].iter().rev()));
    loop {
        let [within_old, within_new] = [old, new].map(|all| &all[start..all.len() - end]);
        let open = [within_old, within_new].map(open_ends);
        if open.iter().any(|open| open.0) {
            start = start.checked_sub(1)?;
        } else if open.iter().any(|open| open.1) {
            end = end.checked_sub(1)?;
        } else {
            let [before, after] = [&old[..start], &old[old.len() - end..]];
            let [before, after] = [before, after].map(|text| escaped_inside(&text.concat()));
            return Some(before + &changes(within_old, within_new) + &after);
        }
    }
}

/// Whether a text must be longer, at its start or its end, to be a change: it has only one of a
/// pair of brackets, or a space there.
fn open_ends(text: &[&str]) -> (bool, bool) {
    let (mut is_closed, mut open) = (false, 0);
    for token in text {
        match *token {
            "(" | "[" | "{" => open += 1,
            ")" | "]" | "}" if open > 0 => open -= 1,
            ")" | "]" | "}" => is_closed = true,
            _ => {}
        }
    }
    let space = |token: Option<&&str>, is_it: fn(&str) -> bool| token.is_some_and(|t| is_it(t));
    (
        is_closed || space(text.first(), |token| token.starts_with(' ')),
        open > 0 || space(text.last(), |token| token.ends_with(' ')),
    )
}

/// A text that becomes another one, as one change or as several with long unchanged texts between.
fn changes(old: &[&str], new: &[&str]) -> String {
    let starts = (0..old.len()).flat_map(|i| (0..new.len()).map(move |j| (i, j)));
    let runs = starts.filter_map(|(i, j)| {
        let pairs = old[i..].iter().zip(&new[j..]);
        let length = pairs.take_while(|(old, new)| old == new).count();
        let rest = [&old[..i], &new[..j], &old[i + length..], &new[j + length..]];
        let letters: usize = old[i..i + length].iter().map(|token| token.len()).sum();
        let is_run = letters >= SHORTEST_UNCHANGED
            && rest.iter().all(|rest| open_ends(rest) == (false, false));
        is_run.then_some((letters, i, j, length))
    });
    match runs.max() {
        Some((_, i, j, length)) => {
            let same = escaped_inside(&old[i..i + length].concat());
            let after = changes(&old[i + length..], &new[j + length..]);
            changes(&old[..i], &new[..j]) + &same + &after
        }
        None => {
            let [start, end] = CHANGE;
            let [old, new] = [old, new].map(|text| escaped(&text.concat()));
            let change = format!("{old} {BECOMES} {new}");
            format!("{start}{}{end}", change.trim())
        }
    }
}

/// Words, numbers, spaces and signs of code.
fn tokens(text: &str) -> Vec<&str> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let letters: Vec<(usize, char)> = text.char_indices().collect();
    let is_point = |three: &[(usize, char)]| {
        matches!(three, [(_, a), (_, '.'), (_, b)] if a.is_ascii_digit() && b.is_ascii_digit())
    };
    let begins = |i: &usize| {
        let ((_, before), (at, here)) = (letters[i - 1], letters[*i]);
        let is_joined = is_word(before) && is_word(here)
            || before.is_whitespace() && here.is_whitespace()
            || OPERATORS.contains(&&text[letters[i - 1].0..at + here.len_utf8()])
            || [i.saturating_sub(2), i - 1]
                .iter()
                .any(|&from| letters.get(from..from + 3).is_some_and(is_point));
        !is_joined
    };
    let mut tokens = Vec::new();
    let mut from = 0;
    for i in (1..letters.len()).filter(begins) {
        tokens.push(&text[from..letters[i].0]);
        from = letters[i].0;
    }
    tokens.push(&text[from..]);
    tokens
}

/// The lines in which a replacement is written below the text to find: one for each line of the
/// code if it is long.
fn replacement_lines(replace: &str) -> impl Iterator<Item = String> {
    let whole = escaped(replace);
    let is_long = whole.len() > LONGEST_LINE;
    let (first, rest) = replace.split_once('\n').filter(|_| is_long).unzip();
    let rest = rest.map(|rest: &str| rest.split('\n').map(escaped_after_indent));
    std::iter::once(first.map_or(whole, escaped)).chain(rest.into_iter().flatten())
}

fn length_of_last(text: &str) -> usize {
    text.len() - text.rfind('\n').map_or(0, |end| end + 1)
}

/// The lines of a form.
pub fn form_text(form: &Mutant) -> String {
    let on = if form.code.is_some() { CODE } else { &form.on };
    let mut text = format!("  {on}");
    for second in form.mistakes.iter().skip(1) {
        let _ = write!(text, " with {second}");
    }
    if !form.how.is_empty() {
        let _ = write!(text, " \"{}\"", form.how);
    }
    if form.held_out {
        text.push_str(" held out");
    }
    if form.code.is_some() {
        text.push(':');
    }
    let mut can_join = true;
    for (i, edit) in form.edits.iter().enumerate() {
        let within = match edit.within.as_str() {
            "" => String::new(),
            function => format!(" in {function}"),
        };
        let and = if i > 0 { " and" } else { "" };
        let line = format!("{and}{within}: {}", edit_line(edit));
        if !can_join || length_of_last(&text) + line.len() > LONGEST_LINE {
            text.push_str(if i > 0 { "\n   " } else { "" });
        }
        can_join = length_of_last(&text) + line.len() <= LONGEST_LINE;
        if can_join {
            text.push_str(&line);
            continue;
        }
        let _ = write!(text, "{and}{within}: {}", escaped(&edit.find));
        for below in replacement_lines(&edit.replace) {
            text.push_str(format!("\n    {BECOMES} {below}").trim_end());
        }
    }
    if form.code.is_none() {
        text.push('\n');
    }
    if let Some(code) = &form.code {
        text.push('\n');
        for line in code.lines() {
            let indent = if line.is_empty() { "" } else { CODE_INDENT };
            let _ = writeln!(text, "{indent}{line}");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let edit = |within: &str, find: &str, replace: &str| Edit {
            within: within.into(),
            find: find.into(),
            replace: replace.into(),
        };
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
    fn written_forms_are_read_back() {
        let long = "a".repeat(LONGEST_LINE);
        let lines = format!(" {long}\n    \n\n  {long} ");
        let edits = [
            ("x ", " y"),
            ("\n", "\\"),
            ("gone", ""),
            (&*long, "short\n}"),
            ("code", &*lines),
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
        let corpus = read(&format!("mistake one: does\n{text}\n")).unwrap();
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
