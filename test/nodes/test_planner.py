#!/usr/bin/python3
"""The node planner in the work cell: its actions on what can be done and what cannot, on cancel and on faults. Objects are
told from the cell's truth, so that no camera is needed."""
import math
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
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Pose
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64
from visualization_msgs.msg import Marker, MarkerArray

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import node_process
from monocular_eye_hand.msg import (GraspTarget, LocatedObject, LocatedObjectArray, MoveAction, MoveGoal,
                                    MoveResult, PickAction, PickGoal, PickResult, PlaceAction, PlaceGoal, PlaceResult,
                                    WorkCellTruth)

READY = [0, math.pi / 2, -math.pi / 2, 0, 0, 0]
GRASP_HEIGHT = 0.048  # of gripper_tcp above a bridge's foot [m]
WALL = 60  # [s]; generous: the machine may be busy


def down(x, y, z, yaw=0.0):
    """Pose of gripper_tcp looking down, the pads along base y turned by yaw."""
    pose = Pose()
    pose.position.x, pose.position.y, pose.position.z = x, y, z
    pose.orientation.x, pose.orientation.y = math.cos(yaw / 2), math.sin(yaw / 2)
    return pose


def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


class Goal:
    """One goal on its way, with its feedback."""

    def __init__(self, client, goal):
        self.client = client
        self.stages = []
        self.progress = []
        client.send_goal(goal, feedback_cb=self.feedback)

    def feedback(self, message):
        if not self.stages or self.stages[-1] != message.stage:
            self.stages.append(message.stage)
        self.progress.append(message.progress)

    def result(self):
        end = time.monotonic() + WALL
        while self.client.get_state() in (actionlib.GoalStatus.PENDING, actionlib.GoalStatus.ACTIVE,
                                          actionlib.GoalStatus.PREEMPTING):
            if time.monotonic() > end:
                raise AssertionError("no result in time; stages: %s" % self.stages)
            time.sleep(0.005)
        while self.client.get_result() is None and time.monotonic() < end:
            time.sleep(0.005)
        return self.client.get_result()


