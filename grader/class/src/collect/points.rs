//! The points of a submission: what its cases earned, times what the plan says that they are worth.

use super::{StudentReport, Task};
use crate::plan::{Plan, PlannedTask};
use crate::unit::Unit;
use base::GraderError;
use grader::score;
use judge::Tier;

/// Gives the cases of a report the points of the plan. A case of the plan that the unit lacks is an
/// error: its question was never asked.
pub(super) fn apply(
    report: &mut StudentReport,
    unit: &Unit,
    plan: &Plan,
) -> Result<(), GraderError> {
    for task in &mut report.tasks {
        if let Some(planned) = plan.tasks.iter().find(|planned| planned.key == task.key) {
            apply_to_task(task, unit, planned)?;
        }
    }
    let sum = |points: fn(&Task) -> f64| report.tasks.iter().map(points).fold(0.0, |a, b| a + b);
    (report.score, report.max_score) = (sum(|task| task.score), sum(|task| task.max_score));
    (report.robust_score, report.robust_max_score) = (
        sum(|task| task.robust_score),
        sum(|task| task.robust_max_score),
    );
    Ok(())
}

fn apply_to_task(task: &mut Task, unit: &Unit, planned: &PlannedTask) -> Result<(), GraderError> {
    let earned = unit.earned.get(&task.key);
    let mut points = [0.0; 2];
    for case in &planned.cases {
        let earned = earned
            .and_then(|cases| cases.get(&case.name))
            .ok_or_else(|| {
                GraderError::new(format!(
                    "the result units/{}.json has no case {} of {}. Run again with `--regrade`",
                    unit.key, case.name, task.key
                ))
            })?;
        let tier = usize::from(case.tier == Tier::Robust);
        points[tier] += case.points * earned;
        if let Some(reported) = task
            .cases
            .iter_mut()
            .find(|reported| reported.name == case.name)
        {
            reported.score = case.points * earned;
            reported.max_score = case.points;
            reported.tier = case.tier;
        }
    }
    let [max_score, max_extra] = [Tier::Core, Tier::Robust].map(|tier| planned.max(tier));
    if !score::earns_extra(points[0], max_score) {
        points[1] = 0.0;
        let extra = task
            .cases
            .iter_mut()
            .filter(|case| case.tier == Tier::Robust);
        extra.for_each(|case| case.score = 0.0);
    }
    [task.score, task.robust_score] = points;
    (task.max_score, task.robust_max_score) = (max_score, max_extra);
    Ok(())
}
