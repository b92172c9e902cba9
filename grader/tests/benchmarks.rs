//! `cargo bench` in every crate accepts criterion's flags and reports throughput.

use cargo_metadata::{MetadataCommand, Package, TargetKind};
use std::path::Path;
use toml::Table;

fn packages() -> Vec<Package> {
    let metadata = MetadataCommand::new().no_deps().exec();
    metadata.expect("cargo metadata runs").packages
}

fn manifest(package: &Package) -> Table {
    let text = std::fs::read_to_string(&package.manifest_path).expect("the manifest can be read");
    text.parse().expect("the manifest is TOML")
}

/// The targets of a kind that the manifest describes, such as `lib` or `bin`.
fn described<'a>(manifest: &'a Table, kind: &str) -> Vec<&'a Table> {
    match manifest.get(kind) {
        Some(toml::Value::Table(one)) => vec![one],
        Some(toml::Value::Array(many)) => many.iter().filter_map(toml::Value::as_table).collect(),
        _ => Vec::new(),
    }
}

/// Cargo passes the flags to every target that it benchmarks. The test harness of a library or of a
/// program ends with an error at a flag of criterion's, such as `--warm-up-time` or
/// `--save-baseline`.
#[test]
fn no_library_and_no_program_is_benchmarked_with_the_test_harness() {
    let mut checked = 0;
    for package in packages() {
        let manifest = manifest(&package);
        for target in &package.targets {
            let kind = match target.kind.as_slice() {
                [TargetKind::Bin] => "bin",
                [TargetKind::Lib] => "lib",
                _ => continue,
            };
            let is_this = |table: &&Table| {
                let name = table.get("name").and_then(toml::Value::as_str);
                name.is_none_or(|name| name == target.name)
            };
            let tables = described(&manifest, kind);
            let bench = tables
                .into_iter()
                .find(is_this)
                .and_then(|t| t.get("bench"));
            assert_eq!(
                bench.and_then(toml::Value::as_bool),
                Some(false),
                "{}: the {kind} `{}` needs `bench = false`, or `cargo bench -- --save-baseline x` fails",
                package.manifest_path,
                target.name
            );
            checked += 1;
        }
    }
    assert!(checked > 15, "only {checked} targets were found");
}

#[test]
fn every_benchmark_is_criterions_and_reports_throughput() {
    let mut checked = 0;
    for package in packages() {
        let manifest = manifest(&package);
        let benches = package.targets.iter();
        for target in benches.filter(|target| target.kind == [TargetKind::Bench]) {
            let of_name = |table: &&Table| {
                table.get("name").and_then(toml::Value::as_str) == Some(target.name.as_str())
            };
            let table = described(&manifest, "bench").into_iter().find(of_name);
            let harness = table.and_then(|table| table.get("harness"));
            assert_eq!(
                harness.and_then(toml::Value::as_bool),
                Some(false),
                "{}: the bench `{}` needs `harness = false`",
                package.manifest_path,
                target.name
            );
            let source = std::fs::read_to_string(Path::new(&target.src_path)).expect("its source");
            for call in ["Throughput::Elements(", "criterion"] {
                assert!(source.contains(call), "{}: no {call}", target.src_path);
            }
            let reads_flags = ["configure_from_args()", "criterion_main!("];
            assert!(
                reads_flags.iter().any(|call| source.contains(call)),
                "{}: criterion's flags are not read",
                target.src_path
            );
            checked += 1;
        }
    }
    assert!(checked >= 3, "only {checked} benchmarks were found");
}
