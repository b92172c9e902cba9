//! `worker CASES RECORDS FIRST MEMORY_MB`: see [`harness::main`].

use cap::Cap;
use std::alloc::System;
use std::process::ExitCode;

#[global_allocator]
static MEMORY: Cap<System> = Cap::new(System, usize::MAX);

fn main() -> ExitCode {
    harness::main(&MEMORY, worker::run)
}
