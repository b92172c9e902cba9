//! Variations of a question: other lengths, fewer digits.
//!
//! Some mistakes need an extreme input, such as a determinant that is compared with 1e-8. No simple
//! question shows them, but the same questions with small lengths do; and what these do not show, a
//! question of a failed case shows with as few digits as possible.

use super::numbers::Number;
use crate::tools::spec::Spec;

/// The simple questions of `spec` with all lengths multiplied by ten to the power of `exponent`;
/// none for work that has no lengths.
pub fn scaled(spec: &Spec, exponent: i32) -> Vec<Spec> {
    let is_scaled = |of: &Spec| {
        let mut is_scaled = false;
        let varied = varied(of, &mut |kind, x| {
            if matches!(kind, Number::Length | Number::T) {
                *x = times_ten_to(*x, exponent);
                is_scaled = true;
            }
        });
        is_scaled.then_some(varied)
    };
    spec.simple().iter().filter_map(is_scaled).collect()
}

/// Variations of `spec`, a question with one call, that have fewer digits: all numbers rounded, the
/// range open, or one number rounded or 0.
pub fn shorter(spec: &Spec) -> Vec<Spec> {
    let mut shorter = Vec::new();
    for digits in 1..=6 {
        shorter.push(varied(spec, &mut |_, x| *x = rounded(*x, digits)));
    }
    let mut numbers = 0;
    varied(spec, &mut |_, _| numbers += 1);
    let mut ends = [0.0, f64::INFINITY].into_iter().cycle();
    shorter.push(varied(spec, &mut |kind, x| {
        if kind == Number::T {
            *x = ends.next().unwrap_or(*x);
        }
    }));
    // The numbers of the ray come last.
    for changed in numbers.max(RAY) - RAY..numbers {
        for digits in [0, 1, 2, 3] {
            let mut at = 0;
            shorter.push(varied(spec, &mut |kind, x| {
                if at == changed && kind != Number::T {
                    *x = rounded(*x, digits);
                }
                at += 1;
            }));
        }
    }
    shorter
}

/// How many numbers a ray has.
const RAY: usize = 8;

fn varied(spec: &Spec, change: &mut dyn FnMut(Number, &mut f64)) -> Spec {
    spec.with_work(spec.check.varied(&spec.work, change))
}

/// `x` with so many significant digits; 0 for none.
fn rounded(x: f64, digits: usize) -> f64 {
    match digits {
        0 => 0.0,
        _ => format!("{x:.*e}", digits - 1).parse().unwrap_or(x),
    }
}

/// The float nearest to `x` times a power of ten, so that it has as few digits as `x`.
fn times_ten_to(x: f64, exponent: i32) -> f64 {
    match x.is_finite() {
        true => shifted(x, exponent).unwrap_or(x),
        false => x,
    }
}

fn shifted(x: f64, exponent: i32) -> Option<f64> {
    let text = format!("{x:e}");
    let (digits, of_x) = text.split_once('e')?;
    let of_x: i32 = of_x.parse().ok()?;
    format!("{digits}e{}", of_x + exponent).parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::face::cases;

    fn triangles() -> Spec {
        let mut of_task = cases::of("part1.task3", 0).into_iter();
        of_task.next().expect("the task has cases")
    }

    #[test]
    fn scaled_questions_have_as_few_digits() {
        assert_eq!(times_ten_to(3.0, -4), 0.0003);
        assert_eq!(times_ten_to(-0.5, 6), -5e5);
        assert_eq!(times_ten_to(f64::INFINITY, -4), f64::INFINITY);
        let scaled = scaled(&triangles(), -4);
        let input = scaled[0].input(0).expect("it has an input");
        assert!(input.contains("p1 = (0.0004, 0.0, 0.0)"), "{input}");
        assert!(input.contains("d = (0.0, 0.0, 1.0)"), "{input}");
    }

    #[test]
    fn variations_of_a_call_have_fewer_digits() {
        assert_eq!(rounded(-0.0283, 2), -0.028);
        assert_eq!(rounded(7.9, 0), 0.0);
        let one = triangles().only_call(0).expect("it has calls");
        let digits = |spec: &Spec| {
            let input = spec.input(0).expect("it has an input");
            input.bytes().filter(u8::is_ascii_digit).count()
        };
        let all = shorter(&one);
        assert_eq!(all.len(), 6 + 1 + 4 * RAY);
        assert!(digits(&all[0]) < digits(&all[3]));
        assert!(all.iter().all(|spec| digits(spec) <= digits(&one)));
    }
}
