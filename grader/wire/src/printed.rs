//! Marks in a worker's output, which say which case prints what follows.

/// The first character of a marker.
const MARK: char = '\0';

/// The marker before the output of case number `case`: a line of its own, after the end of whatever
/// line was begun before.
pub fn output_marker(case: u32) -> String {
    format!("\n{MARK}case {case}\n")
}

/// The case of a line of output that is the second line of a marker.
pub fn case_of_marker(line: &str) -> Option<u32> {
    let case = line.strip_prefix(MARK)?.strip_prefix("case ")?;
    case.trim_end().parse().ok()
}
