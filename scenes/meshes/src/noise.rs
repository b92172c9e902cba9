//! Noise from an integer hash.

use kit::Vec3;
use kit::sampler::mix as hash;

/// A number in [0, 1) that depends only on `key`.
pub(super) fn uniform(key: u64) -> f64 {
    (hash(key) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Perlin noise: smooth, in about [-1, 1], 0 at integer coordinates, with features of size about 1
/// (K. Perlin, "Improving noise", 2002).
pub(super) fn gradient_noise(p: Vec3, seed: u64) -> f64 {
    let cell = p.floor();
    let f = p - cell;
    let lattice = [cell.x as i64, cell.y as i64, cell.z as i64];
    let fade = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let corner = |dx: i64, dy: i64, dz: i64| {
        let gradient = gradient([lattice[0] + dx, lattice[1] + dy, lattice[2] + dz], seed);
        gradient.dot(f - Vec3::new(dx as f64, dy as f64, dz as f64))
    };
    let mix = |a: f64, b: f64, t: f64| a + t * (b - a);
    let along_x = |dy, dz| mix(corner(0, dy, dz), corner(1, dy, dz), fade.x);
    let along_y = |dz| mix(along_x(0, dz), along_x(1, dz), fade.y);
    mix(along_y(0), along_y(1), fade.z)
}

/// One of the 12 directions from a cube's centre to the midpoints of its edges (4 of them occur
/// twice).
fn gradient(lattice: [i64; 3], seed: u64) -> Vec3 {
    let [x, y, z] = lattice.map(|i| i as u64);
    // Three odd constants, so that adjacent cells get unrelated keys.
    let key = x.wrapping_mul(0x8da6_b343_0000_0001)
        ^ y.wrapping_mul(0xd816_3841_0000_0003).rotate_left(21)
        ^ z.wrapping_mul(0xcb1a_b31f_0000_0005).rotate_left(42);
    match hash(key ^ seed) & 15 {
        0 | 12 => Vec3::new(1.0, 1.0, 0.0),
        1 | 13 => Vec3::new(-1.0, 1.0, 0.0),
        2 => Vec3::new(1.0, -1.0, 0.0),
        3 => Vec3::new(-1.0, -1.0, 0.0),
        4 => Vec3::new(1.0, 0.0, 1.0),
        5 => Vec3::new(-1.0, 0.0, 1.0),
        6 => Vec3::new(1.0, 0.0, -1.0),
        7 => Vec3::new(-1.0, 0.0, -1.0),
        8 => Vec3::new(0.0, 1.0, 1.0),
        9 | 14 => Vec3::new(0.0, -1.0, 1.0),
        10 => Vec3::new(0.0, 1.0, -1.0),
        _ => Vec3::new(0.0, -1.0, -1.0),
    }
}
