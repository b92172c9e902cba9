//! How the cost of a ray grows with the size of the mesh.

use super::Speedup;
use serde::Serialize;

/// How the cost of a ray grows with the number of triangles n: as n^k. The exponent k is the slope
/// of log(cost) over log(n), fitted by least squares.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Growth {
    /// Name of the mesh.
    pub mesh: String,
    /// Exponent of the time per ray by brute force; 1 means proportional.
    pub brute: f64,
    /// Exponent of the time per ray with the BVH.
    pub tree: f64,
    /// Exponent of the box and primitive tests per ray with the BVH.
    pub tests: f64,
    /// Exponent of the time to build the BVH.
    pub build: f64,
}

impl Growth {
    /// The exponents of a mesh; `None` unless it was timed in at least two sizes.
    pub(super) fn of(mesh: &str, rows: &[Speedup]) -> Option<Growth> {
        let rows: Vec<&Speedup> = rows.iter().filter(|row| row.mesh == mesh).collect();
        let of = |cost: fn(&Speedup) -> f64| {
            let points: Vec<(f64, f64)> = rows
                .iter()
                .map(|row| (row.triangles as f64, cost(row)))
                .collect();
            slope(&points)
        };
        Some(Growth {
            mesh: mesh.into(),
            brute: of(|row| row.brute_s)?,
            tree: of(|row| row.tree_s)?,
            tests: of(|row| row.work.boxes + row.work.prims)?,
            build: of(|row| row.build_s)?,
        })
    }
}

/// The slope of the line through the points (ln x, ln y), fitted by least squares; `None` if all x
/// are equal.
pub fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let n = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let mean_x = logs.iter().map(|(x, _)| x).sum::<f64>() / n;
    let mean_y = logs.iter().map(|(_, y)| y).sum::<f64>() / n;
    let sum_xx: f64 = logs.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    let sum_xy: f64 = logs.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    (sum_xx > 0.0).then_some(sum_xy / sum_xx)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_of_a_power_law_is_its_exponent() {
        let cube_root: Vec<(f64, f64)> = [1e3, 1e4, 1e6].map(|n: f64| (n, 7.0 * n.cbrt())).into();
        assert!((slope(&cube_root).unwrap() - 1.0 / 3.0).abs() < 1e-12);
        assert_eq!(slope(&[(1e3, 1.0)]), None);
    }
}
