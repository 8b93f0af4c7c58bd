#!/usr/bin/python3
"""The node eye_hand against an arm, a camera and a recogniser that this test plays: poses in the base, covariances,
what is late or missing or broken, every answer of the services."""
import os
import sys
import unittest

import numpy
import rospkg
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseArray
from sensor_msgs.msg import CameraInfo
from std_msgs.msg import Header
from visualization_msgs.msg import Marker, MarkerArray

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import eye_hand_scene as scene
import node_process
from monocular_eye_hand.msg import GraspTargetArray, GripperState, LocatedObjectArray, RecognizedObjectArray
from monocular_eye_hand.srv import ForgetObject, GraspTargets, GraspTargetsResponse

TABLE = 0.3  # [m]
BRIDGE = scene.transform(scene.rotation(0, 0, 0.3), [0.62, -0.15, TABLE])
GRENADE = scene.transform(scene.rotation(0, 0, -1), [0.62, 0.02, TABLE])
FRAME = scene.transform(numpy.eye(3), [0.62, -0.15, TABLE])  # the bridge stands in it
GOOD = numpy.diag([1e-4**2] * 2 + [3e-4**2] + [1e-3**2] * 3)  # [m^2, rad^2]
POOR = 3600 * GOOD


def covariance_of(pose):
    return numpy.array(pose.covariance).reshape(6, 6)


