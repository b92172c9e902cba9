//! Comparison with brute force for the course's own box test and triangles, with all their rounding
//! errors.
// BEGIN SOLUTION(part2.task1)

use bvh::{construct_bvh, intersect_bvh, occludes_bvh};
use kit::{Aabb, Bvh, Hit, Interval, PrimId, Ray, Triangle, Vec3, World};
use proptest::prelude::*;

struct Triangles(Vec<Triangle>);

impl World for Triangles {
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        bbox::intersect_bbox(b, ray)
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        intersect::intersect_triangle(&self.0[id.0 as usize], id, ray)
    }

    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        intersect::test_triangle(&self.0[id.0 as usize], ray).is_some()
    }
}

impl Triangles {
    fn tree(&self, max_leaf_size: usize) -> Bvh {
        let bounds: Vec<Aabb> = self.0.iter().map(Triangle::bounds).collect();
        construct_bvh(&bounds, max_leaf_size)
    }

    fn brute_force(&mut self, ray: &Ray) -> Option<Hit> {
        let ids = (0..self.0.len() as u32).map(PrimId);
        let hits = ids.filter_map(|id| self.hit_prim(id, &mut { *ray }));
        hits.reduce(|a, b| if b.t < a.t { b } else { a })
    }

    fn assert_same(&mut self, tree: &Bvh, ray: &Ray) {
        let expected = self.brute_force(ray);
        let mut shortened = *ray;
        assert_eq!(
            intersect_bvh(tree, &mut shortened, self),
            expected,
            "{ray:?}"
        );
        assert_eq!(shortened.max_t, expected.map_or(ray.max_t, |hit| hit.t));
        assert_eq!(occludes_bvh(tree, ray, self), expected.is_some());
    }
}

/// Coordinates such that triangles share corners, edges and planes, and arbitrary ones.
fn point() -> impl Strategy<Value = Vec3> {
    let coarse = || (-3..=3).prop_map(|i| f64::from(i) / 3.0);
    let any = || -1.0..1.0;
    prop_oneof![[coarse(), coarse(), coarse()], [any(), any(), any()]].prop_map(Vec3::from)
}

/// Up to 40 random triangles, some of them twice, with a scale and an offset. Either anywhere, or
/// all in one slanted plane, where only rounding decides which is nearest.
fn soup() -> impl Strategy<Value = Vec<Triangle>> {
    let triangle = [point(), point(), point()];
    let scale = prop_oneof![Just(1.0), Just(1e-6), Just(1e9)];
    let offset = prop_oneof![Just(0.0), Just(1e3)];
    let plane = prop_oneof![Just(None), point().prop_map(Some)];
    let corners = prop::collection::vec(triangle, 1..40);
    (corners, scale, offset, plane).prop_map(|(corners, scale, offset, plane)| {
        let transformed = |p: Vec3| match plane {
            Some(slope) => scale * (Vec3::new(p.x, slope.x * p.x + slope.y * p.z, p.z) + offset),
            None => scale * (p + offset),
        };
        let mut triangles: Vec<Triangle> = corners
            .into_iter()
            .map(|corners| corners.map(transformed))
            .map(|[a, b, c]| Triangle::flat(a, b, c))
            .collect();
        triangles.extend_from_within(..triangles.len() / 4);
        triangles
    })
}

/// A triangle of the soup, two weights and an origin: a ray to a point of the triangle, which can
/// be on an edge or a corner.
fn soup_ray() -> impl Strategy<Value = (prop::sample::Index, f64, f64, Vec3)> {
    let weight = || prop_oneof![Just(0.0), Just(0.5), 0.0..1.0];
    (any::<prop::sample::Index>(), weight(), weight(), point())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn rays_at_soups(
        soup in soup(),
        rays in prop::collection::vec(soup_ray(), 20),
        leaf in 1..6_usize,
    ) {
        let mut world = Triangles(soup);
        let tree = world.tree(leaf);
        for (index, v, w, start) in rays {
            let t = *index.get(&world.0);
            let size = (t.p1 - t.p0).abs().max_element().max((t.p2 - t.p0).abs().max_element());
            let target = t.p0 + v * (t.p1 - t.p0) + (1.0 - v) * w * (t.p2 - t.p0);
            let o = target + 2.0 * size * start;
            world.assert_same(&tree, &Ray::new(o, target - o));
            let mut cut = Ray::new(o, (target - o).normalize_or_zero());
            cut.max_t = (target - o).length();
            world.assert_same(&tree, &cut);
            // From the surface, where `t` is 0 up to rounding, so a tolerance relative to `t` would
            // be too small.
            let on_it = Ray { o: target, min_t: -1.0, ..Ray::new(target, o - target) };
            world.assert_same(&tree, &on_it);
        }
    }
}

/// Hard case 73. Axis-aligned and diagonal rays through the corners and edges of a mesh with
/// integer coordinates: there are no holes, and the lowest id is hit where triangles meet.
#[test]
fn grid_aligned_rays_on_an_integer_mesh() {
    let mut mesh = Vec::new();
    for i in 0..12 {
        for j in 0..12 {
            let at = |di: i32, dj: i32| {
                let (x, z) = (i + di, j + dj);
                Vec3::new(f64::from(x), f64::from((x * z) % 3), f64::from(z))
            };
            mesh.push(Triangle::flat(at(0, 0), at(1, 0), at(1, 1)));
            mesh.push(Triangle::flat(at(0, 0), at(1, 1), at(0, 1)));
        }
    }
    let mut world = Triangles(mesh);
    let tree = world.tree(2);
    for i in 0..=24 {
        for j in 0..=24 {
            let (x, z) = (0.5 * f64::from(i), 0.5 * f64::from(j));
            let down = Ray::new(Vec3::new(x, 9.0, z), Vec3::NEG_Y);
            assert!(
                occludes_bvh(&tree, &down, &mut world),
                "the mesh has a hole at ({x}, {z})"
            );
            world.assert_same(&tree, &down);
            for y in 0..3 {
                let across = Vec3::new(x, f64::from(y), z);
                for d in [Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::new(1.0, 0.0, -1.0)] {
                    world.assert_same(&tree, &Ray::new(across - 20.0 * d, d));
                }
            }
        }
    }
}
// END SOLUTION(part2.task1)
