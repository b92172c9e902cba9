//! `book_site FOLDER`: the book as a site of mdBook, which is read without a server.
//!
//! mdBook renders the chapters, with search, themes and highlighting. The crate `book` prepares the
//! Markdown ([`book::source`]) and completes the pages ([`book::page`]).

mod search_index;
mod site;

use base::{errln, outln};
use book::source::Links;
use std::path::Path;
use std::process::ExitCode;

const USAGE: &str = "\
usage: book_site FOLDER              writes the site to FOLDER; links to sources lead to the files of this checkout
       book_site FOLDER --published  the same without these links, for a server";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let result = match args.as_slice() {
        [folder] if !folder.starts_with('-') => site::build(Path::new(folder), Links::Project),
        [folder, "--published"] => publish(Path::new(folder)),
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
    site::build(folder, Links::Nowhere)?;
    outln!("The site is ready: {}", folder.join("index.html").display());
    Ok(())
}
