//! `lanes::roulette` and `global::play_roulette`.

use crate::inputs::{Random, vector};
use crate::widths::{Formula, as_number, at_every_width, same};
use global::roulette::{MIN_BOUNCES, play_roulette};
use kit::Spectrum;
use lanes::{Real, roulette};

/// The throughput and `u`; the throughput of a survivor and whether there is one.
struct Played;

impl Formula<4, 4> for Played {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 4]) -> [R; 4] {
        let throughput = vector(&input);
        let q = roulette::survival_probability(throughput);
        let (throughput, survives) = roulette::play(throughput, q, input[3]);
        let is_positive = q.constant(0.0).less(q);
        [
            throughput.x,
            throughput.y,
            throughput.z,
            as_number(survives & is_positive, q),
        ]
    }
}

#[test]
fn survivors() {
    let mut random = Random::new(11);
    let inputs: Vec<[f64; 4]> = (0..8000)
        .map(|_| {
            let channel = |random: &mut Random| {
                let any = random.one();
                random.of(&[any, any, 0.0, 1.0, 1.5 * any, 3.0, 1e-300, f64::NAN])
            };
            let channels = [(); 3].map(|()| channel(&mut random));
            let largest = channels[0].max(channels[1]).max(channels[2]);
            let any = random.one();
            let u = random.of(&[any, any, 0.0, largest]);
            [channels[0], channels[1], channels[2], u]
        })
        .collect();
    let mut counts = [0; 2];
    for (input, result) in inputs.iter().zip(at_every_width(&Played, &inputs)) {
        let [r, g, b, u] = *input;
        let expected = play_roulette(Spectrum::new(r, g, b), MIN_BOUNCES + 1, u);
        counts[usize::from(expected.is_some())] += 1;
        let is_same = match expected {
            None => result[3] == 0.0,
            Some(throughput) => {
                let expected = throughput.to_array();
                result[3] == 1.0 && (0..3).all(|i| same(result[i], expected[i]))
            }
        };
        assert!(is_same, "{result:?}, expected {expected:?} for {input:?}");
    }
    assert!(counts.iter().all(|&count| count > 1000), "{counts:?}");
}
