#!/usr/bin/python3
"""Runs launch/demo.launch, lets the arm clear the frame, and compares with the truth of the work cell.

Prints per object: recognised pose against truth, grasp error, plan and motion time, outcome. Writes what the camera saw
into --out. Exit code 1 when an object was left, dropped or hit, 2 when the task could not be run. The program clear_frame
does the same without ROS."""
import argparse
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time

import numpy


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seed", type=int, default=-1, help="a random scene; -1: two bridges and a grenade")
    parser.add_argument("--rviz", action="store_true", help="show it, at real time")
    parser.add_argument("--out", default="", help="folder for pictures, log and report.json")
    parser.add_argument("--time-limit", type=float, default=600, help="for the whole task [s]")
    parser.add_argument("--keep", action="store_true", help="leave everything running at the end, until Ctrl-C")
    parser.add_argument("arguments", nargs="*", help="more arguments of demo.launch, as name:=value")
    return parser.parse_args()


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


def pose_of(pose):
    p, q = pose.position, pose.orientation
    return {"position": [p.x, p.y, p.z], "quaternion": [q.x, q.y, q.z, q.w]}


def truth_of(message):
    return [{"label": o.label, "name": o.name, "pose": pose_of(o.pose), "held": bool(o.held),
             "in_drop_zone": bool(o.in_drop_zone)} for o in message.objects]


class Run:
    """One launch of the demo with everything that is listened to."""

    def __init__(self, options):
        self.options = options
        self.port = free_port()
        os.environ.update(ROS_MASTER_URI="http://127.0.0.1:%d" % self.port, ROS_IP="127.0.0.1", ROS_HOSTNAME="127.0.0.1")
        self.log = open(os.path.join(options.out, "roslaunch.log"), "w") if options.out else subprocess.DEVNULL
        command = ["roslaunch", "-p", str(self.port), "monocular_eye_hand", "demo.launch",
                   "required:=true", "rviz:=" + str(options.rviz).lower()] + options.arguments
        if options.seed >= 0:
            command.append("seed:=%d" % options.seed)
        self.launch = subprocess.Popen(command, stdout=self.log, stderr=subprocess.STDOUT, start_new_session=True)
        self.truth = None
        self.picks = []   # {target, truth at that time, planning, motion, outcome, reason}
        self.places = []
        self.stages = []
        self.hits = []    # lines of the work cell's truth
        self.overlay = None
        self.pictures = 0

    def connect(self):
        import actionlib
        import rospy
        from monocular_eye_hand.msg import (ClearFrameAction, ClearFrameActionFeedback, PickActionGoal, PickActionResult,
                                            PlaceActionResult, WorkCellTruth)
        from sensor_msgs.msg import Image
        deadline = time.time() + 60
        while self.master_down():
            if self.launch.poll() is not None or time.time() > deadline:
                raise RuntimeError("roslaunch did not start" + self.where())
            time.sleep(0.1)
        rospy.init_node("clear_frame_report", disable_signals=True, anonymous=True)
        rospy.Subscriber("work_cell/truth", WorkCellTruth, self.on_truth, queue_size=50)
        rospy.Subscriber("planner/pick/goal", PickActionGoal, self.on_pick_goal, queue_size=10)
        rospy.Subscriber("planner/pick/result", PickActionResult, self.on_pick_result, queue_size=10)
        rospy.Subscriber("planner/place/result", PlaceActionResult, self.on_place_result, queue_size=10)
        rospy.Subscriber("task/clear_frame/feedback", ClearFrameActionFeedback, self.on_feedback, queue_size=50)
        if self.options.out:
            rospy.Subscriber("recognizer/overlay", Image, self.on_overlay, queue_size=1, buff_size=1 << 22)
        self.client = actionlib.SimpleActionClient("task/clear_frame", ClearFrameAction)
        while not self.server_ready() or self.truth is None:
            if self.launch.poll() is not None or time.time() > deadline + 60:
                raise RuntimeError("the task did not start" + self.where())
            time.sleep(0.1)

    def server_ready(self):
        """The action client's own wait is in time of the cell, which stands when the cell died."""
        action = self.client.action_client
        return action.last_status_msg is not None and all(
            topic.get_num_connections() for topic in (action.pub_goal, action.pub_cancel, action.result_sub, action.feedback_sub))

    def where(self):
        return ", see " + self.log.name if self.options.out else ""

    def master_down(self):
        with socket.socket() as s:
            s.settimeout(0.5)
            return s.connect_ex(("127.0.0.1", self.port)) != 0

    def on_truth(self, message):
        self.truth = message
        self.hits += [event for event in message.events if ": collision: " in event]

    def on_pick_goal(self, message):
        self.picks.append({"target": message.goal.target, "truth": self.truth})

    def on_pick_result(self, message):
        if self.picks:
            self.picks[-1]["result"] = message.result

    def on_place_result(self, message):
        self.places.append(message.result)

    def on_feedback(self, message):
        f = message.feedback
        self.stages.append((f.stage, f.object, f.text))
        print("  %-8s %-10s %s" % (f.stage, f.object, f.text), flush=True)
        if f.stage in ("choose", "pick", "done") and self.overlay:
            self.save(self.overlay, "%02d_%s" % (self.pictures, "_".join([f.stage] + f.object.split())))
            self.pictures += 1

    def on_overlay(self, message):
        self.overlay = message

    def save(self, message, name):
        channels = 1 if message.encoding in ("mono8", "8UC1") else 3
        image = numpy.frombuffer(message.data, numpy.uint8).reshape(message.height, message.step)
        image = image[:, :message.width * channels].reshape(message.height, message.width, channels)
        if message.encoding == "bgr8":
            image = image[:, :, ::-1]
        kind = b"P5" if channels == 1 else b"P6"
        with open(os.path.join(self.options.out, name + (".pgm" if channels == 1 else ".ppm")), "wb") as f:
            f.write(kind + b"\n%d %d\n255\n" % (message.width, message.height) + numpy.ascontiguousarray(image).tobytes())

    def run(self):
        from actionlib import SimpleGoalState
        from monocular_eye_hand.msg import ClearFrameGoal
        self.client.send_goal(ClearFrameGoal())
        deadline = time.time() + self.options.time_limit
        while self.client.simple_state != SimpleGoalState.DONE:  # the state comes before the result
            if self.launch.poll() is not None:
                raise RuntimeError("a node died" + self.where())
            if time.time() > deadline:
                self.client.cancel_goal()
                raise RuntimeError("not done within %g s" % self.options.time_limit)
            time.sleep(0.05)
        return self.client.get_result()

    def stop(self):
        if self.launch.poll() is None:
            os.killpg(self.launch.pid, signal.SIGINT)
            try:
                self.launch.wait(20)
            except subprocess.TimeoutExpired:
                os.killpg(self.launch.pid, signal.SIGKILL)
        if self.log is not subprocess.DEVNULL:
            self.log.close()


