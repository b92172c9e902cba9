//! The command line of the `pathtracer` program.

use crate::common::{folder_of, square};
use snapbox::cmd::{Command, cargo_bin};
use std::fs;
use std::path::Path;

/// A square of two triangles, seen from the front.
fn folder() -> tempfile::TempDir {
    folder_of("square.dae", &square("", ""))
}

fn pathtracer(folder: &Path, args: &str) -> snapbox::cmd::OutputAssert {
    Command::new(cargo_bin!("pathtracer"))
        .current_dir(folder)
        // Without a display no window opens.
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .args(args.split(' '))
        .assert()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let name = |e: std::io::Result<fs::DirEntry>| e.expect("an entry").file_name();
    let mut names: Vec<String> = entries
        .map(|e| name(e).to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// Runs with invalid values: exit code 2, the message on stderr, no file written.
fn refused(args: &str, message: &str) {
    let folder = folder();
    let run = pathtracer(folder.path(), args).code(2);
    let output = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    assert!(output.contains(message), "`{args}` prints:\n{output}");
    assert_eq!(names(folder.path()), ["square.dae"], "after `{args}`");
}

#[test]
fn errors_name_the_allowed_values() {
    refused("square.dae", "pathtracer -f picture.png square.dae");
    refused("square.dae", "there is no display");
    refused("--pixel 480 0 square.dae", "choose X from 0 to 479");
    refused("--pixel 0 360 square.dae", "Y from 0 to 359");
    refused("-f a.png -s 0 square.dae", "whole number from 1 to");
    refused("-f a.png --seed x square.dae", "whole number from 0 to");
    refused("-f a.png --seed -1 square.dae", "whole number from 0 to");
    refused("-f a.png -s many square.dae", "whole number from 1 to");
    refused("-f a.png -t 0 square.dae", "whole number from 1 to 1024");
    refused("-f a.png -l 0 square.dae", "whole number from 1 to");
    refused("-f a.png -m -1 square.dae", "whole number from 0 to");
    refused("-f a.png -r 0 10 square.dae", "whole number from 1 to");
    refused(
        "-f a.png -r 100000 100000 square.dae",
        "at most 100 million pixels",
    );
    refused("-f a.png -r 4 4 -p 2 2 3 1 square.dae", "x + dx at most 4");
    refused(
        "-f a.png -r 4 4 -p 2 2 0 1 square.dae",
        "at least one pixel",
    );
    refused("-f a.png -a 0 0.1 square.dae", "samples per batch");
    refused("-f a.png -a 8 nan square.dae", "such as 0.05");
    refused("-f a.png -a 8 -0.1 square.dae", "such as 0.05");
    refused("-f a.png -e sky.exr square.dae", "sky.exr");
    refused("-f a.png --shade light square.dae", "normals");
    refused("-f a.png --accel fast square.dae", "brute, bvh");
    refused("-f a.gif square.dae", "ends in .png, .exr or .hdr");
    refused("-f . square.dae", "is a folder");
    refused("-f nowhere/a.png square.dae", "cannot write nowhere/a.png");
    refused("-f a.png missing.dae", "missing.dae");
    refused("-f a.png -c missing.txt square.dae", "missing.txt");
}

// BEGIN SOLUTION(part1.task3)
#[test]
fn a_picture_and_a_summary_are_written() {
    let folder = folder();
    let run = pathtracer(folder.path(), "-f a.png -r 40 30 -s 4 square.dae").success();
    let output = String::from_utf8_lossy(&run.get_output().stdout).into_owned();
    assert!(
        output.contains("2 primitives (2 triangles, 0 spheres)"),
        "{output}"
    );
    assert!(output.contains("4800"), "40 x 30 x 4 rays in:\n{output}");
    let stderr = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    assert_eq!(stderr, "", "no progress bar in a pipe");
    assert_eq!(names(folder.path()), ["a.png", "square.dae"]);
    let picture = image::open(folder.path().join("a.png"))
        .expect("a picture")
        .to_rgb8();
    assert_eq!(picture.dimensions(), (40, 30));
    // The normal +z: (1/2, 1/2, 1) after tone mapping. Beside the square rays miss.
    assert_eq!(picture.get_pixel(20, 15).0, [217, 217, 255]);
    assert_eq!(picture.get_pixel(0, 15).0, [0, 0, 0]);
}

/// As in `pathtracer --help | head -1`: nobody reads what the program prints, which still does its
/// work.
#[test]
fn the_picture_is_written_when_nobody_reads_the_summary() {
    let folder = folder();
    for args in ["--help", "-f a.png -r 8 8 square.dae"] {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let output = std::process::Command::new(cargo_bin!("pathtracer"))
            .current_dir(folder.path())
            .args(args.split(' '))
            .stdout(writer)
            .output()
            .expect("it runs");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!((output.status.code(), &*stderr), (Some(0), ""), "{args}");
    }
    assert!(folder.path().join("a.png").is_file());
}

#[test]
fn a_cell_has_the_pixels_of_the_whole_picture() {
    let folder = folder();
    pathtracer(folder.path(), "-f all.png -r 40 30 -s 4 square.dae").success();
    pathtracer(
        folder.path(),
        "-f cell.png -r 40 30 -s 4 -p 5 2 20 11 square.dae",
    )
    .success();
    let open = |name| {
        image::open(folder.path().join(name))
            .expect("a picture")
            .to_rgb8()
    };
    let (all, cell) = (open("all.png"), open("cell.png"));
    assert_eq!(cell.dimensions(), (20, 11));
    for (x, y, pixel) in cell.enumerate_pixels() {
        // Rows count from the top here: the cell starts 30 - (2 + 11) rows below the top of the
        // picture.
        assert_eq!(pixel, all.get_pixel(x + 5, y + 17));
    }
}

/// The replay of a pixel as text: every ray and every test, and the pixel itself.
#[test]
fn a_pixel_is_replayed_as_text() {
    let folder = folder();
    let run = pathtracer(folder.path(), "--pixel 20 15 -r 40 30 -s 2 square.dae").success();
    let text = String::from_utf8_lossy(&run.get_output().stdout).into_owned();
    for line in [
        "Pixel       20 15 of 40 x 30, counted from the bottom left",
        "Linear      0.5 0.5 1.0",
        "8 bit       217 217 255",
        "Samples     2",
        "Replay      2 samples: their mean is the pixel of the picture, bit for bit",
        "camera ray: o = (",
        "of `wall` at t = ",
        "n = (0.0, 0.0, 1.0) (shading normal)",
        "ng = (0.0, 0.0, 1.0) (geometric normal)",
        "triangle 1 of `wall`: ",
    ] {
        assert!(text.contains(line), "no `{line}` in:\n{text}");
    }
    assert_eq!(names(folder.path()), ["square.dae"], "nothing is written");
}

#[test]
fn exr_has_linear_values() {
    let folder = folder();
    pathtracer(folder.path(), "-f a.exr -r 41 31 square.dae").success();
    let picture = image::open(folder.path().join("a.exr"))
        .expect("a picture")
        .to_rgb32f();
    assert_eq!(picture.dimensions(), (41, 31));
    assert_eq!(picture.get_pixel(20, 15).0, [0.5, 0.5, 1.0]);
}

#[test]
fn flags_without_effect_are_noted() {
    let folder = folder();
    let args = "-f a.png -r 4 3 -l 4 -m 5 -a 8 0.05 -H square.dae";
    let run = pathtracer(folder.path(), args).success();
    let output = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    assert!(output.contains("-l -m -a -H"), "{output}");
    assert_eq!(output.lines().count(), 1, "{output}");
}

#[test]
fn neither_pictures_nor_counts_depend_on_threads() {
    let folder = folder();
    let run = |flags: &str| {
        let args = format!("-f a.png -r 50 40 -s 3 {flags} square.dae");
        let run = pathtracer(folder.path(), &args).success();
        let output = String::from_utf8_lossy(&run.get_output().stdout).into_owned();
        let tests = output.lines().find(|line| line.starts_with("Tests"));
        let picture = fs::read(folder.path().join("a.png")).expect("a picture");
        (picture, tests.expect("a line with the tests").to_owned())
    };
    let one = run("-t 1");
    assert_eq!(run("-t 2"), one);
    assert_eq!(run("-t 8"), one);

    let (picture, tests) = run("-t 2 --accel brute");
    assert_eq!(picture, one.0, "the tree changes a pixel");
    // 50 x 40 x 3 rays, two triangles.
    assert!(
        tests.contains("0.00 of boxes (0), 2.00 of primitives (12000)"),
        "{tests}"
    );

    assert_ne!(
        run("-t 1 --seed 1").0,
        one.0,
        "another seed gives other edge pixels"
    );
}
// END SOLUTION(part1.task3)
