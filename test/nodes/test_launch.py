#!/usr/bin/python3
"""image.launch, bag.launch and their helpers from end to end, on files that this test writes."""
import os
import shutil
import signal
import sys
import tempfile
import time
import unittest
import xmlrpc.client

import rosgraph
import roslib.packages
import rospkg
import rospy
import rostest
import tf2_ros
from monocular_eye_hand.msg import RecognizedObjectArray
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Image
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import cube_scene
import node_process
import scene_files

BAG_START = 1600000000.0  # in the past: works only with the bag's clock


class TestLaunch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_launch")

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        config = os.path.join(rospkg.RosPack().get_path("monocular_eye_hand"), "config")
        self.objects = "objects:=" + os.path.join(config, "cube.yaml")
        self.arrays, self.frames, self.clock = (node_process.Collector() for _ in range(3))
        self.subscribers = [
            rospy.Subscriber("/recognizer/objects", RecognizedObjectArray, self.arrays, queue_size=100),
            rospy.Subscriber("/tf", TFMessage, self.frames, queue_size=100),
            rospy.Subscriber("/clock", Clock, self.clock, queue_size=100)]

    def tearDown(self):
        for subscriber in self.subscribers:
            subscriber.unregister()
        shutil.rmtree(self.folder)

    def expect_cube(self, process):
        array = self.arrays.wait(lambda message: message.objects)
        self.assertIsNotNone(array, process.text())
        cube = array.objects[0]
        self.assertEqual((cube.name, cube.instance), ("cube", 0))
        self.assertLess(cube_scene.distance_to_truth(cube.pose.pose), 0.006)
        frame = self.frames.wait(lambda message: message.transforms[0].child_frame_id == "cube_0")
        self.assertIsNotNone(frame, process.text())
        return array

    def test_image(self):
        scene_files.write_cube_files(self.folder)
        with node_process.launch("image.launch", [
                "source:=" + self.folder + "/cube.pgm", "camera_info:=" + self.folder + "/camera.yaml", self.objects,
                "camera_frame:=left_optical", "rate:=5"]) as process:
            array = self.expect_cube(process)
            self.assertEqual(array.header.frame_id, "left_optical")

    def test_unrelated_images_leave_no_ghosts(self):
        """What rviz shows after an image is what was found in it, and nothing of the one before."""
        os.mkdir(self.folder + "/images")
        scene_files.write_cube_files(self.folder)
        shutil.move(self.folder + "/cube.pgm", self.folder + "/images/1.pgm")
        scene_files.write_pgm(self.folder + "/images/2.pgm", cube_scene.flat_picture())
        markers = node_process.Collector()
        subscriber = rospy.Subscriber("/recognizer/markers", MarkerArray, markers, queue_size=100)
        with node_process.launch("image.launch", [
                "source:=" + self.folder + "/images", "camera_info:=" + self.folder + "/camera.yaml", self.objects,
                "rate:=1"]) as process:
            for _ in range(2):  # the cube comes, goes, and comes again
                self.assertIsNotNone(self.arrays.wait(lambda message: message.objects), process.text())
                self.assertIsNotNone(self.arrays.wait(lambda message: not message.objects), process.text())
                self.arrays.clear()
            self.assertTrue(markers.wait_count(3), process.text())
        subscriber.unregister()
        shown, sizes = set(), set()
        for message in [message for message in markers.messages if message.markers]:
            for marker in message.markers:
                key = (marker.ns, marker.id)
                if marker.action == Marker.DELETEALL:
                    shown = set()
                elif marker.action == Marker.DELETE:
                    shown.discard(key)
                else:
                    shown.add(key)
            stamp = message.markers[-1].header.stamp
            added = {(m.ns, m.id) for m in message.markers if m.action == Marker.ADD and m.header.stamp == stamp}
            self.assertEqual(shown, added)
            sizes.add(len(shown))
        self.assertEqual(sizes, {0, 3})  # nothing, or the cube with its axes and text

    def kill_recognizer(self):
        """As a crash does."""
        uri = rosgraph.Master("/test").lookupNode("/recognizer")
        os.kill(xmlrpc.client.ServerProxy(uri).getPid("/test")[2], signal.SIGKILL)
        return uri

    def test_recognizer_is_started_again(self):
        """A robot's launch goes on, in mid-stream; its markers are deleted by the new one."""
        scene_files.write_cube_files(self.folder)
        markers = node_process.Collector()
        subscriber = rospy.Subscriber("/recognizer/markers", MarkerArray, markers, queue_size=100)
        with node_process.launch("image.launch", [
                "source:=" + self.folder + "/cube.pgm", "camera_info:=" + self.folder + "/camera.yaml", self.objects,
                "required:=false"]) as process:
            for _ in range(2):
                self.expect_cube(process)
                markers.clear()
                uri = self.kill_recognizer()
                self.arrays.clear()
                self.frames.clear()
            self.expect_cube(process)
            self.assertTrue(process.running(), process.text())
            self.assertNotEqual(rosgraph.Master("/test").lookupNode("/recognizer"), uri)
            first = markers.wait(lambda message: any(m.action == Marker.DELETEALL for m in message.markers))
            self.assertIsNotNone(first)
        subscriber.unregister()

    def test_a_required_recognizer_ends_the_launch(self):
        scene_files.write_cube_files(self.folder)
        with node_process.launch("image.launch", [
                "source:=" + self.folder + "/cube.pgm", "camera_info:=" + self.folder + "/camera.yaml",
                self.objects]) as process:
            self.expect_cube(process)
            self.kill_recognizer()
            self.assertIsNotNone(process.exit_code(), process.text())

    def test_camera_view_takes_the_frame_of_the_image(self):
        """Of two cameras: one that writes a leading slash, one that names no frame at first."""
        camera = cube_scene.Camera("/left/")
        frames = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(frames)
        image = cube_scene.image_message(cube_scene.flat_picture())
        for first, frame in (("/left_optical", "left_optical"), ("", "other_optical")):
            name = frame + "_view"
            with node_process.node("camera_view", name, ["_view_frame:=" + name, "image_raw:=/left/image_raw"]) as node:
                image.header.frame_id = first
                camera.image = image
                if not first:
                    self.assertTrue(self.said(node, "camera_frame:=FRAME"), node.text())
                    image.header.frame_id = frame
                self.assertTrue(frames.can_transform(frame, name, rospy.Time(0), rospy.Duration(node_process.START)),
                                node.text())
                q = frames.lookup_transform(frame, name, rospy.Time(0)).transform.rotation
                turn = cube_scene.matrix_of(q)  # ahead is the optical z, up the optical -y
                self.assertLess(abs(turn[:, 0] - [0, 0, 1]).max() + abs(turn[:, 2] - [0, -1, 0]).max(), 1e-9)
        camera.timer.shutdown()
        listener.unregister()

    def said(self, process, words):
        end = time.monotonic() + node_process.START
        while words not in process.text() and time.monotonic() < end:
            time.sleep(0.1)
        return words in process.text()

    def test_camera_view_without_images_says_what_to_give(self):
        with node_process.node("camera_view", "lonely_view", ["image_raw:=/nowhere"]) as node:
            self.assertTrue(self.said(node, "camera:=NAMESPACE"), node.text())

    def test_camera_view_needs_no_image_when_it_is_told_the_frame(self):
        frames = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(frames)
        arguments = ["_camera_frame:=eye", "_view_frame:=lonely_view", "image_raw:=/nowhere"]
        with node_process.node("camera_view", "lonely_view", arguments) as node:
            self.assertTrue(frames.can_transform("eye", "lonely_view", rospy.Time(0), rospy.Duration(node_process.START)),
                            node.text())
        listener.unregister()

    def player(self, *arguments):
        paths = roslib.packages.find_node("monocular_eye_hand", "play_bag")
        return node_process.Process([paths[0], "__name:=player"] + list(arguments))

    def test_bag_lacks_topics(self):
        bag = self.folder + "/cube.bag"
        scene_files.write_cube_bag(bag, BAG_START, 1, 0.5)
        with self.player("--bag", bag, "--topics", "/left/image_raw", "/left/camera_info") as process:
            self.assertEqual(process.exit_code(), 1, process.text())
            self.assertIn("the bag has no /left/image_raw, /left/camera_info; its images: /camera/image_raw",
                          process.text())
        for path, words in ((self.folder + "/none.bag", "there is no file"), (__file__, "cannot be read as a bag")):
            with self.player("--bag", path, "--topics", "/camera/image_raw") as process:
                self.assertEqual(process.exit_code(), 1, process.text())
                self.assertIn(words, process.text())

    def test_bag_waits_for_who_is_to_see_it(self):
        """As for rviz: nothing is played before the overlay has a subscriber. At the end it says that the clock stands."""
        bag = self.folder + "/cube.bag"
        scene_files.write_cube_bag(bag, BAG_START, 3, 0.2)
        images = node_process.Collector()
        subscribers = [rospy.Subscriber("/camera/image_raw", Image, images, queue_size=10)]
        with self.player("--bag", bag, "--topics", "/camera/image_raw", "--wait-for", "/some/overlay",
                         "/some/markers") as process:
            self.assertTrue(self.said(process, "waits for a subscriber of /some/overlay, /some/markers"), process.text())
            self.assertEqual(images.messages, [])
            subscribers += [rospy.Subscriber(topic, Image, images) for topic in ("/some/overlay", "/some/markers")]
            self.assertTrue(images.wait_count(3), process.text())
            self.assertEqual(process.exit_code(), 0, process.text())
            self.assertIn("the bag is over and /clock stands", process.text())
        for subscriber in subscribers:
            subscriber.unregister()

    def test_bag_whose_clock_does_not_tick(self):
        """A topic that nobody subscribes to holds the player: it is named."""
        bag = self.folder + "/cube.bag"
        scene_files.write_cube_bag(bag, BAG_START, 3, 0.2)
        subscriber = rospy.Subscriber("/camera/image_raw", Image, lambda _: None)
        with self.player("--bag", bag, "--topics", "/camera/image_raw", "/camera/camera_info", "/tf_odd") as process:
            self.assertTrue(self.said(process, "/clock does not tick"), process.text())
            self.assertIn("waits for a subscriber of /camera/camera_info", process.text())
            self.assertIn("the bag has no /tf_odd", process.text())
        subscriber.unregister()

    def test_bag(self):
        bag = self.folder + "/cube.bag"
        scene_files.write_cube_bag(bag, BAG_START, 5, 0.5)
        with node_process.launch("bag.launch", ["bag:=" + bag, self.objects]) as process:
            array = self.expect_cube(process)
            self.assertEqual(array.header.frame_id, cube_scene.FRAME)
            # The first image is not lost: playing waits for the node.
            self.assertEqual(self.arrays.messages[0].header.stamp.to_sec(), BAG_START)
            self.assertTrue(rospy.get_param("/use_sim_time"))
            clock = self.clock.wait()
            self.assertIsNotNone(clock)
            self.assertLess(abs(clock.clock.to_sec() - BAG_START), 10)


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "launch", TestLaunch)
