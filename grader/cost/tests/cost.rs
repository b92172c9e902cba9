//! Tests that `grader cost` reports the known properties of well-known kernels. Times are not
//! tested.

use cost::report::{Accuracy, CostReport, KernelFamily, KernelRow, Precision, RayFamily, Shape};
use cost::trees::{ExactnessRow, WrongHits};
use cost::{CostRequest, SampleCounts, measure};
use std::sync::LazyLock;

/// Few rays, for a short test.
const SMALL: SampleCounts = SampleCounts {
    rays: 3_000,
    leak_rays: 2_000,
    rounds: 1,
    mesh: 1_000,
    tree_rounds: 1,
    world_rays: 20,
};

fn small(shape: Shape, seed: u64) -> CostReport {
    let request = CostRequest {
        shapes: vec![shape],
        trees: false,
        pictures: false,
        world: false,
        size: SMALL,
        seed,
    };
    measure(None, &request, &mut |_| Ok(())).expect("kernels need no workspace")
}

/// The reports with seed 0, in the order of [`Shape::ALL`]: measured once for all tests.
static REPORTS: LazyLock<[CostReport; 3]> =
    LazyLock::new(|| Shape::ALL.map(|shape| small(shape, 0)));

fn report(shape: Shape) -> &'static CostReport {
    &REPORTS[shape as usize]
}

fn family(shape: Shape) -> &'static KernelFamily {
    &report(shape).families[0]
}

fn row<'a>(family: &'a KernelFamily, name: &str, precision: Precision) -> &'a KernelRow {
    let mut rows = family.rows.iter();
    rows.find(|row| row.name == name && row.precision == precision)
        .unwrap_or_else(|| panic!("there is no row {name}"))
}

pub(super) fn on(row: &KernelRow, rays: RayFamily) -> &Accuracy {
    let mut columns = row.by_ray_family.iter();
    columns.find(|a| a.family == rays).expect("such rays")
}

fn wrong(accuracy: &Accuracy) -> f64 {
    accuracy.wrong_per_million()
}

/// Returns the report without the times, which differ from run to run.
fn timeless(mut report: CostReport) -> CostReport {
    for row in report.families.iter_mut().flat_map(|f| &mut f.rows) {
        row.time = Default::default();
        row.time_with_fma = None;
    }
    report
}

#[test]
fn all_numbers_but_times_depend_only_on_the_seed() {
    let first = timeless(report(Shape::Triangle).clone());
    let [again, other] = [0, 1].map(|seed| timeless(small(Shape::Triangle, seed)));
    assert_eq!(first, again);
    assert_ne!(first.families, other.families);
}

#[test]
fn json_contains_the_whole_report() {
    for shape in Shape::ALL {
        let report = report(shape);
        let json = grader::report::json(report).unwrap();
        let read: CostReport = serde_json::from_str(&json).unwrap();
        assert_eq!(&read, report);
    }
}

#[test]
fn watertight_triangle_tests_have_no_leaks_and_others_do() {
    let family = family(Shape::Triangle);
    let leaks = |name, precision| row(family, name, precision).leaks_per_million.unwrap();
    for precision in [Precision::F32, Precision::F64] {
        assert_eq!(leaks("Woop", precision), 0.0);
        assert!(leaks("Möller-Trumbore", precision) > 10_000.0);
        assert!(leaks("Möller-Trumbore cull", precision) > 10_000.0);
        assert!(leaks("plane, then sides", precision) > 10_000.0);
    }
    assert_eq!(leaks("Woop", Precision::F32InF64), 0.0);
    assert_eq!(leaks("filter, exact fallback", Precision::F64), 0.0);
}

/// Small integers are exact in each precision, but not a stored transformation of the triangle. A
/// test that accepts all triangles of an edge finds the hit, and a count of them is wrong.
#[test]
fn rays_exactly_at_edges_are_found_and_counted_by_each_triangle() {
    for row in &family(Shape::Triangle).rows {
        let grid = row.grid.expect("triangle tests are asked");
        let (lost, miscounted) = (grid.lost_per_million, grid.miscounted_per_million);
        match row.name.as_str() {
            "Baldwin-Weber" => assert!(lost > 20_000.0 && miscounted < 800_000.0, "{row:?}"),
            _ => assert_eq!((lost, miscounted), (0.0, 1e6), "{row:?}"),
        }
    }
}

