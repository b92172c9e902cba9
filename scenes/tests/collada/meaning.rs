//! Tests which scene the elements of a valid COLLADA file give.

use crate::collada::small::{SMALL, edited, load_edited};
use kit::{Camera, Light, Material, Scene, Spectrum, Triangle, Vec3};

fn read(text: &str) -> Scene {
    let loaded = scenes::parse("small.dae", text).unwrap_or_else(|e| panic!("{e}"));
    let warnings: String = loaded.warnings.iter().map(|w| format!("{w}\n")).collect();
    assert_eq!(warnings, "");
    loaded.scene
}

fn v(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3::new(x, y, z)
}

fn points(t: &Triangle) -> [Vec3; 3] {
    [t.p0, t.p1, t.p2]
}

/// Tolerance for results of a few multiplications.
const ROUNDING: f64 = 1e-14;

fn assert_near(found: Vec3, expected: Vec3) {
    assert!(
        found.distance(expected) <= ROUNDING,
        "found {found}, expected {expected}"
    );
}

#[test]
fn primitives_have_objects_and_materials() {
    let scene = read(SMALL);
    assert_eq!(scene.object_of, [0, 0, 1]);
    assert_eq!(scene.objects[0].name, "square-node");
    assert_eq!(scene.objects[1].name, "ball-node");
    assert_eq!(
        scene.materials.len(),
        1,
        "both objects have the same material"
    );
    assert_eq!(scene.materials[0].name, "Red");
    let red = Material::Diffuse {
        reflectance: Spectrum::new(0.8, 0.1, 0.1),
    };
    assert_eq!(*scene.material_of(kit::PrimId(2)), red);
}

/// The world position of the point (1, 2, 3) in a file with the given up axis.
fn with_up_axis(axis: &str) -> Vec3 {
    let text = edited("Y_UP", axis).replace(
        "<translate>3 0 0</translate>",
        "<translate>1 2 3</translate>",
    );
    read(&text).spheres[0].center
}

#[test]
fn all_up_axes_are_supported() {
    assert_eq!(with_up_axis("Y_UP"), v(1.0, 2.0, 3.0));
    assert_eq!(with_up_axis("Z_UP"), v(-1.0, 3.0, 2.0));
    assert_eq!(with_up_axis("X_UP"), v(-2.0, 1.0, 3.0));
    let without_up_axis = edited("<up_axis>Y_UP</up_axis>", "").replace(
        "<translate>3 0 0</translate>",
        "<translate>1 2 3</translate>",
    );
    assert_eq!(read(&without_up_axis).spheres[0].center, v(1.0, 2.0, 3.0));
}

/// The sphere under the given transform elements.
fn sphere_under(transforms: &str) -> kit::Sphere {
    read(&edited("<translate>3 0 0</translate>", transforms)).spheres[0]
}

#[test]
fn transforms_apply_from_the_last_to_the_first() {
    let ball = sphere_under(
        "<translate>1 0 0</translate><rotate>0 0 1 90</rotate><translate>1 0 0</translate>",
    );
    assert_near(ball.center, v(1.0, 1.0, 0.0));
    let ball = sphere_under("<scale>2 2 2</scale><translate>1 0 0</translate>");
    assert_near(ball.center, v(2.0, 0.0, 0.0));
    assert_eq!(ball.radius, 1.0);
}

#[test]
fn matrices_are_written_row_by_row() {
    let ball = sphere_under("<matrix>1 0 0 7  0 1 0 8  0 0 1 9  0 0 0 1</matrix>");
    assert_eq!(ball.center, v(7.0, 8.0, 9.0));
    // A rotation by 90 degrees about z maps x to y.
    let turned = square_under("0 -1 0 0  1 0 0 0  0 0 1 0  0 0 0 1")[0];
    assert_eq!(turned.p1, Vec3::Y);
}

#[test]
fn rotations_are_right_handed_and_in_degrees() {
    assert_near(
        sphere_under("<rotate>1 0 0 90</rotate><translate>0 1 0</translate>").center,
        v(0.0, 0.0, 1.0),
    );
    assert_near(
        sphere_under("<rotate>0 5 0 90</rotate><translate>0 0 1</translate>").center,
        v(1.0, 0.0, 0.0),
    );
}

