//! The kernel interface: run it on a pair, time it, count its operations.

use crate::counting::{CountingF64, OperationCounts};
use crate::instructions::Instructions;
use crate::shapes::{Ray, Shape, Vec3};
use lanes::{Precision, Scalar};
use std::hint::black_box;

/// Name and source of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KernelInfo {
    /// The name.
    pub name: &'static str,
    /// The publication.
    pub paper: &'static str,
    /// Whether it culls triangles seen from behind.
    pub culls: bool,
    /// Whether it contains fused multiply-adds, perhaps only for rare rays.
    pub uses_fma: bool,
}

impl KernelInfo {
    /// A kernel that culls nothing and has no fused multiply-add.
    pub const fn new(name: &'static str, paper: &'static str) -> KernelInfo {
        KernelInfo {
            name,
            paper,
            culls: false,
            uses_fma: false,
        }
    }

    /// The same, culling triangles seen from behind.
    pub const fn culling(mut self) -> KernelInfo {
        self.culls = true;
        self
    }

    /// The same with fused multiply-adds.
    pub const fn fused(mut self) -> KernelInfo {
        self.uses_fma = true;
        self
    }
}

/// A ray intersection test, generic over the number type.
pub trait Test: 'static {
    /// The shape that rays are tested against.
    type Shape: Shape;
    /// The precomputed form of the shape; for most tests the shape itself. The time of the
    /// precomputation is not measured.
    type Prepared<R: Scalar>: Copy + Send + Sync + 'static;
    /// The result of a hit.
    type Answer<R: Scalar>: ToF64<Output = Self::AnswerF64>;
    /// The result of a hit in `f64`.
    type AnswerF64;

    /// Name and source.
    const INFO: KernelInfo;

    /// Precomputes what depends only on the shape.
    fn prepare<R: Scalar>(shape: &<Self::Shape as Shape>::In<R>) -> Self::Prepared<R>;

    /// Returns the hit in the ray's range, if there is one; both ends of the range count.
    fn test<R: Scalar>(shape: &Self::Prepared<R>, ray: &Ray<R>) -> Option<Self::Answer<R>>;
}

/// A result that can be converted to `f64`.
pub trait ToF64: Copy {
    /// The converted result.
    type Output;

    /// Converts to `f64`.
    fn to_f64(self) -> Self::Output;
}

/// A hit on a surface, in the kernel's number type.
#[derive(Clone, Copy, Debug)]
pub struct Hit<R> {
    /// Distance along the ray in lengths of its direction.
    pub t: R,
    /// The hit point, in world space.
    pub p: Vec3<R>,
}

/// A hit on a surface, in `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HitF64 {
    /// Distance along the ray in lengths of its direction.
    pub t: f64,
    /// The hit point, in world space.
    pub p: kit::Vec3,
}

impl<R: Scalar> ToF64 for Hit<R> {
    type Output = HitF64;

    fn to_f64(self) -> HitF64 {
        HitF64 {
            t: self.t.to_f64(),
            p: self.p.to_f64(),
        }
    }
}

/// A ray and the shapes that it is tested against, one after the other. All values in one list have
/// the same number of shapes.
#[derive(Clone, Debug)]
pub struct RayAndShapes<S> {
    /// The ray.
    pub ray: kit::Ray,
    /// The shapes.
    pub shapes: Vec<S>,
}

/// Runs a kernel on its pairs, and returns the number of hits. The argument is the order: the
/// indices of the rays, each with its shapes. In an order that changes from pass to pass, the
/// branch predictor cannot remember which test hits.
pub type Pass = Box<dyn FnMut(&[u32]) -> usize>;

/// A [`Test`] for one number type. Arguments and results are `f64`, whatever the kernel computes
/// with.
#[derive(Clone, Copy)]
pub struct Kernel<S, W> {
    /// Name and source.
    pub info: KernelInfo,
    /// The number type.
    pub precision: Precision,
    answer: fn(&S, &kit::Ray) -> Option<W>,
    pass: fn(&[RayAndShapes<S>], Instructions) -> Pass,
    count: fn(&S, &kit::Ray) -> OperationCounts,
}

