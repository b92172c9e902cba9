//! Ways to spoil a run: each ends its own case, as its sentence says, and no other.

use std::hint::black_box;
use std::io::Write;
use std::os::fd::AsFd;
use std::os::unix::fs::FileExt;
use std::time::Duration;

/// A way to spoil a run.
pub(crate) struct Spoiler {
    pub(crate) name: &'static str,
    /// Parts of what the report may say; `answers` if the case has an answer.
    pub(crate) says: &'static [&'static str],
    pub(crate) code: fn(),
}

const fn spoiler(name: &'static str, says: &'static [&'static str], code: fn()) -> Spoiler {
    Spoiler { name, says, code }
}

/// Exits with a code that no other code here exits with.
const GOT_OUT: i32 = 77;

const PANIC: &[&str] = &["panicked"];

pub(crate) const ALL: &[Spoiler] = &[
    spoiler("a payload that panics when it is dropped", PANIC, || {
        std::panic::panic_any(Payload(1));
    }),
    spoiler("payloads that panic one after the other", PANIC, || {
        std::panic::panic_any(Payload(100));
    }),
    spoiler(
        "closes the pipe of its output, and reads the memory in a hook on the main thread",
        &["panicked", "printed more than"],
        || {
            std::panic::set_hook(Box::new(|_| {
                if std::thread::current().name() == Some("main") && reads_memory() {
                    std::process::exit(GOT_OUT);
                }
            }));
            let line = [b'x'; 1 << 20];
            while std::io::stdout().write_all(&line).is_ok() {}
            std::panic::panic_any(Payload(1));
        },
    ),
    spoiler(
        "a payload whose drop never ends",
        &["did not return"],
        || {
            struct Endless;
            impl Drop for Endless {
                fn drop(&mut self) {
                    loop {
                        std::thread::park();
                    }
                }
            }
            std::panic::panic_any(Endless);
        },
    ),
    spoiler(
        "a payload that exits when it is dropped",
        &["called `std::process::exit(0)`"],
        || {
            struct Exits;
            impl Drop for Exits {
                fn drop(&mut self) {
                    std::process::exit(0)
                }
            }
            std::panic::panic_any(Exits);
        },
    ),
    spoiler("a panic with a message of 100 MB", &["xxx…"], || {
        std::panic::panic_any("x".repeat(100 << 20));
    }),
    spoiler(
        "a hook that panics",
        &["panicked again", "aborted the whole program"],
        || {
            std::panic::set_hook(Box::new(|_| panic!("in the hook")));
            panic!();
        },
    ),
    spoiler(
        "a panic while it cleans up after one",
        &["panicked again"],
        || {
            let _payload = Payload(1);
            panic!();
        },
    ),
    spoiler("a panic with the standard error locked", PANIC, || {
        std::thread::spawn(|| {
            let _lock = std::io::stderr().lock();
            std::thread::sleep(Duration::from_secs(60));
        });
        std::thread::sleep(Duration::from_millis(20));
        panic!();
    }),
    spoiler("keeps the standard input locked", &["answers"], || {
        std::thread::spawn(|| {
            let _lock = std::io::stdin().lock();
            std::thread::sleep(Duration::from_secs(60));
        });
    }),
    spoiler("takes all descriptors and keeps them", &["answers"], || {
        let copy = || std::io::stdin().as_fd().try_clone_to_owned().ok();
        std::mem::forget(std::iter::from_fn(copy).collect::<Vec<_>>());
    }),
    spoiler("prints the marks of other cases", &["answers"], || {
        let marks = (0..50_000).map(|i| format!("\n\0case {}\nx\n", i % 70));
        print!("{}", marks.collect::<String>());
    }),
    spoiler(
        "threads that start threads",
        // A thread that gets no memory for its second stack ends the program.
        &[
            "more than a hundred threads",
            "panicked",
            "aborted the whole program",
        ],
        || {
            fn start() {
                for _ in 0..2 {
                    let thread = std::thread::Builder::new().stack_size(1 << 16);
                    let _ = thread.spawn(start);
                }
                std::thread::sleep(Duration::from_secs(60));
            }
            start();
        },
    ),
    spoiler(
        "a thread whose end never comes",
        &["did not return"],
        || {
            struct Endless;
            impl Drop for Endless {
                fn drop(&mut self) {
                    loop {
                        std::thread::park();
                    }
                }
            }
            thread_local!(static LAST: Endless = const { Endless });
            let _ = std::thread::spawn(|| LAST.with(|_| ())).join();
        },
    ),
    spoiler(
        "panics without end and catches them",
        &["did not return"],
        || {
            loop {
                let _ = std::panic::catch_unwind(|| panic!());
            }
        },
    ),
    spoiler("sleeps in very short pieces", &["did not return"], || {
        loop {
            std::thread::sleep(Duration::from_micros(1));
        }
    }),
    spoiler(
        "more memory than there are addresses",
        &["asked for more than 1024 MB", "panicked"],
        || {
            black_box(Vec::<u8>::with_capacity(black_box(isize::MAX as usize)));
        },
    ),
    spoiler("a recursion of drops", &["overflowed the stack"], || {
        // Some thousand frames fill the stack: the limit of time is far on any machine.
        struct List(Option<Box<List>>);
        impl Drop for List {
            fn drop(&mut self) {
                let frame = [1_u8; 1 << 16];
                black_box(&frame);
                drop(self.0.take());
                black_box(&frame);
            }
        }
        drop((0..3000).fold(None, |rest, _| Some(Box::new(List(rest)))));
    }),
    spoiler("a hook that never returns", &["did not return"], || {
        std::panic::set_hook(Box::new(|_| {
            loop {
                std::thread::park();
            }
        }));
        panic!();
    }),
    spoiler("panics in the text that it prints", PANIC, || {
        struct Text;
        impl std::fmt::Display for Text {
            fn fmt(&self, _: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                panic!("in the text")
            }
        }
        println!("{Text}");
    }),
    spoiler(
        "more threads than it needs",
        &["more than a hundred threads"],
        || {
            let park = || std::thread::park_timeout(Duration::from_secs(60));
            for _ in 0..100_000 {
                let thread = std::thread::Builder::new().stack_size(1 << 16);
                if thread.spawn(park).is_err() {
                    break;
                }
            }
            park();
        },
    ),
    spoiler(
        "memory in the stack of a thread",
        &["asked for more than 1024 MB"],
        || fill_stacks(1, 1150),
    ),
    spoiler(
        "memory in the stacks of many threads",
        &["asked for more than 1024 MB"],
        || fill_stacks(31, 36),
    ),
    spoiler("a stack larger than all memory", &["panicked"], || {
        let thread = std::thread::Builder::new().stack_size(64 << 30);
        drop(thread.spawn(|| ()).expect("a thread starts"));
    }),
    spoiler(
        "overflows the stack of another thread",
        &["overflowed the stack"],
        || {
            let thread = std::thread::spawn(|| black_box(deeper(1)));
            let _ = thread.join();
        },
    ),
    spoiler(
        "exits on another thread",
        &["called `std::process::exit(0)`"],
        || {
            let _ = std::thread::spawn(|| std::process::exit(0)).join();
        },
    ),
    spoiler(
        "aborts on another thread",
        &["aborted the whole program"],
        || {
            let _ = std::thread::spawn(|| std::process::abort()).join();
        },
    ),
    spoiler("sleeps past its time", &["did not return"], || {
        std::thread::sleep(Duration::from_secs(3600));
    }),
    spoiler("waits for itself", &["did not return"], || {
        let lock = std::sync::Mutex::new(());
        let _first = lock.lock();
        let _second = lock.lock();
    }),
    spoiler(
        "writes into the channel",
        &["something else than the worker wrote into its channel"],
        || {
            let stdin = std::io::stdin();
            let channel = stdin
                .as_fd()
                .try_clone_to_owned()
                .expect("it can be copied");
            let _ = std::fs::File::from(channel).write_all(&[0; 64]);
        },
    ),
    spoiler("leaves threads that compute", &["answers"], || {
        for _ in 0..2 {
            std::thread::spawn(|| {
                let until = std::time::Instant::now() + Duration::from_millis(300);
                while std::time::Instant::now() < until {
                    black_box(0);
                }
            });
        }
    }),
    spoiler("panics on another thread and goes on", &["answers"], || {
        assert!(std::thread::spawn(|| panic!()).join().is_err());
    }),
    spoiler("uses as many threads as honest code", &["answers"], || {
        std::thread::scope(|scope| {
            for _ in 0..16 {
                scope.spawn(|| black_box((0..1000).sum::<u64>()));
            }
        });
    }),
    spoiler("panics when its thread ends", &["answers"], || {
        struct Last;
        impl Drop for Last {
            fn drop(&mut self) {
                panic!("at the end of the thread")
            }
        }
        thread_local!(static LAST: Last = const { Last });
        LAST.with(|_| ());
    }),
];

/// Panics with the next one when it is dropped.
struct Payload(u32);

impl Drop for Payload {
    fn drop(&mut self) {
        if self.0 > 0 {
            std::panic::panic_any(Payload(self.0 - 1));
        }
    }
}

/// Whether it can read a secret out of its memory by the kernel's file.
fn reads_memory() -> bool {
    static SECRET: [u8; 8] = *b"a secret";
    let path = format!("/proc/self/task/{}/mem", std::process::id());
    let mut read = [0; 8];
    let got = std::fs::File::open(path)
        .and_then(|it| it.read_exact_at(&mut read, black_box(&SECRET).as_ptr() as u64));
    got.is_ok() && read == SECRET
}

/// Starts threads that write so many megabytes each into their stacks, and waits.
fn fill_stacks(threads: usize, megabytes: usize) {
    let start = |_| {
        let thread = std::thread::Builder::new().stack_size((megabytes + 4) << 20);
        thread.spawn(move || {
            black_box(fill(megabytes));
            std::thread::sleep(Duration::from_secs(60));
        })
    };
    let started: Vec<_> = (0..threads).map(start).collect();
    for thread in started.into_iter().flatten() {
        let _ = thread.join();
    }
}

/// Uses a megabyte of the stack in each call, and keeps it until the deepest has waited.
fn fill(megabytes: usize) -> u8 {
    let memory = [1_u8; 1 << 20];
    black_box(&memory);
    if megabytes == 0 {
        std::thread::sleep(Duration::from_secs(60));
        return memory[7];
    }
    fill(megabytes - 1).wrapping_add(memory[megabytes])
}

#[allow(unconditional_recursion, reason = "it overflows the stack on purpose")]
fn deeper(n: u64) -> u64 {
    black_box(n) + deeper(n + 1)
}
