//! Parts of a picture merge into the bits of one run.
// BEGIN SOLUTION(part6.task1)

use crate::common::run;
use snapbox::cmd::cargo_bin;
use std::fs;
use std::path::Path;

const SCENE: &str = "cornell_mirror_glass.dae";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/dae");
    fs::copy(scenes.join(SCENE), folder.path().join(SCENE)).expect("a copy");
    folder
}

fn render(folder: &Path, flags: &str) {
    let (code, _, stderr) = run(folder, &format!("{flags} {SCENE}"));
    assert_eq!((code, stderr.as_str()), (0, ""), "{flags}");
}

fn bytes(folder: &Path, name: &str) -> Vec<u8> {
    fs::read(folder.join(name)).expect(name)
}

const FLAGS: &str = "-r 40 30 -m 4 --seed 3";

/// Cells and ranges, of different machines, so with different threads and trees, in any order, also
/// merged in two steps; with the samplers whose samples do not depend on their number.
#[test]
fn parts_merge_into_the_bits_of_one_run() {
    for sampler in ["sobol4", "sobol", "independent"] {
        let folder = folder();
        let folder = folder.path();
        let flags = format!("{FLAGS} --sampler {sampler}");
        render(folder, &format!("{flags} -s 21 -f whole.exr"));
        render(folder, &format!("{flags} -s 21 -f whole.png"));
        render(folder, &format!("{flags} -s 21 -f whole.sums"));
        for (name, part) in [
            ("a", "-s 5 -t 1"),
            ("b", "--first-sample 5 -s 3 --accel bvh"),
            ("c", "--first-sample 8 -s 13 -p 0 0 17 30 -t 3"),
            ("d", "--first-sample 8 -s 13 -p 17 0 23 30"),
        ] {
            render(folder, &format!("{flags} {part} -f {name}.sums"));
        }
        let parts = "d.sums b.sums a.sums c.sums";
        for end in ["exr", "png", "sums"] {
            let (code, out, notes) = run(folder, &format!("merge -f all.{end} {parts}"));
            assert_eq!((code, notes.as_str()), (0, ""));
            assert!(
                out.contains("4 parts: 40 x 30 pixels, samples 0 to 20"),
                "{out}"
            );
            let whole = bytes(folder, &format!("whole.{end}"));
            assert!(
                bytes(folder, &format!("all.{end}")) == whole,
                "{sampler} {end}"
            );
        }
        let (code, _, notes) = run(folder, "merge -f right.sums c.sums d.sums");
        assert_eq!(code, 0);
        assert!(notes.contains("sample 8 on"), "{notes}");
        let (code, ..) = run(folder, "merge -f two.exr right.sums a.sums b.sums");
        assert_eq!(code, 0);
        assert!(bytes(folder, "two.exr") == bytes(folder, "whole.exr"));
    }
}

#[test]
fn adaptive_cells_merge_with_their_sample_counts() {
    let folder = folder();
    let folder = folder.path();
    let flags = format!("{FLAGS} -s 64 -a 8 0.3");
    render(folder, &format!("{flags} -f whole.png"));
    render(folder, &format!("{flags} -p 0 0 40 11 -f a.sums"));
    render(folder, &format!("{flags} -p 0 11 40 19 -f b.sums"));
    let (code, out, _) = run(folder, "merge a.sums b.sums -f all.png");
    assert_eq!(code, 0);
    assert!(out.contains("all_rate.png"), "{out}");
    assert!(bytes(folder, "all.png") == bytes(folder, "whole.png"));
    assert!(bytes(folder, "all_rate.png") == bytes(folder, "whole_rate.png"));
}

/// A part depends on all that was read and on what flags make of it, not on the scene's file alone.
#[test]
fn parts_of_changed_materials_or_normals_are_refused() {
    let kept = folder();
    let folder = kept.path();
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).expect("a file");
    write(
        "s.obj",
        "mtllib s.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0.6 0 0.8\nusemtl m\nf 1//1 2//2 3//1\n",
    );
    let part = |name: &str, flags: &str| {
        let (code, _, notes) = run(folder, &format!("s.obj -r 8 6 {flags} -f {name}.sums"));
        assert_eq!(code, 0, "{notes}");
    };
    const PICTURE: &str = "p.png";
    let (code, ..) = run(folder, &format!("s.obj -r 2 2 -f {PICTURE}"));
    assert_eq!(code, 0);
    write("s.mtl", "newmtl m\nKd 0.5 0.5 0.5\n");
    part("a", "-s 4");
    part("flat", "-s 4 --first-sample 4 --normals flat");
    part("same", "-s 4 --first-sample 4");
    write("s.mtl", "newmtl m\nKd 0.5 0.9 0.5\n");
    part("green", "-s 4 --first-sample 4");
    // A texture that is not where the file says, but beside it.
    write("s.mtl", "newmtl m\nmap_Kd C:\\pictures\\t.png\n");
    part("grey", "-s 4");
    fs::copy(folder.join(PICTURE), folder.join("t.png")).expect("a copy");
    part("moved", "-s 4 --first-sample 4");
    for parts in [
        "a.sums flat.sums",
        "a.sums green.sums",
        "grey.sums moved.sums",
    ] {
        let merge = format!("merge -f all.exr {parts}");
        refused(folder, &merge, "not parts of one picture");
    }
    assert_eq!(run(folder, "merge -f all.exr a.sums same.sums").0, 0);
}

