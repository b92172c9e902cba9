//! Tests the page of `grader cost`: it is self-contained and legible, and its captions follow the
//! numbers.

use cost::page::{page, plot};
use cost::picture::{ConfidenceInterval, Curve, CurvePoint, Experiment, PictureReport, Thumbnail};
use cost::quartiles::Quartiles;
use cost::report::{
    Accuracy, CostReport, Errors, KernelFamily, KernelRow, Machine, Precision, Quantiles,
    RayColumn, RayFamily, Shape, Timing,
};
use cost::trees::{
    BreakEven, ExactnessRow, SlackRow, TraversalCost, TreeReport, TreeRow, WrongHits,
};

/// A time of `ratio ± 0.02` times the base's `base_ns`.
fn timing(base_ns: f64, ratio: f64) -> Timing {
    let ratio = Quartiles {
        lower: ratio - 0.02,
        median: ratio,
        upper: ratio + 0.02,
    };
    Timing {
        ns: ratio.scaled(base_ns),
        ratio,
    }
}

fn accuracy(family: RayFamily, relative: f64, wrong: f64) -> Accuracy {
    let quantiles = |p50: f64| Quantiles {
        p50,
        p999: 10.0 * p50,
        max: 100.0 * p50,
    };
    Accuracy {
        family,
        rays: 1000,
        false_hits_per_million: wrong / 2.0,
        false_misses_per_million: wrong / 2.0,
        undecidable_per_million: 0.0,
        undecidable_differing_per_million: 0.0,
        beyond_bound_per_million: 0.0,
        t: Some(Errors {
            ulp: quantiles(relative / 1e-16),
            relative: quantiles(relative),
        }),
        position: None,
        off_surface: None,
        cdf: vec![(0.0, 0.2), (relative, 0.5), (100.0 * relative, 1.0)],
        forward_bound: vec![(1e3 * relative, 0.5), (1e4 * relative, 1.0)],
    }
}

/// A kernel that takes `ratio` times the textbook's time, with leaks and with wrong decisions at
/// edges.
fn row(name: &str, precision: Precision, ratio: f64, leaks: f64, wrong: f64) -> KernelRow {
    let relative = if precision == Precision::F32 {
        1e-7
    } else {
        1e-16
    };
    KernelRow {
        name: name.into(),
        precision,
        paper: "a paper".into(),
        student: name == "yours",
        textbook: ratio == 1.0,
        uses_fma: name == "fused",
        time: timing(10.0, ratio),
        time_with_fma: (name != "yours").then(|| timing(9.0, ratio.min(1.2))),
        operations: None,
        leaks_per_million: Some(leaks),
        grid: None,
        by_ray_family: vec![
            accuracy(RayFamily::Ordinary, relative, 0.0),
            accuracy(RayFamily::Edge, 3.0 * relative, wrong),
        ],
    }
}

fn family(rows: Vec<KernelRow>) -> KernelFamily {
    let column = |family| RayColumn {
        family,
        about: "description & more".into(),
    };
    KernelFamily {
        shape: Shape::Triangle,
        columns: vec![column(RayFamily::Ordinary), column(RayFamily::Edge)],
        rows,
        student_missing: None,
        student_leaks: None,
    }
}

fn rows(leaks_of_tight: f64, wrong: f64) -> Vec<KernelRow> {
    vec![
        row("Möller-Trumbore", Precision::F64, 1.0, 69_000.0, 0.0),
        row("Möller-Trumbore", Precision::F32, 0.7, 70_000.0, 300_000.0),
        row("Woop", Precision::F64, 1.5, leaks_of_tight, wrong),
        row("yours", Precision::F64, 0.9, 0.0, 0.0),
    ]
}

fn thumbnail() -> Thumbnail {
    Thumbnail::of([2, 1], &[[0.5; 3], [0.0; 3]])
}

