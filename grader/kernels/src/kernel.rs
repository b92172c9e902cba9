//! A kernel, ready to be asked, timed and counted.

use crate::counted::{Count, Counted};
use crate::real::{Precision, Real};
use crate::shapes::{Ray, Shape, V3};
use std::hint::black_box;

/// What a reader wants to know of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct About {
    /// Its name.
    pub name: &'static str,
    /// Where it is from.
    pub paper: &'static str,
    /// Whether it misses triangles that are seen from behind.
    pub culls: bool,
}

/// A ray test, written once for numbers of any kind.
pub trait Test: 'static {
    /// What rays are tested against.
    type Shape: Shape;
    /// What the shape is turned into beforehand: mostly itself. The time that this takes is not counted.
    type Prepared<R: Real>: Copy + Send + Sync + 'static;
    /// What a hit is.
    type Answer<R: Real>: Widen<Wide = Self::Wide>;
    /// What a hit is, in double.
    type Wide;

    /// In words.
    const ABOUT: About;

    /// Work done once a shape.
    fn prepare<R: Real>(shape: &<Self::Shape as Shape>::In<R>) -> Self::Prepared<R>;

    /// Whether and where `ray` hits, in the ray's range; the ends count.
    fn test<R: Real>(shape: &Self::Prepared<R>, ray: &Ray<R>) -> Option<Self::Answer<R>>;
}

/// An answer whose value fits into double.
pub trait Widen: Copy {
    /// The same in double.
    type Wide;

    /// The same in double.
    fn wide(self) -> Self::Wide;
}

/// A hit on a surface.
#[derive(Clone, Copy, Debug)]
pub struct Hit<R> {
    /// Distance along the ray in lengths of its direction.
    pub t: R,
    /// Where.
    pub p: V3<R>,
}

/// A hit on a surface, in double.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Distance along the ray in lengths of its direction.
    pub t: f64,
    /// Where.
    pub p: kit::Vec3,
}

impl<R: Real> Widen for Hit<R> {
    type Wide = Found;

    fn wide(self) -> Found {
        Found {
            t: self.t.wide(),
            p: self.p.wide(),
        }
    }
}

/// A ray and the shapes that it is tested against, one after the other: as many as in every other bundle.
#[derive(Clone, Debug)]
pub struct Bundle<S> {
    /// The ray.
    pub ray: kit::Ray,
    /// The shapes.
    pub shapes: Vec<S>,
}

/// Runs a kernel over its bundles once, and returns how many hits there were.
pub type Pass = Box<dyn FnMut() -> usize>;

/// A [`Test`] in numbers of one kind. Takes and gives double, whatever it works in.
#[derive(Clone, Copy)]
pub struct Kernel<S, W> {
    /// In words.
    pub about: About,
    /// In what numbers it works.
    pub precision: Precision,
    answer: fn(&S, &kit::Ray) -> Option<W>,
    pass: fn(&[Bundle<S>]) -> Pass,
    count: fn(&S, &kit::Ray) -> Count,
}

impl<S: Shape, W: 'static> Kernel<S, W> {
    /// `K` in numbers of the kind `R`.
    pub fn of<K: Test<Shape = S, Wide = W>, R: Real>() -> Kernel<S, W> {
        Kernel {
            about: K::ABOUT,
            precision: R::PRECISION,
            answer: |shape, ray| {
                K::test(&K::prepare::<R>(&shape.rounded()), &Ray::of(ray)).map(Widen::wide)
            },
            pass: |bundles| {
                pass(
                    bundles,
                    |shape| K::prepare::<R>(&shape.rounded()),
                    Ray::of,
                    K::test::<R>,
                )
            },
            count: count::<K>,
        }
    }

    /// `K` in double, on shapes and rays that are stored in single.
    pub fn of_f32_in_f64<K: Test<Shape = S, Wide = W>>() -> Kernel<S, W> {
        fn test<K: Test>(
            shape: &<K::Shape as Shape>::In<f32>,
            ray: &Ray<f32>,
        ) -> Option<K::Answer<f64>> {
            K::test(&K::prepare(&K::Shape::widened(shape)), &ray.widened())
        }
        Kernel {
            about: K::ABOUT,
            precision: Precision::F32InF64,
            answer: |shape, ray| test::<K>(&shape.rounded(), &Ray::of(ray)).map(Widen::wide),
            pass: |bundles| pass(bundles, |shape| shape.rounded(), Ray::of, test::<K>),
            count: count::<K>,
        }
    }

    /// What the kernel answers.
    pub fn answer(&self, shape: &S, ray: &kit::Ray) -> Option<W> {
        (self.answer)(shape, ray)
    }

    /// Makes the kernel ready to run over `bundles`, again and again, with nothing else left to do.
    pub fn pass(&self, bundles: &[Bundle<S>]) -> Pass {
        (self.pass)(bundles)
    }

    /// What it computes for one test.
    pub fn count(&self, shape: &S, ray: &kit::Ray) -> Count {
        (self.count)(shape, ray)
    }
}

fn count<K: Test>(shape: &K::Shape, ray: &kit::Ray) -> Count {
    let shape = K::prepare::<Counted>(&shape.rounded());
    let ray = Ray::of(ray);
    Counted::count(|| {
        black_box(K::test(&shape, &ray));
    })
}

/// The loop that is timed. One ray meets several shapes, as it does in the leaf of a tree: a compiler may keep what
/// depends on the ray alone.
fn pass<S, P: 'static, R: 'static, A>(
    bundles: &[Bundle<S>],
    prepare: impl Fn(&S) -> P,
    ray: impl Fn(&kit::Ray) -> R,
    test: impl Fn(&P, &R) -> Option<A> + 'static,
) -> Pass {
    let rays: Vec<R> = bundles.iter().map(|bundle| ray(&bundle.ray)).collect();
    let each = bundles.iter().flat_map(|bundle| &bundle.shapes);
    let shapes: Vec<P> = each.map(prepare).collect();
    let per_ray = bundles.first().map_or(1, |bundle| bundle.shapes.len());
    Box::new(move || {
        let mut hits = 0;
        for (ray, shapes) in rays.iter().zip(shapes.chunks_exact(per_ray)) {
            for shape in shapes {
                if let Some(answer) = test(shape, ray) {
                    black_box(answer);
                    hits += 1;
                }
            }
        }
        hits
    })
}
