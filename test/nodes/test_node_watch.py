#!/usr/bin/python3
"""What every node lives by: a clock that does not come, one that stands, a master that was restarted."""
import os
import sys
import tempfile
import time
import unittest

import rosgraph
import rospkg
import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import node_process
from scene_files import write_cube_files
from set_clock import SetClock

PACKAGE = rospkg.RosPack().get_path("monocular_eye_hand")
OBJECTS, URDF = "_objects:=" + PACKAGE + "/config/cube.yaml", "_urdf:=" + PACKAGE + "/urdf/puma560.urdf"
SIM_TIME = "/use_sim_time"


class Master:
    """A master of its own for some nodes, which can be restarted."""

    def __init__(self):
        self.port = node_process.free_port()
        self.uri = "http://127.0.0.1:%d" % self.port
        self.start()

    def start(self):
        self.process = node_process.Process(["rosmaster", "--core", "-p", str(self.port)])
        end = time.monotonic() + node_process.START
        while time.monotonic() < end:
            try:
                rosgraph.Master("/test", self.uri).getPid()
                return
            except OSError:
                time.sleep(0.05)
        raise RuntimeError("no master: " + self.process.text())

    def knows(self, name):
        try:
            rosgraph.Master("/test", self.uri).lookupNode(name)
            return True
        except rosgraph.MasterError:
            return False


class TestNodeWatch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_node_watch")  # before use_sim_time is set: this test lives in real time
        cls.folder = tempfile.TemporaryDirectory()
        write_cube_files(cls.folder.name)
        cache = "_cache:=" + cls.folder.name
        cls.arguments = {
            "recognizer": [OBJECTS, cache], "eye_hand": [OBJECTS, URDF], "planner": [OBJECTS, URDF],
            "task": [OBJECTS, URDF, cache],
            "image_source": ["_source:=" + cls.folder.name + "/cube.pgm", "_wait_for_subscriber:=false"]}

    def nodes(self):
        nodes = {name: node_process.node(name, name, arguments) for name, arguments in self.arguments.items()}
        for node in nodes.values():
            self.addCleanup(node.stop)
        return nodes

    def wait_for(self, node, text):
        end = time.monotonic() + node_process.START
        while text not in node.text():
            self.assertLess(time.monotonic(), end, "not said: %s; but:\n%s" % (text, node.text()))
            self.assertTrue(node.running(), node.text())
            time.sleep(0.1)

    def test_no_clock(self):
        """use_sim_time without a clock is said once, by every node."""
        rospy.set_param(SIM_TIME, True)
        self.addCleanup(rospy.delete_param, SIM_TIME)
        nodes = self.nodes()
        for node in nodes.values():
            self.wait_for(node, "use_sim_time is set and nothing came on /clock")
        time.sleep(3)
        for name, node in nodes.items():
            self.assertEqual(node.text().count("nothing came on /clock"), 1, name)

    def test_clock_that_stands(self):
        rospy.set_param(SIM_TIME, True)
        self.addCleanup(rospy.delete_param, SIM_TIME)
        clock = SetClock(100)
        self.addCleanup(clock.close)
        node = node_process.node("planner", "planner", self.arguments["planner"])
        self.addCleanup(node.stop)
        self.wait_for(node, "ready")
        self.assertNotIn("the clock stands", node.text())
        clock.hold()
        self.wait_for(node, "the clock stands at 1")
        clock.set(200)
        self.wait_for(node, "the clock goes on")
        self.assertEqual(node.text().count("the clock stands"), 1)

    def test_master_restarted(self):
        """A node that nobody finds any more says so and ends, the planner too."""
        master = Master()
        own, os.environ["ROS_MASTER_URI"] = os.environ["ROS_MASTER_URI"], master.uri
        try:
            nodes = {name: node_process.node(name, name, self.arguments[name]) for name in ("image_source", "planner")}
        finally:
            os.environ["ROS_MASTER_URI"] = own
        for name, node in nodes.items():
            self.addCleanup(node.stop)
            end = time.monotonic() + node_process.START
            while not master.knows("/" + name):
                self.assertLess(time.monotonic(), end, node.text())
                time.sleep(0.1)
        time.sleep(3)  # it has seen that the master knows it
        master.process.stop()
        time.sleep(0.5)
        master.start()
        self.addCleanup(master.process.stop)
        for name, node in nodes.items():
            self.assertIsNotNone(node.exit_code(), name + " goes on: " + node.text())
            self.assertIn("was restarted and does not know this node", node.text())


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "node_watch", TestNodeWatch)
