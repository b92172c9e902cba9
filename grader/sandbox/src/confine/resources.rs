//! Limits on resources, by `setrlimit`.

use crate::policy::Limits;
use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};

/// The most files that a process may have open.
const OPEN_FILES: u64 = 1024;

/// Sets the limits, and forbids dumps of memory: they may contain what others have written.
pub(super) fn limit(limits: &Limits) -> Result<(), String> {
    let bytes = |mb: u64| mb.saturating_mul(1 << 20);
    for (resource, limit) in [
        (Resource::Core, Some(0)),
        (Resource::Nofile, Some(OPEN_FILES)),
        (Resource::Cpu, limits.cpu_seconds),
        (Resource::As, limits.memory_mb.map(bytes)),
        (Resource::Fsize, limits.file_mb.map(bytes)),
    ] {
        let Some(limit) = limit else {
            continue;
        };
        // A lower limit of the caller's stays.
        let limit = getrlimit(resource)
            .maximum
            .map_or(limit, |most| limit.min(most));
        let both = Rlimit {
            current: Some(limit),
            maximum: Some(limit),
        };
        setrlimit(resource, both).map_err(|e| format!("limit of {resource:?}: {e}"))?;
    }
    Ok(())
}
