#!/usr/bin/python3
"""The node eye_hand from its launch file, with parameters that it refuses, and with a clock that is set back."""
import os
import sys
import time
import unittest

import numpy
import rospkg
import rospy
import rostest
from sensor_msgs.msg import CameraInfo

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import eye_hand_scene as scene
import node_process
from set_clock import SetClock
from monocular_eye_hand.msg import LocatedObjectArray, RecognizedObjectArray
from monocular_eye_hand.srv import GraspTargets, GraspTargetsResponse

BRIDGE = scene.transform(scene.rotation(0, 0, 0.3), [0.62, -0.15, 0.3])
GOOD = numpy.diag([1e-4**2] * 3 + [1e-3**2] * 3)  # [m^2, rad^2]
SIM_TIME = "/use_sim_time"


class TestEyeHandStart(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_eye_hand_start")  # before /use_sim_time is set: this program keeps the wall's clock
        cls.package = rospkg.RosPack().get_path("monocular_eye_hand")
        cls.files = ["_objects:=" + cls.package + "/config/objects.yaml", "_urdf:=" + cls.package + "/urdf/puma560.urdf"]

    def publisher(self, topic, kind, latch=False):
        publisher = rospy.Publisher(topic, kind, queue_size=100, latch=latch)
        self.addCleanup(publisher.unregister)
        return publisher

    def listen(self, topic, kind):
        collector = node_process.Collector()
        subscriber = rospy.Subscriber(topic, kind, collector, queue_size=100)
        self.addCleanup(subscriber.unregister)
        return collector, subscriber

    def connected(self, *ends):
        end = time.monotonic() + node_process.START
        while not all(one.get_num_connections() for one in ends):
            self.assertLess(time.monotonic(), end, "not connected")
            time.sleep(0.05)

    def refused(self, arguments, *words):
        with node_process.node("eye_hand", "eye_hand", arguments) as node:
            self.assertEqual(node.exit_code(), 1, node.text())
            for word in words:
                self.assertIn(word, node.text())

    def test_launch(self):
        """The launch file's arguments reach the node; one that was told another name serves under that."""
        with node_process.launch("eye_hand.launch", ["node:=left_eye_hand", "table_height:=0.3"]) as process:
            try:
                rospy.wait_for_service("/left_eye_hand/grasp_targets", node_process.START)
            except rospy.ROSException:
                self.fail(process.text())
            ask = rospy.ServiceProxy("/left_eye_hand/grasp_targets", GraspTargets)
            reply = ask("bridge", -1)
            self.assertEqual(reply.status, GraspTargetsResponse.NOT_READY, reply.text)
            self.assertEqual(rospy.get_param("/left_eye_hand/table_height"), 0.3)
            arrays, listener = self.listen("/left_eye_hand/objects", LocatedObjectArray)
            recognizer = self.publisher("/recognizer/objects", RecognizedObjectArray)
            self.connected(listener, recognizer)
            recognizer.publish(scene.view(rospy.Time(5), []))
            array = arrays.wait()
            self.assertIsNotNone(array, process.text())
            self.assertIn("no camera_info on /camera/camera_info", array.refused)

    def test_parameters(self):
        self.refused(self.files[1:], "objects is not set")
        self.refused(self.files[:1], "urdf is not set")
        self.refused(self.files + ["_tabel:=true"], "unknown key 'tabel'; did you mean 'table'?")
        self.refused(self.files + ["_grasp/sigma:=3.0"], "unknown key 'grasp.sigma'; did you mean 'grasp.sigmas'?")
        self.refused(self.files + ["_map/gate:=-1.0"], "gate = -1")
        self.refused(self.files + ["_wait:=0"], "wait = 0 must be positive")
        self.refused(self.files + ["_joint_names:=[a, b]"], "joint_names")

    def test_files(self):
        self.refused([self.files[0], "_urdf:=/none.urdf"], "/none.urdf")
        self.refused([self.files[1], "_objects:=/none.yaml"], "/none.yaml")
        self.refused(self.files + ["_gripper/opening_max:=0.2"], "gripper.opening_max = 0.2")
        self.refused(self.files + ["_arm/a2:=0.5"], "make the lengths of the URDF and the arm's options equal")

    def test_other_robot_description(self):
        rospy.set_param("/robot_description", "<robot name='other'/>")
        try:
            with node_process.node("eye_hand", "eye_hand", self.files) as node:
                rospy.wait_for_service("/eye_hand/forget", node_process.START)
                self.assertIn("robot_description is not what", node.text())
        finally:
            rospy.delete_param("/robot_description")

    def test_more_views_than_can_wait(self):
        """None is lost without a word."""
        self.publisher("/camera_info", CameraInfo, latch=True).publish(scene.camera_info())
        recognizer = self.publisher("/recognizer/objects", RecognizedObjectArray)
        arrays, listener = self.listen("/eye_hand/objects", LocatedObjectArray)
        with node_process.node("eye_hand", "eye_hand", self.files + ["_wait:=3.0", "_max_waiting:=2"]) as node:
            rospy.wait_for_service("/eye_hand/forget", node_process.START)
            self.connected(recognizer, listener)
            now = rospy.Time.now()
            stamps = [now + rospy.Duration(k) for k in range(6)]
            recognizer.publish(scene.view(stamps[0], []))
            rospy.sleep(0.5)  # the first is taken and waits for tf
            for stamp in stamps[1:]:
                recognizer.publish(scene.view(stamp, []))
            for stamp in stamps:
                array = arrays.wait(lambda message: message.header.stamp == stamp)
                self.assertIsNotNone(array, node.text())
                self.assertNotEqual(array.refused, "")
            refusals = {array.header.stamp: array.refused for array in arrays.messages}
            for stamp in stamps[1:4]:
                self.assertIn("2 newer views came while it waited", refusals[stamp])
            for stamp in stamps[:1] + stamps[4:]:
                self.assertIn("no transform", refusals[stamp])

    def test_clock_set_back(self):
        """A bag that plays again: what was known is forgotten, and the views of the second time are used."""
        rospy.set_param(SIM_TIME, True)
        clock = SetClock(1000)
        arm = scene.Arm(clock.now)
        self.publisher("/camera_info", CameraInfo, latch=True).publish(scene.camera_info())
        recognizer = self.publisher("/recognizer/objects", RecognizedObjectArray)
        arrays, listener = self.listen("/eye_hand/objects", LocatedObjectArray)
        aside = scene.transform(numpy.eye(3), [0, 0.2, 0]) @ BRIDGE

        def see(named):
            stamp = arm.stamp()
            recognizer.publish(scene.view(stamp, [scene.recognized(*one, arm.joints, GOOD) for one in named]))
            array = arrays.wait(lambda message: message.header.stamp == stamp)
            self.assertIsNotNone(array, node.text())
            self.assertEqual(array.refused, "")
            return [(one.name, one.instance) for one in array.objects]
        try:
            with node_process.node("eye_hand", "eye_hand", self.files + ["_wait:=10.0"]) as node:
                rospy.wait_for_service("/eye_hand/forget", node_process.START)
                self.connected(recognizer, listener)
                arm.hang_camera()
                rospy.sleep(0.5)
                self.assertEqual(see([("bridge", BRIDGE), ("bridge", aside)]), [("bridge", 0), ("bridge", 1)])
                clock.set(10)
                rospy.sleep(0.5)
                self.assertEqual(see([("bridge", aside)]), [("bridge", 0)])
        finally:
            clock.close()
            arm.timer.shutdown()
            rospy.delete_param(SIM_TIME)


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "eye_hand_start", TestEyeHandStart)
