#!/usr/bin/python3
"""The node image_source on files that this test writes."""
import os
import shutil
import sys
import tempfile
import unittest

import numpy
import rospy
import rostest
from sensor_msgs.msg import CameraInfo, Image
from sensor_msgs.srv import SetCameraInfo

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import cube_scene
import node_process
import scene_files


class TestImageSource(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_image_source")

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        for i, grey in enumerate((10, 60, 110, 160)):
            scene_files.write_pgm(self.path("img%d.pgm" % (i + 9)), numpy.full((48, 64), grey, numpy.uint8))
        scene_files.write_camera_yaml(self.path("camera.yaml"), 64, 48, 70.0, 31.5, 23.5)
        self.images, self.infos = node_process.Collector(), node_process.Collector()
        self.subscribers = []

    def tearDown(self):
        for subscriber in self.subscribers:
            subscriber.unregister()
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def listen(self):
        self.subscribers = [rospy.Subscriber("camera_info", CameraInfo, self.infos, queue_size=100),
                            rospy.Subscriber("image_raw", Image, self.images, queue_size=100)]

    def source(self, *arguments):
        return node_process.node("image_source", "image_source", arguments)

    def greys(self):
        return [image.data[0] for image in self.images.messages]

    def test_every_image_once_and_its_calibration(self):
        # The node starts first and must wait: nothing is lost.
        with self.source("_source:=" + self.folder, "_camera_info:=" + self.path("camera.yaml"), "_rate:=20.0",
                         "_loop:=false", "_frame_id:=left_optical") as source:
            rospy.wait_for_service("set_camera_info", node_process.START)
            self.listen()
            self.assertTrue(self.images.wait_count(4), source.text())
            self.assertTrue(self.infos.wait_count(4), source.text())
            self.assertTrue(source.running())
        self.assertEqual(self.greys(), [10, 60, 110, 160])
        for image, info in zip(self.images.messages, self.infos.messages):
            self.assertEqual(image.header.stamp, info.header.stamp)
            self.assertEqual(image.header.frame_id, "left_optical")
            self.assertEqual(info.header.frame_id, "left_optical")
            self.assertEqual((image.encoding, image.width, image.height), ("mono8", 64, 48))
            self.assertEqual((info.width, info.height), (64, 48))
            self.assertEqual((info.K[0], info.K[2], info.K[5]), (70.0, 31.5, 23.5))

    def test_pattern_and_loop(self):
        self.listen()
        with self.source("_source:=" + self.path("img%02d.pgm"), "_camera_info:=" + self.path("camera.yaml"),
                         "_rate:=20.0") as source:  # 10, 11, 12: two digits
            self.assertTrue(self.images.wait_count(7), source.text())
        self.assertEqual(self.greys()[:7], [60, 110, 160, 60, 110, 160, 60])

    def test_colour(self):
        self.listen()
        with self.source("_source:=" + self.path("img9.pgm"), "_camera_info:=" + self.path("camera.yaml"),
                         "_colour:=true") as source:
            self.assertTrue(self.images.wait_count(1), source.text())
        self.assertEqual(self.images.messages[0].encoding, "bgr8")
        self.assertEqual(self.images.messages[0].step, 3 * 64)

    def test_set_camera_info(self):
        self.listen()
        with self.source("_source:=" + self.folder, "_camera_info:=" + self.path("camera.yaml"), "_rate:=20.0") as source:
            self.assertTrue(self.infos.wait_count(1), source.text())
            info = self.infos.messages[0]
            info.K = [80.0, 0, 31.5, 0, 80.0, 23.5, 0, 0, 1]
            reply = rospy.ServiceProxy("set_camera_info", SetCameraInfo)(info)
            self.assertTrue(reply.success, reply.status_message)
            self.assertIsNotNone(self.infos.wait(lambda message: message.K[0] == 80.0), source.text())
        with open(self.path("camera.yaml")) as file:
            self.assertIn("80", file.read())

    def test_other_size_than_the_calibration(self):
        scene_files.write_pgm(self.path("img10.pgm"), numpy.zeros((24, 32), numpy.uint8))
        self.listen()
        with self.source("_source:=" + self.folder, "_camera_info:=" + self.path("camera.yaml"), "_rate:=20.0") as source:
            self.assertEqual(source.exit_code(), 1, source.text())
            self.assertIn("img10.pgm is 32x24 but the calibration", source.text())
            self.assertIn("is for 64x48", source.text())


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "image_source", TestImageSource)