impl<S: Shape, W: 'static> Kernel<S, W> {
    /// Returns `K` for the number type `R`.
    pub fn new<K: Test<Shape = S, AnswerF64 = W>, R: Scalar>() -> Kernel<S, W> {
        Kernel {
            info: K::INFO,
            precision: R::PRECISION,
            answer: |shape, ray| {
                K::test(&K::prepare::<R>(&shape.rounded()), &Ray::from_kit(ray)).map(ToF64::to_f64)
            },
            pass: |batches, instructions| {
                pass(
                    batches,
                    |shape| K::prepare::<R>(&shape.rounded()),
                    Ray::from_kit,
                    #[inline(always)]
                    |shape, ray| K::test::<R>(shape, ray),
                    instructions,
                )
            },
            count: count::<K>,
        }
    }

    /// Returns `K` in `f64`, for shapes and rays that are stored in `f32`.
    pub fn new_f32_in_f64<K: Test<Shape = S, AnswerF64 = W>>() -> Kernel<S, W> {
        #[inline(always)]
        fn test<K: Test>(
            shape: &<K::Shape as Shape>::In<f32>,
            ray: &Ray<f32>,
        ) -> Option<K::Answer<f64>> {
            K::test(&K::prepare(&K::Shape::widened(shape)), &ray.widened())
        }
        Kernel {
            info: K::INFO,
            precision: Precision::F32InF64,
            answer: |shape, ray| {
                test::<K>(&shape.rounded(), &Ray::from_kit(ray)).map(ToF64::to_f64)
            },
            pass: |batches, instructions| {
                pass(
                    batches,
                    |shape| shape.rounded(),
                    Ray::from_kit,
                    #[inline(always)]
                    |shape, ray| test::<K>(shape, ray),
                    instructions,
                )
            },
            count: count::<K>,
        }
    }

    /// Runs the kernel on one pair.
    pub fn answer(&self, shape: &S, ray: &kit::Ray) -> Option<W> {
        (self.answer)(shape, ray)
    }

    /// Prepares a pass over `batches` that can be timed repeatedly: conversion and precomputation
    /// are done here. The pass runs with `instructions`.
    pub fn pass(&self, batches: &[RayAndShapes<S>], instructions: Instructions) -> Pass {
        (self.pass)(batches, instructions)
    }

    /// Counts the operations of one test.
    pub fn count(&self, shape: &S, ray: &kit::Ray) -> OperationCounts {
        (self.count)(shape, ray)
    }
}

fn count<K: Test>(shape: &K::Shape, ray: &kit::Ray) -> OperationCounts {
    let shape = K::prepare::<CountingF64>(&shape.rounded());
    let ray = Ray::from_kit(ray);
    CountingF64::count(|| {
        black_box(K::test(&shape, &ray));
    })
}

/// Returns the loop that is timed. One ray is tested against several shapes, as in the leaf of a
/// tree, so the compiler may hoist what depends only on the ray.
fn pass<S, P: 'static, R: 'static, A>(
    batches: &[RayAndShapes<S>],
    prepare: impl Fn(&S) -> P,
    ray: impl Fn(&kit::Ray) -> R,
    test: impl Fn(&P, &R) -> Option<A> + 'static,
    instructions: Instructions,
) -> Pass {
    let rays: Vec<R> = batches.iter().map(|batch| ray(&batch.ray)).collect();
    let each = batches.iter().flat_map(|batch| &batch.shapes);
    let shapes: Vec<P> = each.map(prepare).collect();
    let per_ray = batches.first().map_or(1, |batch| batch.shapes.len());
    Box::new(move |order| {
        instructions.run(
            #[inline(always)]
            || {
                let mut hits = 0;
                for i in order {
                    let i = *i as usize;
                    let ray = &rays[i];
                    for shape in &shapes[i * per_ray..(i + 1) * per_ray] {
                        if let Some(answer) = test(shape, ray) {
                            black_box(answer);
                            hits += 1;
                        }
                    }
                }
                hits
            },
        )
    })
}
