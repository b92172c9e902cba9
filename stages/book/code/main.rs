//! `book`: figures, preprocessor and HTML pages of the book.

use base::{errln, outln};
use std::io::Read;
use std::path::Path;
use std::process::ExitCode;

const USAGE: &str = "\
usage: book figures            writes the figures to stages/book/src/figures
       book build FOLDER       writes the book as HTML pages to FOLDER
       book preprocess         the preprocessor of mdBook: reads its JSON, writes it with MathML
       book --version          prints the version";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let result = match args.as_slice() {
        ["figures"] => book::figures::write_all(),
        ["build", folder] => book::html::build(Path::new(folder)),
        // mdBook asks which renderers the preprocessor supports: HTML alone.
        ["preprocess", "supports", renderer] => {
            return if *renderer == "html" {
                ExitCode::SUCCESS
            } else {
                ExitCode::FAILURE
            };
        }
        ["preprocess"] => preprocess(),
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

fn preprocess() -> Result<(), String> {
    let mut input = String::new();
    std::io::stdin()
        .read_to_string(&mut input)
        .map_err(|error| format!("cannot read the book from mdBook: {error}"))?;
    outln!("{}", book::preprocess::run(&input)?);
    Ok(())
}
