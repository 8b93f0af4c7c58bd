#!/usr/bin/python3
"""The node task when others fail: a clear reason, no motion, and once it is repaired the next goal is done."""
import os
import signal
import sys
import time
import unittest
import xmlrpc.client

import actionlib
import rosgraph
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import node_process
import task_process
from monocular_eye_hand.msg import ClearedObject, ClearFrameResult, MoveAction, RecognizedObjectArray

EARLY, HASTY, PATIENT = "early_task", "hasty_task", "task"


class TestTaskFaults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_task_faults")  # before use_sim_time is set: this test lives in real time
        cls.files = files = task_process.Files()
        cls.addClassCleanup(task_process.forget_clock)
        cls.witness = task_process.Witness()
        cls.addClassCleanup(cls.witness.close)
        cls.processes = {}
        frame, _, bridge, grenade = files.content("cell.yaml")["objects"]
        cell = files.changed("cell.yaml", objects=[frame, bridge, grenade])
        cls.goals = {}
        cls.start_task(EARLY, 10.0, 1)  # lives in real time as well: use_sim_time is read once
        cls.start("work_cell", "cell:=" + cell, "real_time_factor:=0")
        if cls.witness.joint_state() is None:
            raise RuntimeError("the cell does not start:\n" + cls.text())
        cls.start("eye_hand", "table_height:=0.3")
        cls.start_task(HASTY, 2.0, 2)  # where nothing will come, a short wait is enough
        cls.start_task(PATIENT, 60.0, 1)

    @classmethod
    def start_task(cls, node, look_timeout, look_attempts):
        config = cls.files.changed("task.yaml", node + ".yaml", look_timeout=look_timeout, answer_timeout=5.0,
                                   clear_frame={"look_attempts": look_attempts})
        cls.start("task", "node:=" + node, "config:=" + config, process=node)
        cls.goals[node] = task_process.Goals(node)
        if not cls.goals[node].ready():
            raise RuntimeError("the node %s does not start:\n%s" % (node, cls.text()))

    @classmethod
    def start(cls, file, *arguments, process=None):
        cls.processes[process or file] = node_process.launch(file + ".launch", arguments)
        cls.addClassCleanup(cls.processes[process or file].stop)

    @classmethod
    def text(cls):
        return "\n".join(process.text()[-2000:] for process in cls.processes.values())

    def start_recognizer(self, *arguments, image=True):
        if "recognize" in self.processes:
            self.processes["recognize"].stop()
        views = node_process.Collector()
        self.start("recognize", "camera:=camera", "respawn:=false", *arguments)
        subscriber = rospy.Subscriber("/recognizer/objects", RecognizedObjectArray, views)
        if image:
            self.assertIsNotNone(views.wait(), self.text())
        else:
            rospy.wait_for_service("/recognizer/recognize", node_process.START)
        subscriber.unregister()

    def start_planner(self):
        self.start("planner")
        move = actionlib.SimpleActionClient("/planner/move", MoveAction)
        self.assertTrue(move.wait_for_server(rospy.Duration(node_process.START)), self.text())

    def refused(self, node, *words):
        """The goal ends as a fault that says so, and the arm stands."""
        goals = self.goals[node]
        before = self.witness.truth()
        goals.send()
        state, result = goals.result()
        self.assertEqual((state, result.outcome), (GoalStatus.ABORTED, ClearFrameResult.FAULT), goals.said())
        for word in words:
            self.assertIn(word, result.reason, self.text())
        self.assertEqual([o for o in result.objects if o.outcome == ClearedObject.CARRIED], [])
        self.assertEqual(goals.stages()[-1], "done")
        self.assertEqual(self.witness.moves(), 0)
        truth = self.witness.truth()
        self.assertEqual([(o.label, o.held, o.in_drop_zone) for o in truth.objects],
                         [(o.label, False, o.in_drop_zone) for o in before.objects])
        self.assertEqual(truth.collisions, 0)
        return result.reason

    # In the order of their names, each in what the one before it left.
    def test_1_no_planner(self):
        self.addCleanup(self.start_planner)
        self.refused(HASTY, "planner/move does not answer", "is the node planner running?")

    def test_2_recognizer_died(self):
        """A dead node is told by name long before the time-out of a look."""
        self.start_recognizer()
        process = xmlrpc.client.ServerProxy(rosgraph.Master("/test").lookupNode("/recognizer")).getPid("/test")[2]
        os.kill(process, signal.SIGKILL)
        begin = time.monotonic()
        self.refused(PATIENT, "the node recognizer does not run", "/recognizer/recognize")
        self.assertLess(time.monotonic() - begin, 50, "it waited for look_timeout = 60 s")

    def test_2_recognizer_killed(self):
        self.start_recognizer()
        self.processes["recognize"].stop()
        reason = self.refused(HASTY, "2 looks failed", "the node recognizer")
        self.assertTrue("nobody publishes /recognizer/objects" in reason or "does not run" in reason, reason)

    def test_3_camera_silent(self):
        self.start_recognizer("image:=/no_camera/image_raw", image=False)
        self.refused(HASTY, "2 looks failed", "/recognizer/objects last answered for an image of", "camera")

    def test_4_hand_eye_missing(self):
        config = self.files.changed("recognizer.yaml", camera_frame="loose_camera")
        self.start_recognizer("config:=" + config)
        self.refused(PATIENT, "eye_hand refuses the views", "loose_camera")

    def test_5_repaired_and_a_part_taken_away(self):
        """The first part is gone when the hand comes; the other one is carried out all the same."""
        self.start_recognizer()
        goals = self.goals[PATIENT]
        goals.send()
        picking = goals.feedback.wait(lambda m: m.stage in ("pick", "done"), task_process.LONG)
        self.assertIsNotNone(picking, goals.said())
        self.assertEqual(picking.stage, "pick", goals.said())
        name = picking.object.split()[0]
        self.witness.take_away.publish(name + "_0")
        state, result = goals.result()
        said = goals.said()
        self.assertEqual((state, result.outcome), (GoalStatus.SUCCEEDED, ClearFrameResult.CLEARED), said)
        self.assertIn("lost: ", said)
        missing = [o for o in result.objects if o.object.name == name]
        self.assertTrue(missing, said)
        for one in missing:
            self.assertEqual(one.outcome, ClearedObject.GONE, said)
            self.assertIn("not seen any more", one.reason)
        self.assertEqual(sum(o.picks for o in missing), 1)  # a first sighting may have been wrong and gone
        truth = self.witness.truth()
        self.assertNotIn(name + "_0", [o.label for o in truth.objects])
        parts = [o for o in truth.objects if o.name != "frame"]
        self.assertEqual([o.in_drop_zone for o in parts], [True], said)
        self.assertEqual([o.object.name for o in result.objects if o.outcome == ClearedObject.CARRIED],
                         [parts[0].name])
        self.assertEqual(truth.collisions, 0, said)

    def test_6_two_clocks(self):
        self.refused(EARLY, "share one clock", "use_sim_time")
        self.refused(HASTY, "2 looks failed", "planner/move dropped the goal")  # its stamp is before the early one's


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "task_faults", TestTaskFaults)
