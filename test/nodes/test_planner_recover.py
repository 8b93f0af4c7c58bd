#!/usr/bin/python3
"""The node planner after it was killed with a part in the hand, with a hand that holds what nobody knows, and in a start in
collision: ~recover leads out."""
import math
import os
import signal
import sys
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import node_process
import test_planner
from monocular_eye_hand.msg import (LocatedObject, MoveGoal, MoveResult, PickGoal, PickResult, PlaceGoal, PlaceResult,
                                    RecoverAction, RecoverGoal, RecoverResult)
from test_planner import READY, Goal, down

MEMORY = "/planner_memory"


class TestPlannerRecover(test_planner.PlannerInCell):
    @classmethod
    def start_planner(cls):
        super().start_planner()
        cls.clients["recover"] = cls.client("recover", RecoverAction)

    def kill_planner(self):
        """As a crash would: nothing is stopped, nothing is said."""
        process = xmlrpc.client.ServerProxy(rosgraph.Master("/test").lookupNode("/planner")).getPid("/test")[2]
        os.kill(process, signal.SIGKILL)
        self.assertIsNotNone(self.planner.exit_code())  # roslaunch: the node is required

    def hold(self, label):
        self.to_ready()
        self.tell_objects()
        self.expect(self.do("pick", PickGoal(target=self.target(label), place=5)), PickResult.DONE)
        self.assertTrue(self.truth()[label].held)

    def recover(self, *words):
        self.expect(self.do("recover", RecoverGoal()), RecoverResult.DONE, *words)

    # In the order of their names: the cell goes on from test to test.

    def test_1_killed_with_a_part_in_the_hand(self):
        self.hold("bridge_0")
        self.kill_planner()
        self.start_planner()
        self.tell_objects()
        again = self.do("pick", PickGoal(target=self.target("bridge_1"), place=1))
        self.expect(again, PickResult.FAULT, "holds bridge 0", "/planner/recover")
        self.recover("put down bridge 0 at place 0", "opened the gripper")
        bridge = self.truth()["bridge_0"]
        self.assertFalse(bridge.held)
        self.assertTrue(bridge.in_drop_zone)
        self.assertAlmostEqual(bridge.pose.position.z, 0.3, delta=1e-3)
        self.assertFalse(rospy.has_param(MEMORY))
        self.to_ready()

    def test_2_the_next_free_place(self):
        """What stands in the drop zone is seen; and ~place goes on after the crash as well."""
        self.hold("bridge_1")
        self.kill_planner()
        self.start_planner()
        self.tell_objects(without=["bridge_1"])
        self.recover("put down bridge 1 at place 1")
        self.hold("bridge_1")
        self.kill_planner()
        self.start_planner()
        self.tell_objects(without=["bridge_1"])
        self.expect(self.do("place", PlaceGoal(place=4)), PlaceResult.DONE)
        self.assertEqual([label for label, o in self.truth().items() if o.held], [])
        self.assertEqual(self.newest("/work_cell/truth").collisions, 0)

    def test_3_a_hand_that_holds_what_nobody_knows(self):
        """The memory is gone, too."""
        self.hold("bridge_0")
        self.kill_planner()
        rospy.delete_param(MEMORY)
        self.start_planner()
        self.tell_objects(without=["bridge_0"])
        self.expect(self.do("place", PlaceGoal(place=0)), PlaceResult.GRASP_LOST, "not empty", "/planner/recover")
        self.recover("put down unknown part 0 at place")
        self.assertFalse(self.truth()["bridge_0"].held)

    def test_4_start_in_collision(self):
        """Something is told to be where the hand is: it backs off from it."""
        self.to_ready()
        self.tell_objects()
        self.expect(self.do("move", MoveGoal(link="gripper_tcp", poses=[down(0.45, -0.25, 0.5)])), MoveResult.DONE)
        phantom = LocatedObject(name="bridge", instance=7)
        phantom.pose.pose = down(0.45, -0.25, 0.49)
        phantom.pose.pose.orientation.x = 0  # upright, and across the fingers, which would else stand beside it
        phantom.pose.pose.orientation.z = phantom.pose.pose.orientation.w = math.sqrt(0.5)
        self.tell_objects(more=[phantom])
        self.expect(self.do("move", MoveGoal(joints=READY)), MoveResult.IN_COLLISION, "bridge 7", "/planner/recover")
        self.recover("backed off by")
        self.expect(self.do("move", MoveGoal(joints=READY)), MoveResult.DONE)

    def test_5_nothing_is_wrong(self):
        self.to_ready()
        self.recover("opened the gripper")

    def test_6_the_part_falls_on_the_way(self):
        self.hold("bridge_1")
        goal = Goal(self.clients["recover"], RecoverGoal())
        self.open_while_it_carries(goal)
        self.expect(goal.result(), RecoverResult.GRASP_LOST, "the gripper lost bridge 1")


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "planner_recover", TestPlannerRecover)