fn curve(name: &str, slope: f64, bias: Option<f64>) -> Curve {
    let exact = |value: f64| ConfidenceInterval {
        value,
        low: 0.9 * value,
        high: 1.1 * value,
    };
    let point = |samples: f64| CurvePoint {
        flags: format!("-s {samples}"),
        samples,
        seconds: Quartiles::of([0.9, 1.0, 1.2]).scaled(1e-3 * samples),
        rmse: exact(samples.powf(slope)),
        relative_mse: exact(samples.powf(2.0 * slope)),
        variance: samples.powf(2.0 * slope),
        bias,
        mean_difference: -bias.unwrap_or(0.0),
        efficiency: Some(1e3 / samples.powf(2.0 * slope + 1.0)),
        relative_efficiency: Some(Quartiles::of([1.9, 2.0, 2.2])),
    };
    Curve {
        name: name.into(),
        flags: String::new(),
        points: [4.0, 16.0, 64.0].map(point).into(),
        slope: Some(slope),
        at_equal_time: Some((1, thumbnail())),
    }
}

/// A tree that loses some of 10,000 hits, half of them missed.
fn exactness(box_test: &str, precision: Precision, ratio: f64, lost: usize) -> ExactnessRow {
    ExactnessRow {
        split: "midpoint".into(),
        box_test: box_test.into(),
        triangle_test: "Woop".into(),
        precision,
        slack_ulp: 16,
        time: timing(400.0, ratio),
        rays: 10_000,
        missed: lost / 2,
        wrong: lost - lost / 2,
        grid_rays: 3_000,
        grid_lost: lost / 10,
    }
}

/// The better tree takes 10 ms more to build and saves 100 ns per ray.
fn trees() -> TreeReport {
    let trace = |ns: f64, wrong: usize| TraversalCost {
        time: timing(400.0, ns / 400.0),
        box_tests: 30.0,
        prim_tests: 5.0,
        ordinary: WrongHits {
            rays: 256,
            wrong: 0,
        },
        crafted: Some(WrongHits { rays: 9000, wrong }),
    };
    let tree = |name: &str, build_s: f64, ns: f64, break_even| TreeRow {
        name: name.into(),
        paper: String::new(),
        student: false,
        build_s: Quartiles::of([build_s]),
        nodes: Some(100),
        trace: trace(ns, 0),
        break_even,
    };
    let after = BreakEven::After {
        rays: 1e5,
        at_least: 9e4,
        at_most: 2e5,
    };
    TreeReport {
        mesh: "smooth".into(),
        triangles: 10_000,
        by_slack: vec![SlackRow {
            slack_ulp: 2,
            trace: trace(440.0, 7),
        }],
        by_build: vec![
            tree("midpoint", 5e-3, 400.0, BreakEven::Base),
            tree("SAH", 15e-3, 300.0, after),
            tree("median", 6e-3, 404.0, BreakEven::WithinNoise),
        ],
        by_precision: vec![
            exactness("Ize, 2 ulp", Precision::F64, 1.0, 0),
            exactness("Ize, 2 ulp", Precision::F32, 0.9, 31),
            exactness("Williams", Precision::F32, 0.8, 330),
            // Another tree does not change what the tests cost.
            ExactnessRow {
                split: "SAH".into(),
                ..exactness("Ize, 2 ulp", Precision::F64, 0.7, 0)
            },
        ],
        student_missing: None,
    }
}

fn report(rows: Vec<KernelRow>, bias: Option<f64>) -> CostReport {
    CostReport {
        machine: Machine {
            cpu: "a <fast> processor".into(),
            cores: 2,
            rustc: "rustc".into(),
            target_features: vec!["sse2".into()],
            has_fma: true,
        },
        seed: 7,
        quick: false,
        families: vec![family(rows)],
        bvh: Some(trees()),
        world: None,
        pictures: Some(PictureReport {
            experiments: vec![Experiment {
                title: "samples".into(),
                scene: "a.dae".into(),
                film: [8, 6],
                cell: [0, 0, 8, 6],
                seeds: 3,
                converged: "-s 512".into(),
                is_relative: false,
                samples_are: "positions in a pixel".into(),
                reference: Some(thumbnail()),
                converged_rmse: 1e-3,
                curves: vec![
                    curve("independent", -0.5, None),
                    curve("stratified", -0.75, bias),
                ],
                missing: None,
            }],
            missing: None,
        }),
    }
}

fn html(report: &CostReport) -> String {
    page(report).replace('\u{a0}', " ")
}

