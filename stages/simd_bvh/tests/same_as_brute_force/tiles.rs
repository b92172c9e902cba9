//! Rays that are traced by the tile have the hits of rays that are traced alone, bit for bit.

use crate::checker::{Random, exact};
use kit::{PrimId, Ray, Scene, Sphere, Triangle, TriangleHit, Vec3};
use lanes::instruction_sets;
use meshes::{MeshKind, generate};
use simd_bvh::{Level, RayTile, Subset, TestCounts, TileEnds, TileMemory, WideBvh};

type Hit = Option<(PrimId, TriangleHit)>;

fn bits(hit: Hit) -> Option<(PrimId, [u64; 3])> {
    hit.map(|(id, hit)| (id, [hit.t, hit.b1, hit.b2].map(f64::to_bits)))
}

/// Rays from one point, in columns.
struct Tile {
    o: Vec3,
    d: [Vec<f64>; 3],
    min_t: f64,
    max_t: Vec<f64>,
    skips: Vec<Option<PrimId>>,
}

impl Tile {
    /// Rays of any length along `directions`.
    fn new(o: Vec3, directions: &[Vec3]) -> Tile {
        Tile {
            o,
            d: [0, 1, 2].map(|axis| directions.iter().map(|d| d[axis]).collect()),
            min_t: 0.0,
            max_t: vec![f64::INFINITY; directions.len()],
            skips: vec![None; directions.len()],
        }
    }

    fn rays(&self) -> RayTile<'_> {
        let first = self.max_t.first().copied().unwrap_or(1.0);
        let is_same = |end: &f64| end.to_bits() == first.to_bits();
        RayTile {
            o: self.o,
            d: [&self.d[0], &self.d[1], &self.d[2]],
            min_t: self.min_t,
            max_t: if self.max_t.iter().all(is_same) {
                TileEnds::All(first)
            } else {
                TileEnds::Each(&self.max_t)
            },
            skips: if self.skips.iter().all(Option::is_none) {
                &[]
            } else {
                &self.skips
            },
        }
    }
}

struct Checker {
    scene: Scene,
    /// The tree at each level of [`instruction_sets`].
    trees: Vec<(Level, WideBvh)>,
    memory: TileMemory,
    /// The number of rays that hit.
    hits: usize,
    /// The box tests together, and those of rays that are alone.
    box_tests: [u64; 2],
}

impl Checker {
    fn new(triangles: Vec<Triangle>, spheres: Vec<Sphere>) -> Checker {
        let tree = WideBvh::build(&triangles, &spheres);
        let levels = instruction_sets().into_iter();
        Checker {
            scene: Scene {
                triangles,
                spheres,
                ..Scene::default()
            },
            trees: levels
                .map(|level| (level, tree.clone().at_level(level)))
                .collect(),
            memory: TileMemory::default(),
            hits: 0,
            box_tests: [0; 2],
        }
    }

    /// Checks the rays of a tile, and returns their hits.
    fn check(&mut self, tile: &Tile) -> Vec<Hit> {
        let rays = tile.rays();
        let exact = &mut |id, ray: &Ray| exact(&self.scene, id, ray);
        let mut alone = TestCounts::default();
        let expected: Vec<Hit> = (0..rays.len())
            .map(|i| {
                let (_, tree) = &self.trees[0];
                tree.closest(&rays.ray(i), rays.skip(i), exact, &mut alone)
            })
            .collect();
        let mut all_counts = Vec::new();
        for (level, tree) in &self.trees {
            // What is in it is replaced.
            let (mut hits, mut counts) = (vec![None; 3], TestCounts::default());
            let memory = &mut self.memory;
            tree.closest_of_tile(Subset::All, &rays, exact, memory, &mut counts, &mut hits);
            assert_eq!(hits.len(), expected.len());
            for (i, (hit, expected)) in hits.into_iter().zip(&expected).enumerate() {
                let ray = rays.ray(i);
                assert_eq!(bits(hit), bits(*expected), "{level:?} ray {i}: {ray:?}");
            }
            all_counts.push(counts);
        }
        // Whether multiplication and addition are rounded once or twice decides few tests.
        let [first, ..] = all_counts[..] else {
            unreachable!("there is an instruction set")
        };
        for counts in &all_counts {
            let difference = counts.box_tests.abs_diff(first.box_tests);
            assert!(20 * difference <= first.box_tests + 200, "{all_counts:?}");
        }
        self.hits += expected.iter().flatten().count();
        self.box_tests[0] += all_counts[0].box_tests;
        self.box_tests[1] += alone.box_tests;
        expected
    }

