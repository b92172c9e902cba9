//! The list of what the oracle does not judge in the goldens of a task, `not_judged.txt`.

/// The list after the cases `judged` have new lines: names and lines. `order` has the names of all
/// cases of the task; the lines of other cases are kept.
pub(super) fn updated(stored: &str, order: &[&str], judged: &[(&str, String)]) -> String {
    let lines = |name: &str| match judged.iter().find(|(judged, _)| *judged == name) {
        Some((_, lines)) => lines.clone(),
        None => about(stored, name)
            .map(|sentence| format!("{name}: {sentence}\n"))
            .collect(),
    };
    order.iter().map(|name| lines(name)).collect()
}

/// The sentences about a case.
pub(super) fn about<'a>(list: &'a str, case: &str) -> impl Iterator<Item = &'a str> {
    list.lines().filter_map(move |line| {
        let (name, sentence) = line.split_once(": ")?;
        (name == case).then_some(sentence)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_lines_of_the_judged_cases_change() {
        let stored = "a: normal: cancels\nab: t: wide\nab: work: none\nc: uv: none\n";
        let order = ["a", "ab", "b", "c"];
        assert_eq!(updated(stored, &order, &[]), stored);
        let judged = [("ab", String::new()), ("b", "b: t: new\n".to_string())];
        let new = "a: normal: cancels\nb: t: new\nc: uv: none\n";
        assert_eq!(updated(stored, &order, &judged), new);
    }
}