/// Returns the SVG elements of a page.
fn plots(page: &str) -> Vec<&str> {
    let ends = page.match_indices("</svg>").map(|(i, end)| i + end.len());
    let starts = page.match_indices("<svg").map(|(i, _)| i);
    starts
        .zip(ends)
        .map(|(start, end)| &page[start..end])
        .collect()
}

#[test]
fn the_page_is_self_contained() {
    let page = html(&report(rows(0.0, 0.0), None));
    assert_eq!(
        plots(&page).len(),
        12,
        "pareto, heat map, distributions, exactness, trees and pictures for two widths"
    );
    for place in ["src=\"", "href=\""] {
        for (i, _) in page.match_indices(place) {
            let address = &page[i + place.len()..];
            assert!(address.starts_with("data:image/png;base64,") || address.starts_with('#'));
        }
    }
    assert!(!page.contains("<script ") && !page.contains("@import") && !page.contains("url("));
    assert!(page.contains("a &lt;fast&gt; processor"));
    assert!(!page.contains("NaN") && !page.contains("inf "));
}

/// Everything lies on its canvas: nothing is clipped. A letter is assumed to be 0.56 of its font
/// size wide.
#[test]
fn no_text_is_clipped() {
    let page = html(&report(rows(0.0, 1000.0), Some(0.02)));
    for plot in plots(&page) {
        let file = roxmltree::Document::parse(plot).expect("well-formed");
        let canvas = file
            .root_element()
            .attribute("viewBox")
            .expect("a view box");
        let ends: Vec<f64> = canvas
            .split(' ')
            .map(|end| end.parse().expect("a number"))
            .collect();
        let texts = file.descendants().filter(|node| node.has_tag_name("text"));
        for text in texts {
            let number = |name| {
                text.attribute(name)
                    .expect(name)
                    .parse::<f64>()
                    .expect(name)
            };
            let said = text.text().unwrap_or("").trim();
            let size = number("font-size");
            let long = 0.56 * size * said.chars().count() as f64;
            let before = match text.attribute("text-anchor") {
                Some("middle") => 0.5 * long,
                Some("end") => long,
                _ => 0.0,
            };
            // Upright text extends along the other axis.
            let (along, end) = match text.attribute("transform") {
                Some(_) => (ends[3] - number("y"), ends[3]),
                None => (number("x"), ends[2]),
            };
            assert!(
                along - before >= 0.0 && along - before + long <= end,
                "“{said}” is clipped"
            );
            assert!(
                (0.0..=ends[3]).contains(&number("y")),
                "“{said}” is above or below"
            );
            // Four units are one point.
            assert!(size / 4.0 >= 8.5, "“{said}” is too small to read");
        }
    }
}

/// With all families of rays the cells of a telephone's heat map are narrow.
#[test]
fn numbers_fit_their_cells() {
    let mut all = family(rows(5.0, 0.0));
    all.columns = RayFamily::ALL
        .map(|family| RayColumn {
            family,
            about: String::new(),
        })
        .into();
    for (i, row) in all.rows.iter_mut().enumerate() {
        let wrong = [0.0, 5.0, 110_000.0, 1e6][i];
        row.by_ray_family = RayFamily::ALL
            .map(|family| accuracy(family, 1e-16, wrong))
            .into();
    }
    let mut report = report(vec![], None);
    report.families = vec![all];
    let page = html(&report);
    let mut cells = 0;
    for plot in plots(&page) {
        let file = roxmltree::Document::parse(plot).expect("well-formed");
        let number = |node: roxmltree::Node, name| -> f64 {
            let text = node.attribute(name).expect(name);
            text.parse().expect(name)
        };
        let tips = || {
            let rects = file.descendants().filter(|n| n.has_tag_name("rect"));
            rects.filter(|rect| rect.attribute("class") == Some("tip"))
        };
        for text in file.descendants().filter(|n| n.has_tag_name("text")) {
            let (x, y) = (number(text, "x"), number(text, "y"));
            let Some(cell) = tips().find(|rect| {
                let [left, top] = ["x", "y"].map(|name| number(*rect, name));
                (left..left + number(*rect, "width")).contains(&x)
                    && (top..top + number(*rect, "height")).contains(&y)
            }) else {
                continue;
            };
            let said = text.text().unwrap_or("").trim();
            let long = 0.56 * number(text, "font-size") * said.chars().count() as f64;
            assert!(long <= number(cell, "width"), "“{said}” is cut");
            cells += 1;
        }
    }
    assert_eq!(cells, 2 * 4 * (RayFamily::ALL.len() + 1));
}

