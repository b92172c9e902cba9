//! The commands in `scenes/pictures/README.md` make the pictures beside it.
//!
//! A few pixels of each picture are rendered again with the flags of its command, and have to be
//! those of the file.

use clap::Parser;
use image::RgbImage;
use kit::film::Cell;
use pathtracer::args::Args;
use pathtracer::rate_picture::viridis;
use pathtracer::{Job, Passes, Picture, PreparedScene, Textures};
use showcase::collada::Document;
use showcase::forest::{self, Stored};
use showcase::strip::place;
use showcase::{dusk, sky, street, tree};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Where commands put what is not in the repository.
const MADE: &str = "target/showcase";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The commands of `pathtracer` and the others, as words, with continued lines joined.
fn commands() -> Vec<Vec<String>> {
    let text = fs::read_to_string(root().join("scenes/pictures/README.md")).expect("the list");
    let joined = text.replace("\\\n", " ");
    let lines = joined.lines().filter(|line| line.contains("cargo run"));
    let words = |line: &str| line.split_whitespace().map(str::to_owned).collect();
    lines.map(words).collect()
}

/// The flags of the commands of `program`.
fn flags_of(program: &str) -> Vec<Vec<String>> {
    let flags = |words: Vec<String>| {
        let start = words.iter().position(|word| word == "--")?;
        (words[start - 1] == program).then(|| words[start + 1..].to_vec())
    };
    commands().into_iter().filter_map(flags).collect()
}

/// The pictures that the commands put into strips: by file name, the strip's file name and the
/// place in the strip.
fn strips() -> BTreeMap<String, (String, u32)> {
    let text = fs::read_to_string(root().join("scenes/pictures/README.md")).expect("the list");
    let joined = text.replace("\\\n", " ");
    let commands = joined
        .lines()
        .filter_map(|line| line.split_once("-- strip "));
    let mut strips = BTreeMap::new();
    for (_, words) in commands {
        // Labels are in quotation marks, and no path has any.
        let mut paths = words
            .split('"')
            .step_by(2)
            .map(str::trim)
            .filter(|path| !path.is_empty());
        let strip = paths
            .next()
            .expect("a strip")
            .rsplit('/')
            .next()
            .expect("a name")
            .to_owned();
        for (i, path) in (0..).zip(paths) {
            strips.insert(path.to_owned(), (strip.clone(), i));
        }
    }
    strips
}

/// Pixels of a picture as bytes, row by row from the bottom left.
type Pixels = Vec<[u8; 3]>;

/// Renders the pixels of `cell` with the flags, whose paths are relative to the root. `made` is the
/// folder with what the other commands make. Returns those of the picture, and with `-a` those of
/// the picture of the numbers of samples.
fn pixels(flags: &[String], made: &Path, cell: Cell) -> (Pixels, Option<Pixels>) {
    let path = |word: &String| match word.strip_prefix(MADE) {
        Some(name) => made.join(name.trim_start_matches('/')).into(),
        None if word.starts_with("scenes/") => root().join(word).into_os_string(),
        None => word.into(),
    };
    let words = std::iter::once("pathtracer".into()).chain(flags.iter().map(path));
    let args = Args::try_parse_from(words).unwrap_or_else(|why| panic!("{flags:?}: {why}"));
    let loaded = scenes::load(&args.scene).unwrap_or_else(|why| panic!("{why}"));
    let (view, film) = args.view(&loaded.scene).expect("a view");
    let environment = args.environment.as_ref().map(|map| {
        pathtracer::load_environment(map)
            .unwrap_or_else(|why| panic!("{why}"))
            .0
    });
    let picture = Picture::new(args.shade, loaded.scene, environment);
    let (textures, missing) =
        Textures::load(picture.scene(), args.scene.parent().expect("a folder"));
    assert!(missing.is_empty(), "{missing:?}");
    let scene = PreparedScene::new(picture, textures, args.accel.into());
    let passes = Passes {
        scene: &scene,
        job: Job {
            camera: view.camera,
            film,
            cell,
            samples: args.samples,
            sampling: args.sampling(args.samples),
        },
        settings: args.light().expect("settings"),
    };
    let rendered = passes.render(&AtomicBool::new(false), &|_| (), &mut |_| true);
    let tone = args.tone();
    let color = |(x, y)| tone.to_bytes(rendered.film.get(x, y).radiance);
    let rate = |(x, y)| {
        let samples = rendered.film.get(x, y).samples;
        viridis(f64::from(samples) / f64::from(args.samples))
    };
    let rates = args
        .adaptive
        .is_some()
        .then(|| cell.pixels().map(rate).collect());
    (cell.pixels().map(color).collect(), rates)
}

fn open(name: &str) -> RgbImage {
    let path = root().join("scenes/pictures").join(name);
    image::open(&path)
        .unwrap_or_else(|why| panic!("{}: {why}", path.display()))
        .to_rgb8()
}

/// A few pixels somewhat below the middle, where something is to be seen.
fn cell(w: u32, h: u32) -> Cell {
    let (x0, y0) = (w / 2 - 3, h / 3);
    Cell {
        x0,
        y0,
        x1: x0 + 5,
        y1: y0 + 3,
    }
}

