//! Tests the Rust test in a report: it must fail on code with the mistake and pass on the
//! reference.

use authoring::mutants::corpus::{Edit, Mutant, Sources, reference_sources};
use grader::workspace::Workspace;
use judge::Tier;
use judge::cases;
use judge::repro;
use std::path::Path;
use std::process::{Command, Output};

/// A mistake in the reference, and a call whose answer it makes wrong.
struct Reproduction {
    name: &'static str,
    stage: &'static str,
    task: &'static str,
    case: &'static str,
    call: usize,
    edits: &'static [[&'static str; 2]],
}

const REPRODUCTIONS: [Reproduction; 17] = [
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
    /// The test for the call. `usize::MAX` means the first call whose test expects a hit.
    fn test(&self) -> String {
        let specs = cases::all(0);
        let spec = specs.iter().find(|spec| spec.is(self.task, self.case));
        let spec = spec.expect("the case is there");
        let test = |call| repro::test(spec, Tier::Core, call);
        let found = match self.call {
            usize::MAX => (0..100).filter_map(test).find(|test| {
                [" hits\")", " hit\")", ", true)", " continues\")"]
                    .iter()
                    .any(|text| test.contains(text))
            }),
            call => test(call),
        };
        found.unwrap_or_else(|| panic!("there is no test for {} {}", self.task, self.case))
    }

    /// The reference with the mistake in it.
    fn wrong(&self, reference: &Sources) -> Sources {
        let edits = self.edits.iter().map(|[find, replace]| Edit {
            find: find.to_string(),
            replace: replace.to_string(),
        });
        let mutant = Mutant {
            code: None,
            mistakes: vec![self.name.into()],
            on: "reference".into(),
            how: String::new(),
            edits: edits.collect(),
            held_out: false,
        };
        mutant.apply(reference).expect("the edit finds its text")
    }
}

/// Writes a package whose library has the stage's name, with the test in its `tests` folder.
fn write_package(folder: &Path, reproduction: &Reproduction, sources: &Sources, kit: &Path) {
    let manifest = format!(
        "[package]\nname = \"{}\"\nedition = \"2024\"\n\n[lib]\nname = \"{}\"\n\n[dependencies]\nkit = {{ path = {kit:?} }}\n\n[lints]\nworkspace = true\n",
        folder.file_name().unwrap().display(),
        reproduction.stage
    );
    let write = |path: &Path, text: &str| {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    write(&folder.join("Cargo.toml"), &manifest);
    let test = repro::as_file(
        "The worst answer of",
        reproduction.task,
        &reproduction.test(),
    );
    write(&folder.join("tests/worst.rs"), &test);
    for (path, text) in sources {
        write(&folder.join("src").join(path), text);
    }
}

/// Runs the tests of the packages whose names begin with `prefix`.
fn run(job: &Path, target: &Path, prefix: &str) -> Output {
    let mut cargo = Command::new(env!("CARGO"));
    cargo
        .current_dir(job)
        .args(["test", "--offline", "--no-fail-fast", "--test", "worst"])
        .arg("--target-dir")
        .arg(target);
    for reproduction in &REPRODUCTIONS {
        cargo.args(["-p", &format!("{prefix}_{}", reproduction.name)]);
    }
    cargo.output().expect("cargo runs")
}

#[test]
fn reported_tests_fail_on_the_mistake_and_pass_on_the_reference() {
    let workspace = Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let root = workspace.root();
    let job = root.join("target/repro/job");
    let _ = std::fs::remove_dir_all(&job);
    std::fs::create_dir_all(&job).unwrap();
    let members = REPRODUCTIONS.iter().flat_map(|reproduction| {
        ["right", "wrong"].map(|kind| format!("\"{kind}_{}\"", reproduction.name))
    });
    let members: Vec<String> = members.collect();
    let manifest = format!(
        "[workspace]\nresolver = \"3\"\nmembers = [{}]\n\n[workspace.lints.rust]\nmissing_docs = \"warn\"\n",
        members.join(", ")
    );
    std::fs::write(job.join("Cargo.toml"), manifest).unwrap();
    std::fs::copy(root.join("Cargo.lock"), job.join("Cargo.lock")).unwrap();
    for reproduction in &REPRODUCTIONS {
        let reference = reference_sources(&workspace, reproduction.stage).unwrap();
        let wrong = reproduction.wrong(&reference);
        for (kind, sources) in [("right", &reference), ("wrong", &wrong)] {
            let folder = job.join(format!("{kind}_{}", reproduction.name));
            write_package(&folder, reproduction, sources, &root.join("stages/kit"));
        }
    }
    let target = root.join("target/repro/target");
    let right = run(&job, &target, "right");
    let stdout = String::from_utf8_lossy(&right.stdout);
    let stderr = String::from_utf8_lossy(&right.stderr);
    assert!(right.status.success(), "{stderr}\n{stdout}");
    assert_eq!(
        stdout.matches("test result: ok. 1 passed").count(),
        REPRODUCTIONS.len()
    );
    assert!(!stderr.contains("tests/worst.rs:"), "a warning:\n{stderr}");
    let wrong = run(&job, &target, "wrong");
    let stdout = String::from_utf8_lossy(&wrong.stdout);
    let stderr = String::from_utf8_lossy(&wrong.stderr);
    assert_eq!(
        stdout
            .matches("test result: FAILED. 0 passed; 1 failed")
            .count(),
        REPRODUCTIONS.len(),
        "{stderr}\n{stdout}"
    );
}
