//! Runs the filters in a small machine of the kernel's kind, for every system call.

use super::*;
use filter::X32_BIT;

/// What a call does at each level: for a compiler, for a worker, for a sealed thread.
#[derive(Debug, PartialEq)]
enum Outcome {
    Allowed,
    Fails(i32),
}

/// The filters of a level, the newest last.
struct Level(Vec<BpfProgram>);

impl Level {
    fn compiler() -> Level {
        Level(vec![for_program(true).unwrap()])
    }

    fn worker() -> Level {
        Level(vec![no_clone3().unwrap(), for_program(false).unwrap()])
    }

    fn sealed() -> Level {
        let mut filters = Level::worker().0;
        filters.extend([no_clone3().unwrap(), for_sealed_thread().unwrap()]);
        Level(filters)
    }

    /// The outcome of a call: the newest filter that denies it decides.
    fn outcome(&self, call: i64, arguments: [u64; 6]) -> Outcome {
        let mut outcomes = self
            .0
            .iter()
            .rev()
            .map(|filter| run(filter, call, arguments));
        let denied = outcomes.find(|outcome| *outcome != Outcome::Allowed);
        denied.unwrap_or(Outcome::Allowed)
    }

    fn allows(&self, call: i64, arguments: [u64; 6]) -> bool {
        self.outcome(call, arguments) == Outcome::Allowed
    }
}

/// Runs a filter on the data of a call: number, architecture, instruction pointer, six arguments.
fn run(filter: &BpfProgram, call: i64, arguments: [u64; 6]) -> Outcome {
    const X86_64: u32 = 0xc000_003e;
    let mut data = Vec::new();
    data.extend((call as u32).to_le_bytes());
    data.extend(X86_64.to_le_bytes());
    data.extend([0; 8]);
    arguments.iter().for_each(|a| data.extend(a.to_le_bytes()));
    let (mut at, mut accumulator) = (0, 0_u32);
    loop {
        let line = &filter[at];
        let branch = |is: bool| 1 + usize::from(if is { line.jt } else { line.jf });
        at += match line.code {
            0x20 => {
                let word = &data[line.k as usize..][..4];
                accumulator = u32::from_le_bytes(word.try_into().unwrap());
                1
            }
            0x54 => {
                accumulator &= line.k;
                1
            }
            0x05 => 1 + line.k as usize,
            0x15 => branch(accumulator == line.k),
            0x25 => branch(accumulator > line.k),
            0x35 => branch(accumulator >= line.k),
            0x06 => {
                return match line.k & 0xffff_0000 {
                    0x7fff_0000 => Outcome::Allowed,
                    0x0005_0000 => Outcome::Fails((line.k & 0xffff) as i32),
                    action => panic!("the filter returns {action:x}"),
                };
            }
            code => panic!("the filter has an instruction {code:x}"),
        };
    }
}

/// The table of all calls: number, name, and for whom it is allowed with arguments that are 0.
const TABLE: &str = include_str!("x86_64.txt");

