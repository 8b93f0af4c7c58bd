#!/usr/bin/python3
"""The node work_cell with robot_state_publisher, as launch/work_cell.launch starts them: time, arm, gripper, camera."""
import os
import sys
import tempfile
import time
import unittest

import numpy
import rospy
import rostest
import tf2_ros
import yaml
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Image
from std_msgs.msg import Float64, String
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import eye_hand_scene
import node_process
from work_cell_process import FINGERS, JOINTS, LOOK, PACKAGE, Cell, joints_near, limits, pose_of

SEED = 7


class TestWorkCell(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_work_cell")  # before use_sim_time is set: this test lives in real time
        cls.cell = Cell("seed:=%d" % SEED)
        cls.cell.__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.cell.__exit__()

    def test_clock_and_rates(self):
        self.assertTrue(rospy.get_param("/use_sim_time"))
        cell = self.cell
        first = cell.now()
        self.assertGreater(first, 0)
        cell.wait("/clock", lambda m: m.clock.to_sec() > first + 1.5)
        for topic, stamp, period in (("/clock", lambda m: m.clock, 0.01),
                                     ("/joint_states", lambda m: m.header.stamp, 0.01),
                                     ("/gripper/state", lambda m: m.header.stamp, 0.01),
                                     ("/camera/camera_info", lambda m: m.header.stamp, 0.1)):
            cell.heard[topic].clear()
            self.assertTrue(cell.heard[topic].wait_count(5), topic)
            stamps = [stamp(m).to_sec() for m in cell.heard[topic].messages[:5]]
            numpy.testing.assert_allclose(numpy.diff(stamps), period, atol=1e-6, err_msg=topic)

    def test_truth_is_the_scene(self):
        seeded = self.cell.next("/work_cell/truth")
        self.assertEqual(seeded.header.frame_id, "base_link")
        self.assertEqual(len(seeded.objects), 4)
        self.assertEqual(seeded.objects[0].label, "frame_0")
        frame = seeded.objects[0].pose.position
        for part in seeded.objects[1:]:
            self.assertNotEqual(part.name, "frame")
            position = part.pose.position
            self.assertLess(numpy.hypot(position.x - frame.x, position.y - frame.y), 0.15)  # inside its opening
        self.assertEqual(seeded.collisions, 0)
        for o in seeded.objects:
            self.assertFalse(o.held or o.falling or o.in_drop_zone)

    def test_trajectory_is_followed(self):
        cell = self.cell
        start_joints = cell.joints()
        goal = start_joints + [0.3, -0.2, 0.25, 0.4, -0.3, 0.5]
        start, duration = round(cell.now() + 1.0, 2), 1.5
        cell.heard["/joint_states"].clear()
        cell.send(goal, duration, start, names=JOINTS[::-1])
        self.assertIsNotNone(cell.arrive(goal))
        lower, upper, speed = limits()
        before = during = 0
        for message in list(cell.heard["/joint_states"].messages):
            self.assertEqual(message.name, JOINTS + FINGERS)
            s = numpy.clip((message.header.stamp.to_sec() - start) / duration, 0, 1)
            before, during = before + (s == 0), during + (0 < s < 1)
            expected = start_joints + (goal - start_joints) * (3 * s ** 2 - 2 * s ** 3)
            numpy.testing.assert_allclose(message.position[:6], expected, atol=1e-6)
            numpy.testing.assert_allclose(message.velocity[:6], (goal - start_joints) * 6 * s * (1 - s) / duration,
                                          atol=1e-5)
        self.assertGreater(before, 20)  # it waited for its stamp
        self.assertGreater(during, 100)
        # More than the arm can do: it does what it can, and says so.
        far = start_joints + [1.5, 0, 0, 0, 0, 0]
        cell.heard["/work_cell/truth"].clear()
        self.assertIsNotNone(cell.move(far, 0.2))
        states = list(cell.heard["/joint_states"].messages)
        positions = numpy.array([m.position[:6] for m in states])
        self.assertLess((numpy.abs(numpy.diff(positions, axis=0)).max(0) / 0.01 / speed).max(), 1 + 1e-6)
        self.assertTrue((positions >= lower).all() and (positions <= upper).all())
        self.assertIsNotNone(cell.wait("/work_cell/truth", lambda m: any("limit: joint1" in e for e in m.events)))
        self.assertIsNotNone(cell.move(start_joints, 2))

    def test_stop(self):
        cell = self.cell
        home = cell.joints()
        goal = home + [1.2, 0, 0, 0, 0, 0.5]
        cell.heard["/joint_states"].clear()
        cell.send(goal, 4.0)
        self.assertIsNotNone(cell.wait("/joint_states", lambda m: m.velocity[0] > 0.3))
        cell.arm.publish(JointTrajectory())
        cell.heard["/joint_states"].clear()
        stopped = cell.wait("/joint_states", lambda m: max(map(abs, m.velocity)) == 0)
        self.assertLess(stopped.position[0], goal[0] - 0.1)
        after = stopped.header.stamp.to_sec() + 0.3
        later = cell.wait("/joint_states", lambda m: m.header.stamp.to_sec() > after)
        self.assertEqual(later.position, stopped.position)
        # A trajectory that waits for its time is stopped, too.
        start = cell.now() + 1.0
        cell.send(goal, 1.0, start)
        time.sleep(0.2)
        cell.arm.publish(JointTrajectory())
        later = cell.wait("/joint_states", lambda m: m.header.stamp.to_sec() > start + 0.5)
        self.assertEqual(later.position, stopped.position)
        self.assertIsNotNone(cell.move(home, 2))

    def test_bad_commands(self):
        cell = self.cell
        before = cell.joints()

        def refused(publisher, message, text):
            cell.heard["/rosout"].clear()
            publisher.publish(message)
            line = cell.wait("/rosout", lambda m: m.name == "/work_cell" and "refused" in m.msg)
            self.assertIsNotNone(line, text)
            self.assertIn(text, line.msg)
            self.assertEqual(line.level, Log.ERROR)

        def trajectory(names, positions):
            return JointTrajectory(joint_names=names, points=[
                JointTrajectoryPoint(positions=positions, time_from_start=rospy.Duration(1))])

        refused(cell.arm, trajectory(JOINTS[:5], [0] * 5), "lacks joint6")
        refused(cell.arm, trajectory(JOINTS[:5] + ["wrist"], [0] * 6), "lacks joint6")
        refused(cell.arm, trajectory(JOINTS, [0] * 5), "points[0].positions holds 5 numbers")
        refused(cell.arm, trajectory(JOINTS, [0, 0, 0, 0, 0, float("nan")]), "not finite")
        wall = trajectory(JOINTS, [0] * 6)
        wall.header.stamp = rospy.Time.from_sec(1.7e9)
        refused(cell.arm, wall, "use_sim_time")
        for width in (-0.01, 0.2, float("nan")):
            refused(cell.gripper, Float64(width), "gripper width")
        take_away = rospy.Publisher("/work_cell/take_away", String, queue_size=10)
        while take_away.get_num_connections() == 0:
            time.sleep(0.01)
        refused(take_away, String("spoon_0"), 'no object "spoon_0" is in the cell (frame_0, ')
        take_away.unregister()
        self.assertTrue(cell.process.running())
        numpy.testing.assert_array_equal(cell.joints(), before)

    def test_gripper(self):
        cell = self.cell
        for width in (0.02, 0.06):
            cell.heard["/gripper/state"].clear()
            cell.gripper.publish(Float64(width))
            self.assertIsNotNone(cell.wait("/gripper/state", lambda m: m.moving))
            state = cell.wait("/gripper/state", lambda m: not m.moving and abs(m.width - width) < 1e-9)
            self.assertIsNotNone(state)
            self.assertFalse(state.stalled)
            numpy.testing.assert_allclose(cell.next("/joint_states").position[6:], [width / 2] * 2, atol=1e-9)
            messages = [m for m in cell.heard["/gripper/state"].messages if m.moving]
            speeds = numpy.diff([m.width for m in messages]) / numpy.diff([m.header.stamp.to_sec() for m in messages])
            numpy.testing.assert_allclose(numpy.abs(speeds), 0.1, rtol=1e-3)  # gripper_speed of the cell

    def test_images(self):
        """Image, calibration, joint state and tf of one stamp belong together, also while the arm moves."""
        cell = self.cell
        home = cell.joints()
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        cell.listen("/camera/image_raw", Image)
        cell.heard["/joint_states"].clear()
        cell.heard["/camera/camera_info"].clear()
        self.assertIsNotNone(cell.move(LOOK, 3))
        last = cell.image_at_rest().header.stamp
        for topic in ("/joint_states", "/camera/camera_info"):
            self.assertIsNotNone(cell.wait(topic, lambda m: m.header.stamp >= last))
        states = {m.header.stamp for m in cell.heard["/joint_states"].messages}
        infos = {m.header.stamp: m for m in cell.heard["/camera/camera_info"].messages}
        images = [m for m in cell.heard["/camera/image_raw"].messages if m.header.stamp <= last]
        numpy.testing.assert_allclose(numpy.diff([m.header.stamp.to_sec() for m in images]), 0.1, atol=1e-6)
        self.assertGreater(len(images), 20)
        heights = set()
        for image in images[1:]:
            stamp = image.header.stamp
            self.assertEqual((image.encoding, image.width, image.height), ("mono8", 640, 480))
            self.assertEqual(image.header.frame_id, "camera_optical_frame")
            self.assertIn(stamp, states)
            info = infos[stamp]
            self.assertEqual((info.header.frame_id, info.width, info.height), ("camera_optical_frame", 640, 480))
            self.assertEqual((info.K[0], info.K[2], info.distortion_model), (600, 319.5, "plumb_bob"))
            seen = buffer.lookup_transform("base_link", "camera_optical_frame", stamp,
                                           rospy.Duration(node_process.START))
            self.assertEqual(seen.header.stamp, stamp)
            heights.add(seen.transform.translation.z)
        self.assertGreater(len(heights), 10)
        self.assertGreater(numpy.frombuffer(images[-1].data, numpy.uint8).std(), 20)  # it shows something
        listener.unregister()
        self.assertIsNotNone(cell.move(home, 3))

    # The last two need a cell of their own: unittest runs by name.
    def test_z1_another_run(self):
        """The same seed at another pace: the same scene, and at the same joints the very same picture."""
        truth = pose_of(self.cell.next("/work_cell/truth"))
        self.cell.listen("/camera/image_raw", Image)
        self.assertIsNotNone(self.cell.move(LOOK, 3))
        image = self.cell.image_at_rest()
        self.cell.__exit__()
        with Cell("seed:=%d" % SEED, "real_time_factor:=0") as again:
            self.assertEqual(pose_of(again.next("/work_cell/truth")), truth)
            start = time.monotonic()
            self.assertIsNotNone(again.move(LOOK, 20))
            self.assertLess(time.monotonic() - start, 15)  # twenty seconds of the cell
            again.listen("/camera/image_raw", Image)
            picture = again.image_at_rest()
            self.assertEqual(picture.data, image.data)
            self.assertNotEqual(picture.header.stamp, image.header.stamp)
            # At rest, time passes as it does outside.
            start, cell_start = time.monotonic(), again.now()
            again.wait("/clock", lambda m: m.clock.to_sec() > cell_start + 1)
            self.assertGreater(time.monotonic() - start, 0.8)
            # Another pose gives another picture.
            self.assertIsNotNone(again.move(numpy.array(LOOK) + [0, 0, 0, 0, 0, 1e-3], 1))
            self.assertNotEqual(again.image_at_rest().data, image.data)

    def test_z2_scene_from_file(self):
        truth = pose_of(self.cell.heard["/work_cell/truth"].messages[-1])
        self.cell.__exit__()
        with open(PACKAGE + "/config/cell.yaml") as file:
            scene = yaml.safe_load(file)
        scene["camera"]["width"], scene["camera"]["cx"] = 320, 159.5
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            yaml.safe_dump(scene, file)
            file.flush()
            with Cell("cell:=" + file.name, "images_in_motion:=false", "real_time_factor:=0") as other:
                self.assertEqual(other.next("/camera/camera_info").width, 320)
                told = other.next("/work_cell/truth")
                self.check_images_at_rest_only(other)
                self.check_grasp(other, told)
                self.check_collision(other)
        self.assertNotEqual(pose_of(told), truth)
        self.assertEqual(told.collisions, 0)
        self.assertEqual([o.name for o in told.objects], [o["name"] for o in scene["objects"]])
        table = scene["table"]["pose"]
        for seen, wanted in zip(told.objects, scene["objects"]):
            position, turn = seen.pose.position, seen.pose.orientation
            expected = [table["x"] + wanted["pose"]["x"], table["y"] + wanted["pose"]["y"], table["z"]]
            numpy.testing.assert_allclose([position.x, position.y, position.z], expected, atol=1e-6)
            self.assertAlmostEqual(2 * numpy.arctan2(turn.z, turn.w), wanted["pose"].get("yaw", 0), places=6)

    def check_images_at_rest_only(self, cell):
        cell.listen("/camera/image_raw", Image)
        cell.image_at_rest()
        self.assertIsNotNone(cell.move(LOOK, 2))
        cell.image_at_rest()
        moving = [m.header.stamp for m in cell.heard["/joint_states"].messages if numpy.abs(m.velocity).max() > 0]
        self.assertGreater((moving[-1] - moving[0]).to_sec(), 1.5)
        for image in cell.heard["/camera/image_raw"].messages:
            self.assertFalse(moving[0] < image.header.stamp < moving[-1])

    def check_grasp(self, cell, told):
        """A bridge is held across its 40 mm, lifted, let go and falls; the truth tells each."""
        bridge = next(o for o in told.objects if o.label == "bridge_0")
        base_from_bridge = eye_hand_scene.pose_matrix(bridge.pose)
        down = numpy.array([[-1, 0, 0], [0, 1, 0], [0, 0, -1.0]])  # x, y, z of the hand in the bridge's frame
        path, joints = [], eye_hand_scene.ABOVE
        for height in numpy.linspace(0.15, 0.05, 11):
            joints = joints_near(joints, base_from_bridge @ eye_hand_scene.transform(down, [0, 0, height]))
            path.append(joints)
        truth, gripper = cell.heard["/work_cell/truth"], cell.heard["/gripper/state"]

        def truth_with(event):
            return cell.wait("/work_cell/truth", lambda m: any(event in text for text in m.events))

        self.assertIsNotNone(cell.move(path[0], 3))
        self.assertIsNotNone(cell.follow(path, 0.1))
        truth.clear()
        gripper.clear()
        cell.gripper.publish(Float64(0.02))
        state = cell.wait("/gripper/state", lambda m: m.stalled)
        self.assertIsNotNone(state)
        self.assertAlmostEqual(state.width, 0.04, delta=0.002)
        self.assertIsNotNone(truth_with("grasped: bridge_0"))
        up = cell.follow(path[::-1], 0.1)
        lifted = cell.wait("/work_cell/truth", lambda m: m.header.stamp > up.header.stamp)
        held = next(o for o in lifted.objects if o.held)
        self.assertEqual(held.label, "bridge_0")
        self.assertAlmostEqual(held.pose.position.z, bridge.pose.position.z + 0.1, places=3)
        self.assertEqual(lifted.collisions, 0)
        truth.clear()
        cell.gripper.publish(Float64(0.08))
        self.assertIsNotNone(truth_with("released: bridge_0"))
        rested = truth_with("rested: bridge_0")
        self.assertIsNotNone(rested)
        self.assertFalse(any(o.held or o.falling for o in rested.objects))
        fallen = next(o for o in rested.objects if o.label == "bridge_0")
        self.assertAlmostEqual(fallen.pose.position.z, bridge.pose.position.z, places=3)
        self.assertIsNotNone(cell.move(LOOK, 2))

    def check_collision(self, cell):
        """The forearm through the table: counted, told in ~truth, logged."""
        cell.heard["/work_cell/truth"].clear()
        self.assertIsNotNone(cell.move([0, -0.6, -numpy.pi / 2, 0, 0, 0], 3))
        told = cell.wait("/work_cell/truth", lambda m: any("collision: " in e and "table" in e for e in m.events))
        self.assertIsNotNone(told)
        self.assertGreater(told.collisions, 0)
        self.assertIsNotNone(cell.wait("/rosout", lambda m: m.level == Log.WARN and "collision" in m.msg))


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "work_cell", TestWorkCell)
