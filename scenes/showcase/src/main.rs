//! The program `showcase`: makes the inputs of the front-page pictures.

use base::{errln, outln};
use image::RgbImage;
use showcase::forest::{self, Stored};
use showcase::{dusk, sky, street, strip, tree};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::process::ExitCode;

const USAGE: &str = "usage: showcase sky OUT.exr\n       showcase dusk|street|tree|forest|forest_f32 OUT.dae\n       \
                     showcase strip OUT.png LABEL A.png LABEL B.png ...\n       showcase --version";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let made = match args.as_slice() {
        ["sky", out] => whole(out, "exr", |part| {
            sky::map().save(part).map_err(|why| why.to_string())
        }),
        ["dusk", out] => scene(out, dusk::write),
        ["street", out] => scene(out, |file| street::document().write(file)),
        ["forest", out] => scene(out, |file| forest::document(Stored::Double).write(file)),
        ["forest_f32", out] => scene(out, |file| forest::document(Stored::Single).write(file)),
        ["tree", out] => scene(out, |file| tree::document(tree::TRIANGLES).write(file)),
        ["strip", out, pictures @ ..] if pictures.len() >= 2 && pictures.len() % 2 == 0 => {
            whole(out, "png", |part| save_strip(part, pictures))
        }
        ["--version"] => {
            outln!("showcase {}", base::VERSION);
            Ok(())
        }
        _ => Err(USAGE.to_owned()),
    };
    match made {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            errln!("error: {why}");
            ExitCode::from(2)
        }
    }
}

/// Writes a scene file.
fn scene(
    out: &str,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), String> {
    whole(out, "dae", |part| {
        let mut file = BufWriter::new(File::create(part).map_err(|why| why.to_string())?);
        let written = write(&mut file).and_then(|()| file.flush());
        written.map_err(|why| why.to_string())
    })
}

/// Calls `write` with a temporary path, which is renamed to `out` if it succeeds. Creates the
/// folder. `out` has to end in `extension`.
fn whole(
    out: &str,
    extension: &str,
    write: impl FnOnce(&Path) -> Result<(), String>,
) -> Result<(), String> {
    let out = Path::new(out);
    let shown = out.display();
    if out.extension().is_none_or(|end| end != extension) {
        return Err(format!("{shown}: use a name that ends in .{extension}"));
    }
    if let Some(folder) = out.parent() {
        fs::create_dir_all(folder)
            .map_err(|why| format!("cannot create {}: {why}", folder.display()))?;
    }
    let part = out.with_extension(format!("part.{extension}"));
    let renamed = write(&part).and_then(|()| fs::rename(&part, out).map_err(|why| why.to_string()));
    renamed.map_err(|why| format!("cannot write {shown}: {why}"))?;
    outln!("Wrote       {shown}");
    Ok(())
}

/// Writes the pictures whose labels and paths are `words` in turns.
fn save_strip(part: &Path, words: &[&str]) -> Result<(), String> {
    let mut pictures: Vec<(&str, RgbImage)> = Vec::new();
    for pair in words.chunks(2) {
        let [label, path] = [pair[0], pair[1]];
        let picture = image::open(path).map_err(|why| format!("cannot read {path}: {why}"))?;
        pictures.push((label, picture.to_rgb8()));
    }
    let strip = strip::labelled(&pictures)?;
    strip.save(part).map_err(|why| why.to_string())
}