/// What a page says: a line for each heading, paragraph, caption and row, without plots.
fn words(page: &str) -> String {
    let mut text = String::new();
    let mut hidden = None;
    for part in page.split('<').skip(1) {
        let (tag, said) = part.split_once('>').unwrap_or((part, ""));
        let name = tag.split(' ').next().unwrap_or(tag);
        match hidden {
            None if ["style", "script", "svg"].contains(&name) => hidden = Some(name),
            Some(end) if name.strip_prefix('/') == Some(end) => hidden = None,
            _ => {}
        }
        if hidden.is_none() {
            text.push_str(match name {
                "h1" | "h2" | "h3" | "p" | "tr" | "li" | "figcaption" | "summary" => "\n",
                "td" | "th" => " | ",
                _ => "",
            });
            text.push_str(said.trim_matches('\n'));
        }
    }
    text
}

/// Compares what pages say with a snapshot: of those after the first, the lines that differ from
/// it. `look_for` says what the reader of the snapshot looks for.
fn shows(name: &str, look_for: &str, reports: &[CostReport]) {
    let said: Vec<String> = reports.iter().map(|report| words(&html(report))).collect();
    let first: Vec<&str> = said[0].lines().collect();
    let mut text = said[0].clone();
    for other in &said[1..] {
        text += &format!("\n{}\n", "=".repeat(80));
        let new = other.lines().filter(|line| !first.contains(line));
        text.extend(new.flat_map(|line| [line, "\n"]));
    }
    let mut settings = insta::Settings::clone_current();
    settings.set_description(look_for);
    settings.set_omit_expression(true);
    settings.set_prepend_module_to_snapshot(false);
    settings.set_snapshot_path("pages");
    settings.bind(|| insta::assert_snapshot!(name, text));
}

#[test]
fn headings_captions_and_rows_follow_the_numbers() {
    let mut free = rows(0.0, 0.0);
    free[2].time = timing(10.0, 1.01);
    // The slower f32 tree alone: within the error bars it is not faster.
    let mut tie = report(rows(0.0, 0.0), None);
    let trees = tie.bvh.as_mut().expect("trees");
    trees.by_precision.truncate(2);
    trees.by_precision[1].time = timing(400.0, 0.99);
    // It may lose hits at the integer terrain alone.
    let mut at_a_grid = tie.clone();
    let trees = at_a_grid.bvh.as_mut().expect("trees");
    let lossy = &mut trees.by_precision[1];
    (lossy.missed, lossy.wrong, lossy.grid_lost) = (0, 0, 300);
    let mut fused = rows(0.0, 0.0);
    fused.insert(3, row("fused", Precision::F64, 2.2, 0.0, 0.0));
    let mut missing = report(rows(0.0, 0.0), None);
    missing.families[0].rows.pop();
    missing.families[0].student_missing = Some("part1.task3 is not written yet".into());
    missing.pictures = Some(PictureReport {
        experiments: Vec::new(),
        missing: Some("the program pathtracer does not compile".into()),
    });
    shows(
        "cost",
        "whole: Woop never leaks and is never wrong, exact hits cost 25 %, stratified is four times as fast. Then what is new: Woop for nothing; a tree that is not faster, and one that loses hits at a grid alone; leaks everywhere and a bias; a kernel with FMA; what is missing",
        &[
            report(rows(0.0, 0.0), None),
            report(free, None),
            tie,
            at_a_grid,
            report(rows(5.0, 2000.0), Some(0.02)),
            report(fused, None),
            missing,
        ],
    );
}

