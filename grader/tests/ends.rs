//! Runs a worker whose cases end in every way in which a student's code can end, and checks what
//! the report says about it.
//!
//! This program is the worker, too: the runner starts it with the arguments of a worker.

use cap::Cap;
use grader::workers::crash::{Crash, CrashKind};
use grader::workers::printed;
use grader::workers::runner::{self, Ending, Patience, Worker};
use std::alloc::System;
use std::process::ExitCode;
use wire::{Answer, Case, Record, Work};

#[global_allocator]
static MEMORY: Cap<System> = Cap::new(System, usize::MAX);

/// The call in which each case ends, counted from 0.
const CALL: usize = 2;

/// The time limit of code that ends, in milliseconds: a hundred times what it takes on a slow machine.
const LIMIT_MS: u64 = 600_000;

/// The same of code that does not.
const SHORT_LIMIT_MS: u64 = 250;

/// The lines that a case prints that is right.
const MANY_LINES: usize = 30_000;

/// A way to end a case.
struct End {
    name: &'static str,
    kind: CrashKind,
    /// What the report says.
    says: &'static str,
    code: fn(),
}

const ENDS: &[End] = &[
    End {
        name: "panic",
        kind: CrashKind::Panic,
        says: "called `Option::unwrap()` on a `None` value (call 2 of the case)",
        code: || {
            std::hint::black_box(None::<u32>).unwrap();
        },
    },
    End {
        name: "index",
        kind: CrashKind::Panic,
        says: "index out of bounds: the len is 2 but the index is 3 (call 2 of the case)",
        code: || {
            let list = std::hint::black_box([1, 2]);
            let list = list.as_slice();
            std::hint::black_box(list[std::hint::black_box(3)]);
        },
    },
    // The library's function panics in a file of its own.
    End {
        name: "step",
        kind: CrashKind::Panic,
        says: "assertion failed: step != 0 (call 2 of the case)",
        code: || {
            let step = std::hint::black_box(0);
            std::hint::black_box([1, 2].iter().step_by(step).count());
        },
    },
    End {
        name: "sample_loop",
        kind: CrashKind::Endless,
        says: "called camera_ray 1,000,000 times, was asked for 16 samples: an endless loop? (call 2 of the case)",
        code: || {
            for calls in 0_u64.. {
                harness::limit_calls("camera_ray", calls, || "16 samples".into());
            }
        },
    },
    End {
        name: "recursion",
        kind: CrashKind::Endless,
        says: "overflowed the stack of 64 MB: a recursion without end? (call 2 of the case)",
        code: || {
            std::hint::black_box(deeper(1));
        },
    },
    End {
        name: "push",
        kind: CrashKind::Endless,
        says: "asked for more than 1024 MB of memory (the last request was for 67,108,864 bytes): a Vec that grows without end? (call 2 of the case)",
        code: || {
            let mut list = Vec::new();
            loop {
                list.push(std::hint::black_box(vec![0_u8; 64 << 20]));
            }
        },
    },
    End {
        name: "loop",
        kind: CrashKind::Endless,
        says: DID_NOT_RETURN,
        code: endless,
    },
    End {
        name: "loop on other threads",
        kind: CrashKind::Endless,
        says: DID_NOT_RETURN,
        code: || {
            (0..3).for_each(|_| drop(std::thread::spawn(endless)));
            loop {
                std::thread::park();
            }
        },
    },
    End {
        name: "exit_0",
        kind: CrashKind::Ended,
        says: "called `std::process::exit(0)`, which ends the whole program: return a result instead (call 2 of the case)",
        code: || std::process::exit(0),
    },
    End {
        name: "exit_3",
        kind: CrashKind::Ended,
        says: "called `std::process::exit(3)`, which ends the whole program: return a result instead (call 2 of the case)",
        code: || std::process::exit(3),
    },
    End {
        name: "abort",
        kind: CrashKind::Ended,
        says: "aborted the whole program (SIGABRT): does it call `std::process::abort`? (call 2 of the case)",
        code: || std::process::abort(),
    },
    End {
        name: "second_panic",
        kind: CrashKind::Ended,
        says: "panicked again while it cleaned up after a panic: in a `Drop`? (call 2 of the case)",
        code: || {
            let _cleanup = PanicsOnDrop;
            panic!("the first");
        },
    },
];

const DID_NOT_RETURN: &str = "did not return in many times the time of correct code: too much work, or an endless loop? (call 2 of the case)";

fn endless() {
    let mut i = 0_u64;
    loop {
        i = std::hint::black_box(i.wrapping_add(1));
    }
}

