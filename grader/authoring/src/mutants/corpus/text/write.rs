//! Writes a form as its lines in a list of mistakes, in the shorter notation.

use super::super::{Edit, Mutant};
use super::{BECOMES, CHANGE, CODE, CODE_INDENT, texts};
use std::fmt::Write;

/// A form that is longer is written as two lines.
pub(super) const LONGEST_LINE: usize = 120;

/// A shorter unchanged text between two changes is written as a part of one change.
const SHORTEST_UNCHANGED: usize = 9;

/// Operators of two letters.
const OPERATORS: [&str; 14] = [
    "<=", ">=", "==", "!=", "&&", "||", "..", "::", "->", "=>", "+=", "-=", "*=", "/=",
];

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
    let is_point = |three: &[(usize, char)]| matches!(three, [(_, a), (_, '.'), (_, b)] if a.is_ascii_digit() && b.is_ascii_digit());
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
