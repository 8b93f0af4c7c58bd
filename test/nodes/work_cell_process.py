"""The node work_cell as a child of a test, with everything it says, and what the tests need to know of its arm."""
import time
import xml.etree.ElementTree

import numpy
import rospkg
import rospy
from rosgraph_msgs.msg import Clock, Log
from sensor_msgs.msg import CameraInfo, JointState
from std_msgs.msg import Float64
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

import eye_hand_scene
import node_process
from monocular_eye_hand.msg import GripperState, WorkCellTruth

PACKAGE = rospkg.RosPack().get_path("monocular_eye_hand")
JOINTS = ["joint%d" % i for i in range(1, 7)]
FINGERS = ["finger_left_joint", "finger_right_joint"]
LOOK = [0.311033, 1.44815, -3.260139, -0.018686, -1.274922, -2.827161]  # the camera above the frame


def limits():
    """Lower and upper [rad] and speed [rad/s] of the arm's joints, from the URDF."""
    robot = xml.etree.ElementTree.parse(PACKAGE + "/urdf/puma560.urdf").getroot()
    of = {joint.get("name"): joint.find("limit") for joint in robot.findall("joint")}
    return numpy.array([[float(of[name].get(key)) for key in ("lower", "upper", "velocity")] for name in JOINTS]).T


def joints_near(start, base_from_tcp):
    """Joint angles that bring gripper_tcp there, by Newton's method from `start`."""
    target = base_from_tcp @ eye_hand_scene.transform(numpy.eye(3), [0, 0, -0.16])
    joints = numpy.array(start, float)

    def error(q):
        now = eye_hand_scene.base_from_tool0(q)
        turn = target[:3, :3] @ now[:3, :3].T
        spin = [turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]
        return numpy.concatenate([target[:3, 3] - now[:3, 3], numpy.array(spin) / 2])

    for _ in range(50):
        here = error(joints)
        jacobian = numpy.array([(error(joints + step) - here) / 1e-6 for step in 1e-6 * numpy.eye(6)]).T
        joints -= numpy.clip(numpy.linalg.solve(jacobian, here), -0.3, 0.3)
    numpy.testing.assert_allclose(error(joints), 0, atol=1e-6)
    return joints


def pose_of(truth):
    """Label, name and pose of every object, as numbers that can be compared."""
    return [(o.label, o.name, [o.pose.position.x, o.pose.position.y, o.pose.position.z, o.pose.orientation.x,
                               o.pose.orientation.y, o.pose.orientation.z, o.pose.orientation.w])
            for o in truth.objects]


class Cell:
    """work_cell.launch as a child, with everything it says."""

    def __init__(self, *arguments):
        self.heard = {}
        self.subscribers = []
        for topic, kind in (("/clock", Clock), ("/joint_states", JointState), ("/gripper/state", GripperState),
                            ("/work_cell/truth", WorkCellTruth), ("/camera/camera_info", CameraInfo),
                            ("/rosout", Log)):
            self.listen(topic, kind)
        self.arm = rospy.Publisher("/arm_controller/command", JointTrajectory, queue_size=10)
        self.gripper = rospy.Publisher("/gripper/command", Float64, queue_size=10)
        self.process = node_process.launch("work_cell.launch", arguments)

    def __enter__(self):
        if self.wait("/joint_states") is None or self.wait("/work_cell/truth") is None:
            raise RuntimeError("the cell does not start: " + self.process.text())
        while self.arm.get_num_connections() == 0 or self.gripper.get_num_connections() == 0:
            time.sleep(0.01)
        return self

    def __exit__(self, *_):
        self.process.stop()
        for subscriber in self.subscribers:
            subscriber.unregister()
        self.arm.unregister()
        self.gripper.unregister()

    def listen(self, topic, kind):
        self.heard[topic] = node_process.Collector()
        self.subscribers.append(rospy.Subscriber(topic, kind, self.heard[topic], queue_size=100000,
                                                 buff_size=1 << 24))

    def wait(self, topic, fits=lambda message: True):
        return self.heard[topic].wait(fits)

    def next(self, topic):
        """A message that comes from now on."""
        self.heard[topic].clear()
        return self.wait(topic)

    def now(self):
        return self.next("/clock").clock.to_sec()

    def joints(self):
        return numpy.array(self.next("/joint_states").position[:6])

    def send(self, goal, duration, start=0.0, names=None):
        names = names or JOINTS
        message = JointTrajectory(joint_names=names)
        message.header.stamp = rospy.Time.from_sec(start)
        message.points = [JointTrajectoryPoint(positions=[goal[JOINTS.index(name)] for name in names],
                                               velocities=[0] * 6, time_from_start=rospy.Duration(duration))]
        self.arm.publish(message)

    def arrive(self, goal):
        return self.wait("/joint_states", lambda m: numpy.abs(numpy.array(m.position[:6]) - goal).max() < 1e-9
                         and numpy.abs(m.velocity).max() == 0)

    def move(self, goal, duration):
        self.heard["/joint_states"].clear()
        self.send(goal, duration)
        return self.arrive(goal)

    def follow(self, path, step):
        """Through the points of `path`, `step` seconds from one to the next, and stand at the last."""
        self.heard["/joint_states"].clear()
        self.arm.publish(JointTrajectory(joint_names=JOINTS, points=[
            JointTrajectoryPoint(positions=q, time_from_start=rospy.Duration((i + 1) * step))
            for i, q in enumerate(path)]))
        return self.arrive(path[-1])

    def image_at_rest(self):
        """The first image taken after now."""
        after = self.now()
        return self.wait("/camera/image_raw", lambda m: m.header.stamp.to_sec() > after)
