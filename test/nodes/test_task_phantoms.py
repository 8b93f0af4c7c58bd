#!/usr/bin/python3
"""The whole robot with what is not there: every view of the recogniser shows phantoms below the table, too, and the first one
a part on it. The frame is cleared all the same, and nothing of that is left over."""
import collections
import os
import sys
import unittest

import numpy
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from sensor_msgs.msg import JointState

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import eye_hand_scene as scene
import node_process
import task_process
from monocular_eye_hand.msg import ClearedObject, ClearFrameResult, LocatedObjectArray, RecognizedObjectArray
from monocular_eye_hand.srv import Recognize

TABLE, MIDDLE = 0.3, (0.55, 0.0)  # of the cell [m]
SURE = numpy.diag([5e-4**2] * 3 + [4e-3**2] * 3)  # as of a recogniser [m^2, rad^2]


def at(x, y, z, yaw=0.0):
    return scene.transform(scene.rotation(0, 0, yaw), [MIDDLE[0] + x, MIDDLE[1] + y, TABLE + z])


class Phantoms:
    """Stands between the recogniser, which is called eyes here, and those who listen to it; adds what is not there."""

    def __init__(self):
        self.states = collections.deque(maxlen=5000)
        self.always = [("bridge", at(0.02, 0.02, -0.010)), ("bracket", at(-0.03, 0, -0.040)),
                       ("grenade", at(0.05, -0.05, -0.2, 1.0))]
        self.once = [("flange", at(0.05, -0.04, 0.0))]
        self.planted = self.ruled_out = 0
        self.publisher = rospy.Publisher("/recognizer/objects", RecognizedObjectArray, queue_size=100)
        self.eyes = rospy.ServiceProxy("/eyes/recognize", Recognize)
        self.service = rospy.Service("/recognizer/recognize", Recognize, lambda request: self.eyes(request.name))
        self.subscribers = [
            rospy.Subscriber("/joint_states", JointState, self.states.append, queue_size=1000),
            rospy.Subscriber("/eyes/objects", RecognizedObjectArray, self.plant, queue_size=100),
            rospy.Subscriber("/eye_hand/objects", LocatedObjectArray, self.count, queue_size=100)]

    def plant(self, message):
        stamp = message.header.stamp
        nearest = min(list(self.states), key=lambda state: abs((state.header.stamp - stamp).to_sec()))
        for name, pose in self.always + (self.once if self.planted == 0 else []):
            phantom = scene.recognized(name, pose, nearest.position[:6], SURE)
            phantom.header = message.header
            message.objects.append(phantom)
        self.planted += 1
        self.publisher.publish(message)

    def count(self, message):
        self.ruled_out += len(message.ruled_out)


class TestTaskPhantoms(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_task_phantoms")  # before use_sim_time is set: this test lives in real time
        cls.files = task_process.Files()
        frame, bridge, _, grenade = cls.files.content("cell.yaml")["objects"]
        cell = cls.files.changed("cell.yaml", objects=[frame, bridge, grenade])
        cls.addClassCleanup(task_process.forget_clock)
        cls.witness = task_process.Witness()
        cls.addClassCleanup(cls.witness.close)
        cls.goals = task_process.Goals()
        cls.phantoms = Phantoms()
        cls.processes = []
        cls.start("work_cell", "cell:=" + cell, "real_time_factor:=0")
        if cls.witness.joint_state() is None:
            raise RuntimeError("the cell does not start: " + cls.text())
        cls.start("recognize", "camera:=camera", "continuous:=false", "on_request:=true", "node:=eyes")
        cls.start("eye_hand", "table_height:=0.3")
        cls.start("planner")
        cls.start("task")
        rospy.wait_for_service("/eyes/recognize", node_process.START)
        if not cls.goals.ready():
            raise RuntimeError("the task does not start: " + cls.text())

    @classmethod
    def start(cls, file, *arguments):
        cls.processes.append(node_process.launch(file + ".launch", arguments))
        cls.addClassCleanup(cls.processes[-1].stop)

    @classmethod
    def text(cls):
        return "\n".join(process.text()[-2000:] for process in cls.processes)

    def test_phantoms_are_not_left_over(self):
        self.goals.send()
        state, result = self.goals.result()
        said = self.goals.said()
        self.assertEqual((state, result.outcome), (GoalStatus.SUCCEEDED, ClearFrameResult.CLEARED), said)
        self.assertGreater(self.phantoms.planted, 5)
        self.assertGreaterEqual(self.phantoms.ruled_out, 3)
        truth = self.witness.truth()
        self.assertEqual([o.label for o in truth.objects if o.name != "frame" and not o.in_drop_zone], [], said)
        self.assertEqual(truth.collisions, 0, said)
        told = {}
        for one in result.objects:
            told.setdefault(one.object.name, []).append(one.outcome)
            self.assertGreater(one.object.pose.pose.position.z, TABLE - 0.008, said)
        self.assertNotIn("bracket", told)
        self.assertEqual(sorted(o for outcomes in told.values() for o in outcomes if o == ClearedObject.CARRIED),
                         [ClearedObject.CARRIED] * 2, said)
        for outcome in told.get("flange", []):
            self.assertIn(outcome, (ClearedObject.DOUBT, ClearedObject.GONE), said)


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "task_phantoms", TestTaskPhantoms)
