//! Cases.

use crate::kinds::Work;
use serde::{Deserialize, Serialize};

/// One isolated check of one task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Case {
    /// Key of the task, such as `part1.task3`.
    pub task: String,
    /// Name of the case, unique in its task.
    pub name: String,
    /// Time limit in milliseconds. A case that takes longer fails.
    pub limit_ms: u64,
    /// The kind of work and its question.
    pub work: Work,
    /// The order of the calls, by their numbers; empty if they are made in the order of the question.
    /// Work whose calls depend on each other has its own order.
    pub order: Vec<u32>,
}
