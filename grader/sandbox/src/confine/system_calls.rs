//! System calls that are denied, by seccomp.
//!
//! The lists name what is denied, not what is allowed: a list of what is allowed breaks with every
//! new version of a C library. A denied call fails with `EPERM`, so that code that only tries goes
//! on.

use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
    SeccompRule, TargetArch, apply_filter,
};
use std::collections::BTreeMap;

/// What no program here needs: other processes' memory and signals, the network, the system's
/// state, queues that outlive the program, leaving the process group.
const NEVER: &[i64] = &[
    libc::SYS_acct,
    libc::SYS_add_key,
    libc::SYS_adjtimex,
    libc::SYS_bpf,
    libc::SYS_chroot,
    libc::SYS_clock_adjtime,
    libc::SYS_clock_settime,
    libc::SYS_delete_module,
    libc::SYS_fanotify_init,
    libc::SYS_finit_module,
    libc::SYS_init_module,
    libc::SYS_io_uring_enter,
    libc::SYS_io_uring_register,
    libc::SYS_io_uring_setup,
    libc::SYS_ioprio_set,
    libc::SYS_kcmp,
    libc::SYS_kexec_load,
    libc::SYS_keyctl,
    libc::SYS_mount,
    libc::SYS_mq_open,
    libc::SYS_msgget,
    libc::SYS_name_to_handle_at,
    libc::SYS_open_by_handle_at,
    libc::SYS_perf_event_open,
    libc::SYS_personality,
    libc::SYS_pidfd_getfd,
    libc::SYS_pidfd_open,
    libc::SYS_pidfd_send_signal,
    libc::SYS_pivot_root,
    libc::SYS_process_madvise,
    libc::SYS_process_vm_readv,
    libc::SYS_process_vm_writev,
    libc::SYS_ptrace,
    libc::SYS_quotactl,
    libc::SYS_reboot,
    libc::SYS_request_key,
    libc::SYS_semget,
    libc::SYS_setdomainname,
    libc::SYS_sethostname,
    libc::SYS_setns,
    libc::SYS_setpgid,
    libc::SYS_setsid,
    libc::SYS_settimeofday,
    libc::SYS_shmget,
    libc::SYS_socket,
    libc::SYS_swapoff,
    libc::SYS_swapon,
    libc::SYS_syslog,
    libc::SYS_umount2,
    libc::SYS_unshare,
    libc::SYS_userfaultfd,
    libc::SYS_vhangup,
];

/// What a program that starts no other needs no more: files' owners, times and rights are not under
/// Landlock.
const NOT_WITHOUT_PROCESSES: &[i64] = &[
    libc::SYS_fchmod,
    libc::SYS_fchmodat,
    FCHMODAT2,
    libc::SYS_fchown,
    libc::SYS_fchownat,
    libc::SYS_fremovexattr,
    libc::SYS_fsetxattr,
    libc::SYS_lremovexattr,
    libc::SYS_lsetxattr,
    libc::SYS_memfd_create,
    libc::SYS_removexattr,
    libc::SYS_sched_setaffinity,
    libc::SYS_sched_setattr,
    libc::SYS_sched_setparam,
    libc::SYS_sched_setscheduler,
    libc::SYS_setpriority,
    libc::SYS_setxattr,
    libc::SYS_utimensat,
];

/// What the student's thread needs no more, because everything is open already.
const NOT_SEALED: &[i64] = &[
    libc::SYS_chdir,
    libc::SYS_faccessat,
    libc::SYS_faccessat2,
    libc::SYS_execve,
    libc::SYS_execveat,
    libc::SYS_getdents64,
    libc::SYS_linkat,
    libc::SYS_mkdirat,
    libc::SYS_mknodat,
    libc::SYS_openat,
    libc::SYS_openat2,
    libc::SYS_readlinkat,
    libc::SYS_renameat2,
    libc::SYS_setgid,
    libc::SYS_setgroups,
    libc::SYS_setregid,
    libc::SYS_setresgid,
    libc::SYS_setresuid,
    libc::SYS_setreuid,
    libc::SYS_setuid,
    libc::SYS_statfs,
    libc::SYS_statx,
    libc::SYS_symlinkat,
    libc::SYS_truncate,
    libc::SYS_unlinkat,
];

/// `fchmodat2`, which has the same number on every architecture.
const FCHMODAT2: i64 = 452;

/// The calls of the lists that only this architecture has, with `NEVER`'s, the next and the last.
#[cfg(target_arch = "x86_64")]
const OF_X86: [&[i64]; 3] = [
    &[libc::SYS_ioperm, libc::SYS_iopl, libc::SYS_modify_ldt],
    &[
        libc::SYS_chmod,
        libc::SYS_chown,
        libc::SYS_futimesat,
        libc::SYS_lchown,
        libc::SYS_utime,
        libc::SYS_utimes,
    ],
    &[
        libc::SYS_access,
        libc::SYS_creat,
        libc::SYS_getdents,
        libc::SYS_link,
        libc::SYS_lstat,
        libc::SYS_mkdir,
        libc::SYS_mknod,
        libc::SYS_newfstatat,
        libc::SYS_open,
        libc::SYS_readlink,
        libc::SYS_rename,
        libc::SYS_renameat,
        libc::SYS_rmdir,
        libc::SYS_stat,
        libc::SYS_symlink,
        libc::SYS_unlink,
    ],
];

