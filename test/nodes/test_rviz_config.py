#!/usr/bin/python3
"""The rviz configuration shows what the node publishes: topics, display types, the launch file's frame."""
import os
import re
import sys
import unittest
import xml.etree.ElementTree

import yaml

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))


def read(*path):
    with open(os.path.join(ROOT, *path)) as file:
        return file.read()


class TestRvizConfig(unittest.TestCase):
    def setUp(self):
        self.config = yaml.safe_load(read("rviz", "recognize.rviz"))["Visualization Manager"]
        self.displays = {display["Class"]: display for display in self.config["Displays"]}
        self.names = dict(re.findall(r'constexpr char k(\w+)\[\] = "(\w+)"', read("src", "nodes", "names.h")))

    def test_shows_overlay_frames_and_meshes(self):
        self.assertEqual(self.displays["rviz/Image"]["Image Topic"], "/recognizer/" + self.names["Overlay"])
        self.assertEqual(self.displays["rviz/MarkerArray"]["Marker Topic"], "/recognizer/" + self.names["Markers"])
        for kind in ("rviz/Image", "rviz/MarkerArray", "rviz/TF"):
            self.assertTrue(self.displays[kind]["Enabled"], kind)

    def test_every_class_is_one_of_rviz(self):
        description = "/usr/share/rviz/plugin_description.xml"
        if not os.path.exists(description):
            self.skipTest("rviz's plugin description is not at " + description)
        known = {node.get("name") for node in xml.etree.ElementTree.parse(description).iter("class")}
        used = set(self.displays) | {tool["Class"] for tool in self.config["Tools"]}
        used.add(self.config["Views"]["Current"]["Class"])
        self.assertEqual(used - known, set())

    def test_launch_file_names_the_frame_and_topics(self):
        launch = xml.etree.ElementTree.fromstring(read("launch", "rviz.launch"))
        rviz = next(node for node in launch.iter("node") if node.get("pkg") == "rviz")
        self.assertIn("recognize.rviz -f $(arg camera_frame)_view", rviz.get("args"))
        remapped = {remap.get("from") for remap in rviz.iter("remap")}
        self.assertIn(self.displays["rviz/Image"]["Image Topic"], remapped)
        self.assertIn(self.displays["rviz/MarkerArray"]["Marker Topic"], remapped)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