    /// Checks a tile with full ranges; then with ranges that end at or just before the hits, or
    /// begin at one, and without the primitives that were hit.
    fn check_ranges(&mut self, mut tile: Tile, random: &mut Random) {
        let hits = self.check(&tile);
        let Some((_, first)) = hits.iter().flatten().next().copied() else {
            return;
        };
        for (end, hit) in tile.max_t.iter_mut().zip(&hits) {
            if let Some((_, hit)) = hit {
                *end = [hit.t, hit.t.next_down(), 2.0 * hit.t, f64::INFINITY][random.below(4)];
            }
        }
        self.check(&tile);
        tile.max_t.fill(f64::INFINITY);
        tile.min_t = if random.below(2) == 0 {
            first.t
        } else {
            first.t.next_up()
        };
        self.check(&tile);
        tile.min_t = 0.0;
        for (skip, hit) in tile.skips.iter_mut().zip(&hits) {
            *skip = hit.map(|(id, _)| id).filter(|_| random.below(4) > 0);
        }
        self.check(&tile);
    }
}

/// Directions of up to `count` rays from `o` around the one to `target`: on a grid, at random, or to
/// points on triangles near the target, their vertices and edges among them. With some components
/// 0, tiny, or of another length.
fn directions(
    checker: &Checker,
    random: &mut Random,
    o: Vec3,
    target: Vec3,
    count: usize,
) -> Vec<Vec3> {
    let to_target = (target - o).normalize_or(Vec3::Z);
    let spread = 10.0_f64.powf(-7.0 * random.one());
    let kind = random.below(6);
    let near: Vec<&Triangle> = match kind {
        0 | 1 => {
            let mut near: Vec<&Triangle> = checker.scene.triangles.iter().collect();
            near.sort_by(|a, b| {
                (a.p0 - target)
                    .length()
                    .total_cmp(&(b.p0 - target).length())
            });
            near.truncate(12);
            near
        }
        _ => Vec::new(),
    };
    (0..count)
        .map(|i| {
            if let Some(&triangle) = near.get(random.below(near.len().max(1))) {
                return (random.on(triangle) - o).normalize_or(Vec3::X);
            }
            match kind {
                2 => {
                    let (x, y) = ((i % 8) as f64 - 3.5, (i / 8 % 8) as f64 - 3.5);
                    let d = to_target + 0.1 * spread * Vec3::new(x, y, x + y);
                    d.normalize_or(Vec3::Y)
                }
                3 => {
                    // Along an axis, or nearly.
                    let mut d = Vec3::ZERO;
                    d[i % 2] = [0.0, -0.0, 1e-300, -1e-19, 1e-9, 1e-3 * spread][random.below(6)];
                    d[2] = 1.0_f64.copysign(to_target.z);
                    d
                }
                4 => (to_target + spread * random.point()) * 0.6,
                _ => (to_target + spread * random.point()).normalize_or(Vec3::Y),
            }
        })
        .collect()
}

/// Checks tiles from points around the scene, in it, on its triangles and at its vertices: there
/// the rays lie in the planes of triangles.
fn check_tiles(checker: &mut Checker, random: &mut Random, count: usize, scale: f64) {
    for i in 0..count {
        let of = random.below(checker.scene.triangles.len());
        let other = random.below(checker.scene.triangles.len());
        let target = random.on(&checker.scene.triangles[of]);
        let o = match i % 5 {
            0 => target + 3.0 * scale * random.direction(),
            1 => target + 0.3 * scale * random.direction(),
            2 => target + 1e-3 * scale * random.direction(),
            3 => random.on(&checker.scene.triangles[other]),
            _ => {
                // In the plane of the triangle.
                let t = &checker.scene.triangles[of];
                t.p0 + 5.0 * (random.one() - 0.5) * (t.p1 - t.p0) + random.one() * (t.p2 - t.p1)
            }
        };
        let rays = [64, 64, 64, 1, 7, 63, 65, 130][random.below(8)];
        let directions = directions(checker, random, o, target, rays);
        checker.check_ranges(Tile::new(o, &directions), random);
    }
}

#[test]
fn on_meshes() {
    for kind in MeshKind::ALL {
        let mut random = Random::new(21);
        let mut checker = Checker::new(generate(kind, 1500), Vec::new());
        check_tiles(&mut checker, &mut random, 30, 1.0);
        assert!(checker.hits > 1000, "{} rays hit", checker.hits);
        let [together, alone] = checker.box_tests;
        assert!(
            3 * together < alone,
            "{together} box tests of tiles, {alone} of rays"
        );
    }
}

