//! Mistakes, and the calls whose answers they make wrong.

use authoring::mutants::corpus::{Edit, Mutant};
use judge::Tier;
use judge::cases::Spec;
use judge::repro;

/// A mistake in the reference, and a call whose answer it makes wrong.
pub(crate) struct Reproduction {
    pub(crate) name: &'static str,
    pub(crate) stage: &'static str,
    pub(crate) task: &'static str,
    pub(crate) case: &'static str,
    pub(crate) call: usize,
    pub(crate) edits: &'static [[&'static str; 2]],
}

/// At least one for each task that has tests.
pub(crate) const REPRODUCTIONS: [Reproduction; 20] = [
    Reproduction {
        name: "clamped",
        stage: "raygen",
        task: "part1.task1",
        case: "bright_light",
        call: 2,
        edits: &[[
            "sum += trace_ray(&ray, sampler);",
            "let l = trace_ray(&ray, sampler);\nsum += Spectrum::new(l.r.min(1.0), l.g.min(1.0), l.b);",
        ]],
    },
    Reproduction {
        name: "too_narrow",
        stage: "raygen",
        task: "part1.task1",
        case: "fresh_samples",
        call: 0,
        edits: &[["sampler.get_sample()", "0.25 + 0.5 * sampler.get_sample()"]],
    },
    Reproduction {
        name: "seed_ignored",
        stage: "raygen",
        task: "part1.task1",
        case: "fresh_offsets_for_each_seed",
        call: 0,
        edits: &[
            [
                "for _ in 0..ns_aa {",
                "let mut own = PixelSampler::new(x, y, 0);\nfor _ in 0..ns_aa {",
            ],
            ["sampler.get_sample()", "own.get_sample()"],
        ],
    },
    Reproduction {
        name: "numbers_repeat",
        stage: "raygen",
        task: "part1.task1",
        case: "fresh_numbers_for_each_ray",
        call: 0,
        edits: &[[
            "trace_ray(&ray, sampler)",
            "trace_ray(&ray, &mut PixelSampler::new(x, y, 0))",
        ]],
    },
    Reproduction {
        name: "from_nothing",
        stage: "raygen",
        task: "part1.task1",
        case: "no_samples",
        call: 0,
        edits: &[[
            "    if ns_aa == 0 {\n        return PixelEstimate::default();\n    }\n",
            "",
        ]],
    },
    Reproduction {
        name: "mirrored",
        stage: "raygen",
        task: "part1.task2",
        case: "sensor_corners",
        call: 0,
        edits: &[["(2.0 * sensor.y - 1.0)", "(1.0 - 2.0 * sensor.y)"]],
    },
    Reproduction {
        name: "culled",
        stage: "intersect",
        task: "part1.task3",
        case: "back_face",
        call: 7,
        edits: &[[
            "let det = weights.sum();\n    let scale_is_ordinary",
            "let det = weights.sum();\n    if geometric_normal(tri).dot(ray.d) > 0.0 {\n        return None;\n    }\n    let scale_is_ordinary",
        ]],
    },
    Reproduction {
        name: "not_shortened",
        stage: "intersect",
        task: "part1.task4",
        case: "nearest_of_many",
        call: usize::MAX,
        edits: &[[
            "let t = test_sphere(s, ray)?;\n    ray.max_t = t;",
            "let t = test_sphere(s, ray)?;",
        ]],
    },
    Reproduction {
        name: "z_forgotten",
        stage: "bbox",
        task: "part2.task2",
        case: "miss_on_one_axis",
        call: 32,
        edits: &[
            ["let entry = later(earlier(t_min.z, t_max.z), entry);", ""],
            ["let exit = earlier(later(t_min.z, t_max.z), exit);", ""],
        ],
    },
    Reproduction {
        name: "large_leaf",
        stage: "bvh",
        task: "part2.task1",
        case: "two_primitives",
        call: 0,
        edits: &[[
            "items.len() <= self.max_leaf_size",
            "items.len() <= self.max_leaf_size + 1",
        ]],
    },
    Reproduction {
        name: "first_of_leaf",
        stage: "bvh",
        task: "part2.task3",
        case: "leaf_in_any_order",
        call: usize::MAX,
        edits: &[[
            "closest.is_none_or(|c| (hit.t, hit.prim) < (c.t, c.prim))",
            "closest.is_none()",
        ]],
    },
    Reproduction {
        name: "never_blocked",
        stage: "bvh",
        task: "part2.task3",
        case: "clipped_rays_any_hit",
        call: usize::MAX,
        edits: &[[
            "    blocked\n    // STUB",
            "    blocked & false\n    // STUB",
        ]],
    },
    Reproduction {
        name: "no_pi",
        stage: "direct",
        task: "part3.task1",
        case: "value",
        call: 3,
        edits: &[[
            "        reflectance * FRAC_1_PI\n    } else",
            "        reflectance\n    } else",
        ]],
    },
    Reproduction {
        name: "half_density",
        stage: "direct",
        task: "part3.task1",
        case: "seen_from_below",
        call: 5,
        edits: &[["pdf: z * FRAC_1_PI,", "pdf: 0.5 * z * FRAC_1_PI,"]],
    },
    Reproduction {
        name: "summed",
        stage: "global",
        task: "part4.task1",
        case: "fresnel",
        call: 120,
        edits: &[[
            "    0.5 * (parallel * parallel + perpendicular * perpendicular)",
            "    parallel * parallel + perpendicular * perpendicular",
        ]],
    },
    Reproduction {
        name: "not_squeezed",
        stage: "global",
        task: "part4.task1",
        case: "squeezed_light",
        call: 4,
        edits: &[[
            "transmittance * (eta * eta / wi.z.abs())",
            "transmittance / wi.z.abs()",
        ]],
    },
    Reproduction {
        name: "not_scaled",
        stage: "global",
        task: "part4.task3",
        case: "survivors",
        call: usize::MAX,
        edits: &[[
            "(u < q).then(|| throughput / q)",
            "(u < q).then_some(throughput)",
        ]],
    },
    Reproduction {
        name: "upside_down",
        stage: "adaptive",
        task: "part5.task1",
        case: "spread_against_the_mean",
        call: 2,
        edits: &[[
            "Z95 * samples.standard_error() <= tolerance",
            "Z95 * samples.standard_error() > tolerance",
        ]],
    },
    Reproduction {
        name: "in_no_batches",
        stage: "adaptive",
        task: "part5.task1",
        case: "batches",
        call: 1,
        edits: &[["samples % budget.batch.max(1) == 0 && stop(", "stop("]],
    },
    Reproduction {
        name: "half_tolerance",
        stage: "adaptive",
        task: "part5.task2",
        case: "the_plain_rule_decides",
        call: 0,
        edits: &[[
            "&& rule(samples, tolerance)",
            "&& rule(samples, 0.5 * tolerance)",
        ]],
    },
];

impl Reproduction {
    /// The call and its test. `usize::MAX` means the first call whose test expects a hit.
    pub(crate) fn test(&self, specs: &[Spec]) -> (usize, String) {
        let spec = specs
            .iter()
            .find(|spec| spec.is(self.task, self.case))
            .expect("the case is there");
        let test = |call| Some((call, repro::test(spec, Tier::Core, call)?));
        let found = match self.call {
            usize::MAX => (0..100).filter_map(test).find(|(_, test)| {
                [" hits\")", " hit\")", ", true)", " continues\")"]
                    .iter()
                    .any(|text| test.contains(text))
            }),
            call => test(call),
        };
        found.unwrap_or_else(|| panic!("there is no test for {} {}", self.task, self.case))
    }

    /// The mistake as an edit of the reference.
    pub(crate) fn mutant(&self) -> Mutant {
        let edits = self.edits.iter().map(|[find, replace]| Edit {
            find: find.to_string(),
            replace: replace.to_string(),
            ..Edit::default()
        });
        Mutant {
            mistakes: vec![self.name.into()],
            on: "reference".into(),
            edits: edits.collect(),
            ..Mutant::default()
        }
    }
}
