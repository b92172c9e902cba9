//! A report of the grader: its failing cases, each with the ray that is wrong.
//!
//! Reading order: [`mod@file`] (what is read of `report.json`), [`case_view`] (one case: shapes,
//! ray, the stage's answer and the exact one).

pub mod case_view;
pub mod file;

pub use case_view::{CaseView, Row};
pub use file::{FailedCase, read};

use crate::orbit::Orbit;
use crate::session::Session;
use std::path::{Path, PathBuf};

/// A report and the case that is shown.
pub struct OpenReport {
    /// The file.
    pub path: PathBuf,
    /// The failing cases, in the order of the course.
    pub cases: Vec<FailedCase>,
    /// The index of the shown case, and its view; `None` in its place for cases without a ray.
    pub opened: Option<(usize, Option<CaseView>)>,
    /// The camera of the shown case, once it is drawn.
    pub orbit: Option<Orbit>,
}

impl OpenReport {
    /// Reads a report. The error is a sentence.
    pub fn load(path: &Path) -> Result<OpenReport, String> {
        let cases = read(path)?;
        Ok(OpenReport {
            path: path.to_owned(),
            opened: None,
            orbit: None,
            cases,
        })
    }

    /// Shows the case with this index, if there is one.
    pub fn open(&mut self, index: usize) {
        if let Some(case) = self.cases.get(index) {
            self.opened = Some((index, CaseView::of(case)));
            self.orbit = None;
        }
    }

    /// The shown case.
    pub fn case(&self) -> Option<&FailedCase> {
        self.cases.get(self.opened.as_ref()?.0)
    }

    /// The view of the shown case, if it is about a ray.
    pub fn view(&self) -> Option<&CaseView> {
        self.opened.as_ref()?.1.as_ref()
    }
}

impl Session {
    pub(crate) fn open_case(&mut self, index: usize) {
        let Some(mut report) = self.take_report() else {
            return;
        };
        report.open(index);
        if let Some(case) = report.case() {
            self.say(format!("{} {}", case.task, case.name));
        }
        self.set_report(report);
    }

    pub(crate) fn save_case_as_test(&mut self) {
        let test = self
            .report()
            .and_then(|report| Some((report.case()?, report.case()?.test()?)));
        match test.map(|(case, test)| (case.stage.clone(), test)) {
            Some((stage, text)) => self.save_test(&crate::ray_test::RayTest { stage, text }),
            None => self.say("This case has no short test"),
        }
    }
}
