//! A case, its truth and a library's answers as files: little-endian numbers, nothing else.

use kit::{Ray, Triangle, Vec3};
use std::fs;
use std::io;
use std::path::Path;

/// The first eight bytes of a case.
const CASE: &[u8; 8] = b"FLRAYS01";

/// The first eight bytes of answers.
const ANSWERS: &[u8; 8] = b"FLHITS01";

/// The numbers of one answer: t in units of the direction's length (infinite for a miss), the
/// triangle (-1 for a miss), the number of hits along the ray. NaN where a library does not report
/// one.
pub(crate) const FIELDS: usize = 3;

/// A mesh and rays. All coordinates are representable in single precision, so every library gets
/// the same input.
#[derive(Clone, Debug, Default)]
pub(crate) struct Case {
    pub(crate) vertices: Vec<Vec3>,
    pub(crate) faces: Vec<[u32; 3]>,
    pub(crate) rays: Vec<Ray>,
}

impl Case {
    pub(crate) fn triangles(&self) -> Vec<Triangle> {
        let corner = |vertex: u32| self.vertices[vertex as usize];
        let flat = |[a, b, c]: &[u32; 3]| Triangle::flat(corner(*a), corner(*b), corner(*c));
        self.faces.iter().map(flat).collect()
    }

    /// Writes the three counts, the vertices (three `f64` each), the faces (three `u32` each) and
    /// the rays: origin, direction, `min_t`, `max_t` (eight `f64` each).
    pub(crate) fn write(&self, path: &Path) -> io::Result<()> {
        let mut bytes = CASE.to_vec();
        for count in [self.vertices.len(), self.faces.len(), self.rays.len()] {
            bytes.extend((count as u32).to_le_bytes());
        }
        for vertex in &self.vertices {
            bytes.extend(vertex.to_array().iter().flat_map(|x| x.to_le_bytes()));
        }
        bytes.extend(self.faces.iter().flatten().flat_map(|i| i.to_le_bytes()));
        for ray in &self.rays {
            let ([a, b, c], [d, e, f]) = (ray.o.to_array(), ray.d.to_array());
            let numbers = [a, b, c, d, e, f, ray.min_t, ray.max_t];
            bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        }
        fs::write(path, bytes)
    }

    pub(crate) fn read(path: &Path) -> io::Result<Case> {
        let bytes = fs::read(path)?;
        let mut reader = Reader::new(&bytes, CASE)?;
        let [vertices, faces, rays] = [(); 3].map(|()| reader.u32());
        let vec3 = |reader: &mut Reader| Vec3::from_array([(); 3].map(|()| reader.f64()));
        let case = Case {
            vertices: (0..vertices).map(|_| vec3(&mut reader)).collect(),
            faces: (0..faces).map(|_| [(); 3].map(|()| reader.u32())).collect(),
            rays: (0..rays)
                .map(|_| Ray {
                    o: vec3(&mut reader),
                    d: vec3(&mut reader),
                    min_t: reader.f64(),
                    max_t: reader.f64(),
                })
                .collect(),
        };
        reader.end()?;
        Ok(case)
    }
}

/// What a library, or the oracle, answers to the first rays of a case.
#[derive(Clone, Debug, Default)]
pub(crate) struct Answers {
    /// Seconds of processor time for all rays, without reading, building and writing.
    pub(crate) seconds: f64,
    pub(crate) hits: Vec<[f64; FIELDS]>,
}

impl Answers {
    /// Writes the number of answers, the seconds and [`FIELDS`] numbers for each answer.
    pub(crate) fn write(&self, path: &Path) -> io::Result<()> {
        let mut bytes = ANSWERS.to_vec();
        bytes.extend((self.hits.len() as u32).to_le_bytes());
        bytes.extend(self.seconds.to_le_bytes());
        bytes.extend(self.hits.iter().flatten().flat_map(|x| x.to_le_bytes()));
        fs::write(path, bytes)
    }

    pub(crate) fn read(path: &Path) -> io::Result<Answers> {
        let bytes = fs::read(path)?;
        let mut reader = Reader::new(&bytes, ANSWERS)?;
        let count = reader.u32();
        let seconds = reader.f64();
        let hits = (0..count)
            .map(|_| [(); FIELDS].map(|()| reader.f64()))
            .collect();
        reader.end()?;
        Ok(Answers { seconds, hits })
    }
}

/// Reads numbers from bytes.
struct Reader<'a> {
    rest: &'a [u8],
    /// Whether a number was read beyond the end.
    is_short: bool,
}

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8], kind: &[u8; 8]) -> io::Result<Reader<'a>> {
        let rest = bytes.strip_prefix(kind);
        let is_short = false;
        rest.map(|rest| Reader { rest, is_short }).ok_or_else(|| {
            let expected = String::from_utf8_lossy(kind);
            io::Error::other(format!("the file does not begin with {expected}"))
        })
    }

    /// An error if the file is shorter or longer than its counts say.
    fn end(&self) -> io::Result<()> {
        match self.is_short || !self.rest.is_empty() {
            true => Err(io::Error::other(
                "the file's length differs from its counts",
            )),
            false => Ok(()),
        }
    }

    fn take<const N: usize>(&mut self) -> [u8; N] {
        let (first, rest) = self.rest.split_at(N.min(self.rest.len()));
        self.rest = rest;
        first.try_into().unwrap_or_else(|_| {
            self.is_short = true;
            [0; N]
        })
    }

    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }

    fn f64(&mut self) -> f64 {
        f64::from_le_bytes(self.take())
    }
}
