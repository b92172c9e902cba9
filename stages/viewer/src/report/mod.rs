//! A report of the grader: its failing cases, each with what is wrong, and what would be right.
//!
//! Reading order: [`mod@file`] (what is read of `report.json`), [`stage_answer`] (what the stages of
//! this program answer now), [`case_view`] (a case in 3D: [`ray_case`], [`tree_case`],
//! [`visit_case`] with [`child_order`], [`light_case`], [`pixel_case`], [`scatter_case`],
//! [`plot_case`]), [`case_pictures`] (golden, actual and
//! difference), [`open_case`] (the case that is shown).

pub mod case_pictures;
pub mod case_view;
pub mod child_order;
pub mod file;
pub mod light_case;
pub mod open_case;
pub mod pixel_case;
pub mod plot_case;
pub mod ray_case;
pub mod scatter_case;
pub mod stage_answer;
pub mod tree_case;
pub mod visit_case;

pub use case_view::CaseView;
pub use file::{FailedCase, read};
pub use open_case::{CaseContent, CasePart, CasePictures, OpenCase};
pub use ray_case::RayCase;

use crate::task::Wake;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A report and the case that is shown.
pub struct OpenReport {
    /// The file.
    pub path: PathBuf,
    /// The failing cases, in the order of the course.
    pub cases: Vec<Arc<FailedCase>>,
    /// The shown case.
    pub opened: Option<OpenCase>,
}

impl OpenReport {
    /// Reads a report. The error is a sentence.
    pub fn load(path: &Path) -> Result<OpenReport, String> {
        let cases = read(path)?;
        Ok(OpenReport {
            path: path.to_owned(),
            cases: cases.into_iter().map(Arc::new).collect(),
            opened: None,
        })
    }

    /// Shows the case with this index, if there is one.
    pub fn open(&mut self, index: usize, wake: &Wake) {
        if let Some(case) = self.cases.get(index) {
            self.opened = Some(OpenCase::start(index, case, &self.path, wake));
        }
    }

    /// The index of the case after the shown one, or before it.
    pub fn neighbour(&self, forward: bool) -> usize {
        let shown = self.opened.as_ref().map(|opened| opened.index);
        match (shown, forward) {
            (None, _) => 0,
            (Some(at), true) => (at + 1).min(self.cases.len().saturating_sub(1)),
            (Some(at), false) => at.saturating_sub(1),
        }
    }

    /// The shown case.
    pub fn case(&self) -> Option<&FailedCase> {
        let case = self.cases.get(self.opened.as_ref()?.index)?;
        Some(case)
    }
}
