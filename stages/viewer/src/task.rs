//! Work in the background, which a stage may stop with a hole or a panic.

use kit::hole::{self, Hole};
use std::any::Any;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// Why a stage returned nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StageFailure {
    /// A task is not written yet.
    Hole(&'static str),
    /// A stage panicked, with this message.
    Panic(String),
}

impl fmt::Display for StageFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            StageFailure::Hole(task) => write!(f, "{task} is not written yet"),
            StageFailure::Panic(message) => write!(f, "a stage panicked: {message}"),
        }
    }
}

impl StageFailure {
    fn of(payload: &(dyn Any + Send)) -> StageFailure {
        if let Some(hole) = payload.downcast_ref::<Hole>() {
            return StageFailure::Hole(hole.task);
        }
        let text = payload
            .downcast_ref::<&str>()
            .map(|text| text.to_string())
            .or_else(|| payload.downcast_ref::<String>().cloned());
        StageFailure::Panic(text.unwrap_or_else(|| "without a message".to_owned()))
    }
}

/// Calls `run`, which may call stages. A hole and a panic become an error.
pub fn guarded<T>(run: impl FnOnce() -> T) -> Result<T, StageFailure> {
    catch_unwind(AssertUnwindSafe(run)).map_err(|payload| StageFailure::of(&*payload))
}

/// Does not print the panics of holes, which are shown in the window. Other panics are printed as
/// usual.
pub fn silence_holes() {
    let print = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        if !info.payload().is::<Hole>() {
            print(info);
        }
    }));
}

/// What to call when background work has something to show.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// A computation on a thread of its own. Dropping it stops it.
#[derive(Debug)]
pub struct Task<T> {
    receiver: Receiver<Result<T, StageFailure>>,
    stop: Arc<AtomicBool>,
}

impl<T: Send + 'static> Task<T> {
    /// Starts `run`, which should return early once its argument is set. `wake` is called at the
    /// end.
    pub fn spawn(wake: Wake, run: impl FnOnce(&AtomicBool) -> T + Send + 'static) -> Task<T> {
        let (sender, receiver) = channel();
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = Arc::clone(&stop);
        thread::spawn(move || {
            let result = guarded(|| run(&stopped));
            // Marks of provided starts belong to this thread; they are not errors.
            hole::take_marks();
            // The receiver is gone if nobody wants the result any more.
            let _ = sender.send(result);
            wake();
        });
        Task { receiver, stop }
    }

    /// The result, if it is there within `time`.
    pub fn wait(&self, time: Duration) -> Option<Result<T, StageFailure>> {
        match self.receiver.recv_timeout(time) {
            Ok(result) => Some(result),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => Some(Err(ended())),
        }
    }
}

impl<T> Task<T> {
    /// Asks the computation to return early.
    pub fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

fn ended() -> StageFailure {
    StageFailure::Panic("the thread ended".to_owned())
}

impl<T> Drop for Task<T> {
    fn drop(&mut self) {
        self.stop();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quiet() -> Wake {
        Arc::new(|| ())
    }

    #[test]
    fn results_holes_and_panics_arrive() {
        let wait = |task: &Task<u32>| task.wait(Duration::from_secs(60)).expect("in time");
        assert_eq!(wait(&Task::spawn(quiet(), |_| 7)), Ok(7));
        let hole = Task::spawn(quiet(), |_| -> u32 { kit::hole!("part2.task3") });
        let failure = wait(&hole).expect_err("a hole");
        assert_eq!(failure.to_string(), "part2.task3 is not written yet");
        let panic = Task::spawn(quiet(), |_| -> u32 { panic!("index {}", 3) });
        assert_eq!(wait(&panic), Err(StageFailure::Panic("index 3".to_owned())));
    }

    #[test]
    fn dropping_a_task_stops_it() {
        let (sender, receiver) = channel();
        let task = Task::spawn(quiet(), move |stop| {
            while !stop.load(Ordering::Relaxed) {
                thread::sleep(Duration::from_millis(1));
            }
            sender.send(()).expect("the test waits");
        });
        drop(task);
        receiver
            .recv_timeout(Duration::from_secs(60))
            .expect("it stops");
    }
}
