//! Quotes paths for a shell, in commands that programs print.

use std::path::Path;

/// `path` as a POSIX shell reads it in a command: `'my course'`.
pub fn shell_word(path: impl AsRef<Path>) -> String {
    let word = path.as_ref().to_string_lossy();
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "/._-+:@%,=".contains(c);
    match !word.is_empty() && word.chars().all(is_plain) {
        true => word.into_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_shell_reads_the_word_back() {
        for word in ["plain/path.x", "a b", "it's", "$HOME;`x`", "", "ä"] {
            let line = format!("printf %s {}", shell_word(word));
            let mut shell = std::process::Command::new("sh");
            let output = shell.args(["-c", &line]).output().unwrap();
            assert_eq!(String::from_utf8(output.stdout).unwrap(), word);
        }
    }
}