#[test]
fn on_ties_and_slivers() {
    let mut random = Random::new(22);
    let mut triangles: Vec<Triangle> = (0..40)
        .map(|_| {
            let (p, d) = (random.point(), random.direction());
            let width = 10.0_f64.powf(-12.0 * random.one());
            Triangle::flat(p, p + d, p + 0.5 * d + width * random.direction())
        })
        .collect();
    // The same ones again: a hit belongs to the first.
    triangles.extend(triangles.clone());
    let mut checker = Checker::new(triangles, Vec::new());
    check_tiles(&mut checker, &mut random, 100, 1.0);
    assert!(checker.hits > 1000, "{} rays hit", checker.hits);
}

#[test]
fn on_every_scale_and_far_away() {
    let mut random = Random::new(23);
    for (scale, shift) in [(1e-30, 0.0), (1e-3, 5e3), (1.0, 1e9), (1e30, 0.0)] {
        let moved = |p: Vec3| scale * p + Vec3::new(shift, -shift, 0.5 * shift);
        let triangles = generate(MeshKind::Terrain, 800);
        let triangles = triangles
            .iter()
            .map(|t| Triangle::flat(moved(t.p0), moved(t.p1), moved(t.p2)));
        let mut checker = Checker::new(triangles.collect(), Vec::new());
        check_tiles(&mut checker, &mut random, 25, scale);
        assert!(
            checker.hits > 100,
            "{scale} {shift}: {} rays hit",
            checker.hits
        );
    }
}

#[test]
fn from_far_away() {
    let mut random = Random::new(24);
    let mut checker = Checker::new(generate(MeshKind::Knot, 1500), Vec::new());
    for i in 0..60 {
        let of = random.below(checker.scene.triangles.len());
        let target = random.on(&checker.scene.triangles[of]);
        let distance = 10.0_f64.powi(1 + i % 6);
        let o = target + distance * random.direction();
        let aim = |random: &mut Random| (target - o + 0.3 * random.point()) / distance;
        let directions: Vec<Vec3> = (0..64).map(|_| aim(&mut random)).collect();
        checker.check_ranges(Tile::new(o, &directions), &mut random);
    }
    assert!(checker.hits > 1000, "{} rays hit", checker.hits);
}

#[test]
fn on_spheres_among_triangles() {
    let mut random = Random::new(25);
    let spheres = (0..200)
        .map(|_| Sphere {
            center: random.point(),
            radius: 0.2 * random.one(),
        })
        .collect();
    let mut checker = Checker::new(generate(MeshKind::Smooth, 500), spheres);
    check_tiles(&mut checker, &mut random, 60, 1.0);
    assert!(checker.hits > 1000, "{} rays hit", checker.hits);
}

#[test]
fn on_invalid_and_unusual_rays_among_others() {
    let mut random = Random::new(26);
    let mut checker = Checker::new(generate(MeshKind::Terrain, 500), Vec::new());
    let values = [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e-200, 1e200, 3.0];
    for i in 0..100 {
        let target = random.on(&checker.scene.triangles[i]);
        let o = target + random.direction();
        let mut tile = Tile::new(o, &directions(&checker, &mut random, o, target, 64));
        for _ in 0..10 {
            let (ray, value) = (random.below(64), values[random.below(values.len())]);
            match random.below(3) {
                0 => tile.d[random.below(3)][ray] = value,
                1 => tile.d.iter_mut().for_each(|column| column[ray] *= value),
                _ => tile.max_t[ray] = value,
            }
        }
        match i % 10 {
            7 => tile.min_t = values[random.below(values.len())],
            8 => tile.max_t.fill(values[random.below(values.len())]),
            9 => tile.o[random.below(3)] = values[random.below(values.len())],
            _ => {}
        }
        checker.check(&tile);
    }
    assert!(checker.hits > 1000, "{} rays hit", checker.hits);
    assert_eq!(checker.check(&Tile::new(Vec3::ZERO, &[])).len(), 0);
}

#[test]
#[ignore = "slow: some minutes"]
fn on_millions_of_rays() {
    let mut random = Random::new(27);
    for kind in MeshKind::ALL {
        let mut checker = Checker::new(generate(kind, 100_000), Vec::new());
        check_tiles(&mut checker, &mut random, 4000, 1.0);
        assert!(
            checker.hits > 100_000,
            "{kind:?}: {} rays hit",
            checker.hits
        );
    }
}
