"""An arm, a camera on it and a recogniser, played: what the node eye_hand hears. The kinematics are written down here
once more, from the tables of docs/conventions.md."""
import threading

import numpy
import rospy
import tf2_ros
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import CameraInfo, JointState

from cube_scene import matrix_of, rotation
from monocular_eye_hand.msg import RecognizedObject, RecognizedObjectArray

JOINTS = ["joint%d" % (i + 1) for i in range(6)]
CAMERA = "camera_optical_frame"
# d, a, alpha; tool0 lies d6 along z of the last frame.
LINKS = [(0, 0, numpy.pi / 2), (0, 0.4318, 0), (0.15005, 0.0203, -numpy.pi / 2), (0.4318, 0, numpy.pi / 2),
         (0, 0, -numpy.pi / 2), (0.05625, 0, 0)]
BASE_HEIGHT = 0.67183

# Hand above the table, level, and the same from another side.
ABOVE = numpy.array([0.0, 0.9, -2.6, 0.0, 1.7 - numpy.pi, 0.0])
ASIDE = numpy.array([0.2, 0.85, -2.5, 0.0, 1.6 - numpy.pi, 0.3])


def transform(rotation_matrix, translation):
    result = numpy.eye(4)
    result[:3, :3], result[:3, 3] = rotation_matrix, translation
    return result


def base_from_tool0(joints):
    result = transform(numpy.eye(3), [0, 0, BASE_HEIGHT])
    for q, (d, a, alpha) in zip(joints, LINKS):
        result = result @ transform(rotation(0, 0, q), [0, 0, d]) @ transform(rotation(alpha, 0, 0), [a, 0, 0])
    return result


# As urdf/puma560.urdf hangs the camera: body frame, then the optical one.
TOOL0_FROM_CAMERA = (transform(rotation(0, -1.3962634015954636, 0), [-0.078, 0, 0.067]) @
                     transform(rotation(-numpy.pi / 2, 0, -numpy.pi / 2), [0, 0, 0]))


def quaternion_of(matrix):
    """x, y, z, w of a rotation matrix: the eigenvector of Bar-Itzhack's symmetric matrix."""
    m = matrix
    k = numpy.array([
        [m[0, 0] - m[1, 1] - m[2, 2], m[1, 0] + m[0, 1], m[2, 0] + m[0, 2], m[2, 1] - m[1, 2]],
        [m[1, 0] + m[0, 1], m[1, 1] - m[0, 0] - m[2, 2], m[2, 1] + m[1, 2], m[0, 2] - m[2, 0]],
        [m[2, 0] + m[0, 2], m[2, 1] + m[1, 2], m[2, 2] - m[0, 0] - m[1, 1], m[1, 0] - m[0, 1]],
        [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], m[0, 0] + m[1, 1] + m[2, 2]]]) / 3
    return numpy.linalg.eigh(k)[1][:, 3]


def put_quaternion(matrix, message):
    message.x, message.y, message.z, message.w = quaternion_of(matrix)


def pose_matrix(pose):
    return transform(matrix_of(pose.orientation), [pose.position.x, pose.position.y, pose.position.z])


def stamped(parent, child, matrix, stamp):
    message = TransformStamped()
    message.header.frame_id, message.header.stamp, message.child_frame_id = parent, stamp, child
    translation = message.transform.translation
    translation.x, translation.y, translation.z = matrix[:3, 3]
    put_quaternion(matrix[:3, :3], message.transform.rotation)
    return message


class Arm:
    """joint_states and tf of base_link <- tool0, twenty times a second; `joints` may be set at any time. `now`: the clock
    of the stamps."""

    def __init__(self, now=rospy.Time.now):
        self.now = now
        self.joints = ABOVE
        self.offset = numpy.zeros(3)  # of tf alone [m]
        self.joint_states = self.tf = True
        self.split = False  # the joints come in two messages
        self.lock = threading.Lock()
        self.publisher = rospy.Publisher("/joint_states", JointState, queue_size=100)
        self.hidden = []  # joints that are not told
        self.turning = 0  # of the last joint [rad/s]
        self.last = None
        self.broadcaster = tf2_ros.TransformBroadcaster()
        self.static = tf2_ros.StaticTransformBroadcaster()
        self.timer = rospy.Timer(rospy.Duration(0.05), lambda _: self.tick())

    def hang_camera(self):
        self.static.sendTransform(stamped("tool0", CAMERA, TOOL0_FROM_CAMERA, self.now()))

    def tick(self):
        with self.lock:
            now = self.now()
            if self.turning and self.last:
                self.joints = self.joints + numpy.array([0.0] * 5 + [self.turning * (now - self.last).to_sec()])
            self.last = now
            if self.joint_states:
                for joints in ([JOINTS[:2], JOINTS[2:]] if self.split else [JOINTS]):
                    told = [name for name in joints if name not in self.hidden]
                    message = JointState(name=["finger_left_joint"] + told)
                    message.position = [0.02] + [self.joints[JOINTS.index(name)] for name in told]
                    message.header.stamp = now
                    self.publisher.publish(message)
            if self.tf:
                hand = base_from_tool0(self.joints)
                hand[:3, 3] += self.offset
                self.broadcaster.sendTransform(stamped("base_link", "tool0", hand, now))

    def stamp(self):
        """A time with joint states and tf before it and, in a moment, after it."""
        self.tick()
        stamp = self.now()
        self.tick()
        return stamp


