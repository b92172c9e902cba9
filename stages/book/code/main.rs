//! `book`: renders the book, and writes its figures and its index of symbols.

use base::{errln, outln};
use std::path::Path;
use std::process::ExitCode;

const USAGE: &str = "\
usage: book site FOLDER              writes the site to FOLDER; links to sources lead to the files of this checkout
       book site FOLDER --published  the same without these links, for a server
       book figures                  writes the figures to stages/book/src/figures
       book symbols                  writes the index of symbols in stages/book/src/glossary.md
       book --version                prints the version";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let result = match args.as_slice() {
        ["site", folder] if !folder.starts_with('-') => book::site::write(Path::new(folder), false),
        ["site", folder, "--published"] => publish(Path::new(folder)),
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

fn publish(folder: &Path) -> Result<(), String> {
    book::site::write(folder, true)?;
    outln!("The site is ready: {}", folder.join("index.html").display());
    Ok(())
}