class PlannerInCell(unittest.TestCase):
    """A planner in a work cell, whose objects are told from the cell's truth."""

    @classmethod
    def setUpClass(cls):
        cls.cell = node_process.launch("work_cell.launch", ["real_time_factor:=1"])
        while not rospy.has_param("/use_sim_time"):
            time.sleep(0.1)
        rospy.init_node("test_planner")
        cls.objects = rospy.Publisher("/eye_hand/objects", LocatedObjectArray, queue_size=10)
        cls.heard = {}
        cls.subscribers = []
        for topic, kind in (("/work_cell/truth", WorkCellTruth), ("/joint_states", JointState),
                            ("/planner/path", Marker), ("/planner/cell", MarkerArray),
                            ("/diagnostics", DiagnosticArray)):
            cls.heard[topic] = node_process.Collector()
            cls.subscribers.append(rospy.Subscriber(topic, kind, cls.heard[topic], queue_size=1000))
        if cls.heard["/joint_states"].wait() is None or cls.heard["/work_cell/truth"].wait() is None:
            cls.cell.stop()
            raise RuntimeError("the cell does not start: " + cls.cell.text())
        cls.start_planner()

    @classmethod
    def start_planner(cls):
        cls.planner = node_process.launch("planner.launch")
        cls.clients = {name: cls.client(name, kind)
                       for name, kind in (("pick", PickAction), ("place", PlaceAction), ("move", MoveAction))}
        while cls.objects.get_num_connections() == 0:
            time.sleep(0.01)

    @classmethod
    def client(cls, name, kind):
        client = actionlib.SimpleActionClient("/planner/" + name, kind)
        end = time.monotonic() + WALL
        while not client.wait_for_server(rospy.Duration(1)):
            assert time.monotonic() < end, cls.planner.text()
        return client

    @classmethod
    def tearDownClass(cls):
        cls.planner.stop()
        cls.cell.stop()

    def newest(self, topic):
        """The next message of a topic from now on."""
        self.heard[topic].clear()
        message = self.heard[topic].wait()
        self.assertIsNotNone(message, topic)
        return message

    @staticmethod
    def arm_of(state, values):
        return [values[state.name.index("joint%d" % i)] for i in range(1, 7)]

    def joints(self):
        state = self.newest("/joint_states")
        return self.arm_of(state, state.position)

    def truth(self):
        return {o.label: o for o in self.newest("/work_cell/truth").objects}

    def tell_objects(self, without=(), more=()):
        """What eye_hand would know: the truth."""
        array = LocatedObjectArray()
        array.header.frame_id = "base_link"
        array.header.stamp = rospy.Time.now()
        for label, o in self.truth().items():
            if label not in without:
                located = LocatedObject(header=array.header, name=o.name, instance=int(label.split("_")[1]))
                located.pose.pose = o.pose
                array.objects.append(located)
        array.objects += more
        self.objects.publish(array)
        stamp = "%.3f" % array.header.stamp.to_sec()
        self.assertIsNotNone(self.heard["/diagnostics"].wait(lambda message: self.stamp_of(message) == stamp))

    @staticmethod
    def stamp_of(diagnostics):
        """Of the objects that the planner has heard of."""
        values = {value.key: value.value for status in diagnostics.status for value in status.values}
        return values.get("stamp of the objects heard of [s]")

    def open_while_it_carries(self, goal):
        """Somebody else opens the gripper on the way."""
        end = time.monotonic() + WALL
        while "carry" not in goal.stages:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.005)
        thief = rospy.Publisher("/gripper/command", Float64, queue_size=1)
        while thief.get_num_connections() == 0:
            time.sleep(0.005)
        thief.publish(0.08)

    def do(self, name, goal):
        return Goal(self.clients[name], goal).result()

    def target(self, label, shift=0.0):
        """A grasp of a bridge from above, across its middle; `shift`: along y of base, to miss it."""
        truth = self.truth()[label]
        p, yaw = truth.pose.position, yaw_of(truth.pose.orientation)
        target = GraspTarget(name=truth.name, instance=int(label.split("_")[1]), feasible=True, width=0.04,
                             opening=0.07)
        target.header.frame_id = "base_link"
        target.object.pose = truth.pose
        target.pregrasp = down(p.x, p.y + shift, p.z + GRASP_HEIGHT + 0.08, yaw)
        target.grasp = down(p.x, p.y + shift, p.z + GRASP_HEIGHT, yaw)
        target.retreat = down(p.x, p.y + shift, p.z + GRASP_HEIGHT + 0.1, yaw)
        return target

    def expect(self, result, outcome, *words):
        self.assertEqual(result.outcome, outcome, result.reason)
        for word in words:
            self.assertIn(word, result.reason)

    def to_ready(self):
        self.expect(self.do("move", MoveGoal(joints=READY, open_gripper=True)), MoveResult.DONE)

    def assert_stands(self):
        """For a while of cell time."""
        before = self.newest("/joint_states")
        after = self.heard["/joint_states"].wait(lambda m: (m.header.stamp - before.header.stamp).to_sec() > 0.3)
        ways = zip(self.arm_of(before, before.position), self.arm_of(after, after.position))
        self.assertLess(max(abs(a - b) for a, b in ways), 1e-6)


