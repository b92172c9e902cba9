//! Reads cases, runs a library on them and writes its answers. An adapter calls [`run`] once for
//! each row.

use rustix::time::{ClockId, clock_gettime};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::{env, fs};

/// A mesh.
pub struct Mesh {
    /// Coordinates.
    pub vertices: Vec<[f64; 3]>,
    /// Three vertices each.
    pub faces: Vec<[u32; 3]>,
}

/// Origin, direction, `min_t`, `max_t`.
pub type Ray = [f64; 8];

/// What is said of a row: library, version, interface, precision.
pub struct About(pub &'static str, pub &'static str, pub &'static str, pub &'static str);

/// The columns that an interface without a start of the range leaves out.
pub const NO_START: &[&str] = &["at_start"];

/// The columns that an interface without ranges leaves out.
pub const NO_RANGE: &[&str] = &["at_start", "at_end"];

/// Answers every case with `build` and `trace`, which returns t in units of the direction's length
/// (infinite for a miss), the triangle (-1) and the number of hits; NaN for what is not reported.
pub fn run<S>(
    row: &str,
    about: About,
    without: &[&str],
    build: impl Fn(&Mesh) -> S,
    mut trace: impl FnMut(&S, &Ray) -> [f64; 3],
) {
    let arguments: Vec<PathBuf> = env::args().skip(1).map(PathBuf::from).collect();
    let [cases, out] = &arguments[..] else {
        panic!("usage: ADAPTER CASES OUT")
    };
    let out = out.join(row);
    fs::create_dir_all(&out).expect("OUT can be written");
    let About(library, version, interface, precision) = about;
    let about = format!("library\t{library}\nversion\t{version}\ninterface\t{interface}\nprecision\t{precision}\n");
    fs::write(out.join("about.tsv"), about).expect("OUT can be written");
    let only = env::var("RAY_COLUMNS").ok();
    for entry in fs::read_dir(cases).expect("CASES can be read").flatten() {
        let path = entry.path();
        let column = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let wanted = only.as_ref().is_none_or(|only| only.split(',').any(|name| name == column));
        if path.extension().is_none_or(|end| end != "case") || !wanted || without.contains(&&column[..]) {
            continue;
        }
        let [answer, error] = ["answer", "error"].map(|end| out.join(&column).with_extension(end));
        for earlier in [&answer, &error].into_iter().filter(|file| file.exists()) {
            fs::remove_file(earlier).expect("OUT can be written");
        }
        let (mesh, rays) = read(&path);
        let answered = catch_unwind(AssertUnwindSafe(|| {
            let scene = build(&mesh);
            let before = thread_seconds();
            let hits: Vec<[f64; 3]> = rays.iter().map(|ray| trace(&scene, ray)).collect();
            (thread_seconds() - before, hits)
        }));
        match answered {
            Ok((seconds, hits)) => {
                let mut bytes = b"FLHITS01".to_vec();
                bytes.extend((hits.len() as u32).to_le_bytes());
                bytes.extend(seconds.to_le_bytes());
                bytes.extend(hits.iter().flatten().flat_map(|x| x.to_le_bytes()));
                fs::write(answer, bytes).expect("OUT can be written");
            }
            Err(payload) => {
                let literal = || payload.downcast_ref::<&str>().map(|text| text.to_string());
                let text = payload.downcast_ref::<String>().cloned().or_else(literal).unwrap_or_default();
                let first = text.lines().next().unwrap_or_default();
                fs::write(error, format!("panic: {first}\n")).expect("OUT can be written");
            }
        }
    }
}

fn thread_seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

fn read(path: &Path) -> (Mesh, Vec<Ray>) {
    let bytes = fs::read(path).expect("a case can be read");
    let u32 = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes"));
    let f64 = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight bytes"));
    let [n, m, k] = [8, 12, 16].map(|at| u32(at) as usize);
    let (faces, rays) = (20 + 24 * n, 20 + 24 * n + 12 * m);
    let mesh = Mesh {
        vertices: (0..n).map(|i| [0, 8, 16].map(|at| f64(20 + 24 * i + at))).collect(),
        faces: (0..m).map(|i| [0, 4, 8].map(|at| u32(faces + 12 * i + at))).collect(),
    };
    let ray = |i: usize| std::array::from_fn(|j| f64(rays + 64 * i + 8 * j));
    (mesh, (0..k).map(ray).collect())
}

/// A hit at `t`, or a miss, without anything else.
pub fn only_t(t: Option<f64>) -> [f64; 3] {
    match t {
        Some(t) => [t, f64::NAN, f64::NAN],
        None => [f64::INFINITY, -1.0, f64::NAN],
    }
}
