//! Writes a form as its lines in a list of mistakes, in the shorter notation.

use super::super::{Edit, Mutant, common};
use super::{BECOMES, CHANGE, CODE, CODE_INDENT, texts};
use std::fmt::Write;

/// A form that is longer is written as two lines.
pub(super) const LONGEST_LINE: usize = 120;

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
    text.replace('\\', "\\\\")
        .replace('\n', "\\n")
        .replace("{{", "{\\{")
        .replace("{{", "{\\{")
        .replace(" and: ", "\\sand: ")
        .replace(" and in ", "\\sand in ")
}

/// How an edit is written in a line: the shorter of `OLD ~> NEW` and a text with a change inside.
fn edit_line(edit: &Edit) -> String {
    let [find, replace] = [&edit.find, &edit.replace].map(|text| escaped(text));
    let whole = format!("{find} {BECOMES} {replace}").trim_end().to_string();
    let read_back = Ok((edit.find.clone(), Some(edit.replace.clone())));
    let changed = with_change(&edit.find, &edit.replace)
        .filter(|changed| changed.len() < whole.len() && texts(changed.trim()) == read_back);
    changed.unwrap_or(whole)
}

/// A text that becomes another one, with the change inside. `None` if it has only one of a pair of
/// brackets.
fn with_change(find: &str, replace: &str) -> Option<String> {
    let mut start = common(find.chars(), replace.chars());
    let rest = [find, replace].map(|text| text[start..].chars().rev());
    let mut end = common(rest[0].clone(), rest[1].clone());
    loop {
        let [old, new] = [find, replace].map(|text| &text[start..text.len() - end]);
        let (before, after) = (&find[..start], &find[find.len() - end..]);
        let start_tears = |text: &str| tears(before.chars().rev(), text.chars(), "([{");
        let end_tears = |text: &str| tears(after.chars(), text.chars().rev(), ")]}");
        if start_tears(old) || start_tears(new) {
            start -= before.chars().next_back()?.len_utf8();
        } else if end_tears(old) || end_tears(new) {
            end -= after.chars().next()?.len_utf8();
        } else {
            let [open, close] = CHANGE;
            let change = format!("{} {BECOMES} {}", escaped(old), escaped(new));
            let [before, after] = [before, after].map(escaped_inside);
            return Some(format!("{before}{open}{}{close}{after}", change.trim()));
        }
    }
}

/// Whether a change cannot end here, read from this end: within a word or an operator, between the
/// brackets of a pair, or with a space.
fn tears(
    mut outside: impl Iterator<Item = char>,
    change: impl Iterator<Item = char> + Clone,
    opening: &str,
) -> bool {
    let mut open = 0;
    let mut brackets = change.clone().filter(|c| "()[]{}".contains(*c));
    let is_torn_pair = brackets.any(|bracket| {
        open += if opening.contains(bracket) { 1 } else { -1 };
        open < 0
    });
    let (outer, inner) = (outside.next(), change.clone().next());
    is_torn_pair || inner == Some(' ') || outer.zip(inner).is_some_and(are_joined)
}

/// Whether two letters belong to one word, number or operator.
fn are_joined((a, b): (char, char)) -> bool {
    let is_word = |c: char| c.is_alphanumeric() || "_.".contains(c);
    let is_operator = |c: char| "<>=!&|+-*/:.".contains(c);
    is_word(a) && is_word(b) || is_operator(a) && is_operator(b)
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
pub(crate) fn form_text(form: &Mutant) -> String {
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
