#!/usr/bin/python3
"""The rviz configurations show what the nodes publish: topics, display types, the launch files' frames."""
import os
import re
import struct
import sys
import unittest
import xml.etree.ElementTree

import yaml

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))


def read(*path):
    with open(os.path.join(ROOT, *path)) as file:
        return file.read()


class Config(unittest.TestCase):
    def load(self, name):
        self.file = name
        self.config = yaml.safe_load(read("rviz", name))["Visualization Manager"]
        self.displays = {display["Class"]: display for display in self.config["Displays"]}
        self.names = dict(re.findall(r'constexpr char k(\w+)\[\] = "(\w+)"', read("src", "nodes", "common", "names.h")))

    def check_window(self):
        """The overlay is readable at once: its panel is the larger part of the left side, and not hidden."""
        with open(os.path.join(ROOT, "rviz", self.file)) as file:
            window = yaml.safe_load(file)["Window Geometry"]
        self.assertFalse(window["Overlay"]["collapsed"] or window["Hide Left Dock"])
        state = bytes.fromhex(window["QMainWindow State"])
        size = lambda dock: struct.unpack_from(">i", state, state.index(dock.encode("utf-16-be")) + 2 * len(dock) + 5)[0]
        self.assertGreater(size("Overlay"), 2 * size("Displays"))

    def check_classes(self):
        description = "/usr/share/rviz/plugin_description.xml"
        if not os.path.exists(description):
            self.skipTest("rviz's plugin description is not at " + description)
        known = {node.get("name") for node in xml.etree.ElementTree.parse(description).iter("class")}
        used = set(self.displays) | {tool["Class"] for tool in self.config["Tools"]}
        used.add(self.config["Views"]["Current"]["Class"])
        self.assertEqual(used - known, set())


class TestRvizConfig(Config):
    def setUp(self):
        self.load("recognize.rviz")

    def test_shows_overlay_view_and_meshes(self):
        """The objects' axes come with their markers; tf's would stay when an object is gone."""
        self.assertEqual(self.displays["rviz/Image"]["Image Topic"], "/recognizer/" + self.names["Overlay"])
        self.assertEqual(self.displays["rviz/MarkerArray"]["Marker Topic"], "/recognizer/" + self.names["Markers"])
        self.assertEqual(self.displays["rviz/Marker"]["Marker Topic"], "/recognizer/" + self.names["View"])
        for kind in ("rviz/Image", "rviz/MarkerArray", "rviz/Marker"):
            self.assertTrue(self.displays[kind]["Enabled"], kind)
        self.assertIn("rviz/TF", self.displays)

    def test_every_class_is_one_of_rviz(self):
        self.check_classes()

    def test_overlay_is_large(self):
        self.check_window()

    def test_launch_file_names_the_frame_and_topics(self):
        launch = xml.etree.ElementTree.fromstring(read("launch", "rviz.launch"))
        rviz = next(node for node in launch.iter("node") if node.get("pkg") == "rviz")
        self.assertIn("recognize.rviz -f $(arg node)_view", rviz.get("args"))
        view = next(node for node in launch.iter("node") if node.get("type") == "camera_view")
        frames = {param.get("name"): param.get("value") for param in view.iter("param")}
        self.assertEqual(frames["view_frame"], "$(arg node)_view")
        self.assertEqual(self.config["Global Options"]["Fixed Frame"], "recognizer_view")
        remapped = {remap.get("from") for remap in rviz.iter("remap")}
        self.assertIn(self.displays["rviz/Image"]["Image Topic"], remapped)
        for kind in ("rviz/MarkerArray", "rviz/Marker"):
            self.assertIn(self.displays[kind]["Marker Topic"], remapped)


class TestDemoConfig(Config):
    def setUp(self):
        self.load("demo.rviz")

    def test_every_class_is_one_of_rviz(self):
        self.check_classes()

    def test_overlay_is_large(self):
        self.check_window()

    def test_shows_arm_overlay_frames_grasps_and_path(self):
        self.assertEqual(self.displays["rviz/RobotModel"]["Robot Description"], "robot_description")
        self.assertEqual(self.displays["rviz/Image"]["Image Topic"], "/recognizer/" + self.names["Overlay"])
        self.assertIn("rviz/TF", self.displays)
        shown = {d["Marker Topic"]: d["Class"] for d in self.config["Displays"] if "Marker Topic" in d}
        for node, name, file in (("recognizer", "Markers", "outputs.cpp"), ("eye_hand", "Markers", "outputs.cpp"),
                                 ("recognizer", "View", "outputs.cpp"), ("planner", "Path", "node.cpp"),
                                 ("planner", "Cell", "node.cpp")):
            kind = re.search(r"advertise<visualization_msgs::(\w+)>\(names::k%s," % name, read("src", "nodes", node, file)).group(1)
            self.assertEqual(shown["/%s/%s" % (node, self.names[name])], "rviz/" + kind)

    def test_frames_and_topics_are_those_of_the_launch_file(self):
        names = read("src", "nodes", "common", "names.h")
        frame = self.config["Global Options"]["Fixed Frame"]
        self.assertIn('kBaseFrame[] = "%s"' % frame, names)
        launch = xml.etree.ElementTree.fromstring(read("launch", "demo.launch"))
        rviz = next(node for node in launch.iter("node") if node.get("pkg") == "rviz")
        self.assertIn("demo.rviz", rviz.get("args"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