#[test]
fn spheres_can_be_rotated_mirrored_and_scaled_uniformly() {
    assert_eq!(sphere_under("<scale>-3 3 3</scale>").radius, 1.5);
    let turned = sphere_under("<rotate>1 2 3 40</rotate><scale>3 3 3</scale>").radius;
    assert!((turned - 1.5).abs() <= ROUNDING);
}

#[test]
fn nodes_inside_nodes_and_instances_of_nodes_compose() {
    let inner = "<translate>1 0 0</translate><node id=\"inner\"><scale>2 2 2</scale><instance_geometry url=\"#ball\">\
        <bind_material><technique_common><instance_material symbol=\"a\" target=\"#red\"/></technique_common></bind_material>\
        </instance_geometry></node>";
    let nested = read(&edited("<translate>3 0 0</translate>", inner));
    let ball = nested.spheres[0];
    assert_eq!((ball.center, ball.radius), (v(1.0, 0.0, 0.0), 1.0));
    let instance = "<node id=\"again\"><translate>0 9 0</translate><instance_node url=\"#ball-node\"/></node>\
        <node id=\"lamp-node\">";
    let twice = read(&edited("<node id=\"lamp-node\">", instance));
    assert_eq!(twice.spheres[1].center, v(3.0, 9.0, 0.0));
    assert_eq!(twice.objects.len(), 3);
}

/// The two triangles of the square under the given matrix.
fn square_under(matrix: &str) -> Vec<Triangle> {
    read(&edited("1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1", matrix)).triangles
}

#[test]
fn mirrored_triangles_have_consistent_winding_and_normals() {
    for matrix in [
        "-1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1",
        "0 1 0 0  1 0 0 0  0 0 1 0  0 0 0 1",
        "1 0 0 0  0 1 0 0  0 0 -1 0  0 0 0 1",
    ] {
        for t in square_under(matrix) {
            let ng = (t.p1 - t.p0).cross(t.p2 - t.p0).normalize();
            assert_near(t.n0, ng);
            assert_near(t.n2, ng);
        }
    }
    // Mirrored in x, the square still faces +z. Mirrored in z, it faces -z.
    assert_near(
        square_under("-1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1")[0].n0,
        Vec3::Z,
    );
    assert_near(
        square_under("1 0 0 0  0 1 0 0  0 0 -1 0  0 0 0 1")[0].n0,
        Vec3::NEG_Z,
    );
}

#[test]
fn normals_use_the_inverse_transpose() {
    // The square is rotated to face (1, 0, 1), then scaled in z: its normal tilts towards z.
    let [[a, b], [c, d]] = [[1.0, 1.0], [-0.5, 0.5]];
    let t = square_under(&format!("{a} 0 {b} 0  0 1 0 0  {c} 0 {d} 0  0 0 0 1"))[0];
    let plane = (t.p1 - t.p0).cross(t.p2 - t.p0).normalize();
    assert_near(t.n1, plane);
}

#[test]
fn normals_are_finite_under_singular_transforms() {
    for t in square_under("1 0 0 0  0 1 0 0  0 0 0 0  0 0 0 1") {
        assert_near(t.n0, Vec3::Z);
    }
    let nothing = edited("1 0 0 0  0 1 0 0  0 0 1 0", "0 0 0 0  0 0 0 0  0 0 0 0");
    let loaded = scenes::parse("small.dae", &nothing).unwrap();
    assert_eq!(loaded.warnings.len(), 1, "it says that there is no area");
    for t in loaded.scene.triangles {
        assert!(t.n0.is_finite());
    }
    for t in square_under("1e-200 0 0 0  0 1e-200 0 0  0 0 1e-200 0  0 0 0 1") {
        assert!(t.n0.is_finite());
    }
}

