//! The `pathtracer` program: renders a scene file to a picture file.

mod brightness;
mod budget;
mod explain;
mod export;
mod failure;
mod merge;
mod outputs;
mod part;
mod pixel;
mod progress;
mod run;
mod summary;
mod view;
mod window;

use clap::Parser;
use failure::Failure;
use kit::hole::Hole;
use merge::MergeArgs;
use pathtracer::args::{Args, with_advice};
use std::env;
use std::ffi::OsString;
use std::panic;
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut arguments: Vec<OsString> = env::args_os().collect();
    // A scene file of this name is `./merge`.
    if arguments.get(1).is_some_and(|first| first == "merge") {
        arguments.remove(1);
        let args = parse::<MergeArgs>(arguments);
        return merge::run(&args).unwrap_or_else(|failure| failure.report(false));
    }
    let args = parse::<Args>(arguments);
    // A hole is reported in one line, at the end; another panic as usual, with its location.
    let print_panic = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        if !info.payload().is::<Hole>() {
            print_panic(info);
        }
    }));
    match panic::catch_unwind(|| run::run(&args)) {
        Ok(Ok(code)) => code,
        Ok(Err(failure)) => failure.report(args.mis),
        Err(payload) => Failure::from_panic(payload).report(args.mis),
    }
}

/// The flags; ends the program if they are invalid, and after `--help`.
fn parse<A: Parser>(arguments: Vec<OsString>) -> A {
    A::try_parse_from(arguments).unwrap_or_else(|error| with_advice::<A>(error).exit())
}