OUTCOMES = ["waiting", "carried", "gone", "left", "held", "dropped", "doubt"]


def pick_record(pick):
    target = pick["target"]
    record = {"name": target.name, "instance": target.instance, "object": pose_of(target.object.pose),
              "grasp": pose_of(target.grasp), "truth": truth_of(pick["truth"])}
    if "result" in pick:
        result = pick["result"]
        record["result"] = {"outcome": result.outcome, "reason": result.reason, "planning_s": result.planning_time,
                            "motion_s": result.motion_time}
    return record


def record_of(run, result):
    """What happened, as the program clear_frame reads it (docs/json.md)."""
    told = [{"name": c.object.name, "outcome": OUTCOMES[c.outcome], "reason": c.reason} for c in result.objects]
    return {"seed": run.options.seed, "collisions": run.truth.collisions, "hits": run.hits,
            "truth": truth_of(run.truth), "picks": [pick_record(pick) for pick in run.picks],
            "end": {"reason": result.reason, "cell_seconds": result.duration, "rounds": result.rounds, "told": told}}


def report(record, objects, out):
    """Table, report.json and exit code come from the program clear_frame, which clears the same cell without ROS."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(record, file)
        file.flush()
        command = ["rosrun", "monocular_eye_hand", "clear_frame", "--record", file.name, "--objects", objects]
        if out:
            command += ["--json", os.path.join(out, "report.json")]
        return subprocess.run(command, check=False).returncode


def main():
    options = parse_arguments()
    if options.out:
        os.makedirs(options.out, exist_ok=True)
        options.out = os.path.abspath(options.out)
    import rospkg
    objects = os.path.join(rospkg.RosPack().get_path("monocular_eye_hand"), "config", "objects.yaml")
    for argument in options.arguments:
        if argument.startswith("objects:="):
            objects = argument.split(":=", 1)[1]
    run = Run(options)
    try:
        run.connect()
        result = run.run()
        time.sleep(0.5)  # the truth's last words
        code = report(record_of(run, result), objects, options.out)
        if options.keep:
            print("running until Ctrl-C; ROS_MASTER_URI=" + os.environ["ROS_MASTER_URI"])
            signal.pause()
        return code
    except (RuntimeError, KeyboardInterrupt) as e:
        print("clear_frame: %s" % (e or "stopped"), file=sys.stderr)
        return 2
    finally:
        run.stop()


if __name__ == "__main__":
    sys.exit(main())
