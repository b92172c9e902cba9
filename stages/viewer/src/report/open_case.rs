//! The case of a report that is shown: what is computed about it, and a walk through it.

use super::case_pictures::{golden_folder, of_case, of_task};
use super::case_view::CaseView;
use super::file::FailedCase;
use super::stage_answer::{StageAnswer, answer_of, is_timed};
use crate::orbit::Orbit;
use crate::picture_pair::{PairDisplay, PicturePair};
use crate::task::{StageFailure, Task, Wake};
use crate::tree_walk::TreeWalk;
use judge::findings::Finding;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use wire::Answer;

/// The parts of a case that can be looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CasePart {
    /// Shapes and rays in 3D.
    View,
    /// The picture whose pixels are the calls of the case.
    CasePicture,
    /// The picture of the task.
    TaskPicture,
}

impl CasePart {
    /// Its name in the window.
    pub fn name(self) -> &'static str {
        match self {
            CasePart::View => "3D",
            CasePart::CasePicture => "Picture of the case",
            CasePart::TaskPicture => "Picture of the task",
        }
    }
}

/// What is computed about a case with the stages of this program.
#[derive(Clone, Debug, Default)]
pub struct CaseContent {
    /// Why the stages have no answer, as a sentence.
    pub silent: Option<String>,
    /// Whether the task still has the start that the course provides.
    pub is_untouched: bool,
    /// What is wrong with the answer now: the grader's sentences; `None` without an answer.
    pub wrong_now: Option<Vec<String>>,
    /// The case in 3D.
    pub view: Option<CaseView>,
    /// The answer that all this is about.
    pub answer: Option<Arc<Answer>>,
}

/// The pictures of a case, rendered with the stages of this program.
#[derive(Clone, Debug, Default)]
pub struct CasePictures {
    /// Golden, actual and difference of the case; the error is a sentence.
    pub of_case: Option<Result<PicturePair, String>>,
    /// Golden, actual and difference of the task's picture; the error is a sentence.
    pub of_task: Option<Result<PicturePair, String>>,
}

impl CaseContent {
    /// Runs the case.
    pub fn of(case: &FailedCase) -> CaseContent {
        let mut content = CaseContent::default();
        if let Some(spec) = case.spec.as_ref().filter(|spec| !is_timed(&spec.work)) {
            match answer_of(spec) {
                Ok(answer) => {
                    let StageAnswer {
                        answer,
                        is_untouched,
                        not_written,
                    } = answer;
                    let findings = judge::judge_written(spec, case.tier, &answer, &not_written);
                    let is_judged =
                        |finding: &&Finding| finding.judged > 0 || not_written.is_empty();
                    let wrong = findings
                        .iter()
                        .filter(|finding| !finding.passed())
                        .filter(is_judged)
                        .map(sentence);
                    content.wrong_now = Some(wrong.collect());
                    if !not_written.is_empty() {
                        let names = not_written.join(", ");
                        content.silent = Some(format!("{}: not written yet: {names}", spec.task));
                    }
                    content.is_untouched = is_untouched;
                    content.answer = Some(Arc::new(answer));
                }
                Err(why) => content.silent = Some(why),
            }
        }
        content.view = CaseView::of(case, content.answer.as_deref());
        content
    }
}

/// What is wrong in an aspect.
fn sentence(finding: &Finding) -> String {
    match &finding.worst {
        Some(worst) => worst.message.to_string(),
        None => format!("{} is missing", finding.aspect.label()),
    }
}

impl CasePictures {
    /// Makes the pictures of a case and its task. `answer` is that of the stages, if they have one;
    /// `report` is the path of the report, near which the goldens are.
    pub fn of(case: &FailedCase, answer: Option<&Answer>, report: &Path) -> CasePictures {
        let Some(goldens) = golden_folder(report) else {
            return CasePictures::default();
        };
        let spec = case.spec.as_ref();
        CasePictures {
            of_case: answer
                .zip(spec)
                .and_then(|(answer, spec)| of_case(&goldens, spec, case.tier, answer)),
            of_task: judge::pictures::of(&case.task).map(|_| of_task(&goldens, &case.task)),
        }
    }

    /// The two pictures of a part; the error is a sentence.
    pub fn pair(&self, part: CasePart) -> Option<Result<&PicturePair, &str>> {
        let pair = match part {
            CasePart::View => None,
            CasePart::CasePicture => self.of_case.as_ref(),
            CasePart::TaskPicture => self.of_task.as_ref(),
        };
        pair.map(|pair| pair.as_ref().map_err(String::as_str))
    }
}

/// The shown case.
pub struct OpenCase {
    /// Its index in the report.
    pub index: usize,
    case: Arc<FailedCase>,
    report: PathBuf,
    running: Option<Task<CaseContent>>,
    content: Option<CaseContent>,
    rendering: Option<Task<CasePictures>>,
    pictures: CasePictures,
    /// Whether its pictures were asked for.
    is_rendered: bool,
    failure: Option<StageFailure>,
    chosen: Option<CasePart>,
    /// How its pictures are shown.
    pub display: PairDisplay,
    /// The camera of the 3D view, once it is drawn.
    pub orbit: Option<Orbit>,
    /// The selected node of a tree.
    pub walk: TreeWalk,
    /// The number of tests of a traversal that have been walked, or of wrong nodes of a tree.
    pub step: usize,
}

impl OpenCase {
    /// Starts to compute what there is to see of `case`, in the background.
    pub fn start(index: usize, case: &Arc<FailedCase>, report: &Path, wake: &Wake) -> OpenCase {
        let run = Arc::clone(case);
        OpenCase {
            running: Some(Task::spawn(Arc::clone(wake), move |_| {
                CaseContent::of(&run)
            })),
            ..OpenCase::empty(index, case, report)
        }
    }

