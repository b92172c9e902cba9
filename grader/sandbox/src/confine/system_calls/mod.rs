//! System calls that are denied, by seccomp.
//!
//! For programs the lists name what is denied ([`denied`]): a list of what a compiler may call would
//! break with every new version of it. A sealed thread only computes, so there the list names what is
//! allowed ([`sealed`]). A denied call fails with `EPERM`, so that code that only tries goes on.

mod denied;
mod filter;
mod sealed;
#[cfg(all(test, target_arch = "x86_64"))]
mod tests;

use filter::Calls;
use seccompiler::{BpfProgram, SeccompCmpOp};

/// Denies what no program needs, and unless `processes`, everything that starts one.
pub(super) fn deny_for_program(processes: bool) -> Result<(), String> {
    if !processes {
        filter::apply(&no_clone3()?)?;
    }
    filter::apply(&for_program(processes)?)
}

/// Denies, on this thread, everything but to compute and to use open files.
pub(super) fn deny_for_sealed_thread() -> Result<(), String> {
    filter::apply(&no_clone3()?)?;
    filter::apply(&for_sealed_thread()?)
}

fn for_program(processes: bool) -> Result<BpfProgram, String> {
    let mut denied = Calls::default();
    denied.all(denied::NEVER);
    denied.all(denied::NEVER_HERE);
    // Typing into a terminal.
    let types = (1, SeccompCmpOp::Eq, libc::TIOCSTI);
    denied.with(libc::SYS_ioctl, &[types])?;
    if !processes {
        denied.all(denied::NOT_WITHOUT_PROCESSES);
        denied.all(denied::NOT_WITHOUT_PROCESSES_HERE);
        other_processes(&mut denied)?;
    }
    denied.denied_with(libc::EPERM)
}

/// Adds starting processes, and signals and limits of others than this one. Which processes a program
/// that starts others may send signals is Landlock's to say.
fn other_processes(denied: &mut Calls) -> Result<(), String> {
    denied.all(&[
        libc::SYS_rt_sigqueueinfo,
        libc::SYS_rt_tgsigqueueinfo,
        libc::SYS_tkill,
    ]);
    let no_thread = (0, SeccompCmpOp::MaskedEq(THREAD), 0);
    denied.with(libc::SYS_clone, &[no_thread])?;
    let is_other = (0, SeccompCmpOp::Ne, this_process());
    for call in [libc::SYS_kill, libc::SYS_tgkill] {
        denied.with(call, std::slice::from_ref(&is_other))?;
    }
    // `prlimit64` of process 0 is that of the caller.
    denied.with(libc::SYS_prlimit64, &[(0, SeccompCmpOp::Ne, 0)])?;
    // A datagram to an address.
    denied.with(libc::SYS_sendto, &[(5, SeccompCmpOp::Ne, 0)])
}

fn for_sealed_thread() -> Result<BpfProgram, String> {
    let mut allowed = Calls::default();
    allowed.all(sealed::ALLOWED);
    let starts_thread = (0, SeccompCmpOp::MaskedEq(THREAD), THREAD);
    allowed.with(libc::SYS_clone, &[starts_thread])?;
    // The runtime aborts by a signal to itself.
    let is_this = (0, SeccompCmpOp::Eq, this_process());
    allowed.with(libc::SYS_tgkill, &[is_this])?;
    for command in sealed::FCNTL_COMMANDS {
        let is_it = (1, SeccompCmpOp::Eq, u64::from(command.unsigned_abs()));
        allowed.with(libc::SYS_fcntl, &[is_it])?;
    }
    let names = (
        0,
        SeccompCmpOp::Eq,
        u64::from(libc::PR_SET_NAME.unsigned_abs()),
    );
    allowed.with(libc::SYS_prctl, &[names])?;
    // It may read its limits, as the library does for a thread's stack, but not change them.
    allowed.with_null(libc::SYS_prlimit64, 2)?;
    // The channel's own writes have no address.
    allowed.with_null(libc::SYS_sendto, 4)?;
    allowed.allowed_or(libc::EPERM)
}

/// `clone3` passes its flags in memory, which a filter cannot read. A C library that gets `ENOSYS`
/// calls `clone` instead, so threads still work. This filter is applied first: afterwards, a sealed
/// thread can apply no other.
fn no_clone3() -> Result<BpfProgram, String> {
    let mut denied = Calls::default();
    denied.all(&[libc::SYS_clone3]);
    denied.denied_with(libc::ENOSYS)
}

/// The flag of `clone` for a thread of this process.
const THREAD: u64 = libc::CLONE_THREAD as u64;

fn this_process() -> u64 {
    u64::from(std::process::id())
}
