//! What the student's code prints, case by case.

use std::collections::VecDeque;
use std::fmt::Write;
use std::io::{BufRead, BufReader, Read};
use wire::Case;
use wire::case_of_marker;

/// How many of the first lines of a case are kept.
const FIRST_LINES: usize = 12;

/// How many of the last lines of a case are kept.
const LAST_LINES: usize = 8;

/// The largest part of a line that is kept.
const LINE_BYTES: usize = 400;

/// How much of the output of a worker is read: a line of a kilobyte for each of four million calls.
/// Afterwards the worker's pipe is closed: what it prints then is lost, and `println!` panics. The
/// book's chapter about grading names the limit.
pub(crate) const MOST_BYTES: u64 = 4 << 30;

/// What the code printed to stdout and stderr in one case: whole lines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Printed {
    /// Key of the task.
    pub task: String,
    /// Name of the case.
    pub case: String,
    /// The first lines.
    pub first: Vec<String>,
    /// The number of lines between the first and the last ones, which are not kept.
    pub left_out: usize,
    /// The last lines, if there are more than the first ones.
    pub last: VecDeque<String>,
}

impl Printed {
    /// The number of lines that were printed.
    pub fn lines(&self) -> usize {
        self.first.len() + self.left_out + self.last.len()
    }

    fn add(&mut self, line: String) {
        if self.first.len() < FIRST_LINES {
            self.first.push(line);
            return;
        }
        self.last.push_back(line);
        if self.last.len() > LAST_LINES {
            self.last.pop_front();
            self.left_out += 1;
        }
    }

    /// Removes the last lines as long as `is_unwanted`.
    fn trim(&mut self, is_unwanted: impl Fn(&str) -> bool) {
        while self.last.back().is_some_and(|line| is_unwanted(line)) {
            self.last.pop_back();
        }
        while self.last.is_empty()
            && self.left_out == 0
            && self.first.last().is_some_and(|line| is_unwanted(line))
        {
            self.first.pop();
        }
    }
}

/// The output of one worker.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WorkerOutput {
    /// What the cases printed; only those that printed something.
    pub cases: Vec<Printed>,
    /// The last lines of the worker, with the messages of the Rust runtime about its end.
    pub end: String,
}

/// Reads the output of a worker that runs `cases`, to its end, so that the worker never waits.
pub fn read(pipe: impl Read, cases: &[Case]) -> WorkerOutput {
    let mut input = BufReader::with_capacity(1 << 16, pipe.take(MOST_BYTES));
    let mut output = WorkerOutput::default();
    let mut current = Printed::default();
    // The lines before a case: nothing is printed there but messages of the runtime.
    let mut number = None;
    // A marker begins with an empty line, which ends a line that the code began.
    let mut empty_before = false;
    while let Some(line) = read_line(&mut input) {
        // The code can print markers, too, but cases run in their order: so there is one for each
        // case at most, however much is printed.
        let marked = case_of_marker(&line);
        if let Some(case) = marked.filter(|case| number.is_none_or(|before| before < *case)) {
            output.end(&mut current, number, cases);
            (number, empty_before) = (Some(case), false);
            continue;
        }
        if std::mem::take(&mut empty_before) {
            current.add(String::new());
        }
        match line.is_empty() {
            true => empty_before = true,
            false => current.add(line),
        }
    }
    let lines = current.first.iter().chain(&current.last);
    output.end = lines.fold(String::new(), |text, line| text + line + "\n");
    current.trim(is_of_runtime);
    output.end(&mut current, number, cases);
    output
}

impl WorkerOutput {
    /// Adds what case `number` has printed, if it is anything, and leaves `printed` empty.
    fn end(&mut self, printed: &mut Printed, number: Option<u32>, cases: &[Case]) {
        let printed = std::mem::take(printed);
        let case = number.and_then(|number| cases.get(number as usize));
        if let Some(case) = case.filter(|_| printed.lines() > 0) {
            self.cases.push(Printed {
                task: case.task.clone(),
                case: case.name.clone(),
                ..printed
            });
        }
    }
}

/// Reads a line without its end; of a long one, only the first bytes. `None` at the end.
fn read_line(input: &mut BufReader<impl Read>) -> Option<String> {
    let mut bytes = Vec::new();
    let mut part = input.by_ref().take(LINE_BYTES as u64);
    let length = part.read_until(b'\n', &mut bytes).unwrap_or(0);
    if length == 0 {
        return None;
    }
    let is_cut = length == LINE_BYTES && bytes.last() != Some(&b'\n');
    if is_cut {
        let _ = input.skip_until(b'\n');
    }
    let mut line = String::from_utf8_lossy(&bytes)
        .trim_end_matches(['\n', '\r'])
        .to_string();
    if is_cut {
        line.push('…');
    }
    Some(line)
}

/// Whether the Rust runtime prints this line when it ends a program.
fn is_of_runtime(line: &str) -> bool {
    line.is_empty()
        || line.starts_with("thread 'student' (") && line.contains("has overflowed its stack")
        || line.starts_with("fatal runtime error: ")
        || line.starts_with("memory allocation of ") && line.contains(" bytes failed")
        || line.starts_with("thread caused non-unwinding panic")
        || line.starts_with("thread panicked while processing panic")
        || line.starts_with("note: run with `RUST_BACKTRACE")
}

/// How much text [`format`] makes at most, in bytes, and what one case more has: a report has all
/// of it.
const MOST_OF_TEXT: usize = 512 << 10;

