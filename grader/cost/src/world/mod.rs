//! What real ray casters answer: hard cases with exact truth, the stored rows of libraries, and the
//! student's own row.
//!
//! `grader cost world` runs the rays of the stored rows through the student's stages.
//! `grader/world/run` installs the libraries, has their adapters answer the cases as files
//! ([`write_cases`]), and stores what [`judge()`] makes of their answers in `libraries.tsv`.
//!
//! Read [`Column`] (the cases) with `shape` (their meshes), `truth` and `outcome` (how an answer is
//! judged), [`row`] (the table), then `libraries`, `table` and [`plot`].

mod case;
mod column;
mod libraries;
mod outcome;
pub mod plot;
mod random;
pub mod row;
mod shape;
pub(crate) mod table;
mod truth;

pub use case::{Answers, Case, RayAnswer};
pub use column::{COLUMNS, Column, Measure};
pub use libraries::{judge, stored, write_cases};
pub(crate) use random::Random;
pub use row::{Cell, Row};
pub(crate) use shape::terrain;
pub(crate) use truth::may_contain;

use crate::precision::Precision;
use crate::timing::{Measured, or_missing};
use base::GraderError;
use outcome::value;
use serde::{Deserialize, Serialize};

/// The seed of the rays of all rows.
pub const SEED: u64 = 7;

/// The student's row beside the stored rows of the libraries.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldReport {
    /// The student's row.
    pub yours: Option<Row>,
    /// Why there is no such row, if there is none.
    pub missing: Option<String>,
    /// The libraries, the first with the fewest wrong answers in their worst case.
    pub libraries: Vec<Row>,
}

/// What the student's code answers to the rays of a case, or why it has no answers.
pub(crate) type Traced = Measured<Vec<Option<f64>>>;

/// Has `trace` answer the first `rays` rays of each case.
pub(crate) fn measure(
    rays: usize,
    trace: &mut dyn FnMut(&Case) -> Traced,
) -> Result<WorldReport, GraderError> {
    let mut libraries = stored()?;
    let worst = |row: &Row| row.worst().unwrap_or(f64::INFINITY);
    libraries.sort_by(|a, b| worst(a).total_cmp(&worst(b)));
    let mut cells = Vec::new();
    for column in &COLUMNS {
        let case = column.case(SEED, rays);
        cells.push(match or_missing(trace(&case))? {
            Ok(hits) => {
                let rays = hits.into_iter().map(RayAnswer::closest).collect();
                let answers = Answers { seconds: 0.0, rays };
                let truth = truth::answers(&case);
                value(&truth, &answers, column.measure, Precision::F64)
                    .map_or(Cell::None, Cell::Value)
            }
            Err(missing) if cells.is_empty() => {
                return Ok(WorldReport {
                    yours: None,
                    missing: Some(missing),
                    libraries,
                });
            }
            Err(error) => Cell::Error(error),
        });
    }
    let yours = Row {
        name: "yours".into(),
        library: "your stages".into(),
        version: base::VERSION.into(),
        interface: "construct_bvh, intersect_bvh".into(),
        precision: Precision::F64,
        rays,
        million_rays: None,
        cells,
    };
    Ok(WorldReport {
        yours: Some(yours),
        missing: None,
        libraries,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::timing::missing as not_measured;
    use kernels::brute_force;

    #[test]
    fn every_stored_row_has_a_cell_for_each_column() {
        let rows = stored().expect("the stored rows can be read");
        assert!(rows.iter().all(|row| row.cells.len() == COLUMNS.len()));
    }

    /// Brute force with a watertight test is right in all cases; code that finds nothing only where
    /// nothing is hit, and code that always finds something not there either.
    #[test]
    fn a_row_counts_what_is_wrong() {
        let right = measure(30, &mut |case| {
            let triangles = case.triangles();
            let hits = case.rays.iter().map(|ray| brute_force(&triangles, ray));
            Ok(hits.map(|hit| hit.map(|(t, _)| t)).collect())
        });
        let row = right.expect("it is measured").yours.expect("a row");
        assert_eq!(row.worst(), Some(0.0));
        assert_eq!(row.value("at_end"), Some(100.0));

        let misses = measure(30, &mut |case| Ok(vec![None; case.rays.len()]));
        let row = misses.expect("it is measured").yours.expect("a row");
        assert_eq!(row.value("grid_vertex"), Some(1e6));
        assert_eq!(row.value("beside"), Some(0.0));
        assert_eq!(
            (row.value("on_surface"), row.value("inner")),
            (Some(0.0), None)
        );

        let hits = measure(30, &mut |case| Ok(vec![Some(1.0); case.rays.len()]));
        let row = hits.expect("it is measured").yours.expect("a row");
        assert_eq!(row.value("beside"), Some(1e6));
    }

    #[test]
    fn code_that_is_not_written_has_no_row_and_code_that_panics_has_an_error() {
        let report = measure(2, &mut |_| not_measured("part2.task1 is not attempted"));
        let report = report.expect("it is measured");
        assert_eq!(
            (report.yours, report.missing.as_deref()),
            (None, Some("part2.task1 is not attempted"))
        );

        let mut cases = 0;
        let report = measure(2, &mut |case| {
            cases += 1;
            match cases {
                1 => Ok(vec![None; case.rays.len()]),
                _ => not_measured("your code panicked"),
            }
        });
        let row = report.expect("it is measured").yours.expect("a row");
        assert_eq!(row.cells[1], Cell::Error("your code panicked".into()));
    }
}
