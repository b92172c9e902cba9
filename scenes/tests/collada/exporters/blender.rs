//! Blender 2.7 to 4: one `polylist` or `triangles` per material with separate inputs, Z_UP,
//! `<matrix sid="transform">`, camera and light with `<extra>`, an empty mesh, loose edges, an
//! armature with a skin.

use super::load;
use kit::{Light, Spectrum, Vec3};
use std::f64::consts::PI;

const DOCUMENT: &str = r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance">
  <asset>
    <contributor><author>Blender User</author><authoring_tool>Blender 2.93.0</authoring_tool></contributor>
    <created>2024-01-01T00:00:00</created><modified>2024-01-01T00:00:00</modified>
    <unit name="meter" meter="1"/><up_axis>Z_UP</up_axis>
  </asset>
  <library_cameras>
    <camera id="Camera-camera" name="Camera">
      <optics><technique_common><perspective>
        <xfov sid="xfov">39.59775</xfov><aspect_ratio>1.777778</aspect_ratio><znear sid="znear">0.1</znear><zfar sid="zfar">100</zfar>
      </perspective></technique_common></optics>
      <extra><technique profile="blender"><shiftx sid="shiftx" type="float">0</shiftx></technique></extra>
    </camera>
  </library_cameras>
  <library_lights>
    <light id="Light-light" name="Light">
      <technique_common><point>
        <color sid="color">1000 1000 1000</color><constant_attenuation>1</constant_attenuation>
        <linear_attenuation>0</linear_attenuation><quadratic_attenuation>0.00111109</quadratic_attenuation>
      </point></technique_common>
      <extra><technique profile="blender"><type sid="type" type="int">0</type></technique></extra>
    </light>
  </library_lights>
  <library_images/>
  <library_effects>
    <effect id="Stone-effect"><profile_COMMON><technique sid="common"><lambert>
      <emission><color sid="emission">0 0 0 1</color></emission>
      <diffuse><color sid="diffuse">0.8 0.7 0.6 1</color></diffuse>
      <index_of_refraction><float sid="ior">1.45</float></index_of_refraction>
    </lambert></technique></profile_COMMON></effect>
  </library_effects>
  <library_materials>
    <material id="Stone-material" name="Stone"><instance_effect url="#Stone-effect"/></material>
  </library_materials>
  <library_geometries>
    <geometry id="Plane_001-mesh" name="Plane.001">
      <mesh>
        <source id="Plane_001-mesh-positions">
          <float_array id="Plane_001-mesh-positions-array" count="15">-1 -1 0 1 -1 0 1 1 0 -1 1 0 0 0 3</float_array>
          <technique_common><accessor source="#Plane_001-mesh-positions-array" count="5" stride="3">
            <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
          </accessor></technique_common>
        </source>
        <source id="Plane_001-mesh-normals">
          <float_array id="Plane_001-mesh-normals-array" count="3">0 0 1</float_array>
          <technique_common><accessor source="#Plane_001-mesh-normals-array" count="1" stride="3">
            <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
          </accessor></technique_common>
        </source>
        <source id="Plane_001-mesh-map-0">
          <float_array id="Plane_001-mesh-map-0-array" count="8">0 0 1 0 1 1 0 1</float_array>
          <technique_common><accessor source="#Plane_001-mesh-map-0-array" count="4" stride="2">
            <param name="S" type="float"/><param name="T" type="float"/>
          </accessor></technique_common>
        </source>
        <source id="Plane_001-mesh-colors-Col" name="Col">
          <float_array id="Plane_001-mesh-colors-Col-array" count="4">1 1 1 1</float_array>
          <technique_common><accessor source="#Plane_001-mesh-colors-Col-array" count="1" stride="4">
            <param name="R" type="float"/><param name="G" type="float"/><param name="B" type="float"/><param name="A" type="float"/>
          </accessor></technique_common>
        </source>
        <vertices id="Plane_001-mesh-vertices"><input semantic="POSITION" source="#Plane_001-mesh-positions"/></vertices>
        <polylist material="Stone-material" count="1">
          <input semantic="VERTEX" source="#Plane_001-mesh-vertices" offset="0"/>
          <input semantic="NORMAL" source="#Plane_001-mesh-normals" offset="1"/>
          <input semantic="TEXCOORD" source="#Plane_001-mesh-map-0" offset="2" set="0"/>
          <input semantic="COLOR" source="#Plane_001-mesh-colors-Col" offset="3" set="0"/>
          <vcount>4 </vcount>
          <p>0 0 0 0 1 0 1 0 2 0 2 0 3 0 3 0</p>
        </polylist>
        <lines count="1"><input semantic="VERTEX" source="#Plane_001-mesh-vertices" offset="0"/><p>2 4</p></lines>
      </mesh>
      <extra><technique profile="MAYA"><double_sided>1</double_sided></technique></extra>
    </geometry>
    <geometry id="Empty-mesh" name="Empty">
      <mesh>
        <source id="Empty-mesh-positions">
          <float_array id="Empty-mesh-positions-array" count="0"/>
          <technique_common><accessor source="#Empty-mesh-positions-array" count="0" stride="3">
            <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
          </accessor></technique_common>
        </source>
        <vertices id="Empty-mesh-vertices"><input semantic="POSITION" source="#Empty-mesh-positions"/></vertices>
      </mesh>
    </geometry>
  </library_geometries>
  <library_controllers>
    <controller id="Armature_Plane-skin" name="Armature">
      <skin source="#Plane_001-mesh">
        <bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 7 0 0 0 1</bind_shape_matrix>
        <source id="Armature_Plane-skin-joints">
          <Name_array id="Armature_Plane-skin-joints-array" count="1">Bone</Name_array>
          <technique_common><accessor source="#Armature_Plane-skin-joints-array" count="1" stride="1">
            <param name="JOINT" type="name"/>
          </accessor></technique_common>
        </source>
        <joints><input semantic="JOINT" source="#Armature_Plane-skin-joints"/></joints>
        <vertex_weights count="0"/>
      </skin>
    </controller>
  </library_controllers>
  <library_animations><animation id="Bone_transform"/></library_animations>
  <library_visual_scenes>
    <visual_scene id="Scene" name="Scene">
      <node id="Camera" name="Camera" type="NODE">
        <matrix sid="transform">1 0 0 0 0 0 -1 -9 0 1 0 0 0 0 0 1</matrix>
        <instance_camera url="#Camera-camera"/>
      </node>
      <node id="Light" name="Light" type="NODE">
        <matrix sid="transform">1 0 0 1 0 1 0 2 0 0 1 3 0 0 0 1</matrix>
        <instance_light url="#Light-light"/>
      </node>
      <node id="Plane_001" name="Plane.001" type="NODE">
        <matrix sid="transform">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
        <instance_geometry url="#Plane_001-mesh" name="Plane.001"><bind_material><technique_common>
          <instance_material symbol="Stone-material" target="#Stone-material">
            <bind_vertex_input semantic="UVMap" input_semantic="TEXCOORD" input_set="0"/>
          </instance_material>
        </technique_common></bind_material></instance_geometry>
      </node>
      <node id="Empty" name="Empty" type="NODE"><instance_geometry url="#Empty-mesh" name="Empty"/></node>
      <node id="Armature" name="Armature" type="NODE">
        <matrix sid="transform">1 0 0 50 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
        <node id="Armature_Bone" name="Bone" sid="Bone" type="JOINT">
          <matrix sid="transform">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
          <extra><technique profile="blender"><connect sid="connect" type="bool">1</connect></technique></extra>
        </node>
        <node id="Skinned" name="Skinned" type="NODE">
          <instance_controller url="#Armature_Plane-skin">
            <skeleton>#Armature_Bone</skeleton>
            <bind_material><technique_common>
              <instance_material symbol="Stone-material" target="#Stone-material"/>
            </technique_common></bind_material>
          </instance_controller>
        </node>
      </node>
    </visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#Scene"/></scene>