#[test]
fn triangle_tests_are_wrong_where_they_are_known_to_be() {
    let family = family(Shape::Triangle);
    let of = |name| row(family, name, Precision::F64);
    for kernel in &family.rows {
        assert!(
            wrong(on(kernel, RayFamily::Ordinary)) < 3_000.0,
            "{kernel:?}"
        );
    }
    let exact = of("filter, exact fallback");
    for column in &exact.by_ray_family {
        assert_eq!(wrong(column), 0.0, "{column:?}");
        // On the surface t is almost 0 and its sign depends on rounding; elsewhere every decision
        // is exact.
        if column.family != RayFamily::OnTheSurface {
            assert_eq!(column.undecidable_differing_per_million, 0.0, "{column:?}");
        }
    }
    assert!(on(of("Woop"), RayFamily::Edge).undecidable_differing_per_million > 0.0);
    let epsilon = on(of("Möller-Trumbore ε"), RayFamily::TinyScale);
    assert!(epsilon.false_misses_per_million > 400_000.0);
    assert_eq!(wrong(on(of("Möller-Trumbore"), RayFamily::TinyScale)), 0.0);
    let huge = on(
        row(family, "Möller-Trumbore", Precision::F32),
        RayFamily::HugeScale,
    );
    assert!(wrong(huge) > 100_000.0, "f32 overflows");
    let in_double = row(family, "Woop", Precision::F32InF64);
    for column in &in_double.by_ray_family {
        assert_eq!(wrong(column), 0.0, "{column:?}");
    }
    // A culling kernel is judged only on front faces.
    let culling = on(of("Möller-Trumbore cull"), RayFamily::Ordinary);
    assert!((1_000..2_000).contains(&culling.rays));
}

#[test]
fn fused_edges_are_accurate_on_slivers() {
    let family = family(Shape::Triangle);
    let off = |name| {
        let sliver = on(row(family, name, Precision::F64), RayFamily::Sliver);
        sliver.t.expect("hits").ulp.p50
    };
    assert!(off("Woop, FMA edges") < 10.0);
    assert!(off("Woop") > 100.0 * off("Woop, FMA edges"));
    assert!(off("Möller-Trumbore") > off("Woop"));
}

#[test]
fn each_improvement_of_the_sphere_test_removes_its_own_error() {
    let family = family(Shape::Sphere);
    let of = |name, rays| on(row(family, name, Precision::F64), rays);
    let ulp = |name, rays| of(name, rays).t.expect("hits").ulp.p50;
    // For far spheres the discriminant cancels, except for Haines's.
    assert!(
        ulp("q form", RayFamily::FarOffset)
            > 10.0 * ulp("Haines's discriminant", RayFamily::FarOffset)
    );
    let wrong_in_f32 = |name| wrong(on(row(family, name, Precision::F32), RayFamily::FarOffset));
    assert!(wrong_in_f32("q form") > 100.0 * wrong_in_f32("Haines's discriminant"));
    // Reprojection improves the point, not t.
    let far = |name| of(name, RayFamily::FarOffset);
    let (on_ray, reprojected) = (far("Haines's discriminant"), far("Haines's, reprojected"));
    assert_eq!(on_ray.t, reprojected.t);
    assert!(reprojected.off_surface.unwrap().ulp.p999 < 3.0);
    assert!(on_ray.off_surface.unwrap().ulp.p999 > 100.0);
}

#[test]
fn box_tests_are_wrong_where_they_are_known_to_be() {
    let family = family(Shape::Box);
    let misses =
        |name, precision, rays| on(row(family, name, precision), rays).false_misses_per_million;
    for precision in [Precision::F32, Precision::F64] {
        // 0/0 for a ray in the plane of a face.
        assert!(misses("naive slabs", precision, RayFamily::Grazing) > 100_000.0);
        assert_eq!(misses("NaN-safe slabs", precision, RayFamily::Grazing), 0.0);
        assert!(misses("Williams", precision, RayFamily::Vertex) > 10_000.0);
        for column in &row(family, "Ize, 2 ulp", precision).by_ray_family {
            assert_eq!(wrong(column), 0.0, "{column:?}");
        }
    }
}