/// The triangles of the square if `element` replaces its `<triangles>`. `INPUT` in `element` stands
/// for the `<input>` with its four vertices.
fn primitive(element: &str) -> Vec<[Vec3; 3]> {
    let from = SMALL.find("<triangles").unwrap();
    let to = SMALL.find("</triangles>").unwrap() + "</triangles>".len();
    let input = "<input semantic=\"VERTEX\" source=\"#square-vertices\" offset=\"0\"/>";
    let text = format!(
        "{}{}{}",
        &SMALL[..from],
        element.replace("INPUT", input),
        &SMALL[to..]
    );
    read(&text).triangles.iter().map(points).collect()
}

#[test]
fn every_primitive_element_gives_the_square() {
    let [a, b, c, d] = [
        v(0.0, 0.0, 0.0),
        v(1.0, 0.0, 0.0),
        v(1.0, 1.0, 0.0),
        v(0.0, 1.0, 0.0),
    ];
    let expected = [[a, b, c], [a, c, d]];
    assert_eq!(
        primitive(
            "<triangles material=\"paint\" count=\"2\">INPUT<p>0 1 2</p><p>0 2 3</p></triangles>"
        ),
        expected
    );
    assert_eq!(
        primitive(
            "<polylist material=\"paint\" count=\"1\">INPUT<vcount>4</vcount><p>0 1 2 3</p></polylist>"
        ),
        expected
    );
    assert_eq!(
        primitive("<polygons material=\"paint\" count=\"1\">INPUT<p>0 1 2 3</p></polygons>"),
        expected
    );
    assert_eq!(
        primitive("<trifans material=\"paint\" count=\"1\">INPUT<p>0 1 2 3</p></trifans>"),
        expected
    );
    // The winding order of a strip alternates. Here both triangles must face +z.
    let strip =
        primitive("<tristrips material=\"paint\" count=\"1\">INPUT<p>0 1 3 2</p></tristrips>");
    let faces_up = |t: &[Vec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]) == Vec3::Z;
    assert!(strip.len() == 2 && strip.iter().all(faces_up), "{strip:?}");
    assert_eq!(strip[0], [a, b, d]);
}

#[test]
fn concave_polygons_are_triangulated_inside() {
    // An arrow head: a triangle fan around the first corner would also cover the notch, which is
    // outside.
    let text = edited(
        "0 0 0  1 0 0  1 1 0  0 1 0",
        "2 0 0  0 1 0  0.5 0 0  0 -1 0",
    )
    .replace(
        "<triangles material=\"paint\" count=\"2\">",
        "<polygons material=\"paint\" count=\"1\">",
    )
    .replace("</triangles>", "</polygons>")
    .replace("0 1 2 0 2 3", "1 2 3 0");
    let scene = read(&text);
    let areas: Vec<f64> = scene
        .triangles
        .iter()
        .map(|t| (t.p1 - t.p0).cross(t.p2 - t.p0).z / 2.0)
        .collect();
    assert_eq!(areas.len(), 2);
    assert!(areas.iter().all(|area| *area > 0.0), "{areas:?}");
    assert!((areas.iter().sum::<f64>() - 1.5).abs() < ROUNDING);
}

#[test]
fn normals_of_the_file_are_used_and_normalised() {
    let text = edited(
        "<vertices id=",
        "<source id=\"normals\"><float_array id=\"n\" count=\"6\">0 3 4 0 0 0</float_array><technique_common>\
         <accessor source=\"#n\" count=\"2\" stride=\"3\"/></technique_common></source><vertices id=",
    )
    .replace("offset=\"0\"/>", "offset=\"0\"/><input semantic=\"NORMAL\" source=\"#normals\" offset=\"1\"/>")
    .replace("0 1 2 0 2 3", "0 0 1 0 2 1  0 0 2 0 3 0");
    let t = read(&text).triangles[0];
    assert_near(t.n0, v(0.0, 0.6, 0.8));
    assert_near(t.n1, v(0.0, 0.6, 0.8));
    // A zero normal is replaced by the geometric normal.
    assert_near(t.n2, Vec3::Z);
}

