#!/usr/bin/python3
"""What people type first: --help of every node and script, --ros-args of every launch file. Needs no master."""
import glob
import os
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
NODES = ("recognizer", "eye_hand", "planner", "task", "work_cell", "image_source", "camera_view")
REQUIRED = {"image.launch": {"source", "camera_info"}, "bag.launch": {"bag"}}  # nothing else
ENDS_ALL = {"image.launch", "bag.launch"}  # files, no robot: a node that dies ends the launch by default


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120)


def topics(node):
    """The names in the tables of docs/nodes.md that tell what a node subscribes to and publishes."""
    with open(ROOT + "/docs/nodes.md") as file:
        section = ("\n" + file.read()).partition("\n## %s\n" % node)[2].partition("\n## ")[0]
    tables = re.findall(r"### (?:Subscribed|Published)\n(.*?)(?=\n###|\Z)", section, re.DOTALL)
    cells = re.findall(r"^\|([^|]*)\|", "\n".join(tables), re.MULTILINE)
    return re.findall("`([^`]+)`", " ".join(cells))


class TestCommandLines(unittest.TestCase):
    def test_help_of_nodes(self):
        for node in NODES:
            result = run("rosrun", "monocular_eye_hand", node, "--help")
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertIn("Node " + node + ": ", result.stdout)
            self.assertIn("Parameters and their defaults", result.stdout)
            self.assertIn(".launch", result.stdout)

    def test_help_of_nodes_names_the_topics_of_the_documentation(self):
        for node in NODES:
            told = run("rosrun", "monocular_eye_hand", node, "--help").stdout.partition("Parameters and")[0]
            for name in topics(node):
                self.assertIn(name, told, node)

    def test_arguments_that_are_none(self):
        for argument in ("objects.yaml", "--objects"):
            result = run("rosrun", "monocular_eye_hand", "recognizer", argument)
            self.assertEqual(result.returncode, 1, result.stdout)
            self.assertIn("'%s' is no argument of a node" % argument, result.stdout)

    def test_help_of_scripts(self):
        for script in ("ask", "play_bag", "clear_frame.py"):
            result = run("rosrun", "monocular_eye_hand", script, "--help")
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertIn("usage: " + script, result.stdout)

    def test_required_arguments_of_launch_files(self):
        for path in sorted(glob.glob(ROOT + "/launch/*.launch")):
            name = os.path.basename(path)
            result = run("roslaunch", "--ros-args", path)
            self.assertEqual(result.returncode, 0, result.stdout)
            required = result.stdout.partition("Optional Arguments:")[0].splitlines()
            names = {line.split(":")[0].strip() for line in required if line.startswith("  ")}
            self.assertEqual(names, REQUIRED.get(name, set()), name)
            self.assertNotIn("undocumented", result.stdout, name)

    def test_what_a_dead_node_ends_is_an_argument(self):
        for path in glob.glob(ROOT + "/launch/*.launch"):
            name, tree = os.path.basename(path), xml.etree.ElementTree.parse(path)
            for node in tree.iter("node"):
                if node.get("pkg") == "monocular_eye_hand" and node.get("type") not in ("play_bag", "camera_view"):
                    self.assertEqual(node.get("required"), "$(arg required)", name)
            defaults = {arg.get("name"): arg.get("default") for arg in tree.iter("arg")}
            if "required" in defaults and defaults["required"] is not None:
                self.assertEqual(defaults["required"], str(name in ENDS_ALL).lower(), name)
            if name == "recognize.launch":
                self.assertEqual(defaults["respawn"], "true")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
