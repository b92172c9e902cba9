//! Limits on resources, by `setrlimit`.

use crate::policy::Limits;
use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};

/// The most files that a process may have open.
const OPEN_FILES: u64 = 1024;

/// A process that uses up its processor time is told so by SIGXCPU, which ends it and says why. One
/// that ignores that is killed so many seconds later.
const SECONDS_TO_KILL: u64 = 5;

/// Sets the limits, and forbids dumps of memory: they may contain what others have written.
pub(super) fn limit(limits: &Limits) -> Result<(), String> {
    let bytes = |mb: u64| mb.saturating_mul(1 << 20);
    for (resource, limit) in [
        (Resource::Core, Some(0)),
        (Resource::Nofile, Some(OPEN_FILES)),
        (Resource::Cpu, limits.cpu_seconds),
        (Resource::As, limits.memory_mb.map(bytes)),
        (Resource::Fsize, limits.file_mb.map(bytes)),
        (Resource::Nproc, limits.threads),
    ] {
        let Some(limit) = limit else {
            continue;
        };
        let maximum = match resource {
            Resource::Cpu => limit.saturating_add(SECONDS_TO_KILL),
            _ => limit,
        };
        // A lower limit of the caller's stays.
        let most = getrlimit(resource).maximum.unwrap_or(u64::MAX);
        let limits = Rlimit {
            current: Some(limit.min(most)),
            maximum: Some(maximum.min(most)),
        };
        setrlimit(resource, limits).map_err(|e| format!("limit of {resource:?}: {e}"))?;
    }
    Ok(())
}
