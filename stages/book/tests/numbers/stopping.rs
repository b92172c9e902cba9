//! Pixels whose samples are 1/p with the probability p and else 0: how often they stop with which
//! mean, by the reference's rules and without random numbers.

use super::claims::Claim;
use adaptive::{has_converged, has_surely_converged};
use book::figures::part5;
use kit::{PixelSampler, Tally};

/// A rule that stops a pixel.
type Rule = fn(&Tally, f64) -> bool;

fn plain(samples: &Tally, tolerance: f64) -> bool {
    has_converged(samples, tolerance)
}

fn sure(samples: &Tally, tolerance: f64) -> bool {
    has_surely_converged(samples, tolerance, &mut has_converged)
}

/// Pixels with at most `most` samples, in batches of 32.
pub(super) struct Pixels {
    pub(super) p: f64,
    pub(super) tolerance: f64,
    pub(super) most: usize,
}

impl Pixels {
    /// The probability of each number of hits in a batch.
    fn batch(&self) -> Vec<f64> {
        let mut chances = vec![1.0];
        for _ in 0..32 {
            let mut next = vec![0.0; chances.len() + 1];
            for (hits, chance) in chances.iter().enumerate() {
                next[hits] += (1.0 - self.p) * chance;
                next[hits + 1] += self.p * chance;
            }
            chances = next;
        }
        chances
    }

    fn tally(&self, samples: usize, hits: usize) -> Tally {
        let mut tally = Tally::of_equal(0.0, (samples - hits) as u64);
        tally.merge(&Tally::of_equal(1.0 / self.p, hits as u64));
        tally
    }

    /// The mean of all pixels. The right one is 1.
    fn mean(&self, stops: Rule) -> f64 {
        self.expected(stops, |pixel| pixel.mean())
    }

    /// The mean of all pixels with this task's conditions, and how many samples they take on
    /// average.
    pub(super) fn mean_and_samples(&self) -> [f64; 2] {
        let samples = self.expected(sure, |pixel| pixel.count() as f64);
        [self.mean(sure), samples]
    }

    /// The expected value of something about a pixel that has ended.
    fn expected(&self, stops: Rule, of: impl Fn(&Tally) -> f64) -> f64 {
        let batch = self.batch();
        // The probability of each number of hits in the pixels that go on.
        let mut going = vec![1.0];
        let mut expected = 0.0;
        for samples in (32..=self.most).step_by(32) {
            let mut next = vec![0.0; going.len() + 32];
            for (before, chance) in going.iter().enumerate().filter(|(_, c)| **c > 1e-18) {
                for (hits, of_batch) in batch.iter().enumerate() {
                    next[before + hits] += chance * of_batch;
                }
            }
            for (hits, chance) in next.iter_mut().enumerate().filter(|(_, c)| **c > 0.0) {
                let tally = self.tally(samples, hits);
                if samples == self.most || stops(&tally, self.tolerance) {
                    expected += *chance * of(&tally);
                    *chance = 0.0;
                }
            }
            going = next;
        }
        expected
    }
}

#[test]
fn the_example_loses_the_light_that_it_says() {
    let example = Pixels {
        p: 0.001,
        tolerance: 0.05,
        most: 2048,
    };
    let mean = example.mean(plain);
    assert_eq!(format!("{mean:.4}"), "0.0466");
    assert_eq!((1.0 / mean).round(), 21.0);
    let mean = example.mean(sure);
    assert!((mean - 1.0).abs() < 1e-12, "{mean}");
}

#[test]
fn the_figure_draws_the_rules_of_the_reference() {
    let mut sampler = PixelSampler::new(0, 0, 1);
    let mut stopped = [0, 0];
    for _ in 0..4000 {
        let (a, b) = (sampler.get_sample(), sampler.get_sample());
        let count = 1 + (600.0 * a.x) as u64;
        let mut samples = Tally::of_equal(b.x.floor(), count);
        samples.merge(&Tally::of_equal(a.y, (40.0 * b.y) as u64));
        for tolerance in [0.05, 0.5, 2.0] {
            let found =
                [part5::is_narrow, part5::is_surely_narrow].map(|rule| rule(&samples, tolerance));
            let expected = [plain, sure].map(|rule| rule(&samples, tolerance));
            assert_eq!(found, expected, "{samples:?}, {tolerance}");
            stopped = [0, 1].map(|i| stopped[i] + u32::from(found[i]));
        }
    }
    assert!(
        stopped[1] > 200 && stopped[0] > stopped[1] + 200,
        "{stopped:?}"
    );
}

pub(super) fn claims() -> Vec<Claim> {
    // What is left of the bias after both conditions.
    let left = |tolerance, most| {
        let pixels = Pixels {
            p: 0.1,
            tolerance,
            most,
        };
        pixels.mean(sure) - 1.0
    };
    let (strict, loose) = (left(0.05, 19_200), left(0.25, 4096));
    let hits = 1.0 / strict;
    assert!((1200.0..2000.0).contains(&hits), "one part in {hits}");
    // How often the interval of a pixel that has stopped contains the right value.
    let often = Pixels {
        p: 0.1,
        tolerance: 0.25,
        most: 4096,
    };
    let is_within = |pixel: &Tally| f64::from((pixel.mean() - 1.0).abs() <= 0.25 * pixel.mean());
    let right = often.expected(plain, is_within);
    assert!(
        (0.8..0.945).contains(&right),
        "right in {right} of the pixels"
    );
    // Of the figure's pixels, those that meet the light most often.
    let figure = Pixels {
        p: 0.1,
        tolerance: 0.05,
        most: 2048,
    };
    let mean = figure.mean(sure);
    assert!((mean - 1.0).abs() < 1e-12, "some stop: {mean}");
    vec![
        (
            "part5/task1.md",
            "Even then, the first success of many tests is right less often than the 95 % of a single test.".into(),
        ),
        (
            "part5/task2.md",
            format!(
                "by 1/1537, or by {:.0} % with a tolerance of 25 %,",
                100.0 * loose
            ),
        ),
        (
            "part5/task2.md",
            format!(
                "With both conditions no pixel stops before its {} samples",
                figure.most
            ),
        ),
        (
            "part5/task2.md",
            "With at most 2048 samples, the mean of all pixels is about 20 times too dark.".into(),
        ),
    ]
}
