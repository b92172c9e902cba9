//! Maya and 3ds Max, by the FBX exporter or OpenCOLLADA: `polygons` with a `<p>` each and holes in
//! `<ph>`, several sets of TEXCOORD, pivots as many small transforms with rotations about no axis,
//! `<extra>` of many profiles, an orthographic camera, a camera with a target, a morph, a path of
//! Windows to a texture.

use super::load;
use kit::{Vec2, Vec3};

const DOCUMENT: &str = r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>
    <contributor><author></author><authoring_tool>FBX COLLADA exporter</authoring_tool><comments></comments></contributor>
    <created>2014-01-01T00:00:00Z</created><keywords></keywords><modified>2014-01-01T00:00:00Z</modified>
    <revision></revision><subject></subject><title></title>
    <unit meter="0.010000" name="centimeter"></unit><up_axis>Y_UP</up_axis>
  </asset>
  <library_images>
    <image id="Map-image" name="Map"><init_from>file://C:\Users\me\my%20maps\wall.png</init_from></image>
  </library_images>
  <library_materials><material id="Wall" name="Wall"><instance_effect url="#Wall-fx"/></material></library_materials>
  <library_effects>
    <effect id="Wall-fx" name="Wall"><profile_COMMON><technique sid="standard"><phong>
      <diffuse><texture texture="Map-image" texcoord="CHANNEL0"><extra><technique profile="MAYA"><wrapU sid="wrapU0">TRUE</wrapU></technique></extra></texture></diffuse>
      <reflective><color sid="reflective">0 0 0 1</color></reflective>
    </phong></technique></profile_COMMON></effect>
  </library_effects>
  <library_geometries>
    <geometry id="Wall-lib" name="WallMesh">
      <mesh>
        <source id="Wall-lib-Position">
          <float_array id="Wall-lib-Position-array" count="24">0 0 0 3 0 0 3 3 0 0 3 0 1 1 0 2 1 0 2 2 0 1 2 0</float_array>
          <technique_common><accessor source="#Wall-lib-Position-array" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
        </source>
        <source id="Wall-lib-UV0">
          <float_array id="Wall-lib-UV0-array" count="3">0.25 0.75 0</float_array>
          <technique_common><accessor source="#Wall-lib-UV0-array" count="1" stride="3"><param name="S" type="float"/><param name="T" type="float"/><param name="P" type="float"/></accessor></technique_common>
        </source>
        <source id="Wall-lib-UV1">
          <float_array id="Wall-lib-UV1-array" count="2">9 9</float_array>
          <technique_common><accessor source="#Wall-lib-UV1-array" count="1" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor></technique_common>
        </source>
        <vertices id="Wall-lib-Vertex"><input semantic="POSITION" source="#Wall-lib-Position"/></vertices>
        <polygons material="Wall" count="2">
          <input semantic="VERTEX" offset="0" source="#Wall-lib-Vertex"/>
          <input semantic="TEXCOORD" offset="1" set="0" source="#Wall-lib-UV0"/>
          <input semantic="TEXCOORD" offset="2" set="1" source="#Wall-lib-UV1"/>
          <p>4 0 0 5 0 0 6 0 0</p>
          <ph><p>0 0 0 1 0 0 2 0 0 3 0 0</p><h>4 0 0 5 0 0 6 0 0 7 0 0</h></ph>
        </polygons>
      </mesh>
      <extra><technique profile="MAX3D"><max_extension/></technique></extra>
    </geometry>
  </library_geometries>
  <library_controllers>
    <controller id="Wall-morph"><morph source="#Wall-lib" method="NORMALIZED">
      <targets><input semantic="MORPH_TARGET" source="#none"/></targets>
    </morph></controller>
  </library_controllers>
  <library_cameras>
    <camera id="Top-lib" name="Top"><optics><technique_common><orthographic>
      <xmag>10</xmag><aspect_ratio>1</aspect_ratio><znear>1</znear><zfar>100</zfar>
    </orthographic></technique_common></optics></camera>
    <camera id="Persp-lib" name="Persp"><optics><technique_common><perspective>
      <yfov>40</yfov><aspect_ratio>1.5</aspect_ratio><znear>0</znear><zfar>0</zfar>
    </perspective></technique_common></optics><extra><technique profile="MAX3D"><target>#Persp.Target</target></technique></extra></camera>
  </library_cameras>
  <library_visual_scenes>
    <visual_scene id="RootNode" name="RootNode">
      <node id="Wall" name="Wall">
        <translate sid="translate">0 0 -5</translate><rotate sid="rotateZ">0 0 1 -0</rotate><rotate sid="rotateY">0 1 0 90</rotate><rotate sid="rotateX">1 0 0 0</rotate>
        <node id="Wall-Pivot" name="Wall-Pivot">
          <translate>0 0 0</translate><rotate>0.000000 0.000000 0.000000 0.000000</rotate>
          <instance_geometry url="#Wall-lib"><bind_material><technique_common>
            <instance_material symbol="Wall" target="#Wall"/>
          </technique_common></bind_material></instance_geometry>
        </node>
        <extra><technique profile="FCOLLADA"><visibility>1.000000</visibility></technique></extra>
      </node>
      <node id="Morphed" name="Morphed"><translate>0 9 0</translate>
        <instance_controller url="#Wall-morph"><bind_material><technique_common>
          <instance_material symbol="Wall" target="#Wall"/>
        </technique_common></bind_material></instance_controller>
      </node>
      <node id="Top" name="Top"><rotate>1 0 0 -90</rotate><instance_camera url="#Top-lib"/></node>
      <node id="Persp" name="Persp"><matrix sid="matrix">1 0 0 0 0 1 0 0 0 0 1 20 0 0 0 1</matrix><instance_camera url="#Persp-lib"/></node>
      <node id="Persp.Target" name="Persp.Target"><rotate>0 0 0 30</rotate></node>
      <extra><technique profile="MAX3D"><frame_rate>30.000000</frame_rate></technique></extra>
    </visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#RootNode"></instance_visual_scene></scene>
