//! Makes the tables of right results that handouts have in place of formulas.

use crate::face::{cases, pictures};
use crate::tools::packed_truth::{self, Tables};
use std::collections::HashSet;
use std::sync::OnceLock;

/// The right results of all formulas for the questions of seed 0: those of the cases, the simple
/// ones of their kinds of work, those of the pictures.
pub fn of_seed_0() -> &'static Tables {
    static TABLES: OnceLock<Tables> = OnceLock::new();
    TABLES.get_or_init(|| {
        packed_truth::recorded(|| {
            let (mut kinds, mut tasks) = (HashSet::new(), HashSet::new());
            for spec in cases::all(0) {
                spec.check.look_up_truth(&spec.work);
                // The simple questions of a kind of work with a formula are the same for all cases.
                if kinds.insert((spec.task, spec.work.kind())) {
                    for simple in spec.simple() {
                        simple.check.look_up_truth(&simple.work);
                    }
                }
                // The views of pictures are results, too.
                if tasks.insert(spec.task) {
                    pictures::of(spec.task);
                }
            }
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_task_with_a_formula_has_a_table() {
        let tables = of_seed_0();
        let tasks: Vec<&str> = tables.keys().copied().collect();
        let expected = [
            "part1.task2",
            "part2.task1",
            "part3.task1",
            "part4.task1",
            "part4.task2",
            "part4.task3",
            "part5.task1",
            "part5.task2",
        ];
        assert_eq!(tasks, expected);
        let packed: Vec<(&str, usize)> = tables
            .iter()
            .map(|(task, table)| (*task, packed_truth::pack([table]).len()))
            .collect();
        for (task, bytes) in packed {
            println!("{task}: {bytes} bytes");
            assert!(bytes < 600_000, "{task}: {bytes} bytes");
        }
    }
}
