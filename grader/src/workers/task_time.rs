//! How much the cases of one task may take together, and how long all that a submission runs.
//!
//! Each case has a limit of its own, but code that waits a little less than that in hundreds of
//! cases would take hours. What counts is what the worker reports: the time in which the code
//! computed or waited, of a machine of known speed (`harness/src/clock.rs`). The limit is some
//! fifty times what the slowest honest code takes.

use crate::workers::awake::Awake;
use std::collections::HashMap;
use std::time::Duration;
use wire::{Case, Work};

/// The most that a task's cases may take.
pub(crate) const MOST: Duration = Duration::from_secs(240);

/// What the cases of each task have taken so far, and the case that is running.
#[derive(Debug, Default)]
pub(crate) struct TaskTimes {
    taken: HashMap<String, Duration>,
    running: Duration,
    /// When no case may run any more.
    end: Option<Awake>,
}

impl TaskTimes {
    /// No case has run yet, and none may run after `end`.
    pub(crate) fn until(end: Option<Awake>) -> TaskTimes {
        TaskTimes {
            end,
            ..TaskTimes::default()
        }
    }

    /// A case starts.
    pub(crate) fn start(&mut self) {
        self.running = Duration::ZERO;
    }

    /// The running `case` has taken so much.
    pub(crate) fn spend(&mut self, case: &Case, spent: Duration) {
        let more = spent.saturating_sub(self.running);
        self.running += more;
        *self.taken.entry(case.task.clone()).or_default() += more;
    }

    /// What is left until the end of all cases; `None` if there is no such end.
    pub(crate) fn left_of_all(&self) -> Option<Duration> {
        let end = self.end?;
        Some(end.saturating_duration_since(Awake::now()))
    }

    /// Whether nothing is left for `case` and those after it. Timings are not limited together.
    pub(crate) fn is_over(&self, case: &Case) -> bool {
        let is_timing = matches!(case.work, Work::Timing(_) | Work::TimeTest(_));
        let taken = self.taken.get(&case.task).copied().unwrap_or_default();
        !is_timing && taken >= MOST || self.left_of_all().is_some_and(|left| left.is_zero())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cases_of_a_task_are_limited_together() {
        let case = |task: &str| Case {
            task: task.into(),
            name: "a".into(),
            limit_ms: 1,
            work: Work::Stop(Vec::new()),
            order: Vec::new(),
        };
        let (one, other) = (case("part5.task1"), case("part5.task2"));
        let mut times = TaskTimes::default();
        for part in [2, 2] {
            times.start();
            assert!(!times.is_over(&one));
            // Each report has all that the case has taken.
            times.spend(&one, MOST / 8);
            times.spend(&one, MOST / part);
        }
        assert!(times.is_over(&one));
        assert!(!times.is_over(&other));
    }

    #[test]
    fn nothing_is_left_after_the_end_of_a_submission() {
        let case = Case {
            task: "part5.task2".into(),
            name: "a".into(),
            limit_ms: 1,
            work: Work::Stop(Vec::new()),
            order: Vec::new(),
        };
        let now = Awake::now();
        assert!(TaskTimes::until(Some(now)).is_over(&case));
        assert!(!TaskTimes::until(Some(now + MOST)).is_over(&case));
        assert!(!TaskTimes::until(None).is_over(&case));
    }
}
