"""The node task and those it needs as children of a test, the goals it is sent, and what the cell knows of the outcome."""
import os
import tempfile
import time

import actionlib
import numpy
import rospkg
import rospy
import yaml
from sensor_msgs.msg import JointState
from std_msgs.msg import String

import node_process
from monocular_eye_hand.msg import ClearFrameAction, ClearFrameActionFeedback, ClearFrameGoal, WorkCellTruth

PACKAGE = rospkg.RosPack().get_path("monocular_eye_hand")
LONG = 200  # the longest wait for a whole task [s]; generous: the machine may be busy


def forget_clock():
    """For the next test in the same master."""
    if rospy.has_param("/use_sim_time"):
        rospy.delete_param("/use_sim_time")


class Files:
    """Copies of the package's YAML files with some values changed; gone when the test ends."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory()

    def content(self, name):
        with open(os.path.join(PACKAGE, "config", name)) as file:
            return yaml.safe_load(file)

    def changed(self, name, as_name=None, **changes):
        content = self.content(name)
        for key, value in changes.items():
            content[key] = dict(content[key], **value) if isinstance(value, dict) else value
        path = os.path.join(self.folder.name, as_name or name)
        with open(path, "w") as file:
            yaml.safe_dump(content, file)
        return path


class Witness:
    """What the arm does and where the objects are in truth."""

    def __init__(self):
        self.joints, self.truth_heard = node_process.Collector(), node_process.Collector()
        self.subscribers = [
            rospy.Subscriber("/joint_states", JointState, self.joints, queue_size=10000),
            rospy.Subscriber("/work_cell/truth", WorkCellTruth, self.truth_heard, queue_size=1000)]
        self.take_away = rospy.Publisher("/work_cell/take_away", String, queue_size=10)

    def close(self):
        for one in self.subscribers + [self.take_away]:
            one.unregister()

    def truth(self):
        """The truth from now on."""
        now = self.joint_state().header.stamp
        truth = self.truth_heard.wait(lambda message: message.header.stamp >= now)
        self.truth_heard.clear()
        return truth

    def joint_state(self):
        self.joints.clear()
        return self.joints.wait()

    def moves(self, seconds=1.0):
        """How far any joint moves in the next `seconds` of the cell [rad]."""
        first = self.joint_state()
        if self.joints.wait(lambda m: m.header.stamp >= first.header.stamp + rospy.Duration(seconds)) is None:
            raise RuntimeError("joint_states are silent")
        positions = numpy.array([m.position[:6] for m in list(self.joints.messages)])
        return numpy.abs(positions - positions[0]).max()


class Goals:
    """Sends goals to one node `task`; keeps the feedback of the last goal."""

    def __init__(self, node="task"):
        self.client = actionlib.SimpleActionClient("/%s/clear_frame" % node, ClearFrameAction)
        self.feedback, self.ended = node_process.Collector(), node_process.Collector()
        # Not by the client: it drops what comes after the result.
        self.subscriber = rospy.Subscriber("/%s/clear_frame/feedback" % node, ClearFrameActionFeedback,
                                           lambda message: self.feedback(message.feedback), queue_size=100)

    def ready(self):
        if not self.client.wait_for_server(rospy.Duration(node_process.START)):
            return False
        end = time.monotonic() + node_process.START
        while self.subscriber.get_num_connections() == 0 and time.monotonic() < end:
            time.sleep(0.05)
        return self.subscriber.get_num_connections() > 0

    def send(self, frame=""):
        self.feedback, self.ended = node_process.Collector(), node_process.Collector()
        ended = self.ended
        self.client.send_goal(ClearFrameGoal(frame), done_cb=lambda state, result: ended((state, result)))

    def cancel(self):
        self.client.cancel_goal()

    def result(self, timeout=LONG):
        """(state of the goal, ClearFrameResult) once it ended."""
        ended = self.ended.wait(timeout=timeout)
        if ended is None:
            self.cancel()
            raise RuntimeError("the task does not end; it said: " + self.said())
        if ended[1].rounds:  # the last words come on a topic of their own
            self.feedback.wait(lambda message: message.stage == "done")
        return ended

    def stages(self):
        return [message.stage for message in list(self.feedback.messages)]

    def said(self):
        return "\n".join("%s %s: %s" % (m.stage, m.object, m.text) for m in list(self.feedback.messages))
