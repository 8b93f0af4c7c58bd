#!/usr/bin/python3
"""The node planner in real time, with an arm that this test plays: a driver that is silent, and one whose joints come in
several messages of several publishers."""
import os
import sys
import threading
import time
import unittest

import actionlib
import rospkg
import rospy
import rostest
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import node_process
from eye_hand_scene import JOINTS
from monocular_eye_hand.msg import GripperState, MoveAction, MoveGoal, MoveResult
from test_planner import READY, Goal

PACKAGE = rospkg.RosPack().get_path("monocular_eye_hand")


class PlayedArm:
    """Follows the last trajectory exactly. joint1 to joint5 come in two messages, joint6 from a publisher of its own."""

    def __init__(self):
        self.joints, self.speaks = list(READY), True
        self.lock = threading.Lock()
        self.path, self.begin = [], None
        self.stops = 0
        self.publisher = rospy.Publisher("/joint_states", JointState, queue_size=100)
        self.joint6 = node_process.Process([
            "rostopic", "pub", "-s", "-r", "50", "/joint_states", "sensor_msgs/JointState",
            "{header: {stamp: now}, name: [joint6], position: [0.0], velocity: [0.0]}"])
        self.gripper = rospy.Publisher("/gripper/state", GripperState, queue_size=100)
        self.subscriber = rospy.Subscriber("/arm_controller/command", JointTrajectory, self.command, queue_size=10)
        self.timer = rospy.Timer(rospy.Duration(0.02), lambda _: self.tick())

    def command(self, message):
        with self.lock:
            self.stops += not message.points
            self.path, self.begin = message.points, rospy.Time.now()

    def tick(self):
        with self.lock:
            now = rospy.Time.now()
            for point in self.path:
                if now >= self.begin + point.time_from_start:
                    self.joints = list(point.positions)
            if not self.speaks:
                return
            for part in (slice(0, 3), slice(3, 5)):
                message = JointState(name=JOINTS[part], position=self.joints[part], velocity=[0.0] * len(JOINTS[part]))
                message.header.stamp = now
                self.publisher.publish(message)
            state = GripperState(width=0.06)
            state.header.stamp = now
            self.gripper.publish(state)


class TestPlannerRealTime(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_planner_real_time")
        cls.arm = PlayedArm()
        cls.planner = node_process.node("planner", "planner", [
            "_objects:=" + PACKAGE + "/config/cube.yaml", "_urdf:=" + PACKAGE + "/urdf/puma560.urdf",
            "_execution/follow/deviation:=0.5"])  # this arm steps from point to point
        cls.move = actionlib.SimpleActionClient("/planner/move", MoveAction)
        assert cls.move.wait_for_server(rospy.Duration(node_process.START)), cls.planner.text()

    @classmethod
    def tearDownClass(cls):
        cls.planner.stop()
        cls.arm.joint6.stop()
        cls.arm.timer.shutdown()

    def go(self, angle):
        goal = MoveGoal(joints=[angle] + READY[1:])
        return Goal(self.move, goal)

    def arrive(self, angle):
        """Goes there as soon as all joints are told."""
        end = time.monotonic() + node_process.START
        result = self.go(angle).result()
        while result.outcome == MoveResult.FAULT and ("no joint_states yet" in result.reason or "silent" in result.reason):
            self.assertLess(time.monotonic(), end, self.planner.text())
            result = self.go(angle).result()
        self.assertEqual(result.outcome, MoveResult.DONE, result.reason)

    def test_1_joints_of_two_publishers(self):
        self.arrive(0.3)
        self.assertAlmostEqual(self.arm.joints[0], 0.3, places=6)

    def test_2_a_driver_that_is_late_by_seconds(self):
        """In real time silence is one: the arm is told to stop, and the result says so."""
        goal = self.go(1.2)
        end = time.monotonic() + node_process.START
        while self.arm.joints[0] < 0.4:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.005)
        stops = self.arm.stops
        self.arm.speaks = False
        result = goal.result()
        self.arm.speaks = True
        self.assertEqual(result.outcome, MoveResult.FAULT)
        self.assertIn("joint_states is silent", result.reason)
        self.assertEqual(self.arm.stops, stops + 1)
        self.arrive(0)


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "planner_real_time", TestPlannerRealTime)