/// Names are beside the points, numbers in tooltips and in tables.
#[test]
fn each_test_is_named_at_its_point_and_has_a_tooltip() {
    let page = html(&report(rows(0.0, 0.0), Some(0.02)));
    let pareto = roxmltree::Document::parse(plots(&page)[0]).expect("well-formed");
    let texts = |tag: &str| -> Vec<&str> {
        let nodes = pareto.descendants().filter(|node| node.has_tag_name(tag));
        nodes.filter_map(|node| Some(node.text()?.trim())).collect()
    };
    let (names, tips) = (texts("text"), texts("title"));
    for name in [
        "Möller-Trumbore (textbook)",
        "Möller-Trumbore",
        "Woop",
        "yours",
    ] {
        assert!(names.contains(&name), "no {name} in {names:?}");
    }
    assert_eq!(tips.len(), 4);
    assert!(tips[0].contains("of the textbook's time, "), "{tips:?}");
}

/// The trees of the plot of exactness: further right is faster, further down loses less, and zero
/// is apart.
#[test]
fn exactness_is_drawn_at_its_speed_and_its_losses() {
    let mut report = report(rows(0.0, 0.0), None);
    report.families.clear();
    let file = plot(&report).expect("trees are measured");
    assert!(file.contains("In the same tree, exact hits cost 25 % more time than Woop in f32"));
    // The legend names what the markers stand for, and the other trees only if there are some.
    let has_text = |file: &str, text: &str| file.contains(&format!(">{text}</text>"));
    let trees = report.bvh.as_ref().expect("trees");
    let others = trees
        .by_precision
        .iter()
        .any(|row| row.split != trees.by_precision[0].split);
    assert!(has_text(&file, "f64") && has_text(&file, "f32"));
    assert_eq!(has_text(&file, "another tree"), others);
    let file = roxmltree::Document::parse(&file).expect("a whole SVG file");
    let points: Vec<(f64, f64, String)> = file
        .descendants()
        .filter(|node| node.attribute("class") == Some("tip"))
        .map(|node| {
            let number = |name| node.attribute(name).and_then(|n| n.parse().ok());
            let title = node.first_element_child().and_then(|child| child.text());
            (
                number("cx").expect("cx"),
                number("cy").expect("cy"),
                title.expect("a title").into(),
            )
        })
        .collect();
    let [exact, slower, faster, other] = &points[..] else {
        panic!("{points:?}");
    };
    assert!(exact.0 < slower.0 && slower.0 < faster.0, "{points:?}");
    assert!(exact.1 > slower.1 && slower.1 > faster.1, "{points:?}");
    assert!(other.0 > faster.0 && other.1 == exact.1, "{points:?}");
    // One decade lies between the two that lose hits, less between the lesser one and zero.
    let decade = (slower.1 - faster.1) / (330.0_f64 / 31.0).log10();
    assert!(exact.1 - slower.1 < decade && decade > 500.0, "{points:?}");
    let losses = "16,500 missed in a million, 16,500 wrong in a million, 11,000 lost on a grid";
    assert!(faster.2.ends_with(losses), "{points:?}");
}

#[test]
fn pictures_of_equal_time_and_of_leaks_are_embedded() {
    let page = html(&report(rows(0.0, 0.0), None));
    let section = &page[page.find("class=\"thumbnails\"").expect("thumbnails")..];
    assert_eq!(section.matches("<img src=\"data:image/png").count(), 3);
    // The leaks in the picture are computed with the kernels, not taken from the report.
    assert!(page.contains("alt=\"a closed mesh, 0 leaks in magenta\""));
}

/// Each kernel has a bar from quartile to quartile of its time, with a stroke at both ends.
#[test]
fn times_have_error_bars() {
    let page = html(&report(rows(0.0, 0.0), None));
    let pareto = roxmltree::Document::parse(plots(&page)[0]).expect("well-formed");
    let lines = pareto.descendants().filter_map(|node| {
        let ends: Vec<(f64, f64)> = node
            .attribute("points")?
            .split_whitespace()
            .filter_map(|end| {
                let (x, y) = end.split_once(',')?;
                Some((x.parse().ok()?, y.parse().ok()?))
            })
            .collect();
        <[(f64, f64); 2]>::try_from(ends).ok()
    });
    // The strokes are 5 points long; four units are one point.
    let strokes = lines.filter(|[a, b]| a.0 == b.0 && b.1 - a.1 == 20.0);
    assert_eq!(strokes.count(), 2 * 4);
}
