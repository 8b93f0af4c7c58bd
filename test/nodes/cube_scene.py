"""A grey image of the cube of config/cube.yaml, ray-cast with numpy, and what goes with it on ROS."""
import numpy

import rospy
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import CameraInfo, Image

EDGE = 0.084  # [m]
WIDTH, HEIGHT = 640, 480
FOCAL, CX, CY = 600.0, 322.0, 237.0  # [px]
FRAME = "camera_optical"

# Camera from cube: three faces in view.
TRANSLATION = numpy.array([0.03, 0.01, 0.42])


def rotation(x, y, z):
    """Rotation about x, then y, then z [rad]."""
    cx, sx, cy, sy, cz, sz = numpy.cos(x), numpy.sin(x), numpy.cos(y), numpy.sin(y), numpy.cos(z), numpy.sin(z)
    about_x = numpy.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    about_y = numpy.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_z = numpy.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


ROTATION = rotation(0.65, -0.6, 0.25)
LOW = numpy.array([-EDGE, 0.0, 0.0])
HIGH = numpy.array([0.0, EDGE, EDGE])


def corners_in_camera(rotation_matrix=ROTATION, translation=TRANSLATION):
    corners = numpy.array([[x, y, z] for x in (LOW[0], HIGH[0]) for y in (LOW[1], HIGH[1]) for z in (LOW[2], HIGH[2])])
    return corners @ rotation_matrix.T + translation


def cube_picture(translation=TRANSLATION):
    """uint8 (HEIGHT, WIDTH): every face has its grey, edges are smooth (3 x 3 rays per pixel), with mild noise."""
    offsets = (numpy.arange(3) - 1) / 3.0
    u = (numpy.arange(WIDTH)[:, None] + offsets).ravel()
    v = (numpy.arange(HEIGHT)[:, None] + offsets).ravel()
    rays = numpy.stack(numpy.broadcast_arrays((u[None, :] - CX) / FOCAL, (v[:, None] - CY) / FOCAL, 1.0), -1)
    rays = rays @ ROTATION  # into the cube's frame
    eye = -translation @ ROTATION
    with numpy.errstate(divide="ignore", invalid="ignore"):
        a, b = (LOW - eye) / rays, (HIGH - eye) / rays
    near, far = numpy.minimum(a, b), numpy.maximum(a, b)
    enter = near.max(-1)
    hit = enter < far.min(-1)
    axis = near.argmax(-1)
    grey = numpy.where(hit, numpy.array([70.0, 130.0, 215.0])[axis], 25.0)
    grey = grey.reshape(HEIGHT, 3, WIDTH, 3).mean((1, 3))
    grey += numpy.random.RandomState(1).normal(0, 1.0, grey.shape)
    return numpy.clip(numpy.rint(grey), 0, 255).astype(numpy.uint8)


def flat_picture():
    noise = numpy.random.RandomState(2).normal(128, 1.0, (HEIGHT, WIDTH))
    return numpy.clip(numpy.rint(noise), 0, 255).astype(numpy.uint8)


def image_message(picture, encoding="mono8"):
    message = Image(height=picture.shape[0], width=picture.shape[1], encoding=encoding, is_bigendian=0)
    message.step = picture.strides[0]
    message.data = picture.tobytes()
    message.header.frame_id = FRAME
    return message


def camera_info():
    message = CameraInfo(height=HEIGHT, width=WIDTH, distortion_model="plumb_bob", D=[0.0] * 5)
    message.K = [FOCAL, 0, CX, 0, FOCAL, CY, 0, 0, 1]
    message.R = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    message.P = [FOCAL, 0, CX, 0, 0, FOCAL, CY, 0, 0, 0, 1, 0]
    message.header.frame_id = FRAME
    return message


def frame_of_the_cube(name):
    """The transform of a frame in which the cube stands on z = 0, in the camera's."""
    message = TransformStamped(child_frame_id=name)
    message.header.frame_id = FRAME
    message.transform.translation.x, message.transform.translation.y, message.transform.translation.z = TRANSLATION
    turn, r = message.transform.rotation, ROTATION
    turn.w = 0.5 * numpy.sqrt(1 + numpy.trace(r))  # the cube is turned by less than half a turn
    turn.x, turn.y, turn.z = (numpy.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]) / (4 * turn.w))
    return message


def matrix_of(quaternion):
    x, y, z, w = quaternion.x, quaternion.y, quaternion.z, quaternion.w
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def distance_to_truth(pose, translation=TRANSLATION):
    """Largest distance of a corner of the cube at `pose` to the nearest true corner [m]: modulo the symmetries."""
    position = numpy.array([pose.position.x, pose.position.y, pose.position.z])
    seen = corners_in_camera(matrix_of(pose.orientation), position)
    true = corners_in_camera(ROTATION, translation)
    return numpy.linalg.norm(seen[:, None] - true[None, :], axis=-1).min(1).max()


class Camera:
    """Publishes the current image and calibration ten times a second; None is not published."""

    def __init__(self, namespace=""):
        self.image, self.info = None, None
        self.stamp = rospy.Time.now
        self.info_publisher = rospy.Publisher(namespace + "camera_info", CameraInfo, queue_size=1)
        self.image_publisher = rospy.Publisher(namespace + "image_raw", Image, queue_size=1)
        self.timer = rospy.Timer(rospy.Duration(0.1), self.publish)

    def publish(self, _event):
        image, info = self.image, self.info
        stamp = self.stamp()
        if info is not None:
            info.header.stamp = stamp
            self.info_publisher.publish(info)
        if image is not None:
            image.header.stamp = stamp
            self.image_publisher.publish(image)
