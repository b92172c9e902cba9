//! Snapshots of answers: the goldens.

use crate::tasks::check_of;
use crate::tools::snapshot;
use wire::{Answer, Work};

pub use crate::tools::snapshot::{
    ALL_ROWS, Changes, FULL_ROWS, Fields, Line, ParseError, RowsHash, Snapshot, Value, changes,
    parse, record,
};

/// The text of the snapshot of `answer` to `work`; `None` for answers that differ between runs
/// (measured times).
pub fn write(work: &Work, answer: &Answer) -> Option<String> {
    check_of(work).lines(work, answer).map(snapshot::write)
}

/// The snapshot of `answer` to `work` with a row for every call, each with its question and the
/// whole record.
pub fn full(work: &Work, answer: &Answer) -> Option<Snapshot> {
    check_of(work).lines(work, answer).map(snapshot::full)
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::work::{BoxWork, Probe, Ray};

    fn boxes(calls: usize) -> (Work, Vec<Option<[f64; 2]>>) {
        let ray = Ray {
            o: [0.0; 3],
            d: [0.0, 0.0, 1.0],
            min_t: 0.0,
            max_t: f64::INFINITY,
        };
        let work = Work::Boxes(BoxWork {
            boxes: vec![[[0.0; 3], [1.0; 3]]],
            probes: vec![Probe { shape: 0, ray }; calls],
        });
        let answers = (0..calls).map(|call| (call % 3 > 0).then_some([call as f64, 1e9]));
        (work, answers.collect())
    }

    #[test]
    fn a_large_case_has_a_sample_of_its_rows() {
        for (calls, rows) in [(640, 640), (641, 129), (19_200, 198)] {
            let (work, answers) = boxes(calls);
            let snapshot = parse(&write(&work, &Answer::Boxes(answers)).unwrap()).unwrap();
            assert_eq!((snapshot.calls, snapshot.lines.len()), (calls, rows));
            let full = snapshot.lines.iter().filter(|row| !row.question.is_empty());
            assert!((30..=FULL_ROWS).contains(&full.count()));
        }
    }

    #[test]
    fn every_bit_of_every_answer_is_in_the_hash() {
        let (work, answers) = boxes(3000);
        let snapshot = |answers: &Vec<_>| {
            parse(&write(&work, &Answer::Boxes(answers.clone())).unwrap()).unwrap()
        };
        let golden = snapshot(&answers);
        for call in [1, 1000, 2999] {
            let mut other = answers.clone();
            other[call] = match other[call] {
                Some([from, to]) => Some([from, to.next_up()]),
                None => Some([0.0, 0.0]),
            };
            assert!(changes(&golden, &snapshot(&other)).hash, "call {call}");
        }
    }

    #[test]
    fn full_has_the_hash_that_is_written() {
        let (work, answers) = boxes(700);
        let answer = Answer::Boxes(answers);
        let full = full(&work, &answer).unwrap();
        let written = parse(&write(&work, &answer).unwrap()).unwrap();
        assert!(full.is_whole());
        assert_eq!((full.calls, full.hash), (written.calls, written.hash));
    }
}
