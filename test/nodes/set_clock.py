"""A clock that a test plays. The test itself must live in real time: its node is made before use_sim_time is set."""
import threading

import rospy
from rosgraph_msgs.msg import Clock


class SetClock:
    """/clock fifty times a second, at the speed of the wall's, from any time on."""

    def __init__(self, start):
        self.publisher = rospy.Publisher("/clock", Clock, queue_size=10)
        self.set(start)
        self.stop = threading.Event()
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def set(self, start):
        self.held = None
        self.ahead = rospy.Duration(start) - rospy.Duration(rospy.get_time())

    def now(self):
        return self.held or rospy.Time.now() + self.ahead

    def hold(self):
        """The clock stands until it is set again."""
        self.held = self.now()

    def run(self):
        while not self.stop.wait(0.02):
            self.publisher.publish(Clock(clock=self.held or self.now()))

    def close(self):
        self.stop.set()
        self.thread.join()
        self.publisher.unregister()
