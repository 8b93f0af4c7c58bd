#!/usr/bin/python3
"""The way from an own CAD file to a pose in the node: the commands of README.md as they stand there, and `ask`."""
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

import rospkg
import rostest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import node_process
import scene_files

PACKAGE = rospkg.RosPack().get_path("monocular_eye_hand")
LONG = 200  # for one command [s]; generous: the machine may be busy


def commands():
    """The lines of README's block of commands for one's own parts."""
    with open(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "README.md")) as file:
        section = file.read().partition("## Your own parts")[2]
    return re.search(r"```bash\n(.*?)```", section, re.DOTALL).group(1).splitlines()


def write_stl(ply, stl):
    """A binary STL of an ascii PLY of triangles."""
    with open(ply) as file:
        header, _, body = file.read().partition("end_header\n")
    count = int(re.search(r"element vertex (\d+)", header).group(1))
    lines = body.splitlines()
    vertices = [tuple(map(float, line.split()[:3])) for line in lines[:count]]
    faces = [tuple(map(int, line.split()[1:4])) for line in lines[count:] if line.strip()]
    with open(stl, "wb") as file:
        file.write(b"part".ljust(80) + struct.pack("<I", len(faces)))
        for face in faces:
            file.write(struct.pack("<12fH", 0, 0, 0, *(x for vertex in face for x in vertices[vertex]), 0))


class TestNewcomer(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.environment = dict(os.environ, XDG_CACHE_HOME=self.folder + "/cache", PWD=self.folder)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def run_line(self, command):
        return subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=LONG)

    def start(self, command):
        return node_process.Process(["bash", "-c", "cd %s && exec %s" % (self.folder, command)])

    def walk(self):
        lines = commands()
        self.assertEqual(len(lines), 5)
        # As in a shell of one's own: no master runs before roslaunch starts one.
        script = ["export ROS_MASTER_URI=http://127.0.0.1:%d" % node_process.free_port(), "cd " + self.folder, "set -e"]
        script += lines[:4] + ["set +e", lines[4], "code=$?", "kill $!", "wait $!", "exit $code"]
        with node_process.Process(["bash", "-c", "\n".join(script)]) as process:
            self.assertEqual(process.exit_code(LONG), 0, process.text())
            self.assertIn("in the frame camera", process.text())
            self.assertRegex(process.text(), r"part_0 +[01][.][0-9]{2} ")
            return process.text()

    def test_readme_with_a_bracket(self):
        write_stl(PACKAGE + "/models/bracket.ply", self.folder + "/part.stl")
        self.walk()

    def test_readme_with_a_flange(self):
        write_stl(PACKAGE + "/models/flange.ply", self.folder + "/part.stl")
        self.assertRegex(self.walk(), r"part_0 .* mm, free about its axis")

    def test_ask(self):
        scene_files.write_cube_files(self.folder)
        shutil.copy(PACKAGE + "/models/cube.stl", self.folder)
        with open(self.folder + "/own.yaml", "w") as file:
            file.write("objects:\n  - {name: cube, mesh: cube.stl, unit: mm}\n")
        ask = "rosrun monocular_eye_hand ask "
        with self.start("roslaunch monocular_eye_hand image.launch source:=cube.pgm camera_info:=camera.yaml "
                        "objects:=own.yaml") as process:
            for name in ("", "cube"):
                answer = self.run_line(ask + name)
                self.assertEqual(answer.returncode, 0, answer.stdout + process.text())
                lines = [line for line in answer.stdout.splitlines() if not line.startswith("ask: waiting")]
                self.assertEqual(len(lines), 3, answer.stdout)
                self.assertRegex(lines[2], r"^cube_0 +[01][.][0-9]{2} .*[0-9.]+ mm, [0-9.]+ deg$")
                x, y, z = (float(v) for v in re.search(r"(-?[\d.]+), (-?[\d.]+), (-?[\d.]+)  ", lines[2]).groups())
                self.assertLess(abs(x) + abs(y), 300)
                self.assertTrue(200 < z < 700, answer.stdout)
            answer = self.run_line(ask + "cub")
            self.assertEqual(answer.returncode, 1, answer.stdout)
            self.assertIn("known: cube", answer.stdout)
        answer = self.run_line(ask + "--wait 0 --node nobody cube")
        self.assertEqual(answer.returncode, 2, answer.stdout)
        self.assertIn("nobody offers /nobody/recognize", answer.stdout)
        answer = self.run_line("ROS_MASTER_URI=http://127.0.0.1:9 " + ask + "--wait 2")
        self.assertEqual(answer.returncode, 2, answer.stdout)
        self.assertIn("ask: waiting for a ROS master at http://127.0.0.1:9: start a launch file", answer.stdout)
        self.assertIn("ask: no ROS master", answer.stdout)

    def test_a_path_that_is_nowhere(self):
        scene_files.write_cube_files(self.folder)
        for argument in ("objects:=none.yaml", "source:=none.png"):
            others = [other for other in ("source:=cube.pgm", "camera_info:=camera.yaml")
                      if other.split(":=")[0] not in argument]
            with self.start("roslaunch monocular_eye_hand image.launch " + " ".join([argument] + others)) as process:
                self.assertIsNotNone(process.exit_code(), process.text())  # the launch ends
                name, path = argument.split(":=")
                self.assertIn("%s: there is no %s in " % (name, path), process.text())
                self.assertIn("%s:=$PWD/%s" % (name, path), process.text())


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "newcomer", TestNewcomer)
