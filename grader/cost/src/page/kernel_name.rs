//! How the page names a kernel.

use crate::report::KernelRow;

/// Returns a kernel's name with its precision.
pub(crate) fn name(row: &KernelRow) -> String {
    format!("{} {}", row.name, row.precision.name())
}