</COLLADA>
"##;

#[test]
fn polygons_with_holes_pivots_and_morphs_are_read() {
    let warnings = [
        ("<morph> does not deform its mesh", "<morph source"),
        (
            "<camera id=\"Top-lib\"> has <orthographic>",
            "<camera id=\"Top-lib\"",
        ),
        ("zfar is 0", "<zfar>0</zfar>"),
        (
            "<rotate> has a rotation axis of length 0",
            "<rotate>0 0 0 30</rotate>",
        ),
    ];
    let loaded = load("fbx.dae", DOCUMENT, &warnings);
    assert_eq!(
        loaded.warnings[3].0.what_to_do(),
        Some("the node is left out: it contains nothing to render")
    );
    let scene = loaded.scene;
    // A triangle, and a square with a square hole: eight corners and two for the connection.
    assert_eq!(scene.triangles.len(), 2 * (1 + 8));
    let area = |object: u32| -> f64 {
        let triangles = scene.triangles.iter().zip(&scene.object_of);
        let of_object = triangles.filter(|(_, other)| **other == object);
        of_object
            .map(|(t, _)| (t.p1 - t.p0).cross(t.p2 - t.p0).length() / 2.0)
            .sum()
    };
    assert!((area(0) - 8.5).abs() < 1e-12, "{}", area(0));
    assert!((area(1) - 8.5).abs() < 1e-12, "{}", area(1));
    // The morph is where its node is.
    assert_eq!(scene.triangles[9].p0, Vec3::new(1.0, 10.0, 0.0));
    assert_eq!(scene.textures.files, ["C:/Users/me/my maps/wall.png"]);
    let first_set = Vec2::new(0.25, 0.75);
    let mut coordinates = scene.textures.coordinates.iter().flatten();
    assert!(coordinates.all(|uv| *uv == first_set));
    let camera = scene.camera.expect("the perspective camera");
    assert_eq!((camera.v_fov, camera.pos.z), (40.0, 20.0));
    assert!(camera.f_clip > 1e9, "zfar is ignored");
}
