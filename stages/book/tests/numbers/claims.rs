//! Numbers in sentences of the chapters: all of them are computed here, or listed in [`GIVEN`] as
//! inputs of a thought, which nothing is computed from.

use book::chapter::{self, Chapter};
use judge::pictures;
use kit::math;
use std::fs;
use wire::picture::Subject;

/// A chapter and a phrase of it, with computed numbers.
pub(super) type Claim = (&'static str, String);

fn claims() -> Vec<Claim> {
    [
        super::chance_light::claims(),
        super::chance_light::answers(),
        part1(),
        super::sphere_error::claims(),
        super::measured::claims(),
        super::furnace::claims(),
        super::stopping::claims(),
        part2(),
        part3(),
        part5_task1(),
        part5_task2(),
        part6_task1(),
        grading(),
        accuracy(),
    ]
    .concat()
}

fn part6_task1() -> Vec<Claim> {
    let (coordinates, bytes) = (3 * 3, u16::BITS / 8);
    let steps = u32::from(u16::MAX) + 1;
    // Camera, bounce and shadow rays, of the exact tree and of two in single precision.
    let chapter = Chapter::read("part6/task1.md".as_ref()).expect("the chapter");
    let in_a_row = "| nanoseconds, each ray 16 times in a row |";
    let row = chapter.text.lines().find_map(|l| l.strip_prefix(in_a_row));
    let times: Vec<f64> = row
        .expect("the row")
        .split(['|', '/'])
        .filter_map(|cell| cell.trim().parse().ok())
        .collect();
    let ratios = |rays: &[usize]| {
        let of = |ray: &usize| [3, 6].map(|other| times[*ray] / times[ray + other]);
        let mut all: Vec<f64> = rays.iter().flat_map(of).collect();
        all.sort_by(f64::total_cmp);
        [all[0], all[all.len() - 1]].map(|x| (10.0 * x).round() / 10.0)
    };
    let ([low, high], [least, most]) = (ratios(&[0]), ratios(&[1, 2]));
    vec![
        (
            "part6/task1.md",
            format!(
                "16 bits a coordinate are a grid of {},{} steps: {} bytes a triangle instead of {}",
                steps / 1000,
                steps % 1000,
                coordinates * bytes,
                coordinates * 8
            ),
        ),
        (
            "part6/task1.md",
            format!(
                "a camera ray takes {low} to {high} times as long as one in single precision, other rays {least} to \
                 {most} times"
            ),
        ),
    ]
}

/// What the source file at `path`, below the root of the project, gives the constant `name`.
fn constant(path: &str, name: &str) -> f64 {
    let source = fs::read_to_string(book::folder().join("../..").join(path));
    let source = source.expect("the source");
    let after = source.split(&format!("{name}: ")).nth(1);
    let line = after.and_then(|rest| rest.lines().next());
    let value = line
        .and_then(|line| line.rsplit("= ").next())
        .expect("the constant");
    let number = value.split([';', ',', ' ']).next().unwrap_or_default();
    number.replace('_', "").parse().expect("a number")
}

fn grading() -> Vec<Claim> {
    let lines = constant("grader/harness/src/watch.rs", "MOST_WRITES");
    let [likely, sure] = [("mod", "LIKELY"), ("mistake", "SURE")]
        .map(|(file, name)| 100.0 * constant(&format!("grader/src/diagnosis/{file}.rs"), name));
    vec![
        (
            "grading.md",
            format!(
                "up to 4 GB in a run and {:.0},000,000 lines in a call",
                lines / 1e6
            ),
        ),
        (
            "grading.md",
            format!("if {likely:.0} to {sure:.0} % of your wrong answers equal"),
        ),
    ]
}

/// The times are those of the plot.
fn accuracy() -> Vec<Claim> {
    let plot = book::folder().join("../../grader/pictures/triangles.svg");
    let plot = fs::read_to_string(plot).expect("the plot");
    let time = |test: &str| {
        let of_test = plot.split(&format!("<title>{test}: ")).nth(1);
        let time = of_test.and_then(|rest| rest.split(' ').next());
        time.expect("the test is in the plot").to_string()
    };
    let rays = constant("grader/cost/src/measure.rs", "        leak_rays");
    vec![
        (
            "accuracy.md",
            format!(
                "In the plot it takes {} times as long, and the reference, which is also accurate for slivers, {} times",
                time("Woop f64"),
                time("yours f64")
            ),
        ),
        (
            "accuracy.md",
            // None of n rays: with a confidence of 95 %, fewer than 3 in n.
            format!(
                "Of {:.0},000 rays half are in a mesh of ordinary triangles, half in one of needles; 0 means fewer than {:.0} in \
                 a million",
                rays / 1e3,
                3e6 / rays
            ),
        ),
    ]
}

/// Rounded to one digit, as powers of ten are in the text.
pub(super) fn one_digit(x: f64) -> f64 {
    let power = 10_f64.powf(x.log10().floor());
    (x / power).round() * power
}

fn part1() -> Vec<Claim> {
    let half = 30_f64.to_radians().tan();
    let wide = (2.0 * half).atan().to_degrees();
    let steep = (0.5 * std::f64::consts::PI).tan();
    vec![
        (
            "part1/task1.md",
            format!(
                "So to remove 9/10 of the noise, a picture takes {:.0} times as long",
                (1.0 - 0.9_f64).powi(-2)
            ),
        ),
        (
            "part1/task2.md",
            format!("Is the horizontal one {} degrees?", 2 * 60),
        ),
        (
            "part1/task2.md",
            format!(
                "Half of 60 degrees has the tangent {half:.3}, and twice that is the tangent of {wide:.1} degrees, so the \
                 horizontal field of view is {:.1} degrees",
                2.0 * wide
            ),
        ),
        (
            "part1/task2.md",
            format!(
                "the tangent takes radians: {} degrees are $\\pi$",
                std::f64::consts::PI.to_degrees()
            ),
        ),
        (
            "part1/task2.md",
            format!(
                "its tangent is about ${:.1} \\cdot 10^{{16}}$",
                steep / 1e16
            ),
        ),
    ]
}

fn subject(task: &str) -> Subject {
    pictures::of(task)
        .expect("the task has a picture")
        .work
        .subject
}

fn part2() -> Vec<Claim> {
    let tests = 480.0 * 360.0 * 100_000.0;
    let part2 = "grader/judge/src/tasks/part2_task1";
    let judge = format!("{part2}/judge.rs");
    let growth = format!("{part2}/growth.rs");
    let deepest = constant(&judge, "DEPTH_FACTOR");
    assert_eq!(constant(&judge, "COST_FACTOR"), 2.0, "twice");
    let tree_tests = "grader/judge/src/tools/truth/tree_tests.rs";
    // A number of machine epsilons. The unit roundoff is half of one.
    let slack = 2.0 * constant("stages/bvh/src/traverse.rs", "SLACK");
    let empty = 100.0 * (1.0 - std::f64::consts::PI / 6.0);
    let Subject::Leaves {
        triangles,
        max_leaf_size,
    } = subject("part2.task1")
    else {
        panic!("another picture")
    };
    let Subject::Traversal { scene, hottest, .. } = subject("part2.task3") else {
        panic!("another picture")
    };
    let wire::work::SceneSource::InCornellBox(_, mesh) = scene else {
        panic!("another scene")
    };
    let deep = judge::cases::all(0)
        .into_iter()
        .find(|spec| spec.is("part2.task3", "very_deep_tree"));
    let deep = deep.expect("the case is there").about;
    assert!(deep.contains("500 levels"), "{deep}");
    vec![
        (
            "part2/README.md",
            format!(
                "A picture of 480 by 360 pixels of a mesh with 100,000 triangles takes {:.0} billion tests; at 10 nanoseconds \
                 each that is {:.0} seconds",
                (tests / 1e9_f64).floor(),
                tests * 1e-8
            ),
        ),
        (
            "part2/task1.md",
            format!(
                "a mesh of about {} triangles",
                one_digit(triangles.len() as f64)
            ),
        ),
        (
            "part2/task1.md",
            format!("at most {max_leaf_size} triangles in a leaf"),
        ),
        (
            "part2/task1.md",
            format!("The height may be {deepest} times the reference's"),
        ),
        (
            "part2/task1.md",
            format!(
                "at most {} times as long as sorting its boxes at each level, or grows at most $n^{{{}}}$ times faster than sorting",
                constant(&growth, "FAST"),
                constant(&growth, "MAX_EXCESS")
            ),
        ),
        (
            "part2/task3.md",
            format!(
                "There may be at most {} times as many as with a fixed order of children; for `occludes_bvh`, {} times",
                constant(tree_tests, "const WORK_FACTOR"),
                constant(tree_tests, "ANY_HIT_WORK_FACTOR")
            ),
        ),
        (
            "part2/task2.md",
            format!("A sphere in a box leaves {empty:.0} % of the box empty"),
        ),
        (
            "part2/task3.md",
            format!("Each $t$ moves by ${slack} u$ times the sum"),
        ),
        (
            "part2/task3.md",
            format!("A mesh of about {mesh} triangles in a Cornell box"),
        ),
        ("part2/task3.md", format!("white from {hottest} on")),
        ("part2/task3.md", "A tree may be 500 levels deep".into()),
    ]
}

fn part3() -> Vec<Claim> {
    let gap = 1.0 - 1_f64.next_down();
    vec![(
        "part3/task1.md",
        format!("$1 - u_x$ is ${:.1} \\cdot 10^{{-16}}$", gap * 1e16),
    )]
}

/// The share of a bell curve within `z` standard deviations, by Simpson's rule.
fn within(z: f64) -> f64 {
    const STEPS: u32 = 2000;
    let h = z / f64::from(STEPS);
    let density = |x: f64| math::exp(-0.5 * x * x) / std::f64::consts::TAU.sqrt();
    let weight = |i: u32| match i {
        0 | STEPS => 1.0,
        i if i % 2 == 1 => 4.0,
        _ => 2.0,
    };
    let sum: f64 = (0..=STEPS)
        .map(|i| weight(i) * density(h * f64::from(i)))
        .sum();
    2.0 * sum * h / 3.0
}

fn part5_task1() -> Vec<Claim> {
    let Subject::Adaptive {
        ns_aa,
        batch,
        tolerance,
        ..
    } = subject("part5.task1")
    else {
        panic!("another picture")
    };
    let share = 100.0 * within(1.96);
    assert!(
        (within(1.95996) - 0.95).abs() < 1e-6,
        "neither 2 nor 1.95996"
    );
    vec![
        (
            "part5/task1.md",
            format!(
                "at most {ns_aa} samples for a pixel, in batches of {batch}, with a tolerance of {:.0} %",
                100.0 * tolerance
            ),
        ),
        (
            "part5/task1.md",
            format!("Blue is few, green is half, red is all {ns_aa}."),
        ),
        (
            "part5/task1.md",
            format!("If the count is always {ns_aa}, the lower panel is all red."),
        ),
        (
            "part5/task1.md",
            format!("the sum is divided by {ns_aa} all the same"),
        ),
        (
            "part5/task1.md",
            format!("Of a bell curve, {share:.0} % lie within 1.96 standard deviations"),
        ),
        (
            "part5/task1.md",
            "The number is 1.96, neither 2 nor 1.95996".into(),
        ),
    ]
}

fn part5_task2() -> Vec<Claim> {
    let Subject::RareLight {
        ns_aa,
        batch,
        tolerance,
    } = subject("part5.task2")
    else {
        panic!("another picture")
    };
    let fewest = constant("stages/adaptive/src/stop.rs", "FEWEST_SAMPLES");
    vec![
        (
            "part5/task2.md",
            format!(
                "A pixel takes at most {ns_aa} samples, in batches of {batch}, with a tolerance of {:.0} %",
                100.0 * tolerance
            ),
        ),
        (
            "part5/README.md",
            format!(
                "Here the least is green: {fewest} samples of {}",
                2.0 * fewest
            ),
        ),
        (
            "part5/task2.md",
            format!("it stops at {fewest} samples, the fewest allowed"),
        ),
        (
            "part5/task2.md",
            format!("If black pixels may stop at {fewest} samples"),
        ),
        (
            "part5/task2.md",
            format!("The course asks for {fewest} samples at least"),
        ),
        (
            "part5/task2.md",
            format!("({fewest}) samples, a mean above 0"),
        ),
        (
            "part5/task2.md",
            format!("{fewest} samples are enough; {} are not", fewest - 1.0),
        ),
    ]
}

/// Phrases with numbers that are inputs of a thought, settings of a picture that the text names, or
/// results of one measurement.
const GIVEN: &[(&str, &str)] = &[
    ("accuracy.md", "against 8192 Sobol samples"),
    ("rendering.md", "COLLADA of Blender 2.80 or later"),
    (
        "rendering.md",
        "the first two take 0.75 to 1.00 times as long for the same mean squared error in 13\nscenes",
    ),
    (
        "rendering.md",
        "and 0.58 to 0.86 times in three of them at `-m 20`",
    ),
    (
        "rendering.md",
        "With the third a Cornell box takes 0.66 to 1.00 times as long again, and a room with one small lamp in view 0.03 times",
    ),
    (
        "rendering.md",
        "these scenes take so many times as long for the same mean squared error: `cornell_whale` 0.23,\n`cornell_spheres` 0.26, `window_room` 0.37",
    ),
    ("rendering.md", "First 16,384 paths from the lamps"),
    (
        "rendering.md",
        "the scene `cornell_mirror_glass` takes 0.63 times as long for the same mean squared error, `gallery`\n0.68 times. It does not pay where nearly everything is mirrors and glass: `gems` and `spheres` take 1.3 times as long,\n`sphereflake` 1.6 times",
    ),
    (
        "rendering.md",
        "scene: `cornell_mirror_glass` 1.2, `stairs_sky` 1.05",
    ),
    (
        "rendering.md",
        "A room with 12 lamps takes 0.7 times as long for the same\nerror, one with 100 lamps 0.3 times",
    ),
    (
        "accuracy.md",
        "(Xeon, 2.5 GHz, AVX-512, beside other programs)",
    ),
    ("accuracy.md", "320 x 240 pixels, 64 samples"),
    ("grading.md", "not a tolerance like 0.001"),
    ("grading.md", "on 1106 of 1106 calls"),
    // Measured by hand on 574 names of mistakes that others wrote.
    (
        "grading.md",
        "*likely* was right in 93 of 100, *perhaps* in 67 of 100",
    ),
    // Of the report above it, which tests/course.rs compares with the README's.
    ("grading.md", "*hit or miss wrong on 150 of 630 calls*"),
    ("debugging.md", "Scale the scene by 1024, with"),
    ("getting-started.md", "Part 1 needs 300 lines"),
    (
        "part1/task1.md",
        "at 0.35 of its width and 0.4 of its height",
    ),
    ("part1/task1.md", "in one of 1000 samples"),
    ("part1/task2.md", "Angles of 180 degrees and just below"),
    ("part1/task2.md", "a camera that is turned by 180 degrees"),
    (
        "part1/task2.md",
        "from a millionth of a degree to 180 degrees",
    ),
    ("part1/task2.md", "At 180 degrees the tangent"),
    ("part1/task2.md", "and near 180 degrees it does not project"),
    ("part1/task2.md", "Perspective at 150 degrees"),
    // tests/course.rs compares this number with the table of accuracy.md.
    ("part1/task3.md", "one of them of needles, 6.5 % leak"),
    // Proved in the paper that intersect/src/exact.rs names.
    ("part1/task3.md", "an error of 1.5 ulp at most"),
    // Once, with the reference and another slack.
    ("part2/task3.md", "of 2.4 million rays"),
    ("part3/task2.md", "A fixed offset such as 0.001"),
    ("part4/task1.md", "= 1/1.5, 1.5, 1 and 2.4"),
    ("part4/task1.md", "for 1.5 and 1/1.5"),
    ("part4/task3.md", "a largest channel of 1.25"),
    ("part4/task3.md", "survive with at most 95 %"),
    ("part5/task1.md", "Without the factor 1.96"),
    ("part5/task1.md", "1.96 times the standard error"),
    (
        "part5/task1.md",
        "with a confidence of about 95 %, $$\\lvert \\mu - I \\rvert \\le 1.96 \\, s.$$",
    ),
    ("part5/task1.md", "$$1.96 \\, s \\le \\tau \\mu.$$"),
    (
        "part5/task1.md",
        "$n \\ge (1.96 \\, \\sigma / (\\tau \\mu))^2$",
    ),
    ("part5/task1.md", "lies with a confidence of 95 %"),
    (
        "part5/task2.md",
        "from 1 at the right edge to 0.005 at the left one",
    ),
    ("part5/task2.md", "met by one sample of 1000"),
    ("part5/task2.md", "How many of 100 pixels"),
    (
        "part5/task2.md",
        "\\left( \\frac{1.96}{\\tau} \\right)^2 \\frac{1}{p}",
    ),
    (
        "part5/task2.md",
        "\\left( \\frac{1.96}{\\tau} \\right)^2.$$",
    ),
    ("part5/task2.md", "to one of 3000 on the right"),
    // Measured: see the text for how.
    (
        "accuracy.md",
        "1.06 times as fast on the head, 1.03 on the terrain and 1.63 on the knot.",
    ),
    ("accuracy.md", "1.06, 1.09 and 1.87 times as fast."),
    (
        "part6/task1.md",
        "the large mesh of the course, a head of 50,801 triangles,",
    ),
    (
        "part6/task1.md",
        "a ray executes 310 instructions before its first node",
    ),
    ("part6/task1.md", "170 for each leaf"),
    ("part6/task1.md", "240 for each hit in double precision"),
];

/// The text in one line.
fn flat(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn sentences_have_the_computed_numbers() {
    let chapters = chapter::all().expect("all chapters");
    let given = GIVEN.iter().map(|(path, words)| (*path, words.to_string()));
    for (path, words) in claims().into_iter().chain(given) {
        let of_path = |chapter: &&Chapter| chapter.path.as_os_str() == path;
        let chapter = chapters.iter().find(of_path).expect("the chapter");
        assert!(
            flat(&chapter.text).contains(&flat(&words)),
            "{path} does not say: {words}"
        );
    }
}

/// The chapters without worked examples, code, tables and lists of literature.
fn prose(chapter: &Chapter) -> String {
    let mut text = chapter.text.clone();
    for title in ["A worked example", "Exercises and reading"] {
        if let Some(section) = chapter.section(title) {
            text = text.replace(&section.text, "\n");
        }
    }
    let text: String = text.split("```").step_by(2).collect();
    let lines = text.lines().filter(|line| !line.starts_with('|'));
    let text = flat(&lines.collect::<Vec<_>>().join("\n"));
    // Inline code and the targets of links.
    let text: String = text.split('`').step_by(2).collect();
    let mut parts = text.split("](");
    let first = parts.next().unwrap_or_default().to_string();
    parts.fold(first, |all, part| {
        all + "]" + part.split_once(')').map_or("", |(_, rest)| rest)
    })
}

/// The numbers that must have been computed: those with a decimal point, of three digits or more,
/// percentages and powers of ten; not years.
fn telling_numbers(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let chars: Vec<char> = text.chars().collect();
    let mut i = 0;
    while i < chars.len() {
        if !chars[i].is_ascii_digit() {
            i += 1;
            continue;
        }
        let start = i;
        let is_part = |i: usize| {
            let is_digit = |i: usize| chars.get(i).is_some_and(char::is_ascii_digit);
            is_digit(i) || chars.get(i) == Some(&'.') && is_digit(i + 1)
        };
        while is_part(i) {
            i += 1;
        }
        let number: String = chars[start..i].iter().collect();
        let rest: String = chars[i..chars.len().min(i + 2)].iter().collect();
        let is_year = number.len() == 4 && (number.starts_with("19") || number.starts_with("20"));
        let is_telling = number.contains('.')
            || number.len() >= 3 && !is_year
            || rest.starts_with(" %")
            || number == "10" && rest.starts_with('^');
        if is_telling {
            let from = start.saturating_sub(40);
            let until = chars.len().min(i + 20);
            found.push(chars[from..until].iter().collect());
        }
    }
    found
}

#[test]
fn telling_numbers_are_found() {
    let count = |text: &str| telling_numbers(text).len();
    assert_eq!(count("0.5 and 120, 5 %, $10^{-8}$"), 4);
    assert_eq!(count("in 2013, 16 of 24. The 3 others"), 0);
}

const MEASURED_ELSEWHERE: [&str; 5] = [
    "hosting.md",
    "reading.md",
    "hard-cases.md",
    "glossary.md",
    "ray-casters.md",
];

/// Every number of the text is computed or listed as given. Those of [Hosting](hosting.md) and
/// [Further reading](reading.md) are points, which `course.rs` compares, and literature; those of
/// [Hard cases](hard-cases.md) count the cases. [What real ray casters answer](ray-casters.md) was
/// measured once, with libraries that are not installed here.
#[test]
fn no_number_is_left_to_chance() {
    let given = GIVEN.iter().map(|(path, words)| (*path, words.to_string()));
    let known: Vec<Claim> = claims().into_iter().chain(given).collect();
    let mut unknown = Vec::new();
    for chapter in chapter::all().expect("all chapters") {
        let path = chapter.path.display().to_string();
        if MEASURED_ELSEWHERE.contains(&path.as_str()) {
            continue;
        }
        let mut text = prose(&chapter);
        for (_, words) in known.iter().filter(|(of, _)| *of == path) {
            let words: String = flat(words).split('`').step_by(2).collect();
            text = text.replace(&words, "");
        }
        let numbers = telling_numbers(&text);
        unknown.extend(numbers.iter().map(|near| format!("{path}: ...{near}...")));
    }
    assert!(
        unknown.is_empty(),
        "compute these numbers in claims.rs, or list them as given:\n{}",
        unknown.join("\n")
    );
}
