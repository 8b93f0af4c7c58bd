"""Programs of the package as child processes of a test."""
import os
import signal
import socket
import subprocess
import tempfile
import threading
import time

import rosgraph
import roslib.packages

START = 60  # [s]; generous: the machine may be busy


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class Collector:
    """The messages of a topic; waits for one that fits."""

    def __init__(self):
        self.messages = []
        self.changed = threading.Condition()

    def __call__(self, message):
        with self.changed:
            self.messages.append(message)
            self.changed.notify_all()

    def clear(self):
        with self.changed:
            self.messages = []

    def wait(self, fits=lambda message: True, timeout=START):
        """The first message that fits, or None after `timeout` [s]."""
        end = time.monotonic() + timeout
        with self.changed:
            looked = 0
            while True:
                if looked > len(self.messages):
                    looked = 0
                for message in self.messages[looked:]:
                    if fits(message):
                        return message
                looked = len(self.messages)
                left = end - time.monotonic()
                if left <= 0 or not self.changed.wait(left) and time.monotonic() >= end:
                    return None

    def wait_count(self, count, timeout=START):
        with self.changed:
            return self.changed.wait_for(lambda: len(self.messages) >= count, timeout)


class Process:
    """A child process whose output is kept."""

    def __init__(self, command):
        self.output = tempfile.TemporaryFile("w+")
        environment = dict(os.environ, ROSCONSOLE_STDOUT_LINE_BUFFERED="1")  # what a node says is there when it says it
        self.process = subprocess.Popen(command, stdout=self.output, stderr=subprocess.STDOUT, start_new_session=True,
                                        env=environment)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def text(self):
        self.output.seek(0)
        return self.output.read()

    def exit_code(self, timeout=START):
        """Waits for the end; None when it goes on."""
        try:
            return self.process.wait(timeout)
        except subprocess.TimeoutExpired:
            return None

    def running(self):
        return self.process.poll() is None

    def stop(self):
        for sign in (signal.SIGINT, signal.SIGKILL):
            if self.process.poll() is None:
                os.killpg(self.process.pid, sign)
                self.exit_code(20)


def node(program, name, arguments=()):
    """Starts a node of this package; arguments as on rosrun's command line. Parameters of a former start are dropped."""
    master = rosgraph.Master("/test")
    if master.hasParam("/" + name):
        master.deleteParam("/" + name)
    paths = roslib.packages.find_node("monocular_eye_hand", program)
    if not paths:
        raise RuntimeError("no program %s in monocular_eye_hand" % program)
    return Process([paths[0], "__name:=" + name] + list(arguments))


def launch(file, arguments=()):
    """Starts a launch file of this package in the master of the test."""
    return Process(["roslaunch", "--wait", "monocular_eye_hand", file] + list(arguments))