#[test]
fn normals_may_be_an_input_of_the_vertices() {
    let text = edited(
        "<vertices id=\"square-vertices\">",
        "<source id=\"normals\"><float_array id=\"n\" count=\"12\">1 0 0 0 1 0 0 0 1 1 0 0</float_array><technique_common>\
         <accessor source=\"#n\" count=\"4\" stride=\"3\"/></technique_common></source>\
         <vertices id=\"square-vertices\"><input semantic=\"NORMAL\" source=\"#normals\"/>",
    );
    let t = read(&text).triangles[0];
    assert_eq!([t.n0, t.n1, t.n2], [Vec3::X, Vec3::Y, Vec3::Z]);
}

#[test]
fn missing_normals_are_area_weighted_means() {
    // Two triangles at a right angle with a common edge from 0 to 1. One has twice the area of the
    // other.
    let text = edited("0 0 0  1 0 0  1 1 0  0 1 0", "0 0 0  1 0 0  0 2 0  0 0 1")
        .replace("0 1 2 0 2 3", "0 1 2 1 0 3");
    let [first, second] = read(&text).triangles[..] else {
        panic!("expected two triangles")
    };
    let expected = v(0.0, 1.0, 2.0).normalize();
    assert_near(first.n0, expected);
    assert_near(second.n1, expected);
    assert_near(first.n2, Vec3::Z);
    assert_near(second.n2, Vec3::Y);
}

#[test]
fn sources_can_have_strides_offsets_and_unnamed_params() {
    let text = edited(
        "count=\"12\">0 0 0  1 0 0  1 1 0  0 1 0",
        "count=\"21\">9  8 0 0 0 8  8 1 0 0 8  8 1 1 0 8  8 0 1 0 8",
    )
    .replace(
        "count=\"4\" stride=\"3\"",
        "count=\"4\" stride=\"5\" offset=\"1\"",
    )
    .replace("<param name=\"X\"/>", "<param/><param name=\"X\"/>");
    assert_eq!(
        points(&read(&text).triangles[0]),
        points(&read(SMALL).triangles[0])
    );
}

#[test]
fn comments_line_ends_and_cdata_do_not_change_the_scene() {
    let expected = read(SMALL);
    for (from, to) in [
        ("1 1 0", "1 <!-- half way --> 1 0"),
        ("1 1 0", "1\r\n1\t0"),
        (
            "0 0 0  1 0 0  1 1 0  0 1 0",
            "<![CDATA[0 0 0  1 0 0  1 1 0  0 1 0]]>",
        ),
        ("1 1 0", "1 &#49; 0"),
        (
            "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" ",
            "",
        ),
        ("\n", "\r\n"),
    ] {
        assert_eq!(read(&edited(from, to)), expected, "{to}");
    }
}

/// The material of an effect that has `element` in its `<extra>` for the course.
fn material(element: &str) -> Material {
    let extra = |profile: &str| {
        format!(
            "</profile_COMMON><extra><technique profile=\"{profile}\">{element}</technique></extra>"
        )
    };
    let [a, b] = ["CGL", "CMU462"]
        .map(|profile| read(&edited("</profile_COMMON>", &extra(profile))).materials[0].material);
    assert_eq!(a, b, "both profiles must give the same material");
    a
}

#[test]
fn course_materials() {
    let tint = Spectrum::new(0.1, 0.2, 0.3);
    assert_eq!(
        material("<emission><radiance>9 8 7</radiance></emission>"),
        Material::Emission {
            radiance: Spectrum::new(9.0, 8.0, 7.0)
        }
    );
    assert_eq!(
        material("<mirror><reflectance>.1 .2 .3</reflectance></mirror>"),
        Material::Mirror { reflectance: tint }
    );
    assert_eq!(
        material("<glossy><reflectance>.1 .2 .3</reflectance><shininess>40</shininess></glossy>"),
        Material::Glossy {
            reflectance: tint,
            shininess: 40.0
        }
    );
    assert_eq!(
        material(
            "<refraction><transmittance>.1 .2 .3</transmittance><roughness>.5</roughness><ior>1.3</ior></refraction>"
        ),
        Material::Refraction {
            transmittance: tint,
            roughness: 0.5,
            ior: 1.3
        }
    );
    assert_eq!(
        material(
            "<glass><reflectance>1 1 1</reflectance><transmittance>.1 .2 .3</transmittance><ior>1.5</ior></glass>"
        ),
        Material::Glass {
            reflectance: Spectrum::WHITE,
            transmittance: tint,
            roughness: 0.0,
            ior: 1.5
        }
    );
}

