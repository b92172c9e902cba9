//! Cases of the stopping rule that waits for enough samples.

use crate::tools::findings::Aspect::Stop;
use crate::tools::kinds::stopping::call;
use crate::tools::questions::probes::ProbeRng;
use crate::tools::spec::Spec;
use wire::adaptive::StopCall;
use wire::kind;

/// The cases of `part5.task2`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        sure(
            "few_samples",
            "The variance of few samples is unreliable: before the 256th sample the result is \
             false, whatever the plain rule returns.",
            [1, 2, 32, 64, 128, 200, 254, 255, 256, 257, 300, 4096]
                .map(|n| call(vec![(n, 1.0)], true))
                .into(),
        ),
        sure(
            "black_is_never_enough",
            "Only black samples: the result is false, however many they are. Pitfall: their \
             variance is 0, and 0 <= 0; but a lamp that one sample in a thousand finds leaves \
             most pixels black for long.",
            [32, 255, 256, 1000, 100_000]
                .map(|n| call(vec![(n, 0.0)], true))
                .into(),
        )
        .only(&[Stop]),
        sure(
            "a_little_light",
            "One dim sample among many black ones: the samples are not all black, and the plain \
             rule decides.",
            vec![
                call(vec![(255, 0.0), (1, 1e-9)], true),
                call(vec![(255, 0.0), (1, 1e-9)], false),
                call(vec![(5000, 0.0), (1, 0.3)], true),
                call(vec![(1, 1e-12), (300, 0.0)], true),
            ],
        ),
        sure(
            "the_plain_rule_decides",
            "After enough samples with light, the result is that of the plain rule, called with \
             the same samples and the same tolerance, however many samples there are.",
            [
                decided_by_the_plain_rule("the_plain_rule_decides", 0),
                [5_000, 1_000_000]
                    .map(|n| call(vec![(n, 1.0)], false))
                    .into(),
            ]
            .concat(),
        ),
        sure(
            "fireflies",
            "One very bright sample (a firefly): with fewer than 256 samples the result is still \
             false.",
            vec![
                call(vec![(31, 0.0), (1, 1000.0)], true),
                call(vec![(254, 0.01), (1, 1e6)], true),
                call(vec![(255, 0.01), (1, 1e6)], true),
                call(vec![(255, 0.01), (1, 1e6)], false),
            ],
        ),
        sure(
            "fresh_rules",
            "Random samples that depend on the seed.",
            decided_by_the_plain_rule("fresh_rules", seed),
        ),
    ]
}

fn sure(name: &'static str, about: &'static str, calls: Vec<StopCall>) -> Spec {
    Spec::new::<kind::SureStop>("part5.task2", name, about, calls)
}

fn decided_by_the_plain_rule(name: &str, seed: u64) -> Vec<StopCall> {
    let mut rng = ProbeRng::new(name, seed);
    let calls = (0..60).map(|i| StopCall {
        tolerance: rng.range(0.01, 0.3),
        ..call(
            vec![
                (rng.below(400) as u32, rng.range(0.0, 1.0)),
                (1 + rng.below(400) as u32, rng.range(0.0, 5.0)),
            ],
            i % 3 != 0,
        )
    });
    calls.collect()
}
