#!/usr/bin/python3
"""Nodes that cannot start: they end with exit code 1 and say why, by name."""
import os
import shutil
import sys
import tempfile
import unittest

import numpy
import rospkg
import rostest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import node_process
import scene_files


class TestRefusals(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.cube = os.path.join(rospkg.RosPack().get_path("monocular_eye_hand"), "config", "cube.yaml")
        self.image = self.write("image.pgm", "")
        scene_files.write_pgm(self.image, numpy.zeros((48, 64), numpy.uint8))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w") as file:
            file.write(text)
        return path

    def refused(self, program, arguments, *words):
        with node_process.node(program, program, arguments) as node:
            self.assertEqual(node.exit_code(), 1, node.text())
            for word in words:
                self.assertIn(word, node.text())

    def test_recognizer_parameters(self):
        cube = "_objects:=" + self.cube
        self.refused("recognizer", [], "objects is not set")
        self.refused("recognizer", [cube, "_continous:=true"],
                     "unknown key 'continous'; did you mean 'continuous'?")
        self.refused("recognizer", [cube, "_recognition/min_distanze:=0.2"],
                     "unknown key 'recognition.min_distanze'; did you mean 'recognition.min_distance'?")
        self.refused("recognizer", [cube, "_recognition/min_distance:=-1.0"], "min_distance = -1")
        self.refused("recognizer", [cube, "_recognition/min_distance:=near"], "'recognition.min_distance' is 'near'")
        self.refused("recognizer", [cube, "_service_timeout:=0"], "service_timeout = 0 must be positive")
        self.refused("recognizer", [cube, "_instances/speed:=-2.0"], "speed = -2")

    def test_model_base(self):
        self.refused("recognizer", ["_objects:=" + self.folder + "/none.yaml"], self.folder + "/none.yaml")
        empty = self.write("empty.stl", "")
        base = self.write("base.yaml", "objects:\n  - {name: thing, mesh: empty.stl, unit: mm}\n")
        self.refused("recognizer", ["_objects:=" + base, "_cache:=none"], empty)
        os.remove(empty)
        self.refused("recognizer", ["_objects:=" + base, "_cache:=none"], empty)
        base = self.write("typo.yaml", "objects:\n  - {name: thing, mehs: empty.stl, unit: mm}\n")
        self.refused("recognizer", ["_objects:=" + base, "_cache:=none"], "mehs")

    def test_planner(self):
        objects = "_objects:=" + self.cube
        package = rospkg.RosPack().get_path("monocular_eye_hand")
        urdf = "_urdf:=" + package + "/urdf/puma560.urdf"
        self.refused("planner", [urdf], "objects is not set")
        self.refused("planner", [objects], "urdf is not set")
        self.refused("planner", [objects, urdf, "_drop_zone/colums:=2"],
                     "unknown key 'drop_zone.colums'; did you mean 'drop_zone.columns'?")
        self.refused("planner", [objects, urdf, "_table/length:=-1.0"], "length = -1")
        self.refused("planner", [objects, urdf, "_arm/a2:=0.5"], "tool0")
        self.refused("planner", [objects, "_urdf:=" + self.folder + "/none.urdf"], self.folder + "/none.urdf")

    def test_image_source(self):
        source = "_source:=" + self.image
        self.refused("image_source", [], "source is not set")
        self.refused("image_source", [source, "_frame:=camera"], "unknown key 'frame'")
        self.refused("image_source", [source, "_rate:=-1.0"], "rate = -1")
        self.refused("image_source", ["_source:=" + self.folder + "/none%02d.png"], "no file matches")
        self.refused("image_source", ["_source:=" + self.folder + "/none.png"], "there is no file")
        missing = self.folder + "/camera.yaml"
        self.refused("image_source", [source, "_camera_info:=" + missing], "there is no file " + missing)
        broken = self.write("broken.yaml", "image_width: many\n")
        self.refused("image_source", [source, "_camera_info:=" + broken], "'image_width' holds \"many\"")

    def test_work_cell(self):
        path = rospkg.RosPack().get_path("monocular_eye_hand")
        objects, urdf = "_objects:=%s/config/objects.yaml" % path, "_urdf:=%s/urdf/puma560.urdf" % path
        self.refused("work_cell", [urdf], "objects is not set")
        self.refused("work_cell", [objects], "urdf is not set")
        self.refused("work_cell", [objects, "_urdf:=" + self.image], self.image)
        self.refused("work_cell", [objects, urdf, "_real_time_factor:=-1.0"], "real_time_factor = -1")
        self.refused("work_cell", [objects, urdf, "_camera:=10"], "unknown key 'camera'")
        self.refused("work_cell", [objects, urdf, "_cell/frictoin:=1.0"], "'cell.frictoin'; did you mean 'cell.friction'?")
        self.refused("work_cell", [objects, urdf, "_cell/start_width:=0.5"], "width")
        self.refused("work_cell", [objects, urdf, "_arm/a2:=0.5"], "tool0")


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "refusals", TestRefusals)
