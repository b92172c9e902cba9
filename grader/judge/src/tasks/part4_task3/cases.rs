//! Cases of Russian roulette.

use crate::tools::findings::Aspect::{Mean, Survival, Throughput};
use crate::tools::questions::probes::ProbeRng;
use crate::tools::spec::Spec;
use wire::global::RouletteWork;
use wire::kind;
use wire::work::Xyz;

/// A dim throughput, exact in binary.
const DIM: Xyz = [0.25, 0.125, 0.0625];

/// The cases of `part4.task3`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        case(
            "first_bounces",
            "Up to the third bounce a path continues unchanged, however dim it is. Pitfall: ending a \
             path below a threshold as if it were black.",
            work(
                &[DIM, [0.9, 0.01, 0.5], [3.0, 0.5, 0.0], [1e-9, 0.0, 2e-9]],
                &[0, 1, 2, 3],
            ),
        ),
        case(
            "survivors",
            "From the fourth bounce on a path continues if u < q, where q is the largest channel \
             of the throughput, and its throughput is divided by q, however small q is. Pitfall: a \
             lower limit on q makes dark paths too long.",
            work(
                &[
                    DIM,
                    [0.1, 0.9, 0.5],
                    [0.0, 0.0, 0.5],
                    [0.02, 0.01, 0.0],
                    [1e-5, 5e-6, 0.0],
                ],
                &[4, 5, 17, 1000],
            ),
        ),
        case(
            "bright_paths",
            "A path whose largest channel is 1 or more always continues unchanged: q is at most \
             1.",
            work(&[[1.0; 3], [0.2, 1.5, 0.1], [7.0, 8.0, 9.0]], &[4, 30]),
        ),
        case(
            "black_paths",
            "A black path ends at once, also in the first bounces: it cannot add light.",
            work(&[[0.0; 3]], &[0, 1, 3, 4, 50]),
        )
        .only(&[Survival]),
        case(
            "mean_of_many",
            "Over many calls the mean throughput is the throughput before: the picture gets \
             neither darker nor brighter. A bias of 19 % is always detected.",
            mean_of_many(),
        )
        .only(&[Mean]),
        case(
            "fresh_games",
            "Throughputs and random numbers u that depend on the seed.",
            fresh_games(seed),
        )
        .only(&[Survival, Throughput]),
    ]
}

fn case(name: &'static str, about: &'static str, work: RouletteWork) -> Spec {
    Spec::new::<kind::Roulette>("part4.task3", name, about, work)
}

/// Each throughput after each number of bounces, with numbers u spread over [0, 1).
fn work(throughputs: &[Xyz], bounces: &[u32]) -> RouletteWork {
    let paths = throughputs
        .iter()
        .flat_map(|throughput| bounces.iter().map(|bounces| (*throughput, *bounces)));
    RouletteWork {
        paths: paths.collect(),
        numbers: (0..32)
            .map(|i| f64::from(i) / 32.0)
            .chain([0.99, 1.0 - f64::EPSILON])
            .collect(),
    }
}

fn mean_of_many() -> RouletteWork {
    let mut rng = ProbeRng::new("mean_of_many", 0);
    RouletteWork {
        paths: vec![(DIM, 4), ([0.6, 0.3, 0.1], 9)],
        numbers: (0..12_000).map(|_| rng.range(0.0, 1.0)).collect(),
    }
}

fn fresh_games(seed: u64) -> RouletteWork {
    let mut rng = ProbeRng::new("fresh_games", seed);
    let mut channel = || rng.range(0.01, 0.99);
    let paths = [4, 5, 9, 30].map(|bounces| ([channel(), channel(), channel()], bounces));
    RouletteWork {
        paths: paths.to_vec(),
        numbers: (0..500).map(|_| rng.range(0.0, 1.0)).collect(),
    }
}
