#!/usr/bin/python3
"""image.launch and bag.launch from end to end, on files that this test writes."""
import os
import shutil
import sys
import tempfile
import unittest

import rospkg
import rospy
import rostest
from monocular_eye_hand.msg import RecognizedObjectArray
from rosgraph_msgs.msg import Clock
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import cube_scene
import node_process
import scene_files

BAG_START = 1600000000.0  # in the past: works only with the bag's clock


class TestLaunch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_launch")

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        config = os.path.join(rospkg.RosPack().get_path("monocular_eye_hand"), "config")
        self.objects = "objects:=" + os.path.join(config, "cube.yaml")
        self.arrays, self.frames, self.clock = (node_process.Collector() for _ in range(3))
        self.subscribers = [
            rospy.Subscriber("/recognizer/objects", RecognizedObjectArray, self.arrays, queue_size=100),
            rospy.Subscriber("/tf", TFMessage, self.frames, queue_size=100),
            rospy.Subscriber("/clock", Clock, self.clock, queue_size=100)]

    def tearDown(self):
        for subscriber in self.subscribers:
            subscriber.unregister()
        shutil.rmtree(self.folder)

    def expect_cube(self, process):
        array = self.arrays.wait(lambda message: message.objects)
        self.assertIsNotNone(array, process.text())
        cube = array.objects[0]
        self.assertEqual((cube.name, cube.instance), ("cube", 0))
        self.assertLess(cube_scene.distance_to_truth(cube.pose.pose), 0.006)
        frame = self.frames.wait(lambda message: message.transforms[0].child_frame_id == "cube_0")
        self.assertIsNotNone(frame, process.text())
        return array

    def test_image(self):
        scene_files.write_cube_files(self.folder)
        with node_process.launch("image.launch", [
                "source:=" + self.folder + "/cube.pgm", "camera_info:=" + self.folder + "/camera.yaml", self.objects,
                "camera_frame:=left_optical", "rate:=5"]) as process:
            array = self.expect_cube(process)
            self.assertEqual(array.header.frame_id, "left_optical")

    def test_bag(self):
        bag = self.folder + "/cube.bag"
        scene_files.write_cube_bag(bag, BAG_START, 5, 0.5)
        with node_process.launch("bag.launch", ["bag:=" + bag, self.objects]) as process:
            array = self.expect_cube(process)
            self.assertEqual(array.header.frame_id, cube_scene.FRAME)
            # The first image is not lost: playing waits for the node.
            self.assertEqual(self.arrays.messages[0].header.stamp.to_sec(), BAG_START)
            self.assertTrue(rospy.get_param("/use_sim_time"))
            clock = self.clock.wait()
            self.assertIsNotNone(clock)
            self.assertLess(abs(clock.clock.to_sec() - BAG_START), 10)


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "launch", TestLaunch)