#[test]
fn other_profiles_are_ignored() {
    let text = edited(
        "</profile_COMMON>",
        "</profile_COMMON><extra><technique profile=\"blender\"><mirror/></technique></extra>",
    );
    assert_eq!(read(&text), read(SMALL));
}

/// The lamp at (0, 5, 0) with the given light and an additional transform.
fn lamp(light: &str, transform: &str) -> Light {
    let text = edited(
        "<technique_common><point><color>1 2 3</color></point></technique_common>",
        light,
    )
    .replace(
        "<translate>0 5 0</translate>",
        &format!("<translate>0 5 0</translate>{transform}"),
    );
    read(&text).lights[0].light
}

#[test]
fn lights_emit_along_minus_z_of_their_node() {
    let color = Spectrum::new(1.0, 2.0, 3.0);
    let down = "<rotate>1 0 0 -90</rotate>";
    let position = v(0.0, 5.0, 0.0);
    let common = |light: &str| format!("<technique_common>{light}</technique_common>");
    assert_eq!(
        lamp(&common("<point><color>1 2 3</color></point>"), down),
        Light::Point {
            position,
            intensity: color
        }
    );
    assert_eq!(
        lamp(&common("<ambient><color>1 2 3</color></ambient>"), down),
        Light::Hemisphere { radiance: color }
    );
    let Light::Directional {
        direction,
        irradiance,
    } = lamp(
        &common("<directional><color>1 2 3</color></directional>"),
        down,
    )
    else {
        panic!("expected a directional light");
    };
    assert_near(direction, Vec3::NEG_Y);
    assert_eq!(irradiance, color);
    let spot = "<spot><color>1 2 3</color><falloff_angle>40</falloff_angle><falloff_exponent>2</falloff_exponent></spot>";
    let Light::Spot {
        direction,
        falloff_angle,
        falloff_exponent,
        ..
    } = lamp(&common(spot), down)
    else {
        panic!("expected a spot light")
    };
    assert_near(direction, Vec3::NEG_Y);
    assert_eq!((falloff_angle, falloff_exponent), (40.0, 2.0));
}

#[test]
fn area_lights_are_transformed_unit_squares() {
    let area = "<technique_common><point><color>5 5 5</color></point></technique_common>\
        <extra><technique profile=\"CGL\"><area><color>1 2 3</color></area></technique></extra>";
    let size = "<rotate>1 0 0 -90</rotate><scale>2 3 4</scale>";
    for (transform, mirrored) in [
        (size.to_owned(), false),
        (size.replace("2 3 4", "-2 3 4"), true),
    ] {
        let Light::Area {
            center,
            edge_x,
            edge_y,
            direction,
            radiance,
        } = lamp(area, &transform)
        else {
            panic!("expected an area light")
        };
        assert_eq!(center, v(0.0, 5.0, 0.0));
        assert_near(edge_x, v(if mirrored { -2.0 } else { 2.0 }, 0.0, 0.0));
        assert_near(edge_y, v(0.0, 0.0, -3.0));
        // Mirrored in x, it still emits along the -z axis of its node.
        assert_near(direction, Vec3::NEG_Y);
        assert_eq!(radiance, Spectrum::new(1.0, 2.0, 3.0));
    }
}

/// The camera at (0, 0, 5) with the given optics.
fn camera(angles: &str) -> Camera {
    read(&edited(
        "<xfov>50</xfov><aspect_ratio>1.5</aspect_ratio>",
        angles,
    ))
    .camera
    .unwrap()
}

fn aspect(camera: &Camera) -> f64 {
    libm::tan(camera.h_fov.to_radians() / 2.0) / libm::tan(camera.v_fov.to_radians() / 2.0)
}

