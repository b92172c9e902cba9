//! assimp's exporter: one geometry per mesh and all inputs at offset 0, `polylist` with `lines`, a
//! matrix per node, ids with characters of file names, a spot light with an angle of 360 degrees, a
//! camera with `aspect_ratio` 0, all materials bound to the symbol `defaultMaterial`.

use super::load;
use kit::{Light, Vec3};

const DOCUMENT: &str = r##"<?xml version="1.0" encoding="UTF-8" standalone="no" ?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>
    <contributor><author>Assimp</author><authoring_tool>Assimp Exporter</authoring_tool></contributor>
    <created>2024-01-01T00:00:00</created><modified>2024-01-01T00:00:00</modified>
    <unit name="meter" meter="1" /><up_axis>Y_UP</up_axis>
  </asset>
  <library_cameras>
    <camera id="Camera01-camera" name="Camera01"><optics><technique_common><perspective>
      <xfov sid="xfov">45</xfov><aspect_ratio>0</aspect_ratio><znear sid="znear">0.1</znear><zfar sid="zfar">1000</zfar>
    </perspective></technique_common></optics></camera>
  </library_cameras>
  <library_lights>
    <light id="Spot-light" name="Spot"><technique_common><spot>
      <color sid="color">1 1 1</color><constant_attenuation>1</constant_attenuation>
      <falloff_angle sid="fall_off_angle">360</falloff_angle><falloff_exponent sid="fall_off_exponent">0</falloff_exponent>
    </spot></technique_common></light>
  </library_lights>
  <library_effects>
    <effect id="m0-fx" name="m0"><profile_COMMON><technique sid="standard"><phong>
      <ambient><color sid="ambient">0.2 0.2 0.2 1</color></ambient>
      <diffuse><color sid="diffuse">0.6 0.6 0.6 1</color></diffuse>
    </phong></technique></profile_COMMON></effect>
  </library_effects>
  <library_materials><material id="m0" name="m0"><instance_effect url="#m0-fx"/></material></library_materials>
  <library_geometries>
    <geometry id="my model (1).obj-mesh" name="my model (1).obj">
      <mesh>
        <source id="my model (1).obj-positions" name="positions">
          <float_array id="my model (1).obj-positions-array" count="12"> 0 0 0 1 0 0 1 1 0 0 1 0 </float_array>
          <technique_common><accessor count="4" offset="0" source="#my%20model%20(1).obj-positions-array" stride="3">
            <param name="X" type="float" /><param name="Y" type="float" /><param name="Z" type="float" />
          </accessor></technique_common>
        </source>
        <source id="my model (1).obj-normals" name="normals">
          <float_array id="my model (1).obj-normals-array" count="12"> 0 0 1 0 0 1 nan nan nan 0 0 1 </float_array>
          <technique_common><accessor count="4" offset="0" source="#my%20model%20(1).obj-normals-array" stride="3">
            <param name="X" type="float" /><param name="Y" type="float" /><param name="Z" type="float" />
          </accessor></technique_common>
        </source>
        <vertices id="my model (1).obj-vertices">
          <input semantic="POSITION" source="#my%20model%20(1).obj-positions" />
        </vertices>
        <lines count="1" material="defaultMaterial">
          <input offset="0" semantic="VERTEX" source="#my%20model%20(1).obj-vertices" />
          <p>0 1</p>
        </lines>
        <polylist count="1" material="defaultMaterial">
          <input offset="0" semantic="VERTEX" source="#my%20model%20(1).obj-vertices" />
          <input offset="0" semantic="NORMAL" source="#my%20model%20(1).obj-normals" />
          <vcount>4 </vcount>
          <p>0 1 2 3 </p>
        </polylist>
      </mesh>
    </geometry>
  </library_geometries>
  <library_visual_scenes>
    <visual_scene id="Scene" name="Scene">
      <node id="RootNode" name="RootNode" type="NODE">
        <matrix sid="matrix">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
        <node id="Mesh" name="Mesh" type="NODE">
          <matrix sid="matrix">1 0 0 0 0 1 0 0 0 0 1 2 0 0 0 1</matrix>
          <instance_geometry url="#my%20model%20(1).obj-mesh"><bind_material><technique_common>
            <instance_material symbol="defaultMaterial" target="#m0">
              <bind_vertex_input semantic="CHANNEL0" input_semantic="TEXCOORD" input_set="0"/>
            </instance_material>
          </technique_common></bind_material></instance_geometry>
        </node>
        <node id="Spot" name="Spot" type="NODE"><instance_light url="#Spot-light"/></node>
        <node id="Camera01" name="Camera01" type="NODE"><instance_camera url="#Camera01-camera"/></node>
      </node>
    </visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#Scene" /></scene>
</COLLADA>
"##;

#[test]
fn odd_values_are_replaced_with_warnings() {
    let warnings = [
        ("<lines> is ignored", "<lines count=\"1\""),
        (
            "`nan` in <float_array id=\"my model (1).obj-normals-array\"> is not finite",
            "nan nan nan",
        ),
        ("the opening angle is 360 degrees", "<falloff_angle"),
        ("aspect_ratio is 0", "<aspect_ratio>0<"),
    ];
    let loaded = load("assimp.dae", DOCUMENT, &warnings);
    let elsewhere = loaded.warnings[1].0.elsewhere();
    assert_eq!(elsewhere, Some("2 more like this, at line 36"));
    let scene = loaded.scene;
    assert_eq!(scene.triangles.len(), 2);
    assert_eq!(scene.triangles[0].p0, Vec3::new(0.0, 0.0, 2.0));
    // The normal of the third corner is that of the triangle.
    assert_eq!(scene.triangles[0].n2, Vec3::Z);
    assert_eq!(scene.camera.expect("a camera").h_fov, 45.0);
    let Light::Spot { falloff_angle, .. } = scene.lights[0].light else {
        panic!("expected a spot light")
    };
    assert_eq!(falloff_angle, 180.0);
}
