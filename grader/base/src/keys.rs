//! Single keys of the terminal, without Enter; what the terminal says of itself.
//!
//! A terminal collects a line before a program can read it, and shows what is typed. [`SingleKeys`]
//! turns both off while it lives. Ctrl-C still ends the program, and puts the terminal back as it
//! was.

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
/// attributes (DA1). None, if there is no terminal or it does not answer in a moment.
pub fn device_attributes() -> Vec<u32> {
    let Some(_raw) = SingleKeys::start() else {
        return Vec::new();
    };
    attributes_in(&terminal::answer_to("\x1b[c", b'c'))
}

/// The numbers of an answer such as `\x1b[?62;4;22c`.
fn attributes_in(answer: &str) -> Vec<u32> {
    let start = answer.rfind("\x1b[?").map(|start| &answer[start + 3..]);
    let numbers = start.and_then(|rest| rest.strip_suffix('c'));
    let numbers = numbers.into_iter().flat_map(|numbers| numbers.split(';'));
    numbers.filter_map(|number| number.parse().ok()).collect()
}

/// Puts the terminal back as it was before [`SingleKeys::start`].
pub(crate) fn restore_terminal() {
    terminal::restore();
}

#[cfg(unix)]
mod terminal {
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

    /// What the terminal answers to `question`, up to the byte `end`. [`start`] was called.
    pub(super) fn answer_to(question: &str, end: u8) -> String {
        let stdin = std::io::stdin();
        let mut answer = Vec::new();
        if let Ok(mut waiting) = tcgetattr(&stdin) {
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
                && answer.last() != Some(&end)
                && rustix::io::read(&stdin, &mut byte) == Ok(1)
            {
                answer.push(byte[0]);
            }
        }
        String::from_utf8_lossy(&answer).into_owned()
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

    pub(super) fn answer_to(_: &str, _: u8) -> String {
        String::new()
    }

    pub(super) fn restore() {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_attributes_of_a_terminal_are_numbers() {
        assert_eq!(attributes_in("\x1b[?62;4;22c"), [62, 4, 22]);
        // A key was pressed before the terminal answered.
        assert_eq!(attributes_in("x\x1b[?1;2c"), [1, 2]);
        for other in ["", "\x1b[?62;4", "62;4c", "\x1b[?c"] {
            assert_eq!(attributes_in(other), [0; 0], "{other:?}");
        }
    }
}
