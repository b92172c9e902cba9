//! The workers that a stage's cases run in: most in one with the stage alone, so that no neighbour
//! stops them; rays through whole scenes in one with every stage that hits something.

use crate::error::GraderError;
use crate::runner::{self, Ending, Worker};
use judge::cases::Spec;

/// The workers of a stage.
#[derive(Clone, Debug)]
pub struct StageWorkers {
    /// Has the stage.
    pub stage: Worker,
    /// Has every stage that hits something; or the stages that keep it from being built.
    pub whole_scene: Result<Worker, String>,
}

impl StageWorkers {
    /// Runs each case in its worker: its ending, or the stages for want of which it could not run.
    /// Adds what the code printed to `printed`.
    pub fn run(
        &self,
        specs: &[&Spec],
        printed: &mut String,
    ) -> Result<Vec<Result<Ending, String>>, GraderError> {
        let mut run = |worker: &Worker, all_stages: bool| -> Result<_, GraderError> {
            let chosen = specs
                .iter()
                .filter(|spec| spec.needs_all_stages() == all_stages);
            let cases: Vec<wire::Case> = chosen.map(|spec| spec.case()).collect();
            let run = runner::run(worker, &cases)?;
            printed.push_str(&run.printed);
            Ok(run.endings.into_iter())
        };
        let mut alone = run(&self.stage, false)?;
        let mut whole_scene = match &self.whole_scene {
            Ok(worker) => Ok(run(worker, true)?),
            Err(broken) => Err(broken),
        };
        let lost = || GraderError::new("the worker lost a case");
        let each = specs.iter();
        each.map(|spec| match (spec.needs_all_stages(), &mut whole_scene) {
            (false, _) => alone.next().map(Ok).ok_or_else(lost),
            (true, Ok(whole_scene)) => whole_scene.next().map(Ok).ok_or_else(lost),
            (true, Err(broken)) => Ok(Err((*broken).clone())),
        })
        .collect()
    }
}
