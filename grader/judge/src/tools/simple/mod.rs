//! Simple questions: small inputs that can be worked on paper.
//!
//! After a failed case the grader asks the student's code the simple questions of the same kind of
//! work, and shows the first one that it answers wrongly in the same way. So their order is the
//! order in which a person would try them: few numbers that are not 0, then small ones. Every
//! textbook formula answers them rightly: no ray meets an edge, a tangent or an end of its range,
//! but in the questions at the end of a list, which are about those conventions and in which
//! nothing rounds.
//!
//! Each kind of work has its own questions, in `simple.rs` of its task.

pub(crate) mod numbers;
pub(crate) mod rays;
pub mod variations;

/// How hard it is to work with `numbers` by hand. 0 and an infinite end of a range cost nothing,
/// small integers little.
pub(crate) fn complexity(numbers: impl IntoIterator<Item = f64>) -> u32 {
    numbers.into_iter().map(of_number).sum()
}

fn of_number(x: f64) -> u32 {
    let size = match x.abs() {
        0.0 | f64::INFINITY => return 0,
        1.0 => 2,
        2.0 | 0.5 => 4,
        size if size.fract() == 0.0 && size < 10.0 => 5,
        size if (2.0 * size).fract() == 0.0 && size < 10.0 => 7,
        _ => 12,
    };
    size + u32::from(x < 0.0)
}

/// Sorts `questions` from the simplest to the hardest; equally simple ones stay in their order.
pub(crate) fn sorted<T>(mut questions: Vec<T>, complexity: impl Fn(&T) -> u32) -> Vec<T> {
    questions.sort_by_cached_key(complexity);
    questions
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_integers_are_simpler_than_large_ones_and_fractions() {
        let costs = [0.0, 1.0, -1.0, 2.0, -2.0, 3.0, 1.5, 0.3].map(of_number);
        assert!(costs.is_sorted(), "{costs:?}");
        assert_eq!(complexity([0.0, f64::INFINITY]), 0);
    }
}