#[test]
fn every_call_has_the_verdict_of_the_table() {
    let levels = [Level::compiler(), Level::worker(), Level::sealed()];
    let mut wrong = Vec::new();
    for line in TABLE.lines().filter(|line| !line.starts_with('#')) {
        let mut words = line.split_whitespace();
        let number: i64 = words.next().unwrap().parse().unwrap();
        let name = words.next().unwrap();
        let outcomes = ["compiler", "worker", "sealed"].into_iter().zip(&levels);
        let allowed: Vec<&str> = outcomes
            .filter(|(_, level)| level.allows(number, [0; 6]))
            .map(|(name, _)| name)
            .collect();
        let expected: Vec<&str> = words.collect();
        if allowed != expected {
            wrong.push(format!("{number} {name} {}", allowed.join(" ")));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_table_has_every_number_up_to_its_last() {
    let lines = TABLE.lines().filter(|line| !line.starts_with('#'));
    let numbers: Vec<u32> = lines
        .map(|line| line.split(' ').next().unwrap().parse().unwrap())
        .collect();
    assert!(numbers.len() > 350);
    assert!(numbers.is_sorted_by(|a, b| a < b), "{numbers:?}");
}

#[test]
fn a_call_that_nobody_knows_yet_is_denied_to_a_sealed_thread() {
    let sealed = Level::sealed();
    for call in 470..1000 {
        assert!(!sealed.allows(call, [0; 6]), "{call}");
    }
    // By the numbers of the x32 ABI, too.
    for call in 0..1000 {
        assert!(!sealed.allows(call | X32_BIT, [0; 6]), "{call}");
    }
    for level in [Level::compiler(), Level::worker()] {
        assert!(!level.allows(libc::SYS_ptrace | X32_BIT, [0; 6]));
    }
}

#[test]
fn arguments_decide_about_some_calls() {
    let this = u64::from(std::process::id());
    let fork = [libc::SIGCHLD as u64, 0, 0, 0, 0, 0];
    let thread = [(libc::CLONE_VM | libc::CLONE_THREAD) as u64, 0, 0, 0, 0, 0];
    let duplicate = [0, libc::F_DUPFD_CLOEXEC as u64, 3, 0, 0, 0];
    let own_signals = [0, libc::F_SETOWN as u64, this, 0, 0, 0];
    let name = [libc::PR_SET_NAME as u64, 1, 0, 0, 0, 0];
    let dumpable = [libc::PR_SET_DUMPABLE as u64, 1, 0, 0, 0, 0];
    let to_nobody = [0, 1, 1, 0, 0, 0];
    let to_address = [0, 1, 1, 0, 1, 16];
    let read_limit = [0, 7, 0, 1, 0, 0];
    let set_limit = [0, 7, 1, 0, 0, 0];
    let limit_of_other = [1, 7, 0, 1, 0, 0];
    let types = [0, libc::TIOCSTI, 0, 0, 0, 0];
    let [compiler, worker, sealed] = [Level::compiler(), Level::worker(), Level::sealed()];
    for (level, call, arguments, is_allowed) in [
        (&compiler, libc::SYS_clone, fork, true),
        (&worker, libc::SYS_clone, fork, false),
        (&sealed, libc::SYS_clone, fork, false),
        (&worker, libc::SYS_clone, thread, true),
        (&sealed, libc::SYS_clone, thread, true),
        (&worker, libc::SYS_kill, [this, 9, 0, 0, 0, 0], true),
        (&worker, libc::SYS_kill, [1, 9, 0, 0, 0, 0], false),
        (&worker, libc::SYS_tgkill, [1, 1, 9, 0, 0, 0], false),
        (&sealed, libc::SYS_tgkill, [this, this, 6, 0, 0, 0], true),
        (&sealed, libc::SYS_tgkill, [1, 1, 6, 0, 0, 0], false),
        (&sealed, libc::SYS_fcntl, duplicate, true),
        (&sealed, libc::SYS_fcntl, own_signals, false),
        (&sealed, libc::SYS_prctl, name, true),
        (&sealed, libc::SYS_prctl, dumpable, false),
        (&worker, libc::SYS_sendto, to_nobody, true),
        (&worker, libc::SYS_sendto, to_address, false),
        (&sealed, libc::SYS_sendto, to_nobody, true),
        (&sealed, libc::SYS_sendto, to_address, false),
        (&sealed, libc::SYS_prlimit64, read_limit, true),
        (&sealed, libc::SYS_prlimit64, set_limit, false),
        (&worker, libc::SYS_prlimit64, limit_of_other, false),
        (&compiler, libc::SYS_ioctl, types, false),
        (&worker, libc::SYS_ioctl, types, false),
    ] {
        let allowed = level.allows(call, arguments);
        assert_eq!(allowed, is_allowed, "call {call} with {arguments:?}");
    }
}

/// The C library calls `clone` where it gets `ENOSYS`, and gives up where it gets `EPERM`.
#[test]
fn clone3_does_not_exist() {
    for level in [Level::worker(), Level::sealed()] {
        let outcome = level.outcome(libc::SYS_clone3, [0; 6]);
        assert_eq!(outcome, Outcome::Fails(libc::ENOSYS));
    }
}