fn refused(folder: &Path, args: &str, sentence: &str) {
    let (code, _, output) = run(folder, args);
    assert_eq!(code, 2, "`{args}` prints:\n{output}");
    assert!(output.contains(sentence), "`{args}` prints:\n{output}");
}

#[test]
fn what_does_not_fit_is_refused() {
    let folder = folder();
    let folder = folder.path();
    render(folder, &format!("{FLAGS} -s 4 -f a.sums"));
    render(folder, &format!("{FLAGS} -s 4 --first-sample 8 -f c.sums"));
    render(
        folder,
        &format!("{FLAGS} -s 4 --first-sample 4 -l 2 -f l.sums"),
    );
    render(
        folder,
        "-r 40 30 -m 4 --seed 4 -s 4 --first-sample 4 -f seed.sums",
    );
    fs::write(folder.join("text.sums"), "no sums").expect("a file");
    for (args, sentence) in [
        (
            "-f all.png a.sums c.sums",
            "render it with --first-sample 4 -s 4",
        ),
        ("-f all.png a.sums a.sums", "have the same samples"),
        ("-f all.png a.sums l.sums", "not parts of one picture"),
        ("-f all.png a.sums seed.sums", "not parts of one picture"),
        ("-f all.png a.sums none.sums", "none.sums cannot be read"),
        ("-f all.png text.sums", "text.sums is not a file of sums"),
        ("-f all.png a.sums .", ". is a folder, a pipe or a device"),
        ("-f all.gif a.sums", "or in .sums for a part"),
        ("-f a.sums a.sums", "a.sums is also a part"),
    ] {
        refused(folder, &format!("merge {args}"), sentence);
        assert!(!folder.join("all.png").exists(), "{args}");
    }
    for (flags, sentence) in [
        ("--first-sample 4 -s 1 -f b.sums", "at least -s 2"),
        (
            "--first-sample 4 -s 4 --sampler stratified -f b.sums",
            "use sobol or independent",
        ),
        ("--first-sample 4 -s 8 -a 4 0.1 -f b.sums", "--adaptive"),
        (
            "--time 1 -f b.sums",
            "--time: a .sums file needs a fixed number",
        ),
        (
            "--first-sample 4000000000 -s 8 -f b.sums",
            "whole number from 0 to",
        ),
    ] {
        refused(folder, &format!("{flags} {SCENE}"), sentence);
    }
}

/// Runs a template of `cluster`, with `bin` before the other programs. Returns whether it succeeded
/// and what it printed.
#[cfg(unix)]
fn template(folder: &Path, name: &str, bin: &Path, args: &str) -> (bool, String) {
    let script = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("cluster")
        .join(name);
    let path = std::env::var("PATH").unwrap_or_default();
    let run = std::process::Command::new("sh")
        .arg(script)
        .args(args.split_whitespace())
        .current_dir(folder)
        .env("PATHTRACER", cargo_bin!("pathtracer"))
        .env("PATH", format!("{}:{path}", bin.display()))
        .output()
        .expect("sh runs");
    let text = [run.stdout, run.stderr].concat();
    (
        run.status.success(),
        String::from_utf8_lossy(&text).into_owned(),
    )
}

/// A `sbatch` that runs each job at once, task by task. Tasks get what a real one gives them.
#[cfg(unix)]
const SBATCH: &str = r#"#!/bin/sh
set -eu
tasks=none
while :; do
    case "$1" in
    --array=0-*) tasks=$(seq 0 "${1#--array=0-}") ;;
    --dependency=*) test "$1" = --dependency=afterok:17 ;;
    --*) ;;
    *) break ;;
    esac
    shift
done
for task in $tasks; do
    if [ "$task" = none ]; then sh "$@"; else SLURM_ARRAY_TASK_ID=$task sh "$@" >&2; fi
done
echo "17;cluster"
"#;

#[cfg(unix)]
#[test]
fn the_template_for_slurm_renders_the_bits_of_one_run() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let bin = folder.path().join("bin");
    fs::create_dir(&bin).expect("a folder");
    let sbatch = bin.join("sbatch");
    fs::write(&sbatch, SBATCH).expect("a script");
    fs::set_permissions(&sbatch, fs::Permissions::from_mode(0o755)).expect("its mode");
    check_template(folder.path(), "slurm.sh", &bin);
}

/// Does nothing where GNU parallel is not installed.
#[cfg(unix)]
#[test]
fn the_template_for_parallel_renders_the_bits_of_one_run() {
    let version = std::process::Command::new("parallel")
        .arg("--version")
        .output();
    if !version.is_ok_and(|out| String::from_utf8_lossy(&out.stdout).contains("GNU parallel")) {
        eprintln!("note: GNU parallel is not installed: its template is not tested");
        return;
    }
    let folder = folder();
    check_template(folder.path(), "parallel.sh", Path::new("/usr/bin"));
}

#[cfg(unix)]
fn check_template(folder: &Path, name: &str, bin: &Path) {
    render(folder, &format!("{FLAGS} -s 12 -f whole.exr"));
    let (done, text) = template(folder, name, bin, &format!("4 12 all.exr {FLAGS} {SCENE}"));
    assert!(done, "{name} prints:\n{text}");
    assert!(text.contains("4 parts"), "{name} prints:\n{text}");
    assert!(
        bytes(folder, "all.exr") == bytes(folder, "whole.exr"),
        "{name}"
    );
    let (done, text) = template(folder, name, bin, &format!("5 12 all.exr {FLAGS} {SCENE}"));
    assert!(
        !done && text.contains("a multiple of PARTS"),
        "{name} prints:\n{text}"
    );
}
// END SOLUTION(part6.task1)
