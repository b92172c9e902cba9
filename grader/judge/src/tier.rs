//! The two kinds of points.

use serde::{Deserialize, Serialize};

/// What a case's points are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Tier {
    /// What the textbook solution earns.
    Core,
    /// Numerical stability beyond the textbook: extra credit.
    Robust,
}
