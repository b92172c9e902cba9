//! The exact results as records, which can be compared with golden and actual ones. A miss has no
//! fields.

use super::expected::{Expected, ExpectedHit};
use super::{first_of, scene};
use crate::tools::snapshot::{Fields, record};
use crate::tools::{Tier, convert};
use kit::{Primitive, Scene};
use oracle::Shapes;
use wire::answer::Hit;
use wire::work::Ray;

/// The right hit of one shape. It has no number to compare.
pub(crate) fn of_shape(shape: Primitive<'_>, ray: &Ray) -> Fields {
    let first = first_of(
        Tier::Robust,
        &Shapes::new([shape]),
        &convert::ray(ray),
        false,
    );
    let mut fields = fields(&first);
    fields.retain(|(name, _)| name != "prim");
    fields
}

/// The right closest hits of the rays with the numbers `calls`.
pub(crate) fn of_scene(shapes: &Scene, enclosed: bool, rays: &[Ray], calls: &[u32]) -> Vec<Fields> {
    let shapes = Shapes::new(shapes.primitives());
    let of_ray = |ray: &Ray| first_of(Tier::Robust, &shapes, &convert::ray(ray), enclosed);
    let chosen: Vec<Ray> = calls.iter().map(|&call| rays[call as usize]).collect();
    scene::of_each_ray(&chosen, |ray| fields(&of_ray(ray)))
}

fn fields(expected: &Expected) -> Fields {
    let Some(ExpectedHit {
        prim,
        t,
        p,
        uv,
        n,
        ng,
        ..
    }) = expected.hits.first()
    else {
        return Fields::new();
    };
    let hit = Hit {
        t: *t,
        p: (*p).into(),
        n: n.unwrap_or_default().into(),
        ng: ng.unwrap_or_default().into(),
        uv: uv.map(|(uv, _)| uv.into()).unwrap_or_default(),
        prim: *prim,
    };
    // Fields that the oracle does not decide are not shown: a normal that may have any direction,
    // weights of a sphere.
    let is_decided = |name: &str| match name {
        "n" => n.is_some(),
        "ng" => ng.is_some(),
        "uv" => uv.is_some(),
        _ => true,
    };
    let mut fields = record(&hit);
    fields.retain(|(name, _)| is_decided(name));
    fields
}
