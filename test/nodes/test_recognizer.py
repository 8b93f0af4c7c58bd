#!/usr/bin/python3
"""The node recognizer against a camera that this test plays: every answer of the service, every output."""
import os
import shutil
import sys
import tempfile
import threading
import time
import unittest

import numpy
import rospy
import rostest
import rospkg
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from sensor_msgs.msg import Image
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import cube_scene
import node_process
from monocular_eye_hand.msg import RecognizedObject, RecognizedObjectArray
from monocular_eye_hand.srv import Recognize, RecognizeResponse

SERVICE = "/recognizer/recognize"


def status_named(name):
    def fits(message):
        return any(status.name.endswith(name) for status in message.status)
    return fits


def status_of(message, name):
    return next(status for status in message.status if status.name.endswith(name))


def value_of(status, key):
    return next(value.value for value in status.values if value.key == key)


class TestRecognizer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_recognizer")
        cls.cache = tempfile.mkdtemp()
        objects = os.path.join(rospkg.RosPack().get_path("monocular_eye_hand"), "config", "cube.yaml")
        cls.camera = cube_scene.Camera()
        cls.node = node_process.node("recognizer", "recognizer", [
            "_objects:=" + objects, "_cache:=" + cls.cache, "_continuous:=false", "_service_timeout:=2.0",
            "_diagnostic_period:=0.5", "_frame_prefix:=left/"])
        rospy.wait_for_service(SERVICE, node_process.START)
        cls.recognize = rospy.ServiceProxy(SERVICE, Recognize)
        cls.cube, cls.flat = cube_scene.cube_picture(), cube_scene.flat_picture()

    @classmethod
    def tearDownClass(cls):
        cls.camera.timer.shutdown()
        cls.node.stop()
        shutil.rmtree(cls.cache)

    def setUp(self):
        self.assertTrue(self.node.running(), self.node.text())
        self.camera.image = cube_scene.image_message(self.cube)
        self.camera.info = cube_scene.camera_info()
        self.camera.stamp = rospy.Time.now

    def check(self, status, *words, name=""):
        reply = self.recognize(name)
        self.assertEqual(reply.status, status, reply.text)
        for word in words:
            self.assertIn(word, reply.text)
        if status != RecognizeResponse.FOUND:
            self.assertEqual(reply.objects, [])
        return reply

    # The first two need a node that has not seen a camera yet: unittest runs by name.
    def test_0_no_image(self):
        self.camera.image = self.camera.info = None
        self.check(RecognizeResponse.NO_IMAGE, "no image on /image_raw within 2 s")

    def test_1_no_camera_info(self):
        self.camera.info = None
        self.check(RecognizeResponse.BAD_CAMERA_INFO, "/camera_info", "none was received")

    def test_found(self):
        for name in ("", "cube"):
            reply = self.check(RecognizeResponse.FOUND, "found cube_0", name=name)
            self.assertEqual(len(reply.objects), 1)
            cube = reply.objects[0]
            self.assertEqual(cube.name, "cube")
            self.assertEqual(cube.header.frame_id, cube_scene.FRAME)
            self.assertLess(cube_scene.distance_to_truth(cube.pose.pose), 0.006)
            self.assertEqual(cube.decision, RecognizedObject.ACCEPTED)
            self.assertGreater(cube.probability, 0.5)
            self.assertGreater(min(cube.pose.covariance[i * 7] for i in range(6)), 0)
            self.assertGreater(cube.matched_features, 5)

    def test_not_found(self):
        self.camera.image = cube_scene.image_message(self.flat)
        for name, text in (("", "no known object in the image: "), ("cube", "no cube in the image: ")):
            reply = self.check(RecognizeResponse.NOT_FOUND, text, name=name)
            self.assertGreater(len(reply.text), len(text) + 5, "a reason is missing")
            self.assertLess(reply.text.count("candidate"), 2, reply.text)

    def test_unknown_name(self):
        self.camera.image = None  # answered without an image
        self.check(RecognizeResponse.UNKNOWN_NAME, "'cub'", "known: cube", name="cub")

    def test_bad_camera_info(self):
        info = self.camera.info
        info.K = [0.0] * 9
        self.check(RecognizeResponse.BAD_CAMERA_INFO, "K is all zero", "/camera_info")
        self.camera.info = info = cube_scene.camera_info()
        info.K = [1.0, 0, 320, 0, 1.0, 240, 0, 0, 1]
        self.check(RecognizeResponse.BAD_CAMERA_INFO, "fx = 1")
        self.camera.info = info = cube_scene.camera_info()
        info.width, info.height = 320, 240
        self.check(RecognizeResponse.BAD_CAMERA_INFO, "the image is 640x480 but camera_info describes 320x240")
        for field, size in (("K", 9), ("D", 5), ("P", 12)):
            self.camera.info = info = cube_scene.camera_info()
            values = list(getattr(info, field))
            values[0] = float("nan")
            setattr(info, field, values)
            self.assertEqual(len(values), size)
            self.check(RecognizeResponse.BAD_CAMERA_INFO, field + "[0] = nan")
        self.camera.info = cube_scene.camera_info()
        self.check(RecognizeResponse.FOUND)

    def test_slash_before_the_frame(self):
        self.camera.image.header.frame_id = "/" + cube_scene.FRAME
        reply = self.check(RecognizeResponse.FOUND)
        self.assertEqual(reply.objects[0].header.frame_id, cube_scene.FRAME)

    def test_0_twelve_calls_without_an_image(self):
        """All are answered after the same time."""
        self.camera.image = self.camera.info = None
        replies = []
        begin = time.monotonic()
        calls = [threading.Thread(target=lambda: replies.append((self.recognize(""), time.monotonic() - begin)))
                 for _ in range(12)]
        for call in calls:
            call.start()
        for call in calls:
            call.join()
        self.assertEqual({reply.status for reply, _ in replies}, {RecognizeResponse.NO_IMAGE})
        times = [seconds for _, seconds in replies]
        self.assertGreater(min(times), 1.9)
        self.assertLess(max(times) - min(times), 1.9, "they wait for each other")

    def test_odd_stamps(self):
        """Zero, constant and future stamps are told."""
        diagnostics = node_process.Collector()
        subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, diagnostics, queue_size=10)
        for stamp, text in ((lambda: rospy.Time(), "no stamp"), (lambda: rospy.Time(1000), "all have one stamp"),
                            (lambda: rospy.Time.now() + rospy.Duration(7), "s in the future")):
            self.camera.stamp = stamp
            told = diagnostics.wait(lambda message: status_named("camera")(message) and
                                    text in status_of(message, "camera").message)
            self.assertIsNotNone(told, text)
            self.assertEqual(status_of(told, "camera").level, DiagnosticStatus.WARN)
        self.camera.stamp = rospy.Time.now
        diagnostics.clear()
        self.assertIsNotNone(diagnostics.wait(lambda message: status_named("camera")(message) and
                                              status_of(message, "camera").level == DiagnosticStatus.OK))
        subscriber.unregister()

    def test_bad_image(self):
        self.camera.image = cube_scene.image_message(self.cube, "32FC1")
        self.check(RecognizeResponse.BAD_IMAGE, "'32FC1' is not supported", "mono8")
        self.camera.image = cube_scene.image_message(self.cube)
        self.camera.image.data = b""
        self.check(RecognizeResponse.BAD_IMAGE, "empty")
        self.camera.image = cube_scene.image_message(self.cube)
        self.camera.image.header.frame_id = ""
        self.check(RecognizeResponse.BAD_IMAGE, "frame_id is empty", "camera_frame")

    def test_idle_until_someone_listens(self):
        diagnostics = node_process.Collector()
        subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, diagnostics, queue_size=10)
        first = diagnostics.wait(status_named("recognition"))
        self.assertIsNotNone(first)

        def later(message):
            if not status_named("camera")(message):
                return False
            received = int(value_of(status_of(message, "camera"), "images received"))
            return received >= int(value_of(status_of(first, "camera"), "images received")) + 5
        last = diagnostics.wait(later)
        self.assertIsNotNone(last, "images do not arrive")
        worked = [value_of(status_of(message, "recognition"), "images worked on") for message in (first, last)]
        self.assertEqual(worked[0], worked[1])
        objects = node_process.Collector()
        listener = rospy.Subscriber("/recognizer/objects", RecognizedObjectArray, objects, queue_size=10)
        self.assertIsNotNone(objects.wait(lambda array: array.objects))
        listener.unregister()
        subscriber.unregister()

    def test_frame_equals_message(self):
        """tf's transform of <prefix><name>_<n> is the pose of the message, at the image's stamp."""
        objects, frames = node_process.Collector(), node_process.Collector()
        subscribers = [rospy.Subscriber("/tf", TFMessage, frames, queue_size=100),
                       rospy.Subscriber("/recognizer/objects", RecognizedObjectArray, objects, queue_size=100)]
        for _ in range(3):  # the number stays
            array = objects.wait(lambda message: message.objects)
            self.assertIsNotNone(array)
            cube = array.objects[0]
            self.assertEqual(cube.instance, 0)
            self.assertEqual(cube.header.stamp, array.header.stamp)
            message = frames.wait(lambda frame: frame.transforms[0].header.stamp == array.header.stamp)
            self.assertIsNotNone(message)
            transform = message.transforms[0]
            self.assertEqual(transform.header.frame_id, cube_scene.FRAME)
            self.assertEqual(transform.child_frame_id, "left/cube_0")
            position, translation = cube.pose.pose.position, transform.transform.translation
            self.assertEqual((position.x, position.y, position.z), (translation.x, translation.y, translation.z))
            self.assertEqual(cube.pose.pose.orientation, transform.transform.rotation)
            self.assertGreater(array.seconds, 0)
            objects.clear()
        for subscriber in subscribers:
            subscriber.unregister()

    def test_markers_and_overlay(self):
        markers, overlays = node_process.Collector(), node_process.Collector()
        subscribers = [rospy.Subscriber("/recognizer/markers", MarkerArray, markers, queue_size=10),
                       rospy.Subscriber("/recognizer/overlay", Image, overlays, queue_size=10)]
        array = markers.wait(lambda message: any(marker.action == Marker.ADD for marker in message.markers))
        self.assertIsNotNone(array)
        mesh = next(marker for marker in array.markers if marker.action == Marker.ADD)
        self.assertEqual((mesh.type, mesh.ns, mesh.id), (Marker.TRIANGLE_LIST, "cube", 0))
        self.assertEqual(len(mesh.points), 36)
        self.assertLess(cube_scene.distance_to_truth(mesh.pose), 0.006)
        self.assertEqual(mesh.color.a, 1)
        self.assertEqual(mesh.lifetime.to_sec(), 5)  # it goes when the camera dies
        overlay = overlays.wait()
        self.assertIsNotNone(overlay)
        self.assertEqual(overlay.encoding, "bgr8")
        self.assertGreaterEqual(overlay.width, cube_scene.WIDTH)
        self.assertEqual(overlay.header.frame_id, cube_scene.FRAME)
        self.camera.image = cube_scene.image_message(self.flat)
        gone = markers.wait(lambda message: any(marker.action == Marker.DELETE for marker in message.markers))
        self.assertIsNotNone(gone, "the mesh stays although the object is gone")
        for subscriber in subscribers:
            subscriber.unregister()

    def test_view_of_the_camera(self):
        """Where the camera looks, in its frame; not while its calibration cannot be used."""
        views = node_process.Collector()
        subscriber = rospy.Subscriber("/recognizer/view", Marker, views, queue_size=10)
        listener = rospy.Subscriber("/recognizer/objects", RecognizedObjectArray, lambda _: None)
        view = views.wait()
        self.assertIsNotNone(view)
        self.assertEqual(view.header.frame_id, cube_scene.FRAME)
        self.assertTrue(view.frame_locked)
        self.assertGreater(view.lifetime.to_sec(), 0)
        right = max(point.x / point.z for point in view.points if point.z > 0)
        self.assertAlmostEqual(right, (cube_scene.WIDTH - 1 - cube_scene.CX) / cube_scene.FOCAL)
        self.camera.info.K = [0.0] * 9
        for _ in range(2):  # from here on the calibration is bad; what was sent before has arrived
            self.check(RecognizeResponse.BAD_CAMERA_INFO, "K is all zero")
        views.clear()
        self.recognize("")
        self.assertEqual(views.messages, [])
        for one in (subscriber, listener):
            one.unregister()

    def warnings_of(self, info):
        """What a node that is new says of this camera."""
        objects = os.path.join(rospkg.RosPack().get_path("monocular_eye_hand"), "config", "cube.yaml")
        self.camera.info = info
        with node_process.node("recognizer", "other", ["_objects:=" + objects, "_cache:=" + self.cache]) as node:
            service = "/other/recognize"
            rospy.wait_for_service(service, node_process.START)
            status = rospy.ServiceProxy(service, Recognize)("").status
            rospy.ServiceProxy(service, Recognize)("")  # not a second time
            self.assertTrue(node.running())
            text = node.text()
        return status, [line for line in text.splitlines() if "WARN" in line and "camera_info:" in line]

    def test_odd_calibrations_are_warned_of_once(self):
        """A principal point far from the middle, right and down: another binning, or an image that was cropped."""
        for cx, cy in ((590.0, cube_scene.CY), (cube_scene.CX, 30.0)):
            info = cube_scene.camera_info()
            info.K = [cube_scene.FOCAL, 0, cx, 0, cube_scene.FOCAL, cy, 0, 0, 1]
            status, warnings = self.warnings_of(info)
            self.assertNotEqual(status, RecognizeResponse.BAD_CAMERA_INFO)
            self.assertEqual(len(warnings), 1, warnings)
            self.assertIn("far from the middle", warnings[0])
            self.assertIn("binning", warnings[0])
        self.assertEqual(self.warnings_of(cube_scene.camera_info())[1], [])

    def recognized_above(self, frame, height):
        """The reply and the log of a node that knows the plane z = height of a frame, in which the cube stands."""
        objects = os.path.join(rospkg.RosPack().get_path("monocular_eye_hand"), "config", "cube.yaml")
        arguments = ["_objects:=" + objects, "_cache:=" + self.cache, "_continuous:=false", "_support/frame:=" + frame,
                     "_support/height:=%g" % height]
        with node_process.node("recognizer", "above", arguments) as node:
            rospy.wait_for_service("/above/recognize", node_process.START)
            reply = rospy.ServiceProxy("/above/recognize", Recognize)("cube")
            self.assertTrue(node.running())
            return reply, node.text()

    def test_support_plane_from_tf(self):
        broadcaster = tf2_ros.StaticTransformBroadcaster()
        broadcaster.sendTransform(cube_scene.frame_of_the_cube("table"))
        reply, _ = self.recognized_above("table", 0)
        self.assertEqual(reply.status, RecognizeResponse.FOUND, reply.text)
        reply, _ = self.recognized_above("table", 0.03)
        self.assertEqual(reply.status, RecognizeResponse.NOT_FOUND, reply.text)
        self.assertRegex(reply.text, r"reaches (29|30)\.\d mm below the support plane")
        reply, log = self.recognized_above("no_such_frame", 0)  # recognition goes on without
        self.assertEqual(reply.status, RecognizeResponse.FOUND, reply.text)
        self.assertIn("the support plane is not known", log)
        self.assertIn("no_such_frame", log)

    def test_doubtful_candidates(self):
        """What is rejected is published for who merges views, and is no answer."""
        objects = os.path.join(rospkg.RosPack().get_path("monocular_eye_hand"), "config", "cube.yaml")
        arguments = ["_objects:=" + objects, "_cache:=" + self.cache, "_continuous:=false", "_doubtful:=0.1",
                     "_recognition/accept_probability:=0.99999"]
        arrays = node_process.Collector()
        with node_process.node("recognizer", "doubting", arguments) as node:
            rospy.wait_for_service("/doubting/recognize", node_process.START)
            subscriber = rospy.Subscriber("/doubting/objects", RecognizedObjectArray, arrays)
            reply = rospy.ServiceProxy("/doubting/recognize", Recognize)("")
            doubtful = arrays.wait(lambda array: len(array.objects) > 0)
            self.assertTrue(node.running())
            subscriber.unregister()
        self.assertEqual(reply.status, RecognizeResponse.NOT_FOUND, reply.text)
        self.assertEqual(reply.objects, [])
        self.assertIn("probability", doubtful.reason)
        for candidate in doubtful.objects:
            self.assertEqual((candidate.decision, candidate.instance), (RecognizedObject.REJECTED, -1))
            self.assertGreaterEqual(candidate.probability, 0.1)

    def test_lenses_that_cannot_be_used(self):
        """One that folds over inside the image, one with terms that are not known, one that is no lens."""
        for model, coefficients, words in (
                ("plumb_bob", [-0.9, 0.1, 0, 0, 0], "folds over inside the image"),
                ("rational_polynomial", [0.1] * 8 + [0.004, 0, 0, 0], "thin prism terms"),
                ("omnidirectional", [0.1], "'omnidirectional' is not supported")):
            self.camera.info = cube_scene.camera_info()
            self.camera.info.distortion_model, self.camera.info.D = model, coefficients
            self.check(RecognizeResponse.BAD_CAMERA_INFO, words, "/camera_info")
        # The matrix of a binned image with the size of the whole one.
        self.camera.info = cube_scene.camera_info()
        self.camera.info.K = [150, 0, 80, 0, 150, 60, 0, 0, 1]
        self.camera.info.width, self.camera.info.height = 1280, 960
        self.check(RecognizeResponse.BAD_CAMERA_INFO, "the image is 640x480 but camera_info describes 1280x960")

    def test_packed_yuv_of_usb_cameras(self):
        picture = numpy.full(self.cube.shape + (2,), 128, numpy.uint8)
        for encoding, grey in (("yuv422_yuy2", 0), ("yuyv", 0), ("yuv422", 1)):
            pixels = picture.copy()
            pixels[:, :, grey] = self.cube
            self.camera.image = cube_scene.image_message(pixels, encoding)
            self.check(RecognizeResponse.FOUND, "found cube_0")

    def test_nothing_found_is_published_with_a_reason(self):
        self.camera.image = cube_scene.image_message(self.flat)
        objects = node_process.Collector()
        subscriber = rospy.Subscriber("/recognizer/objects", RecognizedObjectArray, objects, queue_size=10)
        array = objects.wait(lambda message: not message.objects)
        self.assertIsNotNone(array)
        self.assertNotEqual(array.reason, "")
        subscriber.unregister()

    def test_diagnostics(self):
        diagnostics = node_process.Collector()
        subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, diagnostics, queue_size=10)
        self.camera.info.K = [0.0] * 9
        self.recognize("")

        def camera_is(level, text=""):  # the state of an earlier image may still be on its way
            return lambda message: (status_named("camera")(message) and status_of(message, "camera").level == level
                                    and text in status_of(message, "camera").message)
        self.assertIsNotNone(diagnostics.wait(camera_is(DiagnosticStatus.ERROR, "K is all zero")))
        self.camera.info = cube_scene.camera_info()
        self.check(RecognizeResponse.FOUND)
        diagnostics.clear()
        good = diagnostics.wait(camera_is(DiagnosticStatus.OK))
        self.assertIsNotNone(good)
        self.assertIn("640x480 mono8", status_of(good, "camera").message)
        self.assertGreater(float(value_of(status_of(good, "recognition"), "seconds for the last image")), 0)
        subscriber.unregister()


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "recognizer", TestRecognizer)
