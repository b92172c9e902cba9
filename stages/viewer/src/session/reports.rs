//! The report of a grader: which case is shown, and the walk through it.

use super::{Mode, Session};
use crate::ray_test::RayTest;
use crate::report::{OpenCase, OpenReport};
use std::sync::Arc;
use std::time::Duration;

impl Session {
    /// The report of a grader.
    pub fn report(&self) -> Option<&OpenReport> {
        self.report.as_ref()
    }

    /// Shows a report of the grader.
    pub fn set_report(&mut self, report: OpenReport) {
        self.report = Some(report);
    }

    /// The case of the report that is shown.
    pub fn opened_case(&self) -> Option<&OpenCase> {
        self.report.as_ref()?.opened.as_ref()
    }

    /// The shown case, to walk through it.
    pub fn opened_case_mut(&mut self) -> Option<&mut OpenCase> {
        self.report.as_mut()?.opened.as_mut()
    }

    /// The shown case, in report mode.
    pub(super) fn walked_case(&mut self) -> Option<&mut OpenCase> {
        match self.mode {
            Mode::Report => self.opened_case_mut(),
            _ => None,
        }
    }

    /// Switches to report mode; there already, shows the next part of the case.
    pub(super) fn show_report(&mut self) {
        if self.report.is_none() {
            return self.say("There is no report: start with --report report.json");
        }
        let was_there = self.mode == Mode::Report;
        self.mode = Mode::Report;
        match self.opened_case_mut() {
            Some(opened) if was_there => opened.show_next(),
            Some(_) => {}
            None => self.open_case(0),
        }
    }

    pub(super) fn open_case(&mut self, index: usize) {
        let wake = Arc::clone(&self.wake);
        let Some(report) = &mut self.report else {
            return;
        };
        report.open(index, &wake);
        self.mode = Mode::Report;
        let name = report
            .case()
            .map(|case| format!("{} {}", case.task, case.name));
        if let Some(name) = name {
            self.say(name);
        }
    }

    pub(super) fn open_neighbour(&mut self, forward: bool) {
        if let Some(index) = self.report.as_ref().map(|report| report.neighbour(forward)) {
            self.open_case(index);
        }
    }

    pub(super) fn save_case_as_test(&mut self) {
        let case = self.report.as_ref().and_then(OpenReport::case);
        let test = case.and_then(|case| Some((case.stage.clone(), case.test()?)));
        match test {
            Some((stage, text)) => self.save_test(&RayTest { stage, text }),
            None => self.say("This case has no short test"),
        }
    }

    /// Takes what was computed about the shown case. Returns whether more is to come.
    pub(super) fn update_case(&mut self, wait: Duration) -> bool {
        let wake = Arc::clone(&self.wake);
        self.opened_case_mut().is_some_and(|opened| {
            opened.update(wait, &wake);
            opened.is_running()
        })
    }
}
