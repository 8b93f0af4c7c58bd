#!/usr/bin/python3
"""The table's height comes from one place: the argument table_height of the launch files, without it the files. Needs no master."""
import subprocess
import sys
import unittest

import yaml


def parameters(launch, *arguments):
    """What a launch file would set on the parameter server."""
    result = subprocess.run(("roslaunch", "--dump-params", "monocular_eye_hand", launch) + arguments,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=120)
    assert result.returncode == 0, result.stdout + result.stderr
    return yaml.safe_load(result.stdout)


def heights(parameters):
    return [parameters[name] for name in ("/recognizer/support/height", "/eye_hand/table_height", "/planner/table/z")]


class TestTableHeight(unittest.TestCase):
    def test_the_nodes_of_the_demo_have_that_of_the_cell(self):
        demo = parameters("demo.launch")
        self.assertEqual(heights(demo), [demo["/work_cell/cell/table/pose/z"]] * 3)

    def test_one_argument_tells_all_nodes(self):
        self.assertEqual(heights(parameters("demo.launch", "table_height:=0.25")), [0.25] * 3)
        self.assertEqual(heights(parameters("demo.launch", "table_height:=0")), [0.0] * 3)

    def test_the_planner_has_it_from_its_file_or_the_argument(self):
        given, file = parameters("planner.launch", "table_height:=0.7"), parameters("planner.launch")
        self.assertEqual(given["/planner/table/z"], 0.7)
        self.assertEqual(file["/planner/table/z"], 0.3)
        del given["/planner/table/z"], file["/planner/table/z"]
        self.assertEqual(given, file)

    def test_eye_hand_has_it_from_its_file_or_the_argument(self):
        given, file = parameters("eye_hand.launch", "table_height:=0.7"), parameters("eye_hand.launch")
        self.assertEqual(given["/eye_hand/table_height"], 0.7)
        del given["/eye_hand/table_height"]
        height = file.pop("/eye_hand/table_height")
        self.assertEqual(given, file)
        self.assertEqual(height, parameters("planner.launch")["/planner/table/z"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