/// Asserts that `picture` has the `bytes` of `cell`, from column `left` on. `h` is the height of
/// the rendered picture; below it there may be a legend.
fn assert_same(picture: &RgbImage, left: u32, h: u32, cell: Cell, bytes: &[[u8; 3]], name: &str) {
    for ((x, y), expected) in cell.pixels().zip(bytes) {
        let found = picture.get_pixel(left + x, h - 1 - y).0;
        assert_eq!(
            found, *expected,
            "{name}: column {x}, row {y} from the bottom"
        );
    }
}

#[test]
#[ignore = "slow: renders parts of all pictures of the front page"]
fn every_picture_has_the_pixels_of_its_command() {
    let folder = tempfile::tempdir().expect("a folder");
    sky::map()
        .save(folder.path().join("dusk.exr"))
        .expect("a sky");
    let scene =
        |name: &str| BufWriter::new(File::create(folder.path().join(name)).expect("a file"));
    let write = |document: Document, name| document.write(&mut scene(name)).expect("a scene");
    write(tree::document(tree::TRIANGLES), "tree.dae");
    write(street::document(), "street.dae");
    write(forest::document(Stored::Double), "forest.dae");
    write(forest::document(Stored::Single), "forest_f32.dae");
    dusk::write(&mut scene("dusk.dae")).expect("a scene");

    let strips = strips();
    let mut checked = BTreeSet::new();
    for flags in flags_of("pathtracer") {
        let output = flags.iter().position(|flag| flag == "-f").expect("-f") + 1;
        let name = flags[output].clone();
        let size = flags.iter().position(|flag| flag == "-r").expect("-r") + 1;
        let [w, h]: [u32; 2] = [0, 1].map(|i| flags[size + i].parse().expect("a number"));
        let cell = cell(w, h);
        let (bytes, rates) = pixels(&flags, folder.path(), cell);
        match name.strip_prefix("scenes/pictures/") {
            Some(name) => {
                let picture = open(name);
                assert_eq!(picture.dimensions(), (w, h), "{name}");
                assert_same(&picture, 0, h, cell, &bytes, name);
                checked.insert(name.to_owned());
                if let Some(rates) = rates {
                    let name = name.replace(".png", "_rate.png");
                    assert_same(&open(&name), 0, h, cell, &rates, &name);
                    checked.insert(name);
                }
            }
            None => {
                let (_, name) = name.rsplit_once('/').expect("a folder");
                let (strip, i) = strips.get(name).expect("a picture of a strip");
                let (left, top) = place(*i, (w, h));
                assert_same(&open(strip), left, top + h, cell, &bytes, name);
                checked.insert(name.to_owned());
            }
        }
    }
    for (name, (strip, _)) in strips {
        assert!(checked.remove(&name), "no command makes {name} of {strip}");
        checked.insert(strip);
    }
    let files = fs::read_dir(root().join("scenes/pictures"))
        .expect("a folder")
        .map(|file| {
            file.expect("a file")
                .file_name()
                .to_string_lossy()
                .into_owned()
        });
    let pictures: BTreeSet<String> = files.filter(|name| name.ends_with(".png")).collect();
    assert_eq!(checked, pictures, "each picture has its command");
}

/// What a reader of the front page sees at first.
#[test]
fn front_page_pictures_are_wide_and_have_no_broken_pixels() {
    for (name, width) in [
        ("dusk", 1600),
        ("street", 1600),
        ("tree", 1600),
        ("materials", 1200),
        ("parts", 1600),
        ("forest", 1605),
    ] {
        let picture = open(&format!("{name}.png"));
        assert_eq!(picture.width(), width, "{name}");
        let nan = pathtracer::tone::NAN_COLOR;
        assert!(
            picture.pixels().all(|pixel| pixel.0 != nan),
            "{name} has NaN"
        );
        let black = picture.pixels().filter(|pixel| pixel.0 == [0; 3]).count();
        let all = picture.pixels().count();
        assert!(black < all / 4, "{name}: {black} of {all} pixels are black");
        let path = root().join("scenes/pictures").join(format!("{name}.png"));
        let size = fs::metadata(path).expect("it exists").len();
        assert!(size <= 2_500_000, "{name} has {size} bytes");
    }
}

/// Columns of a code block or a table that a page shows without cutting or scrolling.
const COLUMNS: usize = 88;

#[test]
fn no_line_of_code_or_of_a_table_is_cut() {
    for name in [
        "README.md",
        "scenes/pictures/README.md",
        "stages/pathtracer/cluster/README.md",
    ] {
        let text = fs::read_to_string(root().join(name)).expect(name);
        let mut is_code = false;
        for line in text.lines() {
            if line.starts_with("```") {
                is_code = !is_code;
            }
            let is_fixed = is_code || line.starts_with('|');
            let columns = line.chars().count();
            assert!(
                !is_fixed || columns <= COLUMNS,
                "{name}: {columns} columns: {line}"
            );
        }
        assert!(!is_code, "{name}: a code block is open at the end");
    }
}

#[test]
fn the_badge_names_the_required_rust_version() {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("Cargo.toml");
    let version = manifest
        .lines()
        .find_map(|line| line.strip_prefix("rust-version = \""))
        .and_then(|rest| rest.strip_suffix('"'))
        .expect("a rust-version");
    let badge = fs::read_to_string(root().join("scenes/pictures/badges/rust.svg"));
    assert!(
        badge
            .expect("a badge")
            .contains(&format!(">{version} or later<"))
    );
}
