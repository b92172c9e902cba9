//! A small valid file. Each test changes it in one place.

use scenes::diagnostic::Diagnostic;
use scenes::{Loaded, SceneError};

/// A square of two triangles, a sphere, a light and a camera.
pub(crate) const SMALL: &str = r##"<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><up_axis>Y_UP</up_axis></asset>
  <library_cameras>
    <camera id="cam">
      <optics><technique_common><perspective>
        <xfov>50</xfov><aspect_ratio>1.5</aspect_ratio><znear>0.1</znear><zfar>100</zfar>
      </perspective></technique_common></optics>
    </camera>
  </library_cameras>
  <library_lights>
    <light id="lamp"><technique_common><point><color>1 2 3</color></point></technique_common></light>
  </library_lights>
  <library_effects>
    <effect id="red-effect"><profile_COMMON><technique sid="common">
      <phong><diffuse><color>0.8 0.1 0.1 1</color></diffuse></phong>
    </technique></profile_COMMON></effect>
  </library_effects>
  <library_materials>
    <material id="red" name="Red"><instance_effect url="#red-effect"/></material>
  </library_materials>
  <library_geometries>
    <geometry id="square">
      <mesh>
        <source id="points">
          <float_array id="points-array" count="12">0 0 0  1 0 0  1 1 0  0 1 0</float_array>
          <technique_common>
            <accessor source="#points-array" count="4" stride="3">
              <param name="X"/><param name="Y"/><param name="Z"/>
            </accessor>
          </technique_common>
        </source>
        <vertices id="square-vertices"><input semantic="POSITION" source="#points"/></vertices>
        <triangles material="paint" count="2">
          <input semantic="VERTEX" source="#square-vertices" offset="0"/>
          <p>0 1 2 0 2 3</p>
        </triangles>
      </mesh>
    </geometry>
    <geometry id="ball">
      <extra><technique profile="CGL"><sphere><radius>0.5</radius></sphere></technique></extra>
    </geometry>
  </library_geometries>
  <library_visual_scenes>
    <visual_scene id="scene">
      <node id="square-node">
        <matrix>1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1</matrix>
        <instance_geometry url="#square"><bind_material><technique_common>
          <instance_material symbol="paint" target="#red"/>
        </technique_common></bind_material></instance_geometry>
      </node>
      <node id="ball-node">
        <translate>3 0 0</translate>
        <instance_geometry url="#ball"><bind_material><technique_common>
          <instance_material symbol="paint" target="#red"/>
        </technique_common></bind_material></instance_geometry>
      </node>
      <node id="lamp-node"><translate>0 5 0</translate><instance_light url="#lamp"/></node>
      <node id="cam-node"><translate>0 0 5</translate><instance_camera url="#cam"/></node>
    </visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"##;

/// The small file with `from` replaced by `to`. Panics if `from` is not in the file.
pub(crate) fn edited(from: &str, to: &str) -> String {
    assert!(SMALL.contains(from), "`{from}` is not in the small file");
    SMALL.replace(from, to)
}

/// Reads the small file with `from` replaced by `to`.
pub(crate) fn load_edited(from: &str, to: &str) -> Result<Loaded, SceneError> {
    scenes::parse("small.dae", &edited(from, to))
}

/// Compares diagnostics with a snapshot: of each the edit that it is about, its place, title, label
/// and advice. `look_for` says what the reader of the snapshot looks for.
pub(crate) fn shows<'a>(
    name: &str,
    look_for: &str,
    each: impl Iterator<Item = (&'a str, &'a str, Diagnostic)>,
) {
    let text = each.map(|(from, to, found)| {
        let (line, column) = found.line_and_column().expect("a place");
        let parts = [found.expected(), found.what_to_do()];
        let parts = parts.into_iter().flatten();
        let more: String = parts.flat_map(|part| ["\n    ", part]).collect();
        format!(
            "`{from}` -> `{to}`\n  {line}:{column}: {}{more}\n",
            found.title()
        )
    });
    let text: String = text.collect();
    let mut settings = insta::Settings::clone_current();
    settings.set_description(look_for);
    settings.set_omit_expression(true);
    settings.set_prepend_module_to_snapshot(false);
    settings.set_snapshot_path("diagnostics");
    settings.bind(|| insta::assert_snapshot!(name, text));
}
