//! How long the cases of one task may take together, and all that a submission runs.
//!
//! Each case has a limit of its own, but code that waits a little less than that in hundreds of
//! cases would take hours. The time that counts is the elapsed one, waiting included; the limit is
//! some fifty times what the slowest honest code takes.

use std::collections::HashMap;
use std::time::{Duration, Instant};
use wire::{Case, Work};

/// The most elapsed time of a task's cases.
pub(crate) const MOST: Duration = Duration::from_secs(240);

/// The time that the cases of each task have taken so far, and the case that is running.
#[derive(Debug, Default)]
pub(crate) struct TaskTimes {
    taken: HashMap<String, Duration>,
    running: Option<(String, Instant)>,
    /// When no case may run any more.
    end: Option<Instant>,
}

impl TaskTimes {
    /// No case has run yet, and none may run after `end`.
    pub(crate) fn until(end: Option<Instant>) -> TaskTimes {
        TaskTimes {
            end,
            ..TaskTimes::default()
        }
    }

    /// A case starts now.
    pub(crate) fn start(&mut self, case: &Case) {
        self.stop();
        self.running = Some((case.task.clone(), Instant::now()));
    }

    /// The case that is running ends now, if there is one.
    pub(crate) fn stop(&mut self) {
        if let Some((task, started)) = self.running.take() {
            *self.taken.entry(task).or_default() += started.elapsed();
        }
    }

    /// What is left for `case` and those after it; `None` if they are not limited together, as
    /// timings are not.
    pub(crate) fn left(&self, case: &Case) -> Option<Duration> {
        let taken = self.taken.get(&case.task).copied().unwrap_or_default();
        let is_timing = matches!(case.work, Work::Timing(_) | Work::TimeTest(_));
        let of_task = (!is_timing).then(|| MOST.saturating_sub(taken));
        of_task.into_iter().chain(self.left_of_all()).min()
    }

    /// What is left for all cases; `None` if there is no such limit.
    pub(crate) fn left_of_all(&self) -> Option<Duration> {
        let end = self.end?;
        Some(end.saturating_duration_since(Instant::now()))
    }

    /// Whether nothing is left for `case`.
    pub(crate) fn is_over(&self, case: &Case) -> bool {
        self.left(case).is_some_and(|left| left.is_zero())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_task_has_its_own_time_and_timings_have_no_limit() {
        let case = |task: &str, work| Case {
            task: task.into(),
            name: "a".into(),
            limit_ms: 1,
            work,
            order: Vec::new(),
        };
        let stop = |task| case(task, Work::Stop(Vec::new()));
        let mut times = TaskTimes::default();
        times.taken.insert("part5.task1".into(), MOST);
        assert!(times.is_over(&stop("part5.task1")));
        assert!(!times.is_over(&stop("part5.task2")));
        times.start(&stop("part5.task2"));
        std::thread::sleep(Duration::from_millis(2));
        times.stop();
        let left = times.left(&stop("part5.task2")).unwrap();
        assert!(left < MOST && left > MOST / 2, "{left:?}");
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
        let now = Instant::now();
        assert!(TaskTimes::until(Some(now)).is_over(&case));
        assert!(!TaskTimes::until(Some(now + MOST)).is_over(&case));
        assert!(!TaskTimes::until(None).is_over(&case));
    }
}
