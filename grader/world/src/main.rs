//! What real ray casters answer: hard cases with exact truth, and how libraries do on them.
//!
//! ```text
//! world cases DIR [--rays N] [--seed S]    writes the cases and their truth
//! world ours DIR OUT                       answers them with this project's trees
//! world table DIR OUT                      judges every row in OUT, and prints the table
//! ```
//!
//! Read [`columns`] (the cases), [`truth`], [`judge`], then [`table`]. `run` in this folder installs
//! the libraries and calls all of it.

mod case;
mod columns;
mod judge;
mod ours;
mod plot;
mod random;
mod shapes;
mod table;
mod truth;

use case::Case;
use columns::COLUMNS;
use std::fs;
use std::io;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = match words[..] {
        ["cases", dir, ref options @ ..] => Options::parse(options)
            .and_then(|options| write_cases(Path::new(dir), &options).map_err(|e| e.to_string())),
        ["ours", dir, out] => answer(Path::new(dir), Path::new(out)).map_err(|e| e.to_string()),
        ["table", dir, out] => table::read(Path::new(dir), Path::new(out))
            .map(|table| print!("{}", table.tsv()))
            .map_err(|e| e.to_string()),
        ["plot", results, svg] => plot::write(Path::new(results), Path::new(svg)),
        _ => Err("usage: world cases DIR [--rays N] [--seed S] | ours DIR OUT | table DIR OUT | plot RESULTS.tsv SVG".into()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("world: {message}");
            ExitCode::from(2)
        }
    }
}

/// How many rays the cases have, and their seed.
struct Options {
    rays: usize,
    seed: u64,
}

impl Options {
    fn parse(words: &[&str]) -> Result<Options, String> {
        let mut options = Options {
            rays: 100_000,
            seed: 7,
        };
        for pair in words.chunks(2) {
            match pair {
                ["--rays", number] => {
                    options.rays = number
                        .parse()
                        .map_err(|e| format!("--rays {number}: {e}"))?
                }
                ["--seed", number] => {
                    options.seed = number
                        .parse()
                        .map_err(|e| format!("--seed {number}: {e}"))?
                }
                other => return Err(format!("unknown option {}", other.join(" "))),
            }
        }
        Ok(options)
    }
}

fn write_cases(dir: &Path, options: &Options) -> io::Result<()> {
    fs::create_dir_all(dir)?;
    for column in &COLUMNS {
        let case = column.case(options.seed, options.rays);
        case.write(&dir.join(column.name).with_extension("case"))?;
        truth::answers(&case).write(&dir.join(column.name).with_extension("truth"))?;
    }
    let speed = columns::speed(options.seed, 2 * options.rays);
    speed.write(&dir.join("speed.case"))
}

/// Writes the rows of this project.
fn answer(cases: &Path, out: &Path) -> io::Result<()> {
    let only = std::env::var("COLUMNS").ok();
    for row in &ours::ROWS {
        let folder = out.join(row.name);
        fs::create_dir_all(&folder)?;
        let (version, interface) = (env!("CARGO_PKG_VERSION"), row.interface);
        let about = format!(
            "library\tFirst Light\nversion\t{version}\ninterface\t{interface}\nprecision\tf64\n"
        );
        fs::write(folder.join("about.tsv"), about)?;
        for name in table::names().filter(|name| only.as_deref().is_none_or(|only| only == *name)) {
            let case = Case::read(&cases.join(name).with_extension("case"))?;
            (row.answer)(&case).write(&folder.join(name).with_extension("answer"))?;
        }
    }
    Ok(())
}
