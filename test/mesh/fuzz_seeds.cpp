#include "fuzz_seeds.h"

#include "mesh_file.h"

namespace monocular_eye_hand::fuzz {
namespace {

const char kObj[] = R"(# Units: mm
mtllib part.mtl
o part
g side
v -20 -25 -30
v 20 -25 -30
v 20 25 -30
v -20 25 -30
v 0 0 30 1.0
vt 0 0
vt 1 0
vt 1 1
vn 0 0 -1
vn 0.5 0.5 0.7
usemtl steel
s off
f 4/1/1 3/2/1 2/3/1 1/1/1
f 1//2 2//2 5//2
f -4 -3 -1
s 1
g other
f 3/1 4/2 5/3
f 4 1 \
 5
l 1 2
p 5
)";

const char kDae[] = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="millimeter" meter="0.001"/><up_axis>Z_UP</up_axis></asset>
  <library_effects><effect id="e"><profile_COMMON><technique sid="c"><phong><diffuse><color>1 0 0 1</color></diffuse>
    </phong></technique></profile_COMMON></effect></library_effects>
  <library_materials><material id="m" name="m"><instance_effect url="#e"/></material></library_materials>
  <library_geometries><geometry id="g" name="part"><mesh>
    <source id="p"><float_array id="pa" count="15">-20 -25 -30 20 -25 -30 20 25 -30 -20 25 -30 0 0 30</float_array>
      <technique_common><accessor source="#pa" count="5" stride="3"><param name="X" type="float"/>
        <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
    <source id="n"><float_array id="na" count="6">0 0 -1 0 1 0</float_array>
      <technique_common><accessor source="#na" count="2" stride="3"><param name="X" type="float"/>
        <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <polylist material="m" count="3"><input semantic="VERTEX" source="#v" offset="0"/>
      <input semantic="NORMAL" source="#n" offset="1"/><vcount>4 3 3</vcount>
      <p>3 0 2 0 1 0 0 0 0 1 1 1 4 1 1 1 2 1 4 1</p></polylist>
    <triangles material="m" count="2"><input semantic="VERTEX" source="#v" offset="0"/><p>2 3 4 3 0 4</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node id="a"><translate>1 2 3</translate><rotate>0 0 1 90</rotate>
    <node id="b"><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix><scale>1 1 1</scale><instance_geometry url="#g">
      <bind_material><technique_common><instance_material symbol="m" target="#m"/></technique_common></bind_material>
    </instance_geometry></node></node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)";

const char kPlyStrips[] = R"(ply
format ascii 1.0
comment units: mm
element vertex 5
property float32 x
property float32 y
property float32 z
element tristrips 1
property list int int vertex_indices
end_header
0 0 0
10 0 0
0 10 0
0 0 10
nan nan nan
9 0 1 2 3 -1 0 2 1 3
)";

const char kPlyPolygons[] = R"(ply
format ascii 1.0
obj_info made by hand
element vertex 5
property double x
property double y
property double z
property uchar red
element face 3
property list uchar uint vertex_index
property float quality
element edge 1
property int vertex1
property int vertex2
end_header
0 0 0 1
10 0 0 2
10 10 0 3
0 10 0 4
5 5 9 5
4 3 2 1 0 0.5
3 0 1 4 1
2 1 2 0
0 1
)";

const char kRosYaml[] = R"(image_width: 640
image_height: 480
camera_name: wrist
camera_matrix:
  rows: 3
  cols: 3
  data: [700.5, 0, 320, 0, 701, 240, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.2, 0.1, 0.001, -0.001, 0]
rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
projection_matrix:
  rows: 3
  cols: 4
  data: [700, 0, 320, 0, 0, 700, 240, 0, 0, 0, 1, 0]
)";

const char kOstIni[] = R"(# oST version 5.0 parameters

[image]

width
640

height
480

[narrow_stereo]

camera matrix
700.000000 0.000000 320.000000
0.000000 700.000000 240.000000
0.000000 0.000000 1.000000

distortion
-0.200000 0.100000 0.000000 0.000000 0.000000

rectification
1.000000 0.000000 0.000000
0.000000 1.000000 0.000000
0.000000 0.000000 1.000000

projection
700.000000 0.000000 320.000000 0.000000
0.000000 700.000000 240.000000 0.000000
0.000000 0.000000 1.000000 0.000000
)";

const char kOpenCvYaml[] = R"(%YAML:1.0
---
calibration_time: "Mon 01 Jan 2024"
image_Width: 640
image_Height: 480
Camera_Matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 700., 0., 320., 0., 700., 240., 0., 0., 1. ]
Distortion_Coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -2.0e-01, 1.0e-01, 0., 0., 0. ]
)";