/// Formats what the code printed, case by case.
pub fn format(printed: &[Printed]) -> String {
    let mut text = String::new();
    for (case, before) in printed.iter().zip(0..) {
        if text.len() > MOST_OF_TEXT {
            let more = printed.len() - before;
            let _ = writeln!(text, "(What {more} more cases printed is left out.)");
            break;
        }
        let _ = writeln!(text, "{} {} printed:", case.task, case.case);
        let line = |text: &mut String, line: &String| {
            let _ = writeln!(text, "    {line}");
        };
        case.first.iter().for_each(|first| line(&mut text, first));
        if case.left_out > 0 {
            let lines = if case.left_out == 1 { "line" } else { "lines" };
            let _ = writeln!(
                text,
                "    … {} more {lines}",
                with_commas(case.left_out as u64)
            );
        }
        case.last.iter().for_each(|last| line(&mut text, last));
    }
    text
}

/// A sentence about how much was printed; `None` if nothing was.
pub fn summary(printed: &[Printed]) -> Option<String> {
    let lines: usize = printed.iter().map(Printed::lines).sum();
    let plural = |count: usize, one: &str| match count {
        1 => format!("1 {one}"),
        _ => format!("{} {one}s", with_commas(count as u64)),
    };
    (lines > 0).then(|| {
        format!(
            "your code printed {} in {}",
            plural(lines, "line"),
            plural(printed.len(), "case")
        )
    })
}

/// A number with commas between its thousands.
pub fn with_commas(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::{Work, output_marker};

    fn read_text(text: &str) -> WorkerOutput {
        let case = |name: &str| Case {
            task: "part1.task1".into(),
            name: name.into(),
            limit_ms: 1,
            work: Work::Stop(Vec::new()),
            order: Vec::new(),
        };
        read(text.as_bytes(), &["a", "b", "c"].map(case))
    }

    fn printed(case: &str, first: &[&str]) -> Printed {
        Printed {
            task: "part1.task1".into(),
            case: case.into(),
            first: first.iter().map(|line| line.to_string()).collect(),
            ..Printed::default()
        }
    }

    #[test]
    fn lines_belong_to_their_cases() {
        let [a, b, c] = [0, 1, 2].map(output_marker);
        let text = format!("{a}one\n\ntwo\n{b}{c}no end");
        let output = read_text(&text);
        let right = [printed("a", &["one", "", "two"]), printed("c", &["no end"])];
        assert_eq!(output.cases, right);
        assert_eq!(
            format(&output.cases[1..]),
            "part1.task1 c printed:\n    no end\n"
        );
        let all = summary(&output.cases);
        assert_eq!(all.as_deref(), Some("your code printed 4 lines in 2 cases"));
        assert_eq!(summary(&[]), None);
    }

    #[test]
    fn an_unfinished_line_ends_before_the_next_case() {
        let [a, b] = [0, 1].map(output_marker);
        let output = read_text(&format!("{a}begun{b}next\n"));
        assert_eq!(
            output.cases,
            [printed("a", &["begun"]), printed("b", &["next"])]
        );
    }

    #[test]
    fn of_many_lines_the_first_and_the_last_are_kept() {
        let lines: String = (0..2000).map(|i| format!("line {i}\n")).collect();
        let output = read_text(&(output_marker(0) + &lines));
        let [case] = &output.cases[..] else {
            panic!("{output:?}")
        };
        assert_eq!(case.lines(), 2000);
        let text = format(&output.cases);
        let shown: Vec<&str> = text.lines().skip(12).take(3).collect();
        assert_eq!(
            shown,
            ["    line 11", "    … 1,980 more lines", "    line 1992"]
        );
    }

    #[test]
    fn printed_markers_cost_no_memory() {
        let marker = output_marker(0) + "x\n";
        let output = read_text(&marker.repeat(10_000));
        let [case] = &output.cases[..] else {
            panic!("{} cases", output.cases.len())
        };
        assert!(case.lines() > 10_000);
        let numbers = [2, 0, 7, 1].map(|case| output_marker(case) + "x\n");
        assert_eq!(read_text(&numbers.concat()).cases[0].case, "c");
    }

    #[test]
    fn the_output_of_very_many_cases_is_left_out() {
        let line = "x".repeat(LINE_BYTES);
        let case = printed("a", &[line.as_str(); FIRST_LINES]);
        let text = format(&vec![case; 1000]);
        assert!(text.len() < 2 * MOST_OF_TEXT);
        assert!(text.ends_with("more cases printed is left out.)\n"));
    }

    #[test]
    fn a_long_line_is_cut_and_the_next_case_is_still_found() {
        let [a, b] = [0, 1].map(output_marker);
        let long = "x".repeat(100_000);
        let output = read_text(&format!("{a}{long}{b}next\n"));
        assert_eq!(output.cases[0].first[0].chars().count(), LINE_BYTES + 1);
        assert_eq!(output.cases[1], printed("b", &["next"]));
    }

    #[test]
    fn messages_of_the_runtime_are_not_the_students() {
        let text = output_marker(1)
            + "mine\n\nthread 'student' (77) has overflowed its stack\nfatal runtime error: stack overflow, aborting\n";
        let output = read_text(&text);
        assert_eq!(output.cases, [printed("b", &["mine"])]);
        assert!(output.end.contains("has overflowed its stack"));
    }
}
