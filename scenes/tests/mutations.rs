//! Fuzzing: for a file with random damage, the reader returns a valid scene or an error with its
//! position. It never panics, hangs or uses unlimited memory.
//!
//! `cargo test` tries a few thousand files. For more: `FIRSTLIGHT_FUZZ_SECONDS=600 cargo test -p
//! scenes --test mutations -- --ignored --nocapture`. `FIRSTLIGHT_FUZZ_SEED` sets the first seed
//! (default 0), to repeat a failure. If `FIRSTLIGHT_SCENES` is set to the folder of the original
//! course's files, these files are also used.

use kit::{FilmSize, PixelSampler, Scene};
use scenes::{CameraFile, placement};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Replacements for tokens: extreme numbers, malformed numbers, and names.
#[rustfmt::skip]
const WORDS: &[&str] = &[
    "", "0", "-0", "1", "-1", "2", "3", "17", "0.5", "-0.5", "nan", "inf", "-inf", "1e308", "-1e308", "1e-308", "5e-324",
    "1e150", "1e100", "1e-100", "1e999", "0.1e", "4000000000", "4294967295", "4294967296", "18446744073709551615",
    "99999999999999999999", "1,5", "0x10", "1e", "+1", ".5", "-.5e-5", "é", "&amp;", "0 0 0", "1 2 3 4 5", "node", "mesh",
    "matrix", "rotate", "scale", "X_UP", "Z_UP", "polygons", "tristrips", "trifans", "triangles", "CMU462", "NORMAL", "VERTEX",
];

/// Text to insert anywhere: pieces of XML, valid and invalid.
#[rustfmt::skip]
const PIECES: &[&str] = &[
    "<", ">", "/>", "</", "\"", "&", "#", "&#0;", "&#x110000;", "<!--", "-->", "<![CDATA[", "]]>", "<?x", "?>", "<!DOCTYPE a>",
    "\u{0}", "\u{feff}", "\r\n", "\u{2028}", "<node/>", "<instance_node url=\"#scene\"/>", "<matrix>1</matrix>",
    "<scale>0 0 0</scale>", "<scale>1e200 1e200 1e200</scale>", "<scale>-1 1 1</scale>", "<rotate>1 1 1 1e18</rotate>",
    "<p/>", "<p>0 0 0</p>", "<vcount>3</vcount>", "<extra><technique profile=\"CGL\"/></extra>",
    "<extra><technique profile=\"CGL\"><sphere><radius>1</radius></sphere></technique></extra>",
];

/// The original files: name and text. Ours come first, each folder's sorted: a seed damages the
/// same file wherever the folders lie.
fn corpus() -> Vec<(String, String)> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("dae");
    let course = std::env::var_os("FIRSTLIGHT_SCENES").map(PathBuf::from);
    if course.is_none() {
        println!("using only our own scenes: set FIRSTLIGHT_SCENES to use the course's files");
    }
    let files_of = |folder: PathBuf| {
        let files = std::fs::read_dir(folder).unwrap();
        let paths = files.map(|file| file.unwrap().path());
        let mut scenes: Vec<PathBuf> = paths
            .filter(|path| path.extension().is_some_and(|ending| ending == "dae"))
            .collect();
        scenes.sort();
        scenes
    };
    let read = |path: PathBuf| {
        (
            path.display().to_string(),
            std::fs::read_to_string(path).unwrap(),
        )
    };
    let folders = [Some(own), course].into_iter().flatten();
    folders.flat_map(files_of).map(read).collect()
}

/// Random choices from a seed.
struct RandomChoices(PixelSampler);

impl RandomChoices {
    fn new(seed: u64) -> RandomChoices {
        RandomChoices(PixelSampler::new(0, 0, seed))
    }

    /// A random number below `end`, which is not 0.
    fn below(&mut self, end: usize) -> usize {
        (self.0.next_1d() * end as f64) as usize
    }

    fn pick<'a, T: ?Sized>(&mut self, list: &[&'a T]) -> &'a T {
        list[self.below(list.len())]
    }
}