#[test]
fn cameras_have_the_angles_of_the_file() {
    let both = camera("<xfov>50</xfov><yfov>20</yfov><aspect_ratio>9</aspect_ratio>");
    assert_eq!((both.h_fov, both.v_fov), (50.0, 20.0));
    let wide = camera("<xfov>50</xfov><aspect_ratio>1.5</aspect_ratio>");
    assert_eq!(wide.h_fov, 50.0);
    assert!((aspect(&wide) - 1.5).abs() < ROUNDING);
    let tall = camera("<yfov>50</yfov><aspect_ratio>1.5</aspect_ratio>");
    assert_eq!(tall.v_fov, 50.0);
    assert!((aspect(&tall) - 1.5).abs() < ROUNDING);
    assert!((aspect(&camera("<xfov>50</xfov>")) - 4.0 / 3.0).abs() < ROUNDING);
    assert_eq!((wide.n_clip, wide.f_clip), (0.1, 100.0));
    assert_eq!(wide.pos, v(0.0, 0.0, 5.0));
}

#[test]
fn scale_and_mirroring_do_not_change_the_camera() {
    for (transform, warning) in [
        ("<scale>0.3 0.3 0.3</scale>", None),
        (
            "<scale>-1 1 1</scale>",
            Some("this camera is mirrored by its transform"),
        ),
        ("<scale>1 2 3</scale>", None),
    ] {
        let loaded = load_edited(
            "<translate>0 0 5</translate>",
            &format!("<translate>0 0 5</translate>{transform}"),
        );
        let loaded = loaded.unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(loaded.warnings.first().map(|w| w.0.title()), warning);
        let c2w = loaded.scene.camera.unwrap().c2w;
        assert_near(c2w.x_axis, Vec3::X);
        assert_near(c2w.y_axis, Vec3::Y);
        assert_near(c2w.z_axis, Vec3::Z);
    }
    let turned = edited(
        "<translate>0 0 5</translate>",
        "<lookat>0 0 5  0 5 0  0 1 0</lookat>",
    );
    assert_near(
        read(&turned).camera.unwrap().c2w * Vec3::NEG_Z,
        v(0.0, 1.0, -1.0).normalize(),
    );
}

/// Matrices computed with `float` have last rows such as 0 0 0 0.99999994.
#[test]
fn the_last_row_of_a_matrix_may_be_rounded() {
    let plain = read(SMALL);
    for row in ["0 0 0 0.99999994", "1e-7 0 -1e-7 1.0000001"] {
        assert_eq!(
            read(&edited("0 0 0 1</matrix>", &format!("{row}</matrix>"))),
            plain
        );
    }
    for row in ["0 0 0 0.9999", "0 1e-5 0 1"] {
        let error = load_edited("0 0 0 1</matrix>", &format!("{row}</matrix>")).unwrap_err();
        assert_eq!(error.0.title(), "the last row of <matrix> is not 0 0 0 1");
    }
}

/// The material of the square with these parts of `phong` in place of its diffuse colour, and the
/// titles of the warnings.
fn phong(parts: &str) -> (Material, Vec<String>) {
    let diffuse = "<diffuse><color>0.8 0.1 0.1 1</color></diffuse>";
    let loaded = load_edited(diffuse, parts).unwrap_or_else(|e| panic!("{parts}: {e}"));
    let titles = loaded.warnings.iter().map(|w| w.0.title().to_owned());
    (loaded.scene.materials[0].material, titles.collect())
}

