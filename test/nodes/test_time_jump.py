#!/usr/bin/python3
"""The node recognizer on a bag that is played again and again: nothing comes from the future, neither with /clock nor
without."""
import os
import sys
import tempfile
import time
import unittest

import rospkg
import rospy
import rostest
from tf2_msgs.msg import TFMessage

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import cube_scene
import node_process
from monocular_eye_hand.msg import RecognizedObjectArray
from set_clock import SetClock

LENGTH = 4.0  # of the bag [s]
SIM_TIME = "/use_sim_time"


class TestTimeJump(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("test_time_jump")  # before use_sim_time is set: this test lives in real time
        cls.cache = tempfile.TemporaryDirectory()
        cls.objects = os.path.join(rospkg.RosPack().get_path("monocular_eye_hand"), "config", "cube.yaml")

    def play(self, clock, loops, grace):
        """Plays the bag and checks that what is published belongs to the present loop. `grace`: the node may hear of the
        jump so late [s]."""
        late = []
        seen = []
        jumped_at = [time.monotonic()]

        def hear(stamp):
            seen.append(stamp)
            if (stamp - clock.now()).to_sec() > 1.0 and time.monotonic() - jumped_at[0] > grace:
                late.append((stamp.to_sec(), clock.now().to_sec()))
        subscribers = [
            rospy.Subscriber("/recognizer/objects", RecognizedObjectArray, lambda m: hear(m.header.stamp), queue_size=100),
            rospy.Subscriber("/tf", TFMessage, lambda m: hear(m.transforms[0].header.stamp), queue_size=100)]
        camera = cube_scene.Camera()
        camera.image, camera.info = cube_scene.image_message(cube_scene.cube_picture()), cube_scene.camera_info()
        camera.stamp = clock.now
        with node_process.node("recognizer", "recognizer", [
                "_objects:=" + self.objects, "_cache:=" + self.cache.name]) as node:
            end = time.monotonic() + node_process.START
            while not seen and time.monotonic() < end:
                time.sleep(0.05)
            for _ in range(loops):
                del seen[:]
                clock.set(100)
                jumped_at[0] = time.monotonic()
                end = time.monotonic() + node_process.START
                while (clock.now().to_sec() < 100 + LENGTH or len(seen) < 4) and time.monotonic() < end:
                    time.sleep(0.01)
                self.assertGreaterEqual(len(seen), 4, node.text())
        camera.timer.shutdown()
        for subscriber in subscribers:
            subscriber.unregister()
        self.assertEqual(late, [])

    def test_with_clock(self):
        rospy.set_param(SIM_TIME, True)
        clock = SetClock(100)
        try:
            self.play(clock, 4, 0.3)
        finally:
            clock.close()
            rospy.delete_param(SIM_TIME)

    def test_stamps_alone(self):
        clock = SetClock(100)  # who does not live in its time does not listen to it
        try:
            self.play(clock, 3, 1.0)  # the first image of the new loop tells
        finally:
            clock.close()


if __name__ == "__main__":
    rostest.rosrun("monocular_eye_hand", "time_jump", TestTimeJump)