/// The byte ranges of the tokens of a text: words, numbers, names and signs.
fn tokens(text: &str) -> Vec<(usize, usize)> {
    let mut tokens = Vec::new();
    let mut start = 0;
    for (at, c) in text.char_indices() {
        if c.is_whitespace() || matches!(c, '<' | '>' | '"' | '=' | '/' | '#') {
            if start < at {
                tokens.push((start, at));
            }
            start = at + c.len_utf8();
        }
    }
    tokens
}

/// The text with one mutation, sometimes more.
fn damaged(text: &str, random: &mut RandomChoices) -> String {
    let mut text = damage(text, random);
    while random.below(3) == 0 {
        text = damage(&text, random);
    }
    text
}

fn damage(text: &str, random: &mut RandomChoices) -> String {
    if text.is_empty() {
        return random.pick(PIECES).to_owned();
    }
    let tokens = tokens(text);
    let mut bytes = text.as_bytes().to_vec();
    let at = random.below(bytes.len());
    match random.below(16) {
        0 => bytes[at] ^= 1 << random.below(8),
        1 => bytes.truncate(at),
        2 => {
            bytes.splice(at..at, random.pick(PIECES).bytes());
        }
        3 | 4 => return with_lines_duplicated(text, random),
        5 => return with_lines_removed(text, random),
        6..=10 if !tokens.is_empty() => {
            let (start, end) = tokens[random.below(tokens.len())];
            bytes.splice(start..end, random.pick(WORDS).bytes());
        }
        // Replaces a token by another token of the file: changes ids, references and tags.
        _ if !tokens.is_empty() => {
            let (from, to) = tokens[random.below(tokens.len())];
            let (start, end) = tokens[random.below(tokens.len())];
            bytes.splice(start..end, text.as_bytes()[from..to].iter().copied());
        }
        _ => {}
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Up to twelve lines of the text, usually whole elements.
fn some_lines(lines: &[&str], random: &mut RandomChoices) -> std::ops::Range<usize> {
    let first = random.below(lines.len());
    first..(first + 1 + random.below(12)).min(lines.len())
}

fn with_lines_duplicated(text: &str, random: &mut RandomChoices) -> String {
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let some = some_lines(&lines, random);
    let (before, after) = lines.split_at(random.below(lines.len()));
    [before, &lines[some], after].concat().concat()
}

fn with_lines_removed(text: &str, random: &mut RandomChoices) -> String {
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let some = some_lines(&lines, random);
    [&lines[..some.start], &lines[some.end..]].concat().concat()
}

/// Reads the file and checks the result. Returns whether it is a scene.
fn check(text: &str) -> bool {
    let outcome = scenes::parse("damaged.dae", text);
    let is_scene = outcome.is_ok();
    match outcome {
        Ok(loaded) => {
            for warning in &loaded.warnings {
                assert!(!warning.to_string().is_empty());
            }
            check_scene(&loaded.scene);
        }
        Err(error) => {
            assert!(!error.0.title().is_empty());
            assert!(error.to_string().contains("damaged.dae"), "{error}");
            assert!(error.styled().len() < 20_000, "the report is too long");
            assert!(error.0.what_to_do().is_some(), "{error}");
        }
    }
    is_scene
}

/// Tolerance for the length of unit normals.
const UNIT_TOLERANCE: f64 = 1e-9;

fn check_scene(scene: &Scene) {
    assert!(!scene.is_empty());
    assert_eq!(scene.object_of.len(), scene.len());
    assert!(
        scene
            .object_of
            .iter()
            .all(|object| (*object as usize) < scene.objects.len())
    );
    assert!(
        scene
            .objects
            .iter()
            .all(|object| (object.material as usize) < scene.materials.len())
    );
    for t in &scene.triangles {
        assert!(
            t.p0.is_finite() && t.p1.is_finite() && t.p2.is_finite(),
            "{t:?}"
        );
        for n in [t.n0, t.n1, t.n2] {
            // A triangle that has no area after its transform may have no normal.
            assert!(
                (n.length() - 1.0).abs() < UNIT_TOLERANCE || n.length() == 0.0,
                "{t:?}"
            );
        }
    }
    for s in &scene.spheres {
        assert!(
            s.center.is_finite() && s.radius.is_finite() && s.radius >= 0.0,
            "{s:?}"
        );
    }
    let film = FilmSize { w: 48, h: 36 };
    let view = placement::place(scene, film);
    let camera = &view.camera;
    assert!(
        camera.h_fov > 0.0 && camera.h_fov < 180.0 && camera.v_fov > 0.0 && camera.v_fov < 180.0,
        "{camera:?}"
    );
    assert!(
        camera.pos.is_finite() && camera.c2w.is_finite(),
        "{camera:?}"
    );
    let file = CameraFile::new(view, film);
    let read =
        CameraFile::parse("damaged.cam", &file.to_string()).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(read, file);
}

/// The value of an environment variable as a number.
fn number_in(variable: &str) -> Option<u64> {
    std::env::var(variable).ok()?.parse().ok()
}

/// Tests mutated files until `enough` returns true for the number of files so far. Prints the
/// slowest file. On a failure prints the seed.
fn run(enough: impl Fn(u64) -> bool) {
    let corpus = corpus();
    let mut slowest = (Duration::ZERO, 0);
    let mut scenes_read = 0;
    let first_seed = number_in("FIRSTLIGHT_FUZZ_SEED").unwrap_or(0);
    let mut seed = first_seed;
    while !enough(seed - first_seed) {
        let mut random = RandomChoices::new(seed);
        // Small files more often, because single numbers of a large mesh are all alike.
        let mut pick = random.below(corpus.len());
        while corpus[pick].1.len() > 50_000 && random.below(20) > 0 {
            pick = random.below(corpus.len());
        }
        let (name, text) = &corpus[pick];
        let text = damaged(text, &mut random);
        let start = Instant::now();
        let outcome = catch_unwind(AssertUnwindSafe(|| check(&text)));
        if start.elapsed() > slowest.0 {
            slowest = (start.elapsed(), seed);
        }
        match outcome {
            Ok(is_scene) => scenes_read += u64::from(is_scene),
            Err(panic) => {
                let start: String = text.chars().take(30_000).collect();
                println!("seed {seed}, {name}, damaged:\n{start}");
                std::panic::resume_unwind(panic);
            }
        }
        seed += 1;
    }
    println!(
        "{} damaged files: {scenes_read} gave a scene, the others an error; the slowest took {:?} (seed {})",
        seed - first_seed,
        slowest.0,
        slowest.1
    );
}

#[test]
fn damaged_files_give_a_valid_scene_or_an_error() {
    run(|done| done == 1_000);
}

#[test]
#[ignore = "runs for FIRSTLIGHT_FUZZ_SECONDS seconds"]
fn damaged_files_for_a_given_time() {
    let seconds = number_in("FIRSTLIGHT_FUZZ_SECONDS").unwrap_or(60);
    let end = Instant::now() + Duration::from_secs(seconds);
    run(|_| Instant::now() >= end);
}

/// Camera files with the same kinds of damage.
#[test]
fn damaged_camera_files_give_a_camera_or_an_error() {
    let scene = scenes::load(Path::new(env!("CARGO_MANIFEST_DIR")).join("dae/cornell_spheres.dae"))
        .unwrap()
        .scene;
    let film = FilmSize { w: 48, h: 36 };
    let text = CameraFile::new(placement::place(&scene, film), film).to_string();
    for seed in 0..5_000 {
        let damaged = damaged(&text, &mut RandomChoices::new(seed));
        match CameraFile::parse("damaged.cam", &damaged) {
            Ok(file) => {
                let camera = file.view.camera;
                assert!(
                    camera.pos.is_finite()
                        && camera.c2w.is_finite()
                        && file.film.w > 0
                        && file.film.h > 0
                );
                assert_eq!(
                    CameraFile::parse("again.cam", &file.to_string()).unwrap(),
                    file,
                    "{damaged}"
                );
            }
            Err(error) => assert!(error.0.what_to_do().is_some(), "{error}"),
        }
    }
}