</COLLADA>
"##;

#[test]
fn everything_that_can_be_shown_is_read() {
    let warnings = [
        ("<lines> is ignored", "<lines count=\"1\">"),
        (
            "the colours of vertices are ignored",
            "<input semantic=\"COLOR\"",
        ),
        ("<skin> does not deform its mesh", "<skin source"),
    ];
    let scene = load("blender.dae", DOCUMENT, &warnings).scene;
    assert_eq!(scene.triangles.len(), 4);
    // Z_UP maps (x, y, z) to (-x, z, y).
    let camera = scene.camera.expect("a camera");
    assert_eq!(camera.pos, Vec3::new(0.0, 0.0, -9.0));
    assert_eq!(camera.h_fov, 39.59775);
    let position = Vec3::new(-1.0, 3.0, 2.0);
    let intensity = Spectrum::grey(1000.0) / (4.0 * PI);
    let expected = Light::Point {
        position,
        intensity,
    };
    assert_eq!(scene.lights[0].light, expected);
}

/// Lights are as bright as in Cycles, from the version on whose lights have watts.
#[test]
fn lights_in_watts_are_as_in_cycles() {
    let light = |more: &str, version: &str| {
        let extra = r#"<type sid="type" type="int">0</type>"#;
        let document = DOCUMENT.replace(extra, more).replace("2.93.0", version);
        let loaded = scenes::parse("blender.dae", &document).expect("a scene");
        let titles: Vec<String> = loaded.warnings.iter().map(|w| w.0.title().into()).collect();
        (loaded.scene.lights[0].light, titles.len() - 3)
    };
    let watts = Spectrum::grey(1000.0);
    let position = Vec3::new(-1.0, 3.0, 2.0);
    for (version, intensity) in [
        ("2.79.0", watts),
        ("4.3.2 commit date:2024", watts / (4.0 * PI)),
    ] {
        let expected = Light::Point {
            position,
            intensity,
        };
        assert_eq!(light("<type>0</type>", version), (expected, 0), "{version}");
    }
    let area = |shape: u32| {
        let sizes = "<area_size>0.5</area_size><area_sizey>0.25</area_sizey>";
        light(
            &format!("<type>4</type><area_shape>{shape}</area_shape>{sizes}"),
            "3.6.0",
        )
    };
    for (shape, width, height, warnings) in [
        (0, 0.5, 0.5, 0),
        (1, 0.5, 0.25, 0),
        (4, (PI / 16.0).sqrt(), (PI / 16.0).sqrt(), 1),
    ] {
        let (
            Light::Area {
                edge_x,
                edge_y,
                direction,
                radiance,
                ..
            },
            told,
        ) = area(shape)
        else {
            panic!("expected an area light")
        };
        assert!((edge_x.length() - width).abs() < 1e-12, "{shape}: {edge_x}");
        assert!(
            (edge_y.length() - height).abs() < 1e-12,
            "{shape}: {edge_y}"
        );
        // Z_UP: it shines down.
        assert_eq!((direction, told), (Vec3::NEG_Y, warnings), "{shape}");
        let expected = 1000.0 / (4.0 * width * height);
        assert!(
            (radiance.r / expected - 1.0).abs() < 1e-12,
            "{shape}: {radiance:?}"
        );
    }
    let spot = DOCUMENT
        .replace("<point>", "<spot>")
        .replace(
            "</point>",
            "<falloff_exponent>0.15</falloff_exponent></spot>",
        )
        .replace(r#"type="int">0</type>"#, "/><spotblend>0.15</spotblend>");
    let loaded = scenes::parse("blender.dae", &spot).expect("a scene");
    let Light::Spot {
        intensity,
        falloff_exponent,
        ..
    } = loaded.scene.lights[0].light
    else {
        panic!("expected a spot light")
    };
    assert_eq!((intensity, falloff_exponent), (watts / (4.0 * PI), 0.0));
    assert!(
        loaded
            .warnings
            .iter()
            .any(|w| w.0.title() == "a spot light with a soft edge")
    );
}

#[test]
fn skins_are_placed_by_their_bind_shape_not_by_their_node() {
    let warnings = [
        ("<lines> is ignored", "<lines count=\"1\">"),
        (
            "the colours of vertices are ignored",
            "<input semantic=\"COLOR\"",
        ),
        ("<skin> does not deform its mesh", "<skin source"),
    ];
    let scene = load("blender.dae", DOCUMENT, &warnings).scene;
    let names: Vec<&str> = scene.objects.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["Plane.001", "Skinned"]);
    let plane = scene.triangles[0];
    let skinned = scene.triangles[2];
    assert_eq!(skinned.p0, plane.p0 + Vec3::new(0.0, 7.0, 0.0));
    assert_eq!(skinned.n0, Vec3::Y);
}

/// Joints whose node is elsewhere than in the bind pose take the mesh with them.
#[test]
fn skins_follow_their_first_joint() {
    let inverse = r##"<source id="poses"><float_array id="poses-array" count="16">1 0 0 -2 0 1 0 0 0 0 1 0 0 0 0 1</float_array></source>
        <joints><input semantic="INV_BIND_MATRIX" source="#poses"/>"##;
    let document = DOCUMENT.replace("<joints>", inverse);
    let scene = scenes::parse("blender.dae", &document)
        .expect("a scene")
        .scene;
    // The armature is at x = 50, and the bind shape at z = 7; Z_UP maps (x, y, z) to (-x, z, y).
    let moved = scene.triangles[2].p0 - scene.triangles[0].p0;
    assert_eq!(moved, Vec3::new(-48.0, 7.0, 0.0));
}
