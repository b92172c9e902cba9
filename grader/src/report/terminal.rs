//! What the terminal of a report allows: its width, and colours.

use crate::score::{Status, TaskResult};
use clap::builder::styling::{AnsiColor, Style};
use std::ffi::OsStr;
use std::io::IsTerminal;

/// The size of a page of the report, and whether it has colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Page {
    /// Columns.
    pub width: usize,
    /// Lines. One more is left for the prompt.
    pub height: usize,
    /// Whether to print colours.
    pub colours: bool,
}

/// Lines of the smallest terminal, without one for the prompt.
const HEIGHT: usize = 23;

/// Columns if the terminal does not say how many it has.
const WIDTH: usize = 80;

/// Wider text is hard to read.
const WIDEST: usize = 100;

/// Narrower text is hard to read as well: the terminal may wrap it.
const NARROWEST: usize = 40;

impl Page {
    /// The page of stdout. Its width is that of the variable `COLUMNS`, or 80.
    pub fn of_stdout() -> Page {
        let columns = std::env::var("COLUMNS").ok();
        Page {
            width: width(columns.as_deref()),
            height: HEIGHT,
            colours: stdout_has_colours(),
        }
    }
}

impl Default for Page {
    /// 23 lines of 80 columns without colours.
    fn default() -> Page {
        Page {
            width: WIDTH,
            height: HEIGHT,
            colours: false,
        }
    }
}

/// Whether to print colours to stdout: to a terminal, unless `NO_COLOR` is set; to anything if
/// `CLICOLOR_FORCE` is set and not `0`.
pub fn stdout_has_colours() -> bool {
    has_colours(
        std::env::var_os("NO_COLOR").as_deref(),
        std::env::var_os("CLICOLOR_FORCE").as_deref(),
        std::io::stdout().is_terminal(),
    )
}

fn has_colours(no_color: Option<&OsStr>, force: Option<&OsStr>, is_terminal: bool) -> bool {
    let is_set = |value: Option<&OsStr>| value.is_some_and(|value| !value.is_empty());
    !is_set(no_color) && (is_terminal || is_set(force) && force != Some(OsStr::new("0")))
}

fn width(columns: Option<&str>) -> usize {
    let columns = columns.and_then(|columns| columns.trim().parse().ok());
    columns.map_or(WIDTH, |columns: usize| columns.clamp(NARROWEST, WIDEST))
}

/// The colour of a task: green if complete, red if not, grey if not attempted.
pub(super) fn style_of(task: &TaskResult) -> Style {
    let colour = match task.status {
        Status::NotAttempted | Status::Needs(_) => AnsiColor::BrightBlack,
        _ if task.is_complete() => AnsiColor::Green,
        _ => AnsiColor::Red,
    };
    colour.on_default()
}

/// The colour of success.
pub const GREEN: Style = AnsiColor::Green.on_default();

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_for_terminals_that_want_them() {
        let [on, zero, empty] = ["1", "0", ""].map(|value| Some(OsStr::new(value)));
        assert!(has_colours(None, None, true));
        assert!(has_colours(empty, None, true));
        assert!(!has_colours(on, on, true));
        assert!(!has_colours(None, None, false));
        assert!(has_colours(None, on, false));
        assert!(!has_colours(None, zero, false));
    }

    #[test]
    fn the_width_is_80_unless_the_terminal_says_another() {
        assert_eq!(width(None), 80);
        assert_eq!(width(Some("many")), 80);
        assert_eq!(width(Some("90")), 90);
        assert_eq!(width(Some("3")), NARROWEST);
        assert_eq!(width(Some("300")), WIDEST);
    }
}
