//! Reads the compiler's messages: finds the first error.

/// The first error among the compiler's messages, and how many errors there are. Without an error
/// the whole text counts as one message.
pub fn first(messages: &str) -> (String, usize) {
    let mut errors: Vec<String> = Vec::new();
    let mut in_error = false;
    for line in messages.lines() {
        let text = plain(line);
        if text.starts_with("error") {
            errors.push(String::new());
            in_error = true;
        } else if text.starts_with("warning") {
            in_error = false;
        }
        if let Some(error) = errors.last_mut().filter(|_| in_error) {
            error.push_str(line);
            error.push('\n');
        }
    }
    let count = errors.len().max(1);
    let first = errors.into_iter().next();
    (first.unwrap_or_else(|| messages.to_owned()), count)
}

/// Where the first error is and what it says, in a line: `src/a.rs:3:5: error: mismatched types`.
/// `None` if it names no place.
pub fn first_in_a_line(messages: &str) -> Option<String> {
    let first = plain(&first(messages).0);
    Some(format!("{}: {}", place(&first)?, first.lines().next()?))
}

/// The file of the first error. `None` if it names no place.
pub fn first_file(messages: &str) -> Option<String> {
    let first = plain(&first(messages).0);
    let (file, _) = place(&first)?.split_once(':')?;
    Some(file.to_owned())
}

/// The place that a message of the compiler names: `src/a.rs:3:5`.
fn place(message: &str) -> Option<&str> {
    let mut lines = message.lines();
    lines.find_map(|line| line.trim_start().strip_prefix("--> "))
}

/// The text without ANSI escape codes, which colour it.
pub fn plain(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, code)) = rest.split_once("\x1b[") {
        out.push_str(before);
        let end = code.find(|c: char| c.is_ascii_alphabetic());
        rest = end.map_or("", |end| &code[end + 1..]);
    }
    out.push_str(rest);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_error_is_found_between_warnings() {
        let text = "warning: unused\n --> a.rs:1\n\n\x1b[1m\x1b[91merror\x1b[0m: no\n --> b.rs:2\n\nerror[E0308]: types\n";
        let (first, count) = first(text);
        assert_eq!(plain(&first), "error: no\n --> b.rs:2\n\n");
        assert_eq!(count, 2);
        assert_eq!(first_in_a_line(text).as_deref(), Some("b.rs:2: error: no"));
        assert_eq!(first_file(text).as_deref(), Some("b.rs"));
        assert_eq!(first_in_a_line("error: no place"), None);
    }
}
