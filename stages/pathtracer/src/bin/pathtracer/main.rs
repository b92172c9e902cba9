//! The `pathtracer` program: from a scene file to a picture file.

mod args;
mod budget;
mod explain;
mod export;
mod failure;
mod outputs;
mod progress;
mod run;
mod settings;
mod summary;
mod values;
mod view;

use args::Args;
use clap::Parser;
use failure::Failure;
use kit::hole::Hole;
use std::panic;
use std::process::ExitCode;

fn main() -> ExitCode {
    let args = Args::parse();
    // A hole is told in one line, at the end; a panic of a stage as usual, with its place.
    let tell_panic = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        if !info.payload().is::<Hole>() {
            tell_panic(info);
        }
    }));
    match panic::catch_unwind(|| run::run(&args)) {
        Ok(Ok(code)) => code,
        Ok(Err(failure)) => failure.report(),
        Err(payload) => Failure::of_panic(payload).report(),
    }
}
