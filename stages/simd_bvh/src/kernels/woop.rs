//! The triangle test in double precision, for the few triangles that pass the filter.

use kit::{Ray, TriangleHit, Vec3 as KitVec3};
use lanes::Vec3;
use lanes::triangle::{Edges, project};

/// The vertices of a triangle in world space, where the tree has them: a test loads each coordinate
/// once.
pub(crate) type Vertices<'t> = [&'t [f64; 3]; 3];

/// What [`test`] found.
pub(crate) enum Decision {
    Miss,
    Hit(TriangleHit),
    /// Rounding errors may be too large: the scalar kernel has to decide.
    Undecided,
}

/// Tests a triangle for a hit in the range of `ray`, where `axes` become x, y and z; `z` is the
/// axis of the largest component of the direction. The result is that of
/// `intersect::test_triangle`; where that switches to its careful variant, the triangle is
/// undecided.
#[inline(always)]
pub(crate) fn test(vertices: Vertices, ray: &Ray, axes: [usize; 3]) -> Decision {
    let (o, d) = (
        permuted(&ray.o.to_array(), axes),
        permuted(&ray.d.to_array(), axes),
    );
    let [a, b, c] = [
        permuted(vertices[0], axes) - o,
        permuted(vertices[1], axes) - o,
        permuted(vertices[2], axes) - o,
    ];
    let edges = Edges::of([project(a, d), project(b, d), project(c, d)]);
    let crossing = edges.crossing([a.z, b.z, c.z], d.z);
    if !crossing.is_certain {
        return Decision::Undecided;
    }
    if !ray.in_range(crossing.t) {
        return Decision::Miss;
    }
    Decision::Hit(TriangleHit {
        t: crossing.t,
        b1: crossing.v / crossing.det,
        b2: crossing.w / crossing.det,
    })
}

/// The axes that become x, y and z for a ray along `d`: z is that of the largest component.
#[inline(always)]
pub(crate) fn axes_along(d: KitVec3) -> [usize; 3] {
    let size = d.abs();
    let z = if size.z >= size.x && size.z >= size.y {
        2
    } else {
        usize::from(size.y >= size.x)
    };
    const NEXT: [usize; 4] = [1, 2, 0, 1];
    [NEXT[z], NEXT[z + 1], z]
}

#[inline(always)]
fn permuted(v: &[f64; 3], [x, y, z]: [usize; 3]) -> Vec3<f64> {
    Vec3 {
        x: v[x],
        y: v[y],
        z: v[z],
    }
}
