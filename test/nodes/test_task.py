#!/usr/bin/python3
"""launch/demo.launch in a random cell: cancelled on the way to a part and with a part in the hand, then the frame is cleared."""
import os
import sys
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import node_process
import task_process
from monocular_eye_hand.msg import (ClearedObject, ClearFrameResult, PickActionFeedback, PlaceActionFeedback,
                                    WorkCellTruth)

SEED = 5
AFTER = {"look": {"look", "choose", "done"}, "choose": {"confirm", "pick", "look", "done"},
         "confirm": {"confirm", "pick", "choose", "look", "done"}, "pick": {"pick", "verify", "choose", "look", "done"},
         "verify": {"carry", "look", "done"}, "carry": {"look", "done"}, "done": set()}


class TestTask(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_task")  # before use_sim_time is set: this test lives in real time
        cls.files = task_process.Files()
        cell = cls.files.changed("cell.yaml", random={"objects": 2, "parts": ["bridge", "bracket"]})
        cls.addClassCleanup(task_process.forget_clock)
        cls.witness = task_process.Witness()
        cls.addClassCleanup(cls.witness.close)
        cls.goals = task_process.Goals()
        cls.demo = node_process.launch("demo.launch", ["cell:=" + cell, "seed:=%d" % SEED,
                                                      "real_time_factor:=1"])  # time to cancel in a motion
        cls.addClassCleanup(cls.demo.stop)
        if not cls.goals.ready() or cls.witness.truth() is None:
            raise RuntimeError("the demo does not start: " + cls.demo.text())

    def cancel_in(self, topic, kind, stage):
        """Cancels a goal when the planner's action moves the arm in that stage; the arm stands, and stays."""
        feedback = node_process.Collector()
        subscriber = rospy.Subscriber(topic, kind, feedback, queue_size=1000)
        self.goals.send()
        seen = feedback.wait(lambda m: m.feedback.stage == stage and m.feedback.progress > 0, task_process.LONG)
        self.goals.cancel()
        subscriber.unregister()
        self.assertIsNotNone(seen, self.goals.said())
        state, result = self.goals.result(node_process.START)
        self.assertEqual(state, GoalStatus.PREEMPTED, result.reason)
        self.assertEqual(result.outcome, ClearFrameResult.CANCELLED, result.reason)
        self.assertIn("cancelled", result.reason)
        self.assertEqual(self.witness.moves(), 0)
        return result

    def test_1_unknown_frame(self):
        self.goals.send("spoon")
        state, result = self.goals.result()
        self.assertEqual((state, result.outcome), (GoalStatus.ABORTED, ClearFrameResult.FAULT))
        self.assertIn('"spoon" is not in the model base', result.reason)
        self.assertEqual(self.witness.moves(), 0)

    def test_2_cancelled_on_the_way_to_a_part(self):
        result = self.cancel_in("/planner/pick/feedback", PickActionFeedback, "reach")
        self.assertIn("pick", self.goals.stages())
        self.assertEqual([o for o in result.objects if o.outcome == ClearedObject.CARRIED], [])
        self.assertEqual(self.witness.truth().collisions, 0)

    def test_3_cancelled_with_a_part_in_the_hand(self):
        result = self.cancel_in("/planner/place/feedback", PlaceActionFeedback, "carry")
        held = [o for o in result.objects if o.outcome == ClearedObject.HELD]
        self.assertEqual(len(held), 1, result)
        self.assertIn("still in the gripper", held[0].reason)
        truth = self.witness.truth()
        self.assertEqual([o.name for o in truth.objects if o.held], [held[0].object.name])

    def test_4_clears_the_frame(self):
        """What is still in the hand goes to the drop zone first."""
        self.goals.send()
        state, result = self.goals.result()
        said = self.goals.said()
        self.assertEqual((state, result.outcome), (GoalStatus.SUCCEEDED, ClearFrameResult.CLEARED), said)
        truth = self.witness.truth()
        parts = [o for o in truth.objects if o.name != "frame"]
        self.assertEqual(len(parts), 2)
        self.assertEqual([o.label for o in parts if not o.in_drop_zone or o.held], [], said)
        self.assertEqual(truth.collisions, 0, said)
        carried = [o for o in result.objects if o.outcome == ClearedObject.CARRIED]
        self.assertEqual(len(carried), 1, said)
        self.assertIn(carried[0].object.name, [o.name for o in parts])
        self.assertGreaterEqual(carried[0].picks, 1)
        self.assertEqual(carried[0].object.header.frame_id, "base_link")
        self.assertGreaterEqual(result.rounds, 2)  # the last one found nothing more
        self.assertGreater(result.duration, 0)
        stages = self.goals.stages()
        self.assertEqual((stages[0], stages[-1]), ("look", "done"))
        for before, after in zip(stages, stages[1:]):
            self.assertIn(after, AFTER[before] | {before}, said)
        # Whether a look from near is needed depends on what the others showed.
        stages = [stage for stage in stages if stage != "confirm"]
        stages = [stage for k, stage in enumerate(stages) if k == 0 or stage != stages[k - 1]]
        carry = stages.index("carry")
        self.assertEqual(stages[carry - 3:carry + 2], ["choose", "pick", "verify", "carry", "look"], said)
        last = self.goals.feedback.messages[-1]
        self.assertEqual((last.carried, last.left, last.text), (1, 0, result.reason))


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "task", TestTask)