def camera_info():
    message = CameraInfo(height=480, width=640, distortion_model="plumb_bob", D=[0.0] * 5)
    message.K = [600.0, 0, 320, 0, 600, 240, 0, 0, 1]
    message.R = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    message.P = [600.0, 0, 320, 0, 0, 600, 240, 0, 0, 0, 1, 0]
    message.header.frame_id = CAMERA
    return message


def base_from_camera(joints):
    return base_from_tool0(joints) @ TOOL0_FROM_CAMERA


def recognized(name, base_from_object, joints, covariance):
    """What a recogniser would say of an object that stands at base_from_object."""
    matrix = numpy.linalg.inv(base_from_camera(joints)) @ base_from_object
    message = RecognizedObject(name=name, probability=0.99, decision=RecognizedObject.ACCEPTED)
    position = message.pose.pose.position
    position.x, position.y, position.z = matrix[:3, 3]
    put_quaternion(matrix[:3, :3], message.pose.pose.orientation)
    message.pose.covariance = covariance.ravel().tolist()
    return message


def view(stamp, objects, frame=CAMERA):
    message = RecognizedObjectArray(objects=objects)
    message.header.stamp, message.header.frame_id = stamp, frame
    for one in objects:
        one.header = message.header
    return message


# A small motion of the object as the three factors of its pose make it, numerically: an independent check.
def small(motion):
    x, y, z = motion[3:]
    skew = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return transform(numpy.eye(3) + skew, motion[:3])


def moved(matrix, motion):
    """Fixed axes, about the moved frame's own origin."""
    result = matrix.copy()
    result[:3, :3] = small(motion)[:3, :3] @ matrix[:3, :3]
    result[:3, 3] += motion[:3]
    return result


def motion_between(a, b):
    turn = b[:3, :3] @ a[:3, :3].T
    return numpy.concatenate([b[:3, 3] - a[:3, 3], [(turn[2, 1] - turn[1, 2]) / 2, (turn[0, 2] - turn[2, 0]) / 2,
                                                    (turn[1, 0] - turn[0, 1]) / 2]])


def derivative(function, size, step=1e-6):
    """6 x size: of base_from_object = function(small vector)."""
    columns = []
    for k in range(size):
        d = numpy.zeros(size)
        d[k] = step
        columns.append((motion_between(function(numpy.zeros(size)), function(d)) -
                        motion_between(function(numpy.zeros(size)), function(-d))) / (2 * step))
    return numpy.array(columns).T


def expected_covariance(base_from_object, joints, image):
    """Of one view, with the defaults of config/eye_hand.yaml; without the floor for what CAD and part differ by."""
    hand = base_from_tool0(joints)
    camera_from_object = numpy.linalg.inv(hand @ TOOL0_FROM_CAMERA) @ base_from_object
    by_image = derivative(lambda d: hand @ TOOL0_FROM_CAMERA @ moved(camera_from_object, d), 6)
    by_hand_eye = derivative(lambda d: hand @ moved(TOOL0_FROM_CAMERA, d) @ camera_from_object, 6)
    by_joints = derivative(lambda d: base_from_tool0(joints + d) @ TOOL0_FROM_CAMERA @ camera_from_object, 6)
    hand_eye = numpy.diag([5e-4**2] * 3 + [8.73e-4**2] * 3)
    repeatability = numpy.diag([1e-4**2] * 3 + [0] * 3)
    return (by_image @ image @ by_image.T + by_hand_eye @ hand_eye @ by_hand_eye.T +
            1e-4**2 * by_joints @ by_joints.T + repeatability)