    /// A case about which nothing is known yet.
    fn empty(index: usize, case: &Arc<FailedCase>, report: &Path) -> OpenCase {
        OpenCase {
            index,
            case: Arc::clone(case),
            report: report.to_owned(),
            running: None,
            content: None,
            rendering: None,
            pictures: CasePictures::default(),
            is_rendered: false,
            failure: None,
            chosen: None,
            display: PairDisplay::default(),
            orbit: None,
            walk: TreeWalk::default(),
            step: 0,
        }
    }

    /// The case with what was computed about it before. Its pictures are not rendered.
    pub fn with_content(
        index: usize,
        case: &Arc<FailedCase>,
        report: &Path,
        content: CaseContent,
    ) -> OpenCase {
        let mut opened = OpenCase {
            content: Some(content),
            is_rendered: true,
            ..OpenCase::empty(index, case, report)
        };
        opened.go_to_difference();
        opened
    }

    /// Takes what was computed. Waits for it at most `wait`.
    pub fn update(&mut self, wait: Duration, wake: &Wake) {
        self.update_content(wait);
        if let (Some(content), None, false) = (&self.content, &self.rendering, self.is_rendered) {
            let (case, answer) = (Arc::clone(&self.case), content.answer.clone());
            let report = self.report.clone();
            self.is_rendered = true;
            self.rendering = Some(Task::spawn(Arc::clone(wake), move |_| {
                CasePictures::of(&case, answer.as_deref(), &report)
            }));
        }
        if let Some(result) = self.rendering.as_ref().and_then(|task| task.wait(wait)) {
            self.rendering = None;
            match result {
                Ok(pictures) => self.pictures = pictures,
                Err(failure) => self.failure = Some(failure),
            }
        }
    }

    fn update_content(&mut self, wait: Duration) {
        let Some(result) = self.running.as_ref().and_then(|task| task.wait(wait)) else {
            return;
        };
        self.running = None;
        match result {
            Ok(content) => self.content = Some(content),
            Err(failure) => self.failure = Some(failure),
        }
        self.go_to_difference();
    }

    /// The walk starts where something is wrong.
    fn go_to_difference(&mut self) {
        match self.view() {
            Some(CaseView::Tree(_)) => self.step_test(true),
            Some(CaseView::Visits(case)) => {
                self.step = case.first_difference().map_or(0, |test| test + 1);
            }
            _ => {}
        }
    }

    /// Whether something is being computed.
    pub fn is_running(&self) -> bool {
        self.running.is_some() || self.rendering.is_some()
    }

    /// The parts that there are so far, in order.
    pub fn parts(&self) -> Vec<CasePart> {
        let parts = [
            (CasePart::View, self.view().is_some()),
            (CasePart::CasePicture, self.pictures.of_case.is_some()),
            (CasePart::TaskPicture, self.pictures.of_task.is_some()),
        ];
        let present = parts.into_iter().filter(|(_, is_there)| *is_there);
        present.map(|(part, _)| part).collect()
    }

    /// Its pictures so far.
    pub fn pictures(&self) -> &CasePictures {
        &self.pictures
    }

    /// What was computed.
    pub fn content(&self) -> Option<&CaseContent> {
        self.content.as_ref()
    }

    /// Why nothing was computed.
    pub fn failure(&self) -> Option<&StageFailure> {
        self.failure.as_ref()
    }

    /// The case in 3D.
    pub fn view(&self) -> Option<&CaseView> {
        self.content()?.view.as_ref()
    }

    /// The visible part; `None` if there is none.
    pub fn part(&self) -> Option<CasePart> {
        let parts = self.parts();
        let chosen = self.chosen.filter(|part| parts.contains(part));
        chosen.or(parts.first().copied())
    }

    /// Shows a part.
    pub fn show(&mut self, part: CasePart) {
        self.chosen = Some(part);
    }

    /// Shows the next part.
    pub fn show_next(&mut self) {
        let parts = self.parts();
        let at = parts.iter().position(|part| Some(*part) == self.part());
        if let Some(at) = at {
            self.chosen = Some(parts[(at + 1) % parts.len()]);
        }
    }

    /// Walks to the next or the previous event: a test of a traversal, a wrong node of a tree.
    pub fn step_test(&mut self, forward: bool) {
        let events = match self.view() {
            Some(CaseView::Visits(case)) => case.record.tests.len(),
            Some(CaseView::Tree(case)) => case.wrong.len(),
            _ => 0,
        };
        let step = if forward {
            (self.step + 1).min(events)
        } else {
            self.step.saturating_sub(1)
        };
        self.go_to_event(step);
    }

    /// Walks to the event with this number, counted from 1; 0 is before the first one.
    pub fn go_to_event(&mut self, step: usize) {
        self.step = step;
        let content = self.content.as_ref();
        if let Some(CaseView::Tree(case)) = content.and_then(|content| content.view.as_ref())
            && let Some(wrong) = step.checked_sub(1).and_then(|i| case.wrong.get(i))
        {
            self.walk.go_to(&case.tree, wrong.node);
        }
    }

    /// Walks through the tree of a case.
    pub fn with_tree(&mut self, change: impl FnOnce(&mut TreeWalk, &kit::Bvh)) {
        let content = self.content.as_ref();
        if let Some(CaseView::Tree(case)) = content.and_then(|content| content.view.as_ref()) {
            change(&mut self.walk, &case.tree);
        }
    }
}
