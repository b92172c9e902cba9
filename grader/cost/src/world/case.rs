//! A case, its truth and a library's answers as files: little-endian numbers, nothing else.

use kit::{Ray, Triangle, Vec3};
use meshes::IndexedMesh;
use std::fmt::Display;
use std::fs;
use std::io;
use std::path::Path;

/// The first eight bytes of a case.
const CASE: &[u8; 8] = b"FLRAYS01";

/// The first eight bytes of answers.
const ANSWERS: &[u8; 8] = b"FLHITS01";

/// A mesh and rays. All coordinates are representable in single precision, so every library gets
/// the same input.
#[derive(Clone, Debug, Default)]
pub struct Case {
    /// The mesh.
    pub mesh: IndexedMesh,
    /// The rays.
    pub rays: Vec<Ray>,
}

impl Case {
    /// The triangles, in the order of the faces.
    pub fn triangles(&self) -> Vec<Triangle> {
        self.mesh.flat_triangles()
    }

    /// Writes the three counts, the vertices (three `f64` each), the faces (three `u32` each) and
    /// the rays: origin, direction, `min_t`, `max_t` (eight `f64` each).
    pub(super) fn write(&self, path: &Path) -> io::Result<()> {
        let IndexedMesh { positions, faces } = &self.mesh;
        let mut bytes = CASE.to_vec();
        for count in [positions.len(), faces.len(), self.rays.len()] {
            bytes.extend((count as u32).to_le_bytes());
        }
        let vertices = positions.iter().flat_map(|p| p.to_array());
        bytes.extend(vertices.flat_map(f64::to_le_bytes));
        bytes.extend(faces.iter().flatten().flat_map(|i| i.to_le_bytes()));
        let rays = self.rays.iter().flat_map(|ray| {
            let ([a, b, c], [d, e, f]) = (ray.o.to_array(), ray.d.to_array());
            [a, b, c, d, e, f, ray.min_t, ray.max_t]
        });
        bytes.extend(rays.flat_map(f64::to_le_bytes));
        fs::write(path, bytes)
    }
}

/// One answer to one ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayAnswer {
    /// `t` in lengths of the direction; infinite for a miss.
    pub t: f64,
    /// The triangle; -1 for a miss, NaN if it is not reported.
    pub triangle: f64,
    /// The number of hits along the ray; NaN if it is not reported.
    pub count: f64,
}

impl RayAnswer {
    /// The answer of an interface that reports the closest hit and nothing else.
    pub fn closest(t: Option<f64>) -> RayAnswer {
        RayAnswer {
            t: t.unwrap_or(f64::INFINITY),
            triangle: if t.is_some() { f64::NAN } else { -1.0 },
            count: f64::NAN,
        }
    }
}

/// What a library, or the oracle, answers to the first rays of a case.
#[derive(Clone, Debug, Default)]
pub struct Answers {
    /// Seconds of processor time for all rays, without reading, building and writing.
    pub seconds: f64,
    /// An answer for each ray.
    pub rays: Vec<RayAnswer>,
}

impl Answers {
    /// Writes the number of answers, the seconds and three `f64` for each answer.
    pub(super) fn write(&self, path: &Path) -> io::Result<()> {
        let mut bytes = ANSWERS.to_vec();
        bytes.extend((self.rays.len() as u32).to_le_bytes());
        bytes.extend(self.seconds.to_le_bytes());
        let numbers = self.rays.iter().flat_map(|a| [a.t, a.triangle, a.count]);
        bytes.extend(numbers.flat_map(f64::to_le_bytes));
        fs::write(path, bytes)
    }

    /// Reads what [`Answers::write`] or an adapter wrote.
    ///
    /// # Errors
    ///
    /// If the file cannot be read, is of another kind, or is shorter or longer than its count says.
    pub(super) fn read(path: &Path) -> io::Result<Answers> {
        let wrong = |what: &str| file_error(path, what);
        let bytes = fs::read(path).map_err(|e| file_error(path, e))?;
        let is_short = || wrong("the file ends before its count and time");
        let rest = bytes
            .strip_prefix(ANSWERS)
            .ok_or_else(|| wrong("expected answers, which begin with FLHITS01"))?;
        let (count, rest) = rest.split_first_chunk().ok_or_else(is_short)?;
        let (seconds, rest) = rest.split_first_chunk().ok_or_else(is_short)?;
        let (numbers, over) = rest.as_chunks::<8>();
        let count = u32::from_le_bytes(*count) as usize;
        if numbers.len() != 3 * count || !over.is_empty() {
            let found = rest.len();
            let what = format!("expected {count} answers of 24 bytes, found {found} bytes");
            return Err(wrong(&what));
        }
        let (answers, _) = numbers.as_chunks::<3>();
        let rays = answers.iter().map(|numbers| {
            let [t, triangle, count] = numbers.map(f64::from_le_bytes);
            RayAnswer { t, triangle, count }
        });
        Ok(Answers {
            seconds: f64::from_le_bytes(*seconds),
            rays: rays.collect(),
        })
    }
}

/// What is wrong with a file.
pub(super) fn file_error(path: &Path, what: impl Display) -> io::Error {
    io::Error::other(format!("{}: {what}", path.display()))
}

/// Rounds to single precision.
pub(super) trait Rounded {
    /// The nearest value that `f32` can represent.
    fn rounded(self) -> Self;
}

impl Rounded for Vec3 {
    fn rounded(self) -> Vec3 {
        self.as_vec3().as_dvec3()
    }
}
