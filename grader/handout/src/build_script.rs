//! Says which tasks of this stage are not written yet: `cargo test` ignores their worked examples.

use std::path::Path;
use std::{fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=src");
    println!("cargo::rustc-check-cfg=cfg(open_task, values(any()))");
    let mut folders = vec![Path::new("src").to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                for key in open_tasks(&fs::read_to_string(&path).unwrap_or_default()) {
                    println!("cargo::rustc-cfg=open_task={key:?}");
                }
            }
        }
    }
    Ok(())
}

/// The tasks whose `hole!` or `untouched!` is in the code of a file.
pub(crate) fn open_tasks(text: &str) -> Vec<String> {
    let lines = text
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let code: String = lines.flat_map(|line| [line, "\n"]).collect();
    let mut keys = Vec::new();
    for start in ["hole!(", "untouched!("] {
        let quoted = code
            .split(start)
            .skip(1)
            .filter_map(|after| after.trim_start().strip_prefix('"'));
        keys.extend(quoted.filter_map(|rest| Some(rest.split_once('"')?.0.to_owned())));
    }
    keys
}
