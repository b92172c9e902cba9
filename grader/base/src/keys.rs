//! Single keys of the terminal, without Enter.
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

/// Puts the terminal back as it was before [`SingleKeys::start`].
pub(crate) fn restore_terminal() {
    terminal::restore();
}

#[cfg(unix)]
mod terminal {
    use rustix::termios::{LocalModes, OptionalActions, Termios, isatty, tcgetattr, tcsetattr};
    use std::sync::Mutex;

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

    pub(super) fn restore() {}
}