struct PanicsOnDrop;

impl Drop for PanicsOnDrop {
    fn drop(&mut self) {
        panic!("the second");
    }
}

fn deeper(i: u64) -> u64 {
    let frame = std::hint::black_box([i; 64]);
    if frame[0] == 0 {
        return 0;
    }
    deeper(frame[0] + 1) + frame[1]
}

/// Runs a case in the worker: some calls, of which the last one ends as the case's name says.
fn run_case(index: u32, case: &Case) -> Record {
    harness::run(index, case, |_| {
        for call in 0..=CALL {
            harness::call(call);
            println!("{} {call}", case.name);
        }
        if case.name == "prints" {
            (0..MANY_LINES).for_each(|i| println!("line {i} of a case that is right"));
        }
        if let Some(end) = ENDS.iter().find(|end| end.name == case.name) {
            (end.code)();
        }
        Ok(Answer::Stop(Vec::new()))
    })
}

fn case(name: &str) -> Case {
    Case {
        // Each its own task: cases after two timeouts of a task get less time.
        task: name.into(),
        name: name.into(),
        limit_ms: match name.starts_with("loop") {
            true => SHORT_LIMIT_MS,
            false => LIMIT_MS,
        },
        work: Work::Stop(Vec::new()),
        order: Vec::new(),
    }
}

/// The cases of a task after one that does not return are not run for an editor; simple questions
/// to such code have a short limit.
fn a_task_is_left_at_its_first_timeout(worker: &Worker) {
    for (patience, limit) in [
        (Patience::OneTimeout, 600),
        (Patience::OneShortTimeout, 500),
    ] {
        let worker = Worker {
            patience,
            ..worker.clone()
        };
        let mut cases = ["before", "loop", "after", "loop"].map(case);
        for case in &mut cases {
            (case.task, case.limit_ms) = ("task".into(), 600);
        }
        let run = runner::run(&worker, &cases).expect("the worker runs");
        let [before, looping, rest @ ..] = &run.endings[..] else {
            panic!("{run:?}")
        };
        assert!(matches!(before, Ending::Recorded(_)), "{before:?}");
        let is_late = matches!(looping, Ending::TimedOut { limit_ms, .. } if *limit_ms == limit);
        assert!(is_late, "{looping:?}");
        assert_eq!(rest, [Ending::NotRun, Ending::NotRun]);
    }
}

fn main() -> ExitCode {
    // A worker gets the place of its records; the test program, options.
    let first = std::env::args().nth(1);
    if first.is_some_and(|first| first == "-" || first.ends_with("records")) {
        return harness::main(&MEMORY, run_case);
    }
    let this_program = std::env::current_exe().expect("this program has a path");
    let worker = Worker::from(this_program);
    let right = ["before", "prints", "after"].map(case);
    let cases: Vec<Case> = right[..2]
        .iter()
        .cloned()
        .chain(ENDS.iter().map(|end| case(end.name)))
        .chain(right[2..].iter().cloned())
        .collect();
    let run = runner::run(&worker, &cases).expect("the worker runs");
    for (case, ending) in cases.iter().zip(&run.endings) {
        let Some(end) = ENDS.iter().find(|end| end.name == case.name) else {
            assert!(
                matches!(ending, Ending::Recorded(_)),
                "{}: {ending:?}",
                case.name
            );
            continue;
        };
        let crash = Crash::of(ending).unwrap_or_default();
        let says = crash.to_string();
        assert!(
            says == end.says || end.kind == CrashKind::Panic && says.ends_with(end.says),
            "{}: {says}",
            case.name
        );
        let expected = (end.kind, Some(CALL as u32));
        assert_eq!((crash.kind, crash.call), expected, "{}", case.name);
    }
    // Every case printed three lines, and nothing of the runtime is among them.
    for (case, printed) in cases.iter().zip(&run.printed) {
        assert_eq!(printed.case, case.name);
        let lines = if case.name == "prints" {
            MANY_LINES + 3
        } else {
            3
        };
        assert_eq!(printed.lines(), lines, "{printed:?}");
        assert_eq!(printed.first[CALL], format!("{} {CALL}", case.name));
    }
    assert_eq!(run.printed.len(), cases.len());
    let all = printed::format(&run.printed);
    assert!(all.contains("    … 29,983 more lines\n"), "{all}");
    a_task_is_left_at_its_first_timeout(&worker);
    println!("test every_end_has_its_sentence ... ok");
    ExitCode::SUCCESS
}
