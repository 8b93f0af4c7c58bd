#!/usr/bin/python3
"""Makes the pictures of rviz in docs/images: starts each configuration on a display of its own (Xvfb, software rendering),
waits until it shows what it is for, and saves what is on the screen. scripts/packages.txt, section [screenshots]."""
import argparse
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

WIDTH, HEIGHT = 1500, 850  # of the screen and of rviz's window
SMALL = 1200               # width of the picture
COLOURS = 96               # of the picture; enough for rviz, and small
START = 180                # longest wait for anything [s]; generous: the machine may be busy


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", default="", help="folder of the pictures [docs/images]")
    parser.add_argument("--settle", type=float, default=10, help="time for rviz to draw what has arrived [s]")
    parser.add_argument("only", nargs="*", metavar="CONFIGURATION", help="recognize, demo; left out: all")
    return parser.parse_args()


def wait_until(true, what):
    end = time.monotonic() + START
    while not true():
        if time.monotonic() > end:
            raise RuntimeError("waited in vain for " + what)
        time.sleep(0.2)


class Screen:
    """A display without hardware whose pixels lie in a file."""

    def __init__(self):
        self.folder = tempfile.mkdtemp()
        reader, writer = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writer), "-screen", "0", "%dx%dx24" % (WIDTH, HEIGHT), "-fbdir", self.folder,
             "-nolisten", "tcp"], pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as number:
            self.name = ":" + number.readline().strip()
        if self.name == ":":
            raise RuntimeError("Xvfb does not start")

    def save(self, path):
        """The screen, an X window dump (XWD), as a small picture with few colours."""
        subprocess.run(["convert", "xwd:" + os.path.join(self.folder, "Xvfb_screen0"), "-resize", str(SMALL), "+dither",
                        "-colors", str(COLOURS), path], check=True)

    def close(self):
        self.server.terminate()
        self.server.wait()
        shutil.rmtree(self.folder)


class Launch:
    """A launch file with rviz, in a master of its own."""

    def __init__(self, screen, arguments):
        with socket.socket() as s:
            s.bind(("127.0.0.1", 0))
            port = s.getsockname()[1]
        os.environ.update(ROS_MASTER_URI="http://127.0.0.1:%d" % port, ROS_IP="127.0.0.1", ROS_HOSTNAME="127.0.0.1")
        environment = dict(os.environ, DISPLAY=screen.name, LIBGL_ALWAYS_SOFTWARE="1", QT_X11_NO_MITSHM="1")
        self.log = tempfile.TemporaryFile("w+")
        self.process = subprocess.Popen(["roslaunch", "-p", str(port), "monocular_eye_hand"] + arguments + ["rviz:=true"],
                                        env=environment, stdout=self.log, stderr=subprocess.STDOUT,
                                        start_new_session=True)

    def topics(self):
        """Topics with a subscriber and a publisher."""
        import rosgraph
        try:
            publishers, subscribers, _ = rosgraph.Master("/screenshots").getSystemState()
        except (OSError, rosgraph.MasterException):
            return set()
        of_rviz = {topic for topic, nodes in subscribers if any("rviz" in node for node in nodes)}
        return of_rviz & {topic for topic, nodes in publishers if nodes}

    def text(self):
        self.log.seek(0)
        return self.log.read()

    def close(self):
        for sign in (signal.SIGINT, signal.SIGKILL):
            if self.process.poll() is None:
                os.killpg(self.process.pid, sign)
                try:
                    self.process.wait(20)
                except subprocess.TimeoutExpired:
                    pass


def share():
    import rospkg
    return rospkg.RosPack().get_path("monocular_eye_hand")


def echo(topic, filter_text):
    """Waits for a message of the topic whose text holds a word, by rostopic: one process can have one master only."""
    with subprocess.Popen(["rostopic", "echo", topic], stdout=subprocess.PIPE, text=True, start_new_session=True) as process:
        end = time.monotonic() + START
        try:
            for line in process.stdout:
                if filter_text in line:
                    return
                if time.monotonic() > end:
                    raise RuntimeError("waited in vain for '%s' on %s" % (filter_text, topic))
        finally:
            os.killpg(process.pid, signal.SIGINT)


def recognize(launch):
    wait_until(lambda: {"/recognizer/overlay", "/recognizer/markers", "/recognizer/view"} <= launch.topics(), "rviz")
    echo("/recognizer/objects", "name: ")


def demo(launch):
    wait_until(lambda: {"/recognizer/overlay", "/eye_hand/markers", "/planner/cell"} <= launch.topics(), "rviz")
    echo("/task/clear_frame/status", "frame_id")  # the task is ready
    subprocess.run(["rostopic", "pub", "-1", "/task/clear_frame/goal", "monocular_eye_hand/ClearFrameActionGoal", "{}"],
                   check=True, stdout=subprocess.DEVNULL)
    echo("/planner/pick/feedback", "stage: ")  # the arm is on its way, the path is shown


CONFIGURATIONS = {
    "recognize": (lambda: ["image.launch", "source:=%s/data/demo/two_bridges_and_grenade.png" % share(),
                           "camera_info:=%s/data/demo/camera.yaml" % share()], recognize, "recognize.png"),
    "demo": (lambda: ["demo.launch"], demo, "arm.png"),
}


def make(name, options):
    arguments, ready, file = CONFIGURATIONS[name]
    path = os.path.join(options.out, file)
    screen = Screen()
    launch = Launch(screen, arguments())
    try:
        ready(launch)
        time.sleep(options.settle)
        screen.save(path)
    except (RuntimeError, subprocess.CalledProcessError) as e:
        raise RuntimeError("%s: %s\n%s" % (name, e, launch.text()))
    finally:
        launch.close()
        screen.close()
    print("%s: %d kB" % (path, os.path.getsize(path) // 1000), flush=True)


def main():
    options = parse_arguments()
    options.out = options.out or os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(__file__))), "docs", "images")
    os.makedirs(options.out, exist_ok=True)
    try:
        for name in options.only or CONFIGURATIONS:
            if name not in CONFIGURATIONS:
                raise RuntimeError("there is no configuration %s; known: %s" % (name, ", ".join(CONFIGURATIONS)))
            make(name, options)
        return 0
    except (RuntimeError, OSError) as e:
        print("screenshots: %s" % e, file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
