//! Builds the parts of lines that several kinds of work share.

use super::line::Value;
use super::write::{Fields, Forms, field, forms, number, record, vector};
use wire::answer::Hit;
use wire::light::BsdfSample;
use wire::work::Ray;

/// A line for each call.
pub(crate) fn each<Q, A>(
    questions: impl IntoIterator<Item = Q>,
    answers: &[A],
    line: impl Fn(Q, &A) -> Forms,
) -> Vec<Forms> {
    let pairs = questions.into_iter().zip(answers);
    pairs
        .map(|(question, answer)| line(question, answer))
        .collect()
}

/// The line of a hit or a miss of a ray, and of the shape it was aimed at.
pub(crate) fn hit(shape: Option<u32>, ray: &Ray, hit: Option<&Hit>) -> Forms {
    let Some(hit) = hit else {
        return forms(ray_at(shape, ray), Vec::new(), Vec::new());
    };
    let full = record(hit);
    forms(ray_at(shape, ray), full[..2].to_vec(), full)
}

/// The question of a ray and the shape it is aimed at.
pub(crate) fn ray_at(shape: Option<u32>, ray: &Ray) -> Fields {
    let shape = shape.map(|shape| number("shape", f64::from(shape)));
    shape.into_iter().chain(ray_fields(ray)).collect()
}

/// The fields of a ray.
pub(crate) fn ray_fields(ray: &Ray) -> Fields {
    vec![
        field("o", vector(&ray.o)),
        field("d", vector(&ray.d)),
        field("range", Value::Range(ray.min_t, ray.max_t)),
    ]
}

/// The fields of a sampled direction.
pub(crate) fn sample(name: &str, sample: &BsdfSample) -> Fields {
    vec![
        field(name, vector(&sample.wi)),
        field("drawn_f", vector(&sample.f)),
        number("drawn_pdf", sample.pdf),
    ]
}
