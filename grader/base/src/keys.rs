//! Single keys of the terminal, without Enter; what the terminal says of itself.
//!
//! A terminal collects a line before a program can read it, and shows what is typed. [`SingleKeys`]
//! turns both off while it lives. Ctrl-C still ends the program, and puts the terminal back as it
//! was.

use std::sync::LazyLock;

/// The terminal passes on each key at once. Dropping this puts it back as it was.
#[derive(Debug)]
pub struct SingleKeys(());

impl SingleKeys {
    /// Changes the terminal of stdin; `None` if stdin is no terminal, or the system has no such
    /// mode.
    pub fn start() -> Option<SingleKeys> {
        terminal::start().then_some(SingleKeys(()))
    }
}

impl Drop for SingleKeys {
    fn drop(&mut self) {
        terminal::restore();
    }
}

/// What the terminal of stdin and stdout says that it can: the numbers of its primary device
/// attributes (DA1). None, if there is no terminal, it does not answer in a moment, or somebody
/// types already, whose keys would be read with the answer.
pub fn device_attributes() -> &'static [u32] {
    /// Asked once in each run: a terminal that does not answer makes the program wait.
    static ATTRIBUTES: LazyLock<Vec<u32>> = LazyLock::new(|| {
        let raw = SingleKeys::start();
        let answer =
            raw.map(|_raw| terminal::answer_to("\x1b[c", |text| numbers_in(text).is_some()));
        let numbers = answer.as_deref().and_then(numbers_in);
        numbers
            .into_iter()
            .flat_map(|text| text.split(';'))
            .filter_map(|text| text.parse().ok())
            .collect()
    });
    &ATTRIBUTES
}

/// The numbers of a whole answer such as `\x1b[?62;4;22c`.
fn numbers_in(answer: &str) -> Option<&str> {
    let start = answer.rfind("\x1b[?")? + 3;
    answer[start..].strip_suffix('c')
}

/// Puts the terminal back as it was before [`SingleKeys::start`].
pub(crate) fn restore_terminal() {
    terminal::restore();
}

#[cfg(unix)]
mod terminal {
    use rustix::io::ioctl_fionread;
    use rustix::termios::{
        LocalModes, OptionalActions, SpecialCodeIndex, Termios, isatty, tcgetattr, tcsetattr,
    };
    use std::io::Write;
    use std::sync::Mutex;

    /// How long a terminal may take to begin an answer, in tenths of a second.
    const PATIENCE: u8 = 3;

    /// The longest answer in bytes.
    const LONGEST: usize = 128;

    /// The terminal as it was.
    static BEFORE: Mutex<Option<Termios>> = Mutex::new(None);

    pub(super) fn start() -> bool {
        let stdin = std::io::stdin();
        let (true, Ok(before), Ok(mut kept)) = (isatty(&stdin), tcgetattr(&stdin), BEFORE.lock())
        else {
            return false;
        };
        let mut single = before.clone();
        single.local_modes -= LocalModes::ICANON | LocalModes::ECHO;
        let is_set = tcsetattr(&stdin, OptionalActions::Now, &single).is_ok();
        if is_set {
            *kept = Some(before);
        }
        is_set
    }

    /// What the terminal answers to `question`, until it `is_whole`. [`start`] was called.
    pub(super) fn answer_to(question: &str, is_whole: impl Fn(&str) -> bool) -> String {
        let stdin = std::io::stdin();
        let mut answer = String::new();
        let is_idle = ioctl_fionread(&stdin) == Ok(0);
        if let (true, Ok(mut waiting)) = (is_idle, tcgetattr(&stdin)) {
            waiting.special_codes[SpecialCodeIndex::VMIN] = 0;
            waiting.special_codes[SpecialCodeIndex::VTIME] = PATIENCE;
            let is_set = tcsetattr(&stdin, OptionalActions::Now, &waiting).is_ok();
            let mut stdout = std::io::stdout();
            let is_asked = stdout.write_all(question.as_bytes()).and(stdout.flush());
            let mut byte = [0];
            // Not through the buffer of stdin, which would keep what is typed behind the answer.
            while is_set
                && is_asked.is_ok()
                && answer.len() < LONGEST
                && !is_whole(&answer)
                && rustix::io::read(&stdin, &mut byte) == Ok(1)
            {
                answer.push(char::from(byte[0]));
            }
        }
        answer
    }

    pub(super) fn restore() {
        if let Ok(Some(before)) = BEFORE.lock().map(|mut kept| kept.take()) {
            let _ = tcsetattr(std::io::stdin(), OptionalActions::Now, &before);
        }
    }
}

#[cfg(not(unix))]
mod terminal {
    pub(super) fn start() -> bool {
        false
    }

    pub(super) fn answer_to(_: &str, _: impl Fn(&str) -> bool) -> String {
        String::new()
    }

    pub(super) fn restore() {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_answer_of_a_terminal_is_known_when_it_is_whole() {
        assert_eq!(numbers_in("\x1b[?62;4;22c"), Some("62;4;22"));
        // A key was pressed before the terminal answered.
        assert_eq!(numbers_in("c\x1b[?1;2c"), Some("1;2"));
        for other in ["", "c", "\x1b[?62;4", "62;4c"] {
            assert_eq!(numbers_in(other), None, "{other:?}");
        }
    }
}