class TestEyeHand(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_eye_hand")
        package = rospkg.RosPack().get_path("monocular_eye_hand")
        cls.arm = scene.Arm()
        cls.arm.joint_states = False
        cls.recognizer = rospy.Publisher("/recognizer/objects", RecognizedObjectArray, queue_size=100)
        cls.info = rospy.Publisher("/camera_info", CameraInfo, queue_size=1, latch=True)
        cls.located = node_process.Collector()
        cls.listener = rospy.Subscriber("/eye_hand/objects", LocatedObjectArray, cls.located, queue_size=100)
        cls.node = node_process.node("eye_hand", "eye_hand", [
            "_objects:=" + package + "/config/objects.yaml", "_urdf:=" + package + "/urdf/puma560.urdf",
            "_table_height:=%g" % TABLE, "_wait:=1.5", "_max_joint_gap:=1.0", "_max_joint_age:=2.0",
            "_diagnostic_period:=0.5"])
        for name in ("grasp_targets", "forget"):
            rospy.wait_for_service("/eye_hand/" + name, node_process.START)
        cls.grasp_targets = rospy.ServiceProxy("/eye_hand/grasp_targets", GraspTargets)
        cls.forget = rospy.ServiceProxy("/eye_hand/forget", ForgetObject)
        end = rospy.Time.now() + rospy.Duration(node_process.START)
        while cls.recognizer.get_num_connections() == 0 and rospy.Time.now() < end:
            rospy.sleep(0.05)

    @classmethod
    def tearDownClass(cls):
        cls.arm.timer.shutdown()
        cls.node.stop()

    def setUp(self):
        self.assertTrue(self.node.running(), self.node.text())
        self.arm.joints, self.arm.offset = scene.ABOVE, numpy.zeros(3)
        self.arm.tf = True
        self.arm.split, self.arm.hidden, self.arm.turning = False, [], 0
        self.forget("", -1)

    def tearDown(self):
        self.assertTrue(self.node.running(), self.node.text())

    # What the recogniser says, and what comes of it.
    def see(self, named, covariance=GOOD, change=lambda objects: None, frame=scene.CAMERA, stamp=None):
        """Publishes a view of (name, base_from_object) pairs and returns what eye_hand says of it."""
        stamp = stamp or self.arm.stamp()
        objects = [scene.recognized(name, pose, self.arm.joints, covariance) for name, pose in named]
        change(objects)
        self.recognizer.publish(scene.view(stamp, objects, frame))
        return self.answer_to(stamp)

    def answer_to(self, stamp):
        array = self.located.wait(lambda message: message.header.stamp == stamp)
        self.assertIsNotNone(array, self.node.text())
        self.assertEqual(array.header.frame_id, "base_link")
        return array

    def use(self, named, covariance=GOOD):
        array = self.see(named, covariance)
        self.assertEqual(array.refused, "")
        return array

    def refuse(self, words, **view):
        array = self.see([("bridge", BRIDGE)], **view)
        self.assertEqual(array.objects, [])
        for word in words:
            self.assertIn(word, array.refused)

    def near(self, located, truth, metres=1e-6, radians=1e-6):
        motion = scene.motion_between(truth, scene.pose_matrix(located.pose.pose))
        self.assertLess(numpy.linalg.norm(motion[:3]), metres)
        self.assertLess(numpy.linalg.norm(motion[3:]), radians)

    def ask(self, status, *words, name="bridge", instance=-1):
        reply = self.grasp_targets(name, instance)
        self.assertEqual(reply.status, status, reply.text)
        self.assertGreater(len(reply.text), 5)
        for word in words:
            self.assertIn(word, reply.text)
        if status != GraspTargetsResponse.FOUND:
            self.assertEqual(reply.targets, [])
        return reply

    # The first ones need a node to which the arm has not spoken yet: unittest runs by name.
    def test_00_no_view(self):
        self.ask(GraspTargetsResponse.NOT_READY, "no view was received yet")

    def test_01_no_camera_info(self):
        self.refuse(["no camera_info on /camera_info"])
        self.ask(GraspTargetsResponse.NOT_READY, "no view could be used yet", "no camera_info on /camera_info")
        broken = scene.camera_info()
        broken.K = [0.0] * 9
        self.info.publish(broken)
        rospy.sleep(0.3)
        self.refuse(["bad camera_info on /camera_info: K is all zero"])

    def test_02_no_hand_eye(self):
        self.info.publish(scene.camera_info())
        rospy.sleep(0.3)
        self.refuse(["no transform from camera_optical_frame to tool0", "hand-eye"])
        self.ask(GraspTargetsResponse.NOT_READY, "hand-eye")

    def test_03_no_joint_states(self):
        self.arm.hang_camera()
        rospy.sleep(0.3)
        self.refuse(["no joint state within 1 s of the image's stamp on /joint_states", "no message came"])
        self.arm.joint_states = True
        self.assertEqual(self.use([("bridge", BRIDGE)]).objects[0].name, "bridge")
        self.ask(GraspTargetsResponse.FOUND)
        self.arm.joint_states = False
        rospy.sleep(2.5)
        self.ask(GraspTargetsResponse.NOT_READY, "the last joint state on /joint_states is", "s old")
        self.arm.joint_states = True

    def test_pose_and_covariance(self):
        array = self.use([("bridge", BRIDGE), ("frame", FRAME)])
        self.assertEqual([one.name for one in array.objects], ["bridge", "frame"])
        for located, truth in zip(array.objects, (BRIDGE, FRAME)):
            self.near(located, truth)
            self.assertEqual((located.instance, located.views, located.misses), (0, 1, 0))
            self.assertEqual((located.header.stamp, located.header.frame_id), (array.header.stamp, "base_link"))
            self.assertEqual(located.probability, 0.99)
            self.assertFalse(located.free_axis)
            published = covariance_of(located.pose)
            least = scene.expected_covariance(truth, scene.ABOVE, GOOD)
            # Beside the shares of image, hand-eye and arm only what CAD and part differ by, equal on every axis.
            rest = published - least
            self.assertGreater(numpy.linalg.eigvalsh(rest)[0], 0)
            self.assertLess(numpy.abs(rest - numpy.diag(numpy.diag(rest))).max(), 1e-3 * least.max())
            self.assertLess(rest[:3, :3].max(), 3e-8)
            self.assertLess(rest[3:, 3:].max(), 3e-6)

    def test_two_views(self):
        shift = scene.transform(numpy.eye(3), [0.0004, 0, 0])
        first = self.use([("bridge", shift @ BRIDGE)]).objects[0]
        self.arm.joints = scene.ASIDE
        second = self.use([("bridge", numpy.linalg.inv(shift) @ BRIDGE)])
        self.assertEqual(len(second.objects), 1)
        merged = second.objects[0]
        self.assertEqual((merged.instance, merged.views), (0, 2))
        self.near(merged, BRIDGE, 3e-4, 1e-6)
        self.assertLess(covariance_of(merged.pose).trace(), covariance_of(first.pose).trace())
        # A common error of hand-eye and joints is not averaged away.
        common = scene.expected_covariance(BRIDGE, scene.ASIDE, 0 * GOOD)
        self.assertGreater(covariance_of(merged.pose)[0, 0], 0.5 * common[0, 0])

    def test_two_of_a_name_and_misses(self):
        other = scene.transform(numpy.eye(3), [0, 0.15, 0]) @ BRIDGE
        array = self.use([("bridge", BRIDGE), ("bridge", other)])
        self.assertEqual([one.instance for one in array.objects], [0, 1])
        array = self.use([("bridge", other)])
        self.assertEqual([one.misses for one in array.objects], [1, 0])
        for misses in (2, 3, 4):
            array = self.use([("bridge", other)])
            self.assertEqual([one.misses for one in array.objects], [misses, 0])
        array = self.use([("bridge", other)])  # the fifth view that should have shown it
        self.assertEqual([one.instance for one in array.objects], [1])

    def test_cut_search_misses_nothing(self):
        self.use([("bridge", BRIDGE)])
        stamp = self.arm.stamp()
        view = scene.view(stamp, [])
        view.truncated = True
        self.recognizer.publish(view)
        self.assertEqual(self.answer_to(stamp).objects[0].misses, 0)

    def test_a_hand_that_holds_or_moves_misses_nothing(self):
        self.use([("bridge", BRIDGE)])
        gripper = rospy.Publisher("/gripper/state", GripperState, queue_size=10, latch=True)
        for stalled, misses in ((True, 0), (False, 1)):
            stamp = self.arm.stamp()
            gripper.publish(GripperState(header=Header(stamp=stamp), width=0.04, stalled=stalled))
            rospy.sleep(0.3)
            self.assertEqual(self.use([]).objects[0].misses, misses)
        self.arm.turning = 0.3
        rospy.sleep(0.3)
        self.assertEqual(self.use([]).objects[0].misses, 1)
        self.arm.turning = 0
        rospy.sleep(0.3)
        self.assertEqual(self.use([]).objects[0].misses, 2)

    def test_missing_tf(self):
        self.refuse(["no transform from other_camera to tool0"], frame="other_camera")
        self.refuse(["no transform from tool0 to base_link"], stamp=rospy.Time.now() + rospy.Duration(100))
        self.refuse(["no transform from tool0 to base_link"], stamp=rospy.Time.now() - rospy.Duration(1000))
        self.assertEqual(len(self.use([("bridge", BRIDGE)]).objects), 1)

    def test_late_tf(self):
        self.arm.tf = False
        stamp = rospy.Time.now()
        self.recognizer.publish(scene.view(stamp, [scene.recognized("bridge", BRIDGE, scene.ABOVE, GOOD)]))
        rospy.sleep(0.3)
        self.assertFalse([m for m in list(self.located.messages) if m.header.stamp == stamp])
        self.arm.tf = True
        array = self.answer_to(stamp)
        self.assertEqual(array.refused, "")
        self.near(array.objects[0], BRIDGE)

    def test_tf_of_another_arm(self):
        self.arm.offset = numpy.array([0, 0.02, 0])
        self.refuse(["tf puts tool0 20 mm", "joint states"])

    def test_broken_views(self):
        def changed(change):
            return lambda objects: change(objects[0])

        def name(one): one.name = "spoon"
        def position(one): one.pose.pose.position.y = float("nan")
        def orientation(one): one.pose.pose.orientation.w = float("inf")
        def zero(one): one.pose.pose.orientation = type(one.pose.pose.orientation)()
        def covariance(one): one.pose.covariance = [float("nan")] * 36
        def negative(one): one.pose.covariance = (-GOOD).ravel().tolist()
        def probability(one): one.probability = 7
        for change, words in [
                (name, ["'spoon' is not in the model base (bridge, grenade, frame, flange, bracket)"]),
                (position, ["the pose of bridge is not finite"]),
                (orientation, ["the orientation of bridge has length"]),
                (zero, ["the orientation of bridge has length 0"]),
                (covariance, ["the covariance of bridge"]),
                (negative, ["the covariance of bridge"]),
                (probability, ["probability of bridge = 7"])]:
            self.refuse(words, change=changed(change))
        self.refuse(["frame_id"], frame="")
        self.recognizer.publish(scene.view(rospy.Time(), []))
        self.assertIn("no stamp", self.answer_to(rospy.Time()).refused)
        self.assertEqual(len(self.use([("bridge", BRIDGE)]).objects), 1)

    def test_older_view(self):
        array = self.use([("bridge", BRIDGE)])
        again = self.see([("bridge", BRIDGE)], stamp=array.header.stamp - rospy.Duration(0.2))
        self.assertIn("not newer", again.refused)
        self.assertEqual(again.objects, array.objects)

    def test_stamps_that_begin_again(self):
        """A bag that is played again without a clock: a new map, not a refusal for ever."""
        array = self.use([("bridge", BRIDGE), ("bridge", scene.transform(numpy.eye(3), [0, 0.15, 0]) @ BRIDGE)])
        rospy.sleep(2)
        self.use([("grenade", GRENADE)])
        again = self.see([("bridge", BRIDGE)], stamp=array.header.stamp + rospy.Duration(0.02))
        self.assertEqual(again.refused, "")
        self.assertEqual([(one.name, one.instance, one.views) for one in again.objects], [("bridge", 0, 1)])
        self.assertIn("the stamps of the views went back by", self.node.text())
        rospy.sleep(0.2)
        self.assertEqual(self.use([("bridge", BRIDGE)]).objects[0].instance, 0)

    def test_what_cannot_be_there(self):
        """Below the table's top nothing is; what stands on it beside that is used."""
        def lowered(matrix, depth):
            return scene.transform(numpy.eye(3), [0, 0, -depth]) @ matrix
        array = self.use([("bridge", lowered(BRIDGE, 0.010)), ("bracket", lowered(FRAME, 0.040)), ("grenade", GRENADE)])
        self.assertEqual([one.name for one in array.objects], ["grenade"])
        self.assertEqual(len(array.ruled_out), 2)
        self.assertIn("bridge: reaches 10.0 mm below the table's top", array.ruled_out[0])
        self.assertIn("bracket: reaches 40.0 mm below", array.ruled_out[1])
        self.ask(GraspTargetsResponse.NOT_KNOWN, "no bridge is known")
        array = self.use([("bridge", lowered(BRIDGE, 0.002))])
        self.assertEqual(array.ruled_out, [])
        self.assertIn("bridge", [one.name for one in array.objects])

    def test_what_the_hand_is(self):
        """A part where the hand itself is was seen wrongly."""
        in_hand = scene.base_from_tool0(self.arm.joints) @ scene.transform(numpy.eye(3), [0, 0, 0.05])
        array = self.use([("bracket", in_hand), ("grenade", GRENADE)])
        self.assertEqual([one.name for one in array.objects], ["grenade"])
        self.assertEqual(array.ruled_out, ["bracket: reaches into the hand"])

    def test_slash_before_the_frame(self):
        array = self.see([("bridge", BRIDGE)], frame="/" + scene.CAMERA)
        self.assertEqual(array.refused, "")
        self.near(array.objects[0], BRIDGE)

    def test_split_joints(self):
        self.arm.split = True
        rospy.sleep(0.3)
        self.near(self.use([("bridge", BRIDGE)]).objects[0], BRIDGE)
        self.ask(GraspTargetsResponse.FOUND)

    def test_a_joint_that_is_not_told(self):
        self.arm.split, self.arm.hidden = True, ["joint5"]
        rospy.sleep(2.5)
        self.refuse(["no joint state within 1 s of the image's stamp"])

    def test_body_frame(self):
        """The driver names the body's frame (x forward): told, whether tf has the optical one or not."""
        body_from_optical = scene.transform(numpy.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]]), [0, 0, 0])
        tool0_from_body = scene.TOOL0_FROM_CAMERA @ numpy.linalg.inv(body_from_optical)
        stamp = rospy.Time.now()
        self.arm.static.sendTransform(scene.stamped("tool0", "camera_link", tool0_from_body, stamp))
        rospy.sleep(0.3)
        self.refuse(["camera_link seems to be the body of the camera", "camera_frame"], frame="camera_link")
        self.arm.static.sendTransform(
            scene.stamped("camera_link", "left_optical_frame", body_from_optical, stamp))
        rospy.sleep(0.3)
        self.refuse(["camera_link is the body of the camera", "left_optical_frame"], frame="camera_link")
        self.assertEqual(self.see([("bridge", BRIDGE)], frame="left_optical_frame").refused, "")

    def test_a_view_from_before_a_forget_is_no_trouble(self):
        self.use([("bridge", BRIDGE), ("grenade", GRENADE)])
        stamp = self.arm.stamp()
        said = self.node.text().count("a view is not used")
        self.forget("bridge", 0)
        array = self.see([("bridge", BRIDGE)], stamp=stamp)
        self.assertIn("older than the last ~forget", array.refused)
        self.assertEqual([one.name for one in array.objects], ["grenade"])
        self.assertEqual(self.node.text().count("a view is not used"), said)

    def test_on_request_is_no_alarm(self):
        """A recogniser that waits to be asked is silent, and nothing is wrong."""
        rospy.set_param("/recognizer/on_request", True)
        self.addCleanup(rospy.delete_param, "/recognizer/on_request")
        self.use([("bridge", BRIDGE)])
        rospy.sleep(10.5)
        diagnostics = node_process.Collector()
        subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, diagnostics, queue_size=10)
        heard = diagnostics.wait(lambda message: any(one.name == "eye_hand: views" for one in message.status))
        subscriber.unregister()
        views = [one for one in heard.status if one.name == "eye_hand: views"][0]
        self.assertEqual((views.level, views.message), (DiagnosticStatus.OK, "knows bridge 0"))

    def test_grasps_found(self):
        array = self.use([("bridge", BRIDGE), ("grenade", GRENADE)])
        reply = self.ask(GraspTargetsResponse.FOUND, "bridge 0", "grasps")
        best = reply.targets[0]
        self.assertEqual((best.name, best.instance, best.feasible), ("bridge", 0, True))
        self.assertEqual(best.header, array.objects[0].header)
        self.assertEqual(best.object, array.objects[0].pose)
        qualities = [target.quality for target in reply.targets]
        self.assertEqual(qualities, sorted(qualities, reverse=True))
        tool0_from_tcp = scene.transform(numpy.eye(3), [0, 0, 0.16])
        for target in reply.targets:
            for pose, joints in ((target.pregrasp, target.pregrasp_joints), (target.grasp, target.grasp_joints),
                                 (target.retreat, target.retreat_joints)):
                reached = scene.base_from_tool0(joints) @ tool0_from_tcp
                self.assertLess(numpy.abs(scene.pose_matrix(pose) - reached).max(), 1e-6)
            tip = numpy.array([target.grasp.position.x, target.grasp.position.y, target.grasp.position.z])
            self.assertLess(numpy.linalg.norm(tip - BRIDGE[:3, 3]), 0.1)
            self.assertGreater(tip[2], TABLE)
            self.assertLess(target.approach.z, 0)
            self.assertGreater(target.free, target.needed)
            self.assertGreater(target.opening, target.width)
            self.assertEqual(len(target.branch.split("-")), 3)
            self.assertNotEqual(target.reason, "")
        self.ask(GraspTargetsResponse.FOUND, "grenade 0", name="grenade", instance=0)

    def test_other_objects_are_in_the_way(self):
        self.use([("bridge", BRIDGE)])
        alone = self.ask(GraspTargetsResponse.FOUND)
        self.forget("", -1)
        walls = [("bracket", scene.transform(numpy.eye(3), [0, side, 0]) @ BRIDGE) for side in (-0.05, 0.05)]
        self.use([("bridge", BRIDGE)] + walls)
        among = self.grasp_targets("bridge", -1)
        self.assertNotEqual([t.grasp for t in among.targets], [t.grasp for t in alone.targets])

    def test_no_grasp(self):
        self.ask(GraspTargetsResponse.NO_GRASP, "frame is an obstacle", name="frame")
        far = scene.transform(numpy.eye(3), [0, 1.2, 0]) @ BRIDGE  # out of reach
        self.use([("bridge", far)])
        self.ask(GraspTargetsResponse.NO_GRASP, "bridge 0: ")

    def test_too_uncertain(self):
        self.use([("bridge", BRIDGE)], POOR)
        self.ask(GraspTargetsResponse.TOO_UNCERTAIN, "bridge 0: ")

    def test_not_known(self):
        self.use([("grenade", GRENADE)])
        self.ask(GraspTargetsResponse.NOT_KNOWN, "no bridge is known", "known now: grenade 0")
        self.ask(GraspTargetsResponse.NOT_KNOWN, "no grenade 3 is known", name="grenade", instance=3)
        self.ask(GraspTargetsResponse.UNKNOWN_NAME, "'spoon'", "known: bridge, grenade, frame", name="spoon")

    def test_forget(self):
        other = scene.transform(numpy.eye(3), [0, 0.15, 0]) @ BRIDGE
        seen = self.use([("bridge", BRIDGE), ("bridge", other), ("frame", FRAME)])
        self.located.clear()
        reply = self.forget("bridge", 0)
        self.assertEqual((reply.forgotten, reply.text), (1, "forgot bridge 0"))
        told = self.located.wait()  # at once, without a view
        self.assertEqual(told.header.stamp, seen.header.stamp)
        self.assertEqual([(one.name, one.instance) for one in told.objects], [("bridge", 1), ("frame", 0)])
        reply = self.forget("bridge", 0)
        self.assertEqual((reply.forgotten, reply.text), (0, "no bridge 0 is known"))
        reply = self.forget("spoon", -1)
        self.assertEqual(reply.forgotten, 0)
        self.assertIn("'spoon'", reply.text)
        self.assertEqual(self.forget("bridge", -1).forgotten, 1)
        self.assertEqual(self.forget("", -1).forgotten, 1)
        self.assertEqual(self.use([("bridge", BRIDGE)]).objects[0].instance, 0)

    def test_grasps_and_markers_for_those_who_listen(self):
        self.use([("bridge", BRIDGE), ("frame", FRAME)])
        best, poses, markers = (node_process.Collector() for _ in range(3))
        subscribers = [rospy.Subscriber("/eye_hand/best_grasps", GraspTargetArray, best, queue_size=10),
                       rospy.Subscriber("/eye_hand/grasp_poses", PoseArray, poses, queue_size=10),
                       rospy.Subscriber("/eye_hand/markers", MarkerArray, markers, queue_size=10)]
        array = best.wait(lambda message: message.targets)  # without another view
        self.assertIsNotNone(array)
        self.assertEqual([target.name for target in array.targets], ["bridge"])
        poses_at_best = poses.wait(lambda message: message.poses)
        self.assertEqual(poses_at_best.header.frame_id, "base_link")
        if array.targets[0].feasible:
            self.assertEqual(poses_at_best.poses[0], array.targets[0].grasp)
        self.use([("bridge", BRIDGE), ("frame", FRAME)])  # markers, too
        mesh = markers.wait(lambda message: any(m.type == Marker.TRIANGLE_LIST for m in message.markers))
        self.assertIsNotNone(mesh)
        bridge = next(m for m in mesh.markers if m.ns == "bridge" and m.type == Marker.TRIANGLE_LIST)
        self.assertEqual(bridge.header.frame_id, "base_link")
        self.assertLess(numpy.abs(scene.pose_matrix(bridge.pose) - BRIDGE).max(), 1e-6)
        self.assertEqual(bridge.color.a, 1)
        arrow = markers.wait(lambda message: any(m.ns == "bridge/grasp" for m in message.markers))
        self.assertIsNotNone(arrow)
        # What lasts is shown again and again without another view, and would go with the node.
        for space in ("bridge", "bridge/grasp", "frame/label"):
            markers.clear()
            again = markers.wait(lambda message: any(m.ns == space for m in message.markers))
            self.assertIsNotNone(again, space)
            self.assertGreater(next(m for m in again.markers if m.ns == space).lifetime.to_sec(), 0)
        markers.clear()
        self.forget("bridge", -1)
        gone = markers.wait(lambda message: any(
            m.ns == "bridge/grasp" and m.action == Marker.DELETE for m in message.markers))
        self.assertIsNotNone(gone)
        for subscriber in subscribers:
            subscriber.unregister()

    def test_diagnostics(self):
        diagnostics = node_process.Collector()
        subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, diagnostics, queue_size=10)

        def views_are(level, text):
            return diagnostics.wait(lambda message: any(
                status.name == "eye_hand: views" and status.level == level and text in status.message
                for status in message.status))
        self.refuse(["other_camera"], frame="other_camera")
        self.assertIsNotNone(views_are(DiagnosticStatus.ERROR, "other_camera"))
        self.use([("bridge", BRIDGE)])
        self.assertIsNotNone(views_are(DiagnosticStatus.OK, "knows bridge 0"))
        self.assertIsNotNone(diagnostics.wait(lambda message: any(
            status.name == "eye_hand: arm" and status.level == DiagnosticStatus.OK for status in message.status)))
        subscriber.unregister()


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "eye_hand", TestEyeHand)