#[test]
fn operation_counts_match_the_formulas() {
    let family = family(Shape::Sphere);
    let operations = |name| row(family, name, Precision::F64).operations.unwrap();
    let (naive, q) = (operations("quadratic formula"), operations("q form"));
    // Two divisions and a square root if the discriminant is not negative, else none.
    assert_eq!(naive.div, 2.0 * naive.sqrt);
    assert!((0.3..0.9).contains(&naive.sqrt));
    assert_eq!((q.sqrt, q.fma), (naive.sqrt, 0.0));
    let reprojected = operations("q form, reprojected");
    assert!(reprojected.sqrt > q.sqrt && reprojected.total() > q.total());
}

#[test]
fn traversal_needs_slack_to_equal_brute_force() {
    let request = CostRequest {
        shapes: Vec::new(),
        trees: true,
        pictures: false,
        world: false,
        size: SampleCounts {
            rays: 24_000,
            ..SMALL
        },
        seed: 0,
    };
    let trees = measure(None, &request, &mut |_| Ok(()))
        .unwrap()
        .bvh
        .expect("trees");
    let crafted: Vec<WrongHits> = trees
        .by_slack
        .iter()
        .map(|row| row.trace.crafted.expect("crafted rays"))
        .collect();
    let wrong: Vec<usize> = crafted.iter().map(|hits| hits.wrong).collect();
    assert!(
        1_000 * wrong[0] > crafted[0].rays && wrong[0] > 3 * wrong[1],
        "{wrong:?}"
    );
    assert_eq!(wrong[2], 0);
    // Crafted rays are not counted as ordinary ones: those are right even without slack.
    for row in &trees.by_slack {
        assert_eq!(
            row.trace.ordinary,
            WrongHits {
                rays: 256,
                wrong: 0
            }
        );
    }
    let of = |name: &str| {
        let mut trees = trees.by_build.iter();
        trees.find(|tree| tree.name == name).expect("such a tree")
    };
    let (median, sah) = (of("median"), of("SAH, 16 bins"));
    assert!(sah.trace.box_tests < median.trace.box_tests);
    assert!(
        trees
            .by_build
            .iter()
            .all(|tree| tree.trace.crafted.is_some_and(|hits| hits.wrong == 0))
    );
    assert!(trees.by_build.iter().all(|tree| tree.nodes > Some(500)));
    // What others build loses: plain tests at edges, single precision more.
    let lost = |triangle_test: &str, box_test: &str, precision: Precision| {
        let mut rows = trees.by_precision.iter();
        let row = rows.find(|row| {
            (
                row.triangle_test.as_str(),
                row.box_test.as_str(),
                row.precision,
            ) == (triangle_test, box_test, precision)
        });
        row.expect("such a tree").lost_per_million()
    };
    assert_eq!(lost("Woop", "Ize, 2 ulp", Precision::F64), 0.0);
    let others = trees
        .by_precision
        .iter()
        .filter(|row| row.split != "midpoint");
    assert!(others.clone().all(|row| row.lost_per_million() == 0.0));
    // Zeros of the direction have both signs: naive slabs lose boxes to 0/0.
    let rows = trees.by_precision.iter();
    let (naive, safe): (Vec<&ExactnessRow>, _) =
        rows.partition(|row| row.box_test == "naive slabs");
    assert!(safe.iter().all(|row| row.grid_lost == 0), "{safe:?}");
    assert!(naive[0].grid_lost_per_million() > 100_000.0, "{naive:?}");
    assert_eq!(
        naive[0].worst_per_million(),
        naive[0].grid_lost_per_million()
    );
    assert_eq!(others.count(), 2, "the trees by median and SAH");
    let single = lost("Woop", "Ize, 2 ulp", Precision::F32);
    assert!(single > 0.0);
    assert!(lost("Woop", "Williams", Precision::F32) > single);
    assert!(lost("Möller-Trumbore", "Ize, 2 ulp", Precision::F64) > single);
    assert!(lost("Möller-Trumbore", "Williams", Precision::F32) > single);
}
