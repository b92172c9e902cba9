//! Part 1, Tasks 3 and 4: a ray and a triangle, a ray and a sphere. The oracle computes the truth.

use super::example::{AskedNumber, WorkedExample, vector};
use crate::predict::draw::Draw;
use kit::{Ray, Sphere, Triangle, Vec3};

fn draw_vector(draw: &mut Draw, low: i32, high: i32) -> Vec3 {
    Vec3::from([0, 1, 2].map(|_| f64::from(draw.from(low, high))))
}

/// A ray that hits a triangle in the plane z = z0 at weights of eighths.
pub(super) fn triangle(draw: &mut Draw) -> WorkedExample {
    loop {
        let p0 = draw_vector(draw, -2, 2);
        let edges = [
            Vec3::new(f64::from(draw.one(&[4, 8])), 0.0, 0.0),
            Vec3::new(0.0, f64::from(draw.one(&[4, 8])), 0.0),
        ];
        let (i, j) = draw.one(&[
            (1, 2),
            (2, 1),
            (1, 4),
            (4, 1),
            (2, 5),
            (5, 2),
            (1, 5),
            (3, 1),
        ]);
        let hit = p0 + f64::from(i) / 8.0 * edges[0] + f64::from(j) / 8.0 * edges[1];
        let d = Vec3::new(
            f64::from(draw.from(-2, 2)),
            f64::from(draw.from(-2, 2)),
            f64::from(draw.one(&[-2, -1, 1, 2])),
        );
        if d.x == 0.0 && d.y == 0.0 {
            continue;
        }
        let ray = Ray::new(hit - f64::from(draw.one(&[1, 2, 3])) * 0.5 * d, d);
        let triangle = Triangle::flat(p0, p0 + edges[0], p0 + edges[1]);
        let Some(at) = oracle::triangle(&triangle, &ray).crossing else {
            continue;
        };
        let (t, b1, b2) = (at.t.to_f64(), at.b1.to_f64(), at.b2.to_f64());
        let weight = |other: f64| {
            [
                (
                    other,
                    "the other weight: b1 belongs to the second vertex, b2 to the third",
                ),
                (1.0 - b1 - b2, "b0, the weight of the first vertex"),
                (-b1.max(b2), "a weight with the wrong sign"),
            ]
        };
        return WorkedExample {
            given: vec![
                format!(
                    "Triangle: p0 = {}, p1 = {}, p2 = {}.",
                    vector(p0.into()),
                    vector(triangle.p1.into()),
                    vector(triangle.p2.into())
                ),
                format!(
                    "Ray: o = {}, d = {}.",
                    vector(ray.o.into()),
                    vector(d.into())
                ),
            ],
            asked: vec![
                AskedNumber::new(
                    "t",
                    t,
                    &[
                        (
                            t * d.length(),
                            "t for a direction of length 1: the distance",
                        ),
                        (
                            -t,
                            "t with the wrong sign: the ray goes towards the triangle",
                        ),
                        (1.0 / t, "one divided by t: the determinant divides"),
                    ],
                ),
                AskedNumber::new("b1", b1, &weight(b2)),
                AskedNumber::new("b2", b2, &weight(b1)),
            ],
        };
    }
}

/// A ray along an axis that meets a sphere at rational roots.
pub(super) fn sphere(draw: &mut Draw) -> WorkedExample {
    // Distance of the line from the centre, half chord and radius.
    let (beside, half, radius) = draw.one(&[
        (3.0, 4.0, 5.0),
        (4.0, 3.0, 5.0),
        (5.0, 12.0, 13.0),
        (6.0, 8.0, 10.0),
    ]);
    let center = draw_vector(draw, -3, 3);
    let axis = draw.from(0, 2) as usize;
    let (speed, sign) = (draw.one(&[2.0, 4.0]), draw.one(&[-1.0, 1.0]));
    let mut d = Vec3::ZERO;
    d[axis] = sign * speed;
    let mut o = center - (half + f64::from(draw.from(2, 8))) * sign * Vec3::AXES[axis];
    o[(axis + 1) % 3] += beside;
    let sphere = Sphere { center, radius };
    let ray = Ray::new(o, d);
    let roots = oracle::sphere(&sphere, &ray)
        .roots
        .map(|roots| roots.map(|root| root.to_f64()));
    let [near, far] = roots.unwrap_or([f64::NAN; 2]);
    let middle = 0.5 * (near + far);
    let normal = ((o + near * d) - center) / radius;
    WorkedExample {
        given: vec![
            format!(
                "Sphere: centre m = {}, radius r = {radius}.",
                vector(center.into())
            ),
            format!(
                "Ray: o = {}, d = {}. Its range starts at 0.",
                vector(o.into()),
                vector(d.into())
            ),
        ],
        asked: vec![
            AskedNumber::new(
                "t of the hit",
                near,
                &[
                    (near * speed, "t for a direction of length 1: the distance"),
                    (far, "the far root"),
                    (
                        middle,
                        "t of the point that is closest to the centre, b / a",
                    ),
                    (-near, "t with the wrong sign of b"),
                    (-far, "t with the wrong sign of b"),
                ],
            ),
            AskedNumber::new(
                "t of the hit if the range starts between the roots",
                far,
                &[
                    (far * speed, "t for a direction of length 1: the distance"),
                    (near, "the near root, which is out of the range now"),
                    (far - near, "the length of the chord in t"),
                ],
            ),
            AskedNumber::new(
                [
                    "x of the normal at the first hit",
                    "y of the normal at the first hit",
                    "z of the normal at the first hit",
                ][axis],
                normal[axis],
                &[
                    (normal[axis] * radius, "the normal as long as the radius"),
                    (-normal[axis], "the normal that points inwards"),
                ],
            ),
        ],
    }
}
