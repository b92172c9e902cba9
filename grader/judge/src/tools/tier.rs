//! The two kinds of points.

use serde::{Deserialize, Serialize};

/// The tier of a case's points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Tier {
    /// Points that the textbook solution earns.
    Core,
    /// Extra credit for numerical stability beyond the textbook.
    Robust,
}
