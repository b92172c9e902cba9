//! Reads `stages/STAGE/examples.toml`.

use base::GraderError;
use judge::examples::{
    CameraExample, Example, Expectation, PixelExample, RayExample, Shape, SpecularExample,
    SpecularFunction,
};
use kit::{Aabb, Ray, Sphere, Triangle, Vec2};
use serde::Deserialize;

/// The most examples of a file. Nobody writes more by hand, and each is judged in exact arithmetic
/// by the process that grades.
const MOST: usize = 500;

/// The file of a stage.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(default)]
    pixel: Vec<OfPixel>,
    #[serde(default)]
    camera: Vec<OfCamera>,
    #[serde(default)]
    reflect: Vec<OfMirror>,
    #[serde(default)]
    refract: Vec<OfBoundary>,
    #[serde(default)]
    triangle: Vec<OfTriangle>,
    #[serde(default)]
    sphere: Vec<OfSphere>,
    #[serde(default, rename = "box")]
    boxes: Vec<OfBox>,
}

/// Declares the table of an example: a shape, a ray and the expected result. A macro, because
/// serde's `flatten` would leave out which field is unknown, and in which line.
macro_rules! shape_and_ray {
    ($name:ident { $($field:ident: $of:ty),* }) => {
        #[derive(Debug, Deserialize)]
        #[serde(deny_unknown_fields)]
        struct $name {
            $($field: $of,)*
            o: [f64; 3],
            d: [f64; 3],
            #[serde(default)]
            min_t: f64,
            #[serde(default = "infinity")]
            max_t: f64,
            expected: Written,
        }

        impl $name {
            fn with(self, shape: Shape) -> RayExample {
                RayExample {
                    shape,
                    ray: Ray {
                        o: self.o.into(),
                        d: self.d.into(),
                        min_t: self.min_t,
                        max_t: self.max_t,
                    },
                    expected: self.expected.into(),
                }
            }
        }
    };
}

shape_and_ray!(OfTriangle {
    p0: [f64; 3],
    p1: [f64; 3],
    p2: [f64; 3]
});
shape_and_ray!(OfSphere {
    center: [f64; 3],
    radius: f64
});
shape_and_ray!(OfBox {
    min: [f64; 3],
    max: [f64; 3]
});

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OfPixel {
    film: [u32; 2],
    pixel: [u32; 2],
    expected: [f64; 2],
}

/// A camera that is not turned if `axes` are not written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OfCamera {
    #[serde(default = "straight")]
    axes: [[f64; 3]; 3],
    h_fov: f64,
    v_fov: f64,
    sensor: [f64; 2],
    expected: [f64; 3],
}

fn straight() -> [[f64; 3]; 3] {
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OfMirror {
    wo: [f64; 3],
    expected: [f64; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OfBoundary {
    wo: [f64; 3],
    ior: f64,
    expected: Refracted,
}

#[derive(Debug, Deserialize)]
#[serde(
    untagged,
    expecting = "expected the direction as [x, y, z], or \"none\""
)]
enum Refracted {
    None(Nothing),
    Direction([f64; 3]),
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Nothing {
    None,
}

fn infinity() -> f64 {
    f64::INFINITY
}

/// A result as it is written: "miss", a `t`, or the two ends of an interval.
#[derive(Debug, Deserialize)]
#[serde(
    untagged,
    expecting = "expected \"miss\", the t of a hit, or [from, to] for a box"
)]
enum Written {
    Miss(Miss),
    Hit(f64),
    Inside([f64; 2]),
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Miss {
    Miss,
}

impl From<Written> for Expectation {
    fn from(written: Written) -> Expectation {
        match written {
            Written::Miss(Miss::Miss) => Expectation::Miss,
            Written::Hit(t) => Expectation::Hit(t),
            Written::Inside(ends) => Expectation::Inside(ends),
        }
    }
}

/// Reads the examples of a file, those of each kind in their order.
pub fn parse(text: &str) -> Result<Vec<Example>, GraderError> {
    let File {
        pixel,
        camera,
        reflect,
        refract,
        triangle,
        sphere,
        boxes,
    } = toml::from_str(text).map_err(|e| GraderError::new(e.to_string()))?;
    let pixels = pixel.into_iter().map(|of| PixelExample {
        film: of.film,
        pixel: of.pixel,
        expected: of.expected.into(),
    });
    let cameras = camera.into_iter().map(|of| CameraExample {
        axes: of.axes.map(Into::into),
        fov: Vec2::new(of.h_fov, of.v_fov),
        film: of.sensor.into(),
        expected: of.expected.into(),
    });
    let mirrors = reflect.into_iter().map(|of| SpecularExample {
        function: SpecularFunction::Reflect,
        wo: of.wo.into(),
        expected: Some(of.expected.into()),
    });
    let boundaries = refract.into_iter().map(|of| SpecularExample {
        function: SpecularFunction::Refract(of.ior),
        wo: of.wo.into(),
        expected: match of.expected {
            Refracted::None(Nothing::None) => None,
            Refracted::Direction(wi) => Some(wi.into()),
        },
    });
    let triangles = triangle.into_iter().map(|of| {
        let flat = Triangle::flat(of.p0.into(), of.p1.into(), of.p2.into());
        of.with(Shape::Triangle(flat))
    });
    let spheres = sphere.into_iter().map(|of| {
        let center = of.center.into();
        let radius = of.radius;
        of.with(Shape::Sphere(Sphere { center, radius }))
    });
    let boxes = boxes.into_iter().map(|of| {
        let [min, max] = [of.min, of.max].map(Into::into);
        of.with(Shape::Box(Aabb { min, max }))
    });
    let rays = triangles.chain(spheres).chain(boxes).map(Example::Ray);
    let specular = mirrors.chain(boundaries).map(Example::Specular);
    let all: Vec<Example> = pixels
        .map(Example::Pixel)
        .chain(cameras.map(Example::Camera))
        .chain(rays)
        .chain(specular)
        .collect();
    match all.len() {
        0..=MOST => Ok(all),
        many => Err(GraderError::new(format!(
            "{many} examples: expected at most {MOST} in a file"
        ))),
    }
}