/// The strongest of the diffuse colour, the mirror and the highlight is the material.
#[test]
fn the_strongest_part_of_phong_is_the_material() {
    let diffuse = |g: f64| format!("<diffuse><color>{g} {g} {g} 1</color></diffuse>");
    let reflective = |g: f64, r: f64| {
        format!(
            "<reflective><color>{g} {g} {g} 1</color></reflective>\
             <reflectivity><float>{r}</float></reflectivity>"
        )
    };
    let specular = |g: f64, s: f64| {
        format!(
            "<specular><color>{g} {g} {g} 1</color></specular>\
             <shininess><float>{s}</float></shininess>"
        )
    };
    let grey = |g| Material::Diffuse {
        reflectance: Spectrum::grey(g),
    };
    let mirror = |g| Material::Mirror {
        reflectance: Spectrum::grey(g),
    };
    let glossy = |g, shininess| Material::Glossy {
        reflectance: Spectrum::grey(g),
        shininess,
    };
    let is_mirror = "the diffuse colour is ignored: the surface is a mirror";
    let no_mirror = "the reflection of the common profile is ignored";
    let no_highlight = "the highlight of the common profile is ignored";
    let chrome = diffuse(0.0) + &specular(1.0, 50.0) + &reflective(1.0, 1.0);
    let both = diffuse(0.5) + &specular(1.0, 20.0) + &reflective(1.0, 0.25);
    for (parts, material, warnings) in [
        (chrome, mirror(1.0), vec![]),
        (reflective(1.0, 0.75), mirror(0.75), vec![]),
        (
            diffuse(0.2) + &reflective(1.0, 0.5),
            mirror(0.5),
            vec![is_mirror],
        ),
        (
            diffuse(0.5) + &reflective(1.0, 0.25),
            grey(0.5),
            vec![no_mirror],
        ),
        (both, grey(0.5), vec![no_mirror]),
        (diffuse(0.5) + &reflective(0.0, 1.0), grey(0.5), vec![]),
        (diffuse(0.5) + &reflective(1.0, 0.05), grey(0.5), vec![]),
        (
            diffuse(0.0) + &specular(0.75, 20.0),
            glossy(0.75, 20.0),
            vec![],
        ),
        (
            diffuse(0.5) + &specular(0.75, 20.0),
            grey(0.5),
            vec![no_highlight],
        ),
        (diffuse(0.5) + &specular(0.5, 50.0), grey(0.5), vec![]),
        (diffuse(0.0) + &specular(0.0, 20.0), grey(0.0), vec![]),
        (
            diffuse(0.5) + "<reflectivity><float>x</float></reflectivity>",
            grey(0.5),
            vec!["`x` in <float> is not a number"],
        ),
    ] {
        assert_eq!(
            phong(&parts),
            (material, warnings.iter().map(|w| w.to_string()).collect()),
            "{parts}"
        );
    }
    // One warning for all materials, with the place of each.
    let many = diffuse(0.5) + &specular(1.0, 20.0) + &reflective(1.0, 0.25);
    assert_eq!(phong(&many).1.len(), 1);
}

/// The file of a converter that writes radians, and an aspect ratio of 0.
#[test]
fn cameras_with_angles_in_radians_are_left_out() {
    let angles = "<xfov>50</xfov><aspect_ratio>1.5</aspect_ratio>";
    for (xfov, aspect, is_damaged) in [
        ("0.785398185", "0", true),
        ("0.785398185", "1.5", false),
        ("49.1", "0", false),
    ] {
        let text = format!("<xfov>{xfov}</xfov><aspect_ratio>{aspect}</aspect_ratio>");
        let loaded = load_edited(angles, &text).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(loaded.scene.camera.is_none(), is_damaged, "{xfov} {aspect}");
        let title = loaded.warnings.first().map(|w| w.0.title());
        if is_damaged {
            let expected = "xfov is 0.785398185 degrees, which looks like radians";
            assert_eq!((title, loaded.warnings.len()), (Some(expected), 1));
        }
    }
}

/// A mesh without normals is smoothed. Where that rounds its edges, its name is reported.
#[test]
fn smoothed_edges_are_reported() {
    let smoothed = |triangles: &str| {
        let loaded = load_edited("0 1 2 0 2 3", triangles).unwrap_or_else(|e| panic!("{e}"));
        loaded.smoothed
    };
    // All in one plane.
    assert!(smoothed("0 1 2 0 2 3").is_empty());
    let folded = "0 0 0  1 0 0  1 1 0  0 1 0";
    let loaded = load_edited(folded, "0 0 0  1 0 0  1 1 0  0 0 1").unwrap();
    assert_eq!(loaded.smoothed, ["square"]);
}