class TestPlanner(PlannerInCell):
    # In the order of their names: the cell goes on from test to test.

    def test_0_cell_is_shown(self):
        """Table and drop zone, again and again, so that they go with the planner."""
        for _ in range(2):
            cell = self.newest("/planner/cell")
            self.assertEqual({m.ns for m in cell.markers}, {"table", "drop_zone"})
            self.assertTrue(all(m.lifetime.to_sec() > 0 for m in cell.markers))
            table = next(m for m in cell.markers if m.ns == "table")
            self.assertAlmostEqual(table.pose.position.z + table.scale.z / 2, rospy.get_param("/planner/table/z"))

    def test_1_goals_that_cannot_be(self):
        """Answered with a reason, and nothing moves."""
        begin = self.joints()
        target = GraspTarget(name="bridge", feasible=True, width=0.04, opening=0.06)
        target.header.frame_id = "base_link"
        target.object.pose = target.pregrasp = target.grasp = target.retreat = down(0.5, 0, 0.4)
        self.expect(self.do("pick", PickGoal(target=target)), PickResult.FAULT, "eye_hand/objects")
        self.tell_objects()
        nan = float("nan")
        for goal, words in ((MoveGoal(), "link ''"), (MoveGoal(link="elbow", poses=[down(0.5, 0, 0.6)]), "'elbow'"),
                            (MoveGoal(link="tool0"), "where to"), (MoveGoal(joints=[0, 1, 2]), "3 angles"),
                            (MoveGoal(joints=READY[:5] + [nan]), "not finite"),
                            (MoveGoal(link="tool0", poses=[down(nan, 0, 0.6)]), "poses[0] is not finite"),
                            (MoveGoal(link="tool0", poses=[Pose()]), "length 0")):
            self.expect(self.do("move", goal), MoveResult.FAULT, "bad goal", words)
        bad = self.target("bridge_0")
        bad.name = "teapot"
        self.expect(self.do("pick", PickGoal(target=bad)), PickResult.FAULT, "'teapot'", "grenade")
        bad = self.target("bridge_0")
        bad.grasp.position.z = nan
        self.expect(self.do("pick", PickGoal(target=bad)), PickResult.FAULT, "target.grasp")
        bad = self.target("bridge_0")
        bad.header.frame_id = "camera"
        self.expect(self.do("pick", PickGoal(target=bad)), PickResult.FAULT, "'camera'")
        bad = self.target("bridge_0")
        bad.opening = 0.2
        self.expect(self.do("pick", PickGoal(target=bad)), PickResult.FAULT, "opening")
        bad = self.target("bridge_0")
        bad.feasible, bad.reason = False, "too near to the frame"
        self.expect(self.do("pick", PickGoal(target=bad)), PickResult.UNREACHABLE, "too near to the frame")
        for place in (-1, 6):
            self.expect(self.do("pick", PickGoal(target=self.target("bridge_0"), place=place)),
                        PickResult.UNREACHABLE, "no place %d" % place)
        self.expect(self.do("place", PlaceGoal()), PlaceResult.GRASP_LOST, "holds nothing")
        self.assertEqual(begin, self.joints())

    def test_2_moves(self):
        """The first pose that can be reached; unreachable and blocked ones say why."""
        self.tell_objects()
        begin = self.joints()
        self.expect(self.do("move", MoveGoal(link="gripper_tcp", poses=[down(1.5, 0, 0.6)])), MoveResult.UNREACHABLE,
                    "out of reach")
        self.expect(self.do("move", MoveGoal(link="gripper_tcp", poses=[down(0.5, 0, 0.28)])), MoveResult.IN_COLLISION,
                    "table")
        self.expect(self.do("move", MoveGoal(joints=[3.1] + READY[1:])), MoveResult.UNREACHABLE, "joint limits")
        self.assertEqual(begin, self.joints())
        self.heard["/planner/path"].clear()
        goal = Goal(self.clients["move"],
                    MoveGoal(link="gripper_tcp", poses=[down(1.5, 0, 0.6), down(0.5, 0, 0.28), down(0.45, 0, 0.62)]))
        result = goal.result()
        self.expect(result, MoveResult.DONE)
        self.assertEqual(result.reached, 2)
        self.assertGreater(result.motion_time, 1)
        self.assertGreater(result.planning_time, 0)
        self.assertEqual(goal.stages, ["plan", "move"])
        self.assertGreater(goal.progress[-1], 0.9)  # the last feedback may come after the result
        self.assertEqual(sorted(goal.progress[2:]), goal.progress[2:])
        path = self.heard["/planner/path"].wait()
        end = path.points[-1]
        self.assertLess(math.dist((end.x, end.y, end.z), (0.45, 0, 0.62)), 1e-3)
        self.assert_stands()
        # Something new stands there.
        lid = LocatedObject(name="frame", instance=7)
        lid.pose.pose.position.x, lid.pose.pose.position.y, lid.pose.pose.position.z = 0.4, -0.31, 0.6
        lid.pose.pose.orientation.w = 1
        self.tell_objects(more=[lid])
        self.expect(self.do("move", MoveGoal(link="gripper_tcp", poses=[down(0.4, -0.2, 0.61)])),
                    MoveResult.IN_COLLISION, "frame 7")
        self.tell_objects()
        self.expect(self.do("move", MoveGoal(link="gripper_tcp", poses=[down(0.4, -0.2, 0.61)])), MoveResult.DONE)

    def test_3_cancel_while_it_moves(self):
        """The arm stops at its deceleration, and the result says so."""
        self.to_ready()
        self.tell_objects()
        goal = Goal(self.clients["move"], MoveGoal(joints=[-1.5] + READY[1:]))
        end = time.monotonic() + WALL
        while self.joints()[0] > -0.5:
            self.assertLess(time.monotonic(), end)
        busy = self.do("place", PlaceGoal(place=0))
        self.expect(busy, PlaceResult.FAULT, "busy with move", "one action at a time")
        asked = rospy.Time.now()
        goal.client.cancel_goal()
        result = goal.result()
        took = (rospy.Time.now() - asked).to_sec()
        self.expect(result, MoveResult.CANCELLED, "cancelled")
        self.assertEqual(goal.client.get_state(), actionlib.GoalStatus.PREEMPTED)
        self.assertEqual(result.reached, -1)
        self.assertGreater(self.joints()[0], -1.45)
        self.assert_stands()
        self.assertLess(took, 2, "2 rad/s at 8 rad/s^2 is a quarter of a second, and the way of the messages")
        # A new goal of the same action takes over.
        first = Goal(self.clients["move"], MoveGoal(joints=[1.5] + READY[1:]))
        while self.joints()[0] < 0:
            self.assertLess(time.monotonic(), end)
        second = actionlib.SimpleActionClient("/planner/move", MoveAction)
        self.assertTrue(second.wait_for_server(rospy.Duration(20)))
        goal = Goal(second, MoveGoal(joints=READY))
        self.expect(first.result(), MoveResult.CANCELLED)
        self.expect(goal.result(), MoveResult.DONE)

    def test_4_pick_and_place(self):
        """A bridge out of the frame to a place of the drop zone, and the other one around it."""
        self.to_ready()
        self.tell_objects()
        goal = Goal(self.clients["pick"], PickGoal(target=self.target("bridge_0"), place=4))
        result = goal.result()
        self.expect(result, PickResult.DONE)
        self.assertEqual(goal.stages, ["plan", "reach", "approach", "close", "lift"])
        self.assertTrue(self.truth()["bridge_0"].held)
        again = self.do("pick", PickGoal(target=self.target("bridge_1"), place=1))
        self.expect(again, PickResult.FAULT, "holds bridge 0")
        goal = Goal(self.clients["place"], PlaceGoal(place=4))
        result = goal.result()
        self.expect(result, PlaceResult.DONE)
        self.assertEqual(goal.stages, ["plan", "carry", "lower", "open", "retreat"])
        bridge = self.truth()["bridge_0"]
        self.assertTrue(bridge.in_drop_zone)
        self.assertLess(math.dist((bridge.pose.position.x, bridge.pose.position.y), (0.5, 0.395)), 2e-3)
        self.assertAlmostEqual(bridge.pose.position.z, 0.3, delta=1e-4)
        self.assertAlmostEqual(abs(yaw_of(bridge.pose.orientation)), math.pi / 2, delta=0.01)
        # Eye-hand forgot it; the planner did not: it goes around it, and takes no place that it stands in.
        self.tell_objects(without=["bridge_0"])
        through = down(bridge.pose.position.x, bridge.pose.position.y, 0.35)
        self.expect(self.do("move", MoveGoal(link="gripper_tcp", poses=[through])), MoveResult.IN_COLLISION,
                    "bridge at place 4")
        # To another place than was planned, from where the arm was stopped in its lift.
        goal = Goal(self.clients["pick"], PickGoal(target=self.target("bridge_1"), place=5))
        end = time.monotonic() + WALL
        while "lift" not in goal.stages:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.005)
        goal.client.cancel_goal()
        self.expect(goal.result(), PickResult.CANCELLED)
        self.assertTrue(self.truth()["bridge_1"].held)
        self.expect(self.do("place", PlaceGoal(place=3)), PlaceResult.DONE)
        bridge = self.truth()["bridge_1"]
        self.assertLess(math.dist((bridge.pose.position.x, bridge.pose.position.y), (0.38, 0.395)), 2e-3)
        self.assertEqual(self.newest("/work_cell/truth").collisions, 0)

    def test_5_nothing_in_the_gripper(self):
        """A grasp that misses, and a part that is taken away on the way."""
        self.to_ready()
        self.tell_objects()
        # The object is told to be where it is not.
        target = self.target("bridge_0")
        for pose in (target.object.pose, target.pregrasp, target.grasp, target.retreat):
            pose.position.x, pose.position.y = 0.6, -0.4
        self.expect(self.do("pick", PickGoal(target=target, place=0)), PickResult.GRASP_LOST, "closed to")
        self.expect(self.do("place", PlaceGoal(place=0)), PlaceResult.GRASP_LOST, "holds nothing")
        self.to_ready()
        # Somebody opens the gripper while it carries.
        self.tell_objects()
        self.expect(self.do("pick", PickGoal(target=self.target("bridge_1"), place=0)), PickResult.DONE)
        goal = Goal(self.clients["place"], PlaceGoal(place=0))
        self.open_while_it_carries(goal)
        self.expect(goal.result(), PlaceResult.GRASP_LOST, "the gripper lost bridge 1")
        self.assert_stands()
        self.to_ready()

    def test_6_standing_clock(self):
        """A simulation that stands is no fault: told, and the motion goes on with it."""
        self.to_ready()
        self.tell_objects()
        goal = Goal(self.clients["move"], MoveGoal(joints=[1.5] + READY[1:]))
        end = time.monotonic() + WALL
        while self.joints()[0] < 0.3:
            self.assertLess(time.monotonic(), end)
        self.heard["/diagnostics"].clear()
        cell = xmlrpc.client.ServerProxy(rosgraph.Master("/test").lookupNode("/work_cell")).getPid("/test")[2]
        os.kill(cell, signal.SIGSTOP)
        try:
            told = self.heard["/diagnostics"].wait(lambda message: any(
                one.name == "planner: robot" and "the clock stands" in one.message for one in message.status))
            self.assertIsNotNone(told, self.planner.text())
            time.sleep(4)
            self.assertEqual(goal.client.get_state(), actionlib.GoalStatus.ACTIVE)
        finally:
            os.kill(cell, signal.SIGCONT)
        self.expect(goal.result(), MoveResult.DONE)
        self.assertIn("the clock stands at", self.planner.text())
        self.to_ready()

    def test_7_end_while_it_moves(self):
        """A planner that is ended stops the arm first."""
        self.to_ready()
        Goal(self.clients["move"], MoveGoal(joints=[-1.5] + READY[1:]))
        end = time.monotonic() + WALL
        while self.joints()[0] > -0.3:
            self.assertLess(time.monotonic(), end)
        self.planner.stop()
        self.assert_stands()
        self.assertGreater(self.joints()[0], -1.45)


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "planner", TestPlanner)
