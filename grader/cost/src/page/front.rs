//! The Pareto front of the kernels: accuracy against time, as far as the errors of the times allow.

use crate::report::{KernelRow, whole_bits};

/// Returns the correct bits of `t` that kernels are compared by.
pub(super) fn bits(row: &KernelRow) -> u32 {
    whole_bits(row.mean_correct_bits())
}

/// Whether there is a reason to choose `a` instead of `b`: it is as accurate and certainly faster,
/// or more accurate and not certainly slower. Times are certain if their error bars do not overlap.
pub(super) fn beats(a: &KernelRow, b: &KernelRow) -> bool {
    let (a_time, b_time) = (a.ranked_time(), b.ranked_time());
    if bits(a) > bits(b) {
        !b_time.is_faster_than(a_time)
    } else {
        bits(a) == bits(b) && a_time.is_faster_than(b_time)
    }
}

/// Returns the kernels that no other one beats, from the fastest and least accurate on. Kernels of
/// one step have the same bits and tie in time; steps differ in time by more than the errors.
pub(super) fn front(rows: &[KernelRow]) -> Vec<Vec<&KernelRow>> {
    let is_beaten = |row: &KernelRow| rows.iter().any(|other| beats(other, row));
    let mut unbeaten: Vec<&KernelRow> = rows.iter().filter(|row| !is_beaten(row)).collect();
    let time = |row: &KernelRow| row.ranked_time().ratio.median;
    unbeaten.sort_by(|a, b| {
        let by_bits = bits(a).cmp(&bits(b));
        by_bits.then(time(a).total_cmp(&time(b)))
    });
    let steps = unbeaten.chunk_by(|a, b| bits(a) == bits(b));
    steps.map(<[&KernelRow]>::to_vec).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quartiles::Quartiles;
    use crate::report::{Accuracy, Errors, Precision, Quantiles, RayFamily};
    use crate::timing::Timing;

    /// A kernel with `bits` correct bits that takes `ratio ± error` times the textbook's time.
    fn row(name: &str, bits: i32, ratio: f64, error: f64) -> KernelRow {
        let half = Quantiles {
            p50: 2.0_f64.powi(-bits),
            ..Quantiles::default()
        };
        let ratio = Quartiles {
            lower: ratio - error,
            median: ratio,
            upper: ratio + error,
        };
        KernelRow {
            name: name.into(),
            precision: Precision::F64,
            paper: String::new(),
            student: false,
            textbook: false,
            uses_fma: false,
            time: Timing { ns: ratio, ratio },
            time_with_fma: None,
            operations: None,
            leaks_per_million: None,
            grid: None,
            by_ray_family: vec![Accuracy {
                family: RayFamily::Ordinary,
                rays: 1,
                false_hits_per_million: 0.0,
                false_misses_per_million: 0.0,
                undecidable_per_million: 0.0,
                undecidable_differing_per_million: 0.0,
                beyond_bound_per_million: 0.0,
                t: Some(Errors {
                    ulp: half,
                    relative: half,
                }),
                position: None,
                off_surface: None,
                cdf: Vec::new(),
                forward_bound: Vec::new(),
            }],
        }
    }

    fn names(rows: &[KernelRow]) -> Vec<Vec<&str>> {
        let steps = front(rows).into_iter();
        steps
            .map(|step| step.iter().map(|row| row.name.as_str()).collect())
            .collect()
    }

    #[test]
    fn slower_and_less_accurate_kernels_are_not_on_the_front() {
        let mut rows = vec![
            row("fast", 20, 0.5, 0.01),
            row("textbook", 40, 1.0, 0.01),
            row("bad", 30, 1.2, 0.01),
            row("exact", 53, 2.0, 0.01),
        ];
        let expected: [&[&str]; 3] = [&["fast"], &["textbook"], &["exact"]];
        assert_eq!(names(&rows), expected);
        // A very slow and bad kernel changes nothing.
        rows.push(row("slow", 10, 50.0, 20.0));
        assert_eq!(names(&rows), expected);
    }

    #[test]
    fn the_front_does_not_follow_noise() {
        // Three runs measured 0.70, 0.92 and 1.00 of the textbook's time: within the error it is
        // not faster, and less accurate.
        for measured in [0.7, 0.92, 1.0] {
            let rows = [
                row("textbook", 46, 1.0, 0.02),
                row("Baldwin-Weber", 40, measured, 0.3),
            ];
            assert_eq!(names(&rows), [["textbook"]]);
        }
        // With the same bits they tie, whichever was faster in this run.
        for measured in [0.9, 1.1] {
            let rows = [row("a", 46, 1.0, 0.1), row("b", 46, measured, 0.1)];
            assert_eq!(front(&rows).len(), 1);
            assert_eq!(front(&rows)[0].len(), 2);
        }
    }

    #[test]
    fn kernels_with_fma_are_ranked_with_fma_instructions() {
        let mut fused = row("fused", 50, 2.2, 0.05);
        fused.uses_fma = true;
        fused.time_with_fma = Some(row("", 50, 1.1, 0.05).time);
        let rows = [fused, row("plain", 50, 1.5, 0.05)];
        assert_eq!(names(&rows), [["fused"]]);
    }
}