#[cfg(not(target_arch = "x86_64"))]
const OF_X86: [&[i64]; 3] = [&[], &[], &[]];

/// Programs of the x32 ABI call the same calls by numbers with this bit.
#[cfg(target_arch = "x86_64")]
const X32_BIT: i64 = 0x4000_0000;

/// Denies what no program needs, and unless `processes`, everything that starts one.
pub(super) fn deny_for_program(processes: bool) -> Result<(), String> {
    let mut denied = Denied::default();
    denied.all(NEVER);
    denied.all(OF_X86[0]);
    denied.terminal_input()?;
    if processes {
        // Which processes may be sent signals is Landlock's to say.
        return denied.apply();
    }
    denied.all(NOT_WITHOUT_PROCESSES);
    denied.all(OF_X86[1]);
    denied.other_processes()?;
    denied.apply()?;
    deny_clone3()
}

/// Denies, on this thread, everything but to compute and to write to open files.
pub(super) fn deny_for_sealed_thread() -> Result<(), String> {
    let mut denied = Denied::default();
    for list in [NEVER, NOT_WITHOUT_PROCESSES, NOT_SEALED] {
        denied.all(list);
    }
    OF_X86.into_iter().for_each(|list| denied.all(list));
    denied.terminal_input()?;
    denied.other_processes()?;
    denied.apply()?;
    deny_clone3()
}

/// `clone3` passes its flags in memory, which a filter cannot read. A C library that gets `ENOSYS`
/// calls `clone` instead, so threads still work.
fn deny_clone3() -> Result<(), String> {
    let mut denied = Denied::default();
    denied.all(&[libc::SYS_clone3]);
    denied.apply_with(libc::ENOSYS)
}

/// The calls that a filter denies; with rules, only calls with such arguments.
#[derive(Default)]
struct Denied(BTreeMap<i64, Vec<SeccompRule>>);

impl Denied {
    fn all(&mut self, calls: &[i64]) {
        for call in calls {
            self.0.insert(*call, Vec::new());
            #[cfg(target_arch = "x86_64")]
            self.0.insert(*call | X32_BIT, Vec::new());
        }
    }

    /// Denies `call` if its argument number `argument` is as `compare` and `value` say.
    fn with_argument(
        &mut self,
        call: i64,
        argument: u8,
        compare: SeccompCmpOp,
        value: u64,
    ) -> Result<(), String> {
        let condition = SeccompCondition::new(argument, SeccompCmpArgLen::Dword, compare, value);
        let rule = condition.and_then(|condition| SeccompRule::new(vec![condition]));
        let rule = rule.map_err(|e| format!("seccomp: {e}"))?;
        self.0.entry(call).or_default().push(rule);
        Ok(())
    }

    /// Denies starting processes, and signals and limits of others than this one.
    fn other_processes(&mut self) -> Result<(), String> {
        let this = u64::from(std::process::id());
        #[cfg(target_arch = "x86_64")]
        self.all(&[libc::SYS_fork, libc::SYS_vfork]);
        self.all(&[
            libc::SYS_rt_sigqueueinfo,
            libc::SYS_rt_tgsigqueueinfo,
            libc::SYS_tkill,
        ]);
        let thread = libc::CLONE_THREAD as u64;
        self.with_argument(libc::SYS_clone, 0, SeccompCmpOp::MaskedEq(thread), 0)?;
        for call in [libc::SYS_kill, libc::SYS_tgkill] {
            self.with_argument(call, 0, SeccompCmpOp::Ne, this)?;
        }
        // `prlimit64` of process 0 is that of the caller.
        self.with_argument(libc::SYS_prlimit64, 0, SeccompCmpOp::Ne, 0)
    }

    /// Denies typing into a terminal.
    fn terminal_input(&mut self) -> Result<(), String> {
        self.with_argument(libc::SYS_ioctl, 1, SeccompCmpOp::Eq, libc::TIOCSTI)
    }

    fn apply(self) -> Result<(), String> {
        self.apply_with(libc::EPERM)
    }

    fn apply_with(self, error: i32) -> Result<(), String> {
        let failed = |e: &dyn std::fmt::Display| format!("seccomp: {e}");
        let machine = TargetArch::try_from(std::env::consts::ARCH).map_err(|e| failed(&e))?;
        let deny = SeccompAction::Errno(error.unsigned_abs());
        let filter = SeccompFilter::new(self.0, SeccompAction::Allow, deny, machine);
        let program = filter.and_then(BpfProgram::try_from);
        apply_filter(&program.map_err(|e| failed(&e))?).map_err(|e| failed(&e))
    }
}
