//! Properties of the generated meshes: triangle counts, closed surfaces, valid normals, identical
//! bits on all platforms.

use kit::{Aabb, Triangle, Vec3};
use meshes::{MeshKind, cornell_with, generate};
use std::collections::HashMap;

fn bits(p: Vec3) -> [u64; 3] {
    // Adding 0 turns -0 into 0.
    p.to_array().map(|x| (x + 0.0).to_bits())
}

#[test]
fn number_of_triangles_is_exact() {
    for kind in MeshKind::ALL {
        for target in [100, 1_000, 1_500, 9_999, 123_456, 300_000] {
            assert_eq!(generate(kind, target).len(), target / 2 * 2, "{kind}");
        }
    }
}

#[test]
fn very_small_sizes_give_a_mesh() {
    for kind in MeshKind::ALL {
        for target in [0, 1, 2, 7, 50] {
            assert!(!generate(kind, target).is_empty(), "{kind} {target}");
        }
    }
}

#[test]
fn closed_meshes_have_two_triangles_at_every_edge() {
    for kind in MeshKind::ALL.into_iter().filter(|kind| kind.is_closed()) {
        for target in [1, 1_000, 23_456] {
            // Each directed edge occurs once, and its reverse once: the mesh is closed with
            // consistent winding.
            let mut edges: HashMap<[[u64; 3]; 2], i32> = HashMap::new();
            for t in generate(kind, target) {
                for [a, b] in [[t.p0, t.p1], [t.p1, t.p2], [t.p2, t.p0]] {
                    *edges.entry([bits(a), bits(b)]).or_default() += 1;
                }
            }
            for ([a, b], count) in &edges {
                assert_eq!(
                    (*count, edges.get(&[*b, *a])),
                    (1, Some(&1)),
                    "{kind} {target}"
                );
            }
        }
    }
}

#[test]
fn normals_of_closed_meshes_point_outwards() {
    for kind in MeshKind::ALL.into_iter().filter(|kind| kind.is_closed()) {
        // By the divergence theorem the volume is positive if the normals point outwards.
        let volume: f64 = generate(kind, 5_000)
            .iter()
            .map(|t| t.p0.dot(t.p1.cross(t.p2)) / 6.0)
            .sum();
        assert!(volume > 0.01, "{kind}: {volume}");
    }
}

#[test]
fn triangles_are_valid_and_inside_the_cube() {
    for kind in MeshKind::ALL {
        let mesh = generate(kind, 20_000);
        let bounds = mesh
            .iter()
            .fold(Aabb::EMPTY, |all, t| all.union(t.bounds()));
        assert!(
            bounds.min.min_element() >= -1.0 && bounds.max.max_element() <= 1.0,
            "{kind}: {bounds:?}"
        );
        for t in &mesh {
            let ng = (t.p1 - t.p0).cross(t.p2 - t.p0);
            assert!(ng.length() > 0.0, "{kind}: a triangle has no area");
            for n in [t.n0, t.n1, t.n2] {
                assert!(
                    (n.length() - 1.0).abs() < 1e-12,
                    "{kind}: normal of length {}",
                    n.length()
                );
                // In rough terrain the normals of adjacent triangles can differ by more than 90
                // degrees, but there are no overhangs.
                let outwards = if kind == MeshKind::Terrain {
                    n.y.min(ng.y)
                } else {
                    n.dot(ng)
                };
                assert!(
                    outwards > 0.0,
                    "{kind}: the normal points to the other side"
                );
            }
        }
    }
}

/// Ratio of the longest edge to the height over that edge.
fn slenderness(t: &Triangle) -> f64 {
    let longest = [t.p1 - t.p0, t.p2 - t.p1, t.p0 - t.p2]
        .map(|e| e.length())
        .into_iter()
        .fold(0.0, f64::max);
    longest * longest / (t.p1 - t.p0).cross(t.p2 - t.p0).length()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[test]
fn only_knots_and_needles_have_thin_triangles() {
    let typical = |kind| median(generate(kind, 100_000).iter().map(slenderness).collect());
    assert!(typical(MeshKind::Smooth) < 4.0);
    assert!(typical(MeshKind::Terrain) < 4.0);
    assert!(typical(MeshKind::Knot) > 8.0);
    assert!(typical(MeshKind::Needles) > 20.0);
}

/// FNV-1a hash of the bits of all coordinates.
fn fingerprint(mesh: &[Triangle]) -> u64 {
    let vectors = mesh
        .iter()
        .flat_map(|t| [t.p0, t.p1, t.p2, t.n0, t.n1, t.n2]);
    let words = vectors.flat_map(bits);
    words.fold(0xcbf2_9ce4_8422_2325, |hash, word| {
        (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[test]
fn meshes_are_identical_on_all_platforms() {
    let found = MeshKind::ALL.map(|kind| (kind, fingerprint(&generate(kind, 10_000))));
    let expected = [
        (MeshKind::Smooth, 498_503_827_058_403_025),
        (MeshKind::Terrain, 9_324_335_173_672_389_678),
        (MeshKind::Knot, 11_820_671_714_725_792_206),
        (MeshKind::Needles, 3_711_191_773_078_785_226),
    ];
    assert_eq!(
        found, expected,
        "golden files and operation counts depend on these meshes: change them only on purpose"
    );
}

#[test]
fn names_are_parsed() {
    for kind in MeshKind::ALL {
        assert_eq!(kind.to_string().parse(), Ok(kind));
    }
    assert!(
        "bunny"
            .parse::<MeshKind>()
            .unwrap_err()
            .contains("choose one of smooth")
    );
}

#[test]
fn mesh_is_inside_its_cornell_box() {
    for kind in MeshKind::ALL {
        let mesh = generate(kind, 2_000);
        let count = mesh.len();
        let scene = cornell_with(mesh);
        assert_eq!(scene.triangles.len(), count + 12);
        assert_eq!(scene.object_of.len(), scene.len());
        let (mesh, walls) = scene.triangles.split_at(count);
        let bounds = |part: &[Triangle]| {
            part.iter()
                .fold(Aabb::EMPTY, |all, t| all.union(t.bounds()))
        };
        assert!(bounds(walls).contains(&bounds(mesh)), "{kind}");
        assert_eq!(scene.objects[scene.object_of[0] as usize].name, "mesh");
        assert_eq!(
            scene.objects[scene.object_of[count + 11] as usize].name,
            "light"
        );
        // Walls and light face into the box.
        let middle = Vec3::new(0.0, 0.75, 0.0);
        for wall in walls {
            assert!(wall.n0.dot(middle - wall.p0) > 0.0);
        }
    }
}
