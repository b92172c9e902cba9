//! A rough landscape: mountains with detail at the size of single triangles.

use super::indexed_mesh::IndexedMesh;
use super::noise::gradient_noise;
use kit::Vec3;

/// Heights are in about [0, RELIEF] above the plane y = 0.
const RELIEF: f64 = 0.9;

/// The largest mesh of at most `triangles` triangles: 2n², over the square [-1, 1]² in x and z.
/// Open below and at the boundary.
pub(super) fn mesh(triangles: usize) -> IndexedMesh {
    let n = ((triangles as f64 / 2.0).sqrt() as u32).max(1);
    // Each octave halves the size of features. The last one is about two grid squares wide.
    let octaves = n.ilog2().max(2);
    let at = |i: u32| 2.0 * f64::from(i) / f64::from(n) - 1.0;
    let mut mesh = IndexedMesh::default();
    let side = n as usize + 1;
    mesh.positions.reserve(side * side);
    for i in 0..=n {
        for j in 0..=n {
            let (x, z) = (at(i), at(j));
            mesh.positions.push(Vec3::new(x, height(x, z, octaves), z));
        }
    }
    mesh.faces.reserve(2 * (n as usize) * (n as usize));
    for i in 0..n {
        for j in 0..n {
            let a = i * (n + 1) + j;
            let (b, c, d) = (a + 1, a + n + 2, a + n + 1);
            mesh.faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

/// Ridged noise: the folds of |noise| form crests, and each octave is stronger where the previous
/// one is high (F. K. Musgrave, "Procedural fractal terrains", in Ebert et al., Texturing &
/// Modeling, 1994). The height falls to 0 at the boundary.
fn height(x: f64, z: f64, octaves: u32) -> f64 {
    let mut sum = 0.0;
    let mut amplitude = 0.5;
    let mut frequency = 1.9;
    let mut weight: f64 = 1.0;
    for octave in 0..octaves {
        // Each octave uses a different plane, which is off the lattice, where the noise would be 0.
        let p = Vec3::new(frequency * x, 0.5 + f64::from(octave), frequency * z);
        let ridge = 1.0 - gradient_noise(p, 17).abs().min(1.0);
        let crest = ridge * ridge * weight;
        sum += amplitude * crest;
        weight = (2.0 * crest - 0.3).clamp(0.0, 1.0);
        // Slightly more than half: slopes get steeper with every octave, so the terrain is rough at
        // every scale.
        amplitude *= 0.53;
        frequency *= 2.03;
    }
    let shore = |u: f64| 1.0 - u * u * u * u;
    RELIEF * (sum - 0.35).max(0.0) * shore(x) * shore(z)
}
