//! `book`: writes the figures of the book and its index of symbols.

use base::{errln, outln};
use std::process::ExitCode;

const USAGE: &str = "\
usage: book figures      writes the figures to stages/book/src/figures
       book symbols      writes the index of symbols in stages/book/src/glossary.md
       book --version    prints the version";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let result = match args.as_slice() {
        ["figures"] => book::figures::write_all(),
        ["symbols"] => book::symbols::write(),
        ["--version"] => {
            outln!("book {}", base::VERSION);
            Ok(())
        }
        _ => Err(USAGE.into()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            errln!("{message}");
            ExitCode::from(2)
        }
    }
}