const char kOpenCvXml[] = R"(<?xml version="1.0"?>
<opencv_storage>
<!-- made by a test -->
<image_width>640</image_width>
<image_height>480</image_height>
<camera_matrix type_id="opencv-matrix">
  <rows>3</rows>
  <cols>3</cols>
  <dt>d</dt>
  <data>
    700. 0. 320. 0. 700. 240. 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id="opencv-matrix">
  <rows>1</rows>
  <cols>5</cols>
  <dt>d</dt>
  <data>
    -0.2 0.1 0. 0. 0.</data></distortion_coefficients>
</opencv_storage>
)";

const char kKalibr[] = R"(cam0:
  cam_overlaps: []
  camera_model: pinhole
  distortion_coeffs: [-0.01, 0.02, 0.001, -0.001]
  distortion_model: equidistant
  intrinsics: [700.0, 700.0, 320.0, 240.0]
  resolution: [640, 480]
  rostopic: /camera/image_raw
)";

const char kCameraInfo[] = R"(header:
  seq: 12
  stamp:
    secs: 1700000000
    nsecs: 5000
  frame_id: "camera"
height: 480
width: 640
distortion_model: "plumb_bob"
D: [-0.2, 0.1, 0.0, 0.0, 0.0]
K: [700.0, 0.0, 320.0, 0.0, 700.0, 240.0, 0.0, 0.0, 1.0]
R: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
P: [700.0, 0.0, 320.0, 0.0, 0.0, 700.0, 240.0, 0.0, 0.0, 0.0, 1.0, 0.0]
binning_x: 2
binning_y: 2
roi:
  x_offset: 10
  y_offset: 20
  height: 400
  width: 600
  do_rectify: False
---
)";

const char kVisp[] = R"(<?xml version="1.0"?>
<root>
  <camera>
    <name>Camera</name>
    <image_width>640</image_width>
    <image_height>480</image_height>
    <model><type>perspectiveProjWithoutDistortion</type><px>700</px><py>700</py><u0>320</u0><v0>240</v0></model>
    <model><type>perspectiveProjWithDistortion</type><px>700</px><py>700</py><u0>320</u0><v0>240</v0>
      <kud>-0.05</kud><kdu>0.05</kdu></model>
  </camera>
</root>
)";

const char kRealSense[] =
    R"({"width": 640, "height": 480, "fx": 700.0, "fy": 700.0, "ppx": 320.0, "ppy": 240.0,
 "model": "Brown Conrady", "coeffs": [0.0, 0.0, 0.0, 0.0, 0.0]}
)";

const char kObjects[] = R"(objects:
  - name: box
    mesh: box.stl
    unit: mm
    sharp_angle: 0.4
    weld_tolerance: 1e-6
    find_symmetries: false
    grasps:
      - {xyz: [0, 0, 0.05], rpy: [3.14, 0, 0], width: 0.04}
      - {xyz: [0.1, 0, 0], width: 0.02, rotation_steps: 6, axis: [0, 0, 2], point: [0.1, 0, 0]}
  - {name: frame, mesh: ./box.stl, unit: inch, obstacle: true}
  - {name: third, mesh: "box.stl", grasp: false}
)";

const char kOptions[] = R"(# every kind of field
model:
  sharp_angle: 0.35
  weld_tolerance: 1e-6
  symmetry_tolerance: 0.002
  find_symmetries: true
views: {spacing: 0.21, distance_ratios: [2.0, 3.5, 7.0], samples_per_view: 120}
name: "a text"
corners: [[0, 1], [2, 3], [4, 5]]
box: [0.1, -2, 3e-1]
)";

const char kAnyYaml[] = R"(%YAML 1.2
---
a: &x [1, 2, {b: c}]
d: *x
"e\n": |
  text
  more
f:
  - h
  - - i
    - j: k
l: !!str 12
...
)";

}  // namespace

std::vector<SeedFile> meshSeeds() {
  const Mesh box = shapes::box(40, 50, 60);
  const std::string unit = "<unit name=\"inch\" meter=\"0.0254\"/>";
  return {{"stl", asciiStl(box)},
          {"stl", binaryStl(box)},
          {"stl", binaryStl(box, "solid that is binary")},
          {"ply", ply(box, "ascii")},
          {"ply", ply(box, "binary_little_endian")},
          {"ply", ply(box, "binary_big_endian")},
          {"ply", kPlyStrips},
          {"ply", kPlyPolygons},
          {"obj", obj(box)},
          {"obj", kObj},
          {"dae", dae(box, unit)},
          {"dae", kDae}};
}

std::vector<SeedFile> calibrationSeeds() {
  return {{"yaml", kRosYaml}, {"ini", kOstIni},      {"yaml", kOpenCvYaml}, {"xml", kOpenCvXml},
          {"yaml", kKalibr},  {"yaml", kCameraInfo}, {"xml", kVisp},        {"json", kRealSense}};
}

std::vector<SeedFile> objectListSeeds() { return {{"yaml", kObjects}}; }

std::vector<SeedFile> optionSeeds() { return {{"yaml", kOptions}, {"yaml", kAnyYaml}}; }

}  // namespace monocular_eye_hand::fuzz
