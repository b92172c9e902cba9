//! `lanes::mis` and `direct::mis::power_heuristic`.

use crate::inputs::Random;
use crate::widths::{Formula, at_every_width, same};
use lanes::{Real, mis};

/// The densities of both strategies; the weight.
struct Weight;

impl Formula<2, 1> for Weight {
    #[inline(always)]
    fn compute<R: Real>(&self, [own, other]: [R; 2]) -> [R; 1] {
        [mis::power_heuristic(own, other)]
    }
}

#[test]
fn weights() {
    let mut random = Random::new(15);
    let inputs: Vec<[f64; 2]> = (0..4000)
        .map(|_| {
            [(); 2].map(|()| {
                let any = random.one();
                random.of(&[any, any, 1e9 * any, 0.0, 1e-300, 1e300, f64::INFINITY])
            })
        })
        .collect();
    let mut fractions = 0;
    for (input, [weight]) in inputs.iter().zip(at_every_width(&Weight, &inputs)) {
        let expected = direct::mis::power_heuristic(input[0], input[1]);
        assert!(
            same(weight, expected),
            "{weight}, expected {expected} for {input:?}"
        );
        fractions += usize::from(expected > 0.0 && expected < 1.0);
    }
    assert!(fractions > 500, "{fractions} weights are between 0 and 1");
}
