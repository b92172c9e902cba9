//! Gives up rights, for good: what this process, or this thread, and everything that it starts may
//! do from now on.

#[cfg(target_os = "linux")]
mod files;
#[cfg(target_os = "linux")]
mod resources;
#[cfg(target_os = "linux")]
mod system_calls;

use crate::policy::Policy;

/// Gives up everything that `policy` does not list. Call it before other threads start: they would
/// keep their rights.
#[cfg(target_os = "linux")]
pub fn enter(policy: &Policy) -> Result<(), String> {
    // A file that the caller has open is not protected by any of the following.
    close_fds::set_fds_cloexec_threadsafe(3, &[]);
    rustix::thread::set_no_new_privs(true).map_err(|e| format!("no_new_privs: {e}"))?;
    resources::limit(&policy.limits)?;
    if !policy.without.landlock {
        files::restrict(policy)?;
    }
    if !policy.without.seccomp {
        system_calls::deny_for_program(policy.processes)?;
    }
    Ok(())
}

/// Gives up, on this thread and those that it will start, every file, program and process: what is
/// left is to compute, and to write to what is open already.
#[cfg(target_os = "linux")]
pub fn seal_thread() -> Result<(), String> {
    rustix::thread::set_no_new_privs(true).map_err(|e| format!("no_new_privs: {e}"))?;
    files::restrict(&Policy::default())?;
    system_calls::deny_for_sealed_thread()
}

/// Does nothing: this system has no means for it. [`crate::probe`] reports that.
#[cfg(not(target_os = "linux"))]
pub fn enter(_: &Policy) -> Result<(), String> {
    Ok(())
}

/// Does nothing: this system has no means for it. [`crate::probe`] reports that.
#[cfg(not(target_os = "linux"))]
pub fn seal_thread() -> Result<(), String> {
    Ok(())
}
