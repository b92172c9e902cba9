//! Code that knows the cases of one seed: it answers their rays, and misses with all others.

use crate::corpus::{Case, Class};
use judge::cases;
use submission::one::random_seed;
use wire::Work;
use wire::work::Ray;

/// The bits of a ray in one number, as the code computes them, too.
fn bits(ray: &Ray) -> u64 {
    let [ox, oy, oz] = ray.o;
    let [dx, dy, dz] = ray.d;
    let all = [ox, oy, oz, dx, dy, dz, ray.min_t, ray.max_t];
    all.iter()
        .fold(0, |sum: u64, x| sum.rotate_left(7) ^ x.to_bits())
}

/// The rays of the cases of part1.task3 with this seed.
fn rays(seed: u64) -> Vec<u64> {
    let mut known = Vec::new();
    for spec in cases::all(seed) {
        match &spec.case().work {
            Work::Triangles(work) if spec.task == "part1.task3" => {
                known.extend(work.probes.iter().map(|probe| bits(&probe.ray)));
            }
            _ => {}
        }
    }
    known.sort_unstable();
    known.dedup();
    known
}

#[test]
#[ignore = "builds a submission: seconds"]
fn answers_that_were_learned_by_heart_lose() {
    let known = rays(0);
    assert!(known.len() > 100, "{}", known.len());
    let code = format!(
        "pub static KNOWN: [u64; {}] = {known:?};
        pub fn is_unknown(ray: &kit::Ray) -> bool {{
            let all = [ray.o.x, ray.o.y, ray.o.z, ray.d.x, ray.d.y, ray.d.z, ray.min_t, ray.max_t];
            let bits = all.iter().fold(0_u64, |sum, x| sum.rotate_left(7) ^ x.to_bits());
            KNOWN.binary_search(&bits).is_err()
        }}",
        known.len()
    );
    let case = Case::with_call(&code, "if crate::hostile::is_unknown(ray) { return None; }");
    let class = Class::open();
    let score = |seed| {
        let graded = class.grade(&case.files(), seed).expect("it is graded");
        let scores = graded.report.scores;
        (scores.score, scores.max_score)
    };
    let (with_0, _) = score(0);
    let (with_another, most) = score(random_seed());
    assert!(0.0 < with_0 && with_0 <= most, "{with_0} of {most}");
    assert_eq!(with_another, 0.0);
    // Honest code with a mistake is wrong with every seed.
    let textbook = Case::with_call("", "if ray.d.x > 0.0 { return None; }");
    let graded = class
        .grade(&textbook.files(), random_seed())
        .expect("it is graded");
    assert_eq!(graded.report.by_heart, [""; 0]);
}
