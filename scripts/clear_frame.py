#!/usr/bin/python3
"""Runs launch/demo.launch, lets the arm clear the frame, and compares with the truth of the work cell.

Prints per object: recognised pose against truth, grasp error, plan and motion time, outcome. Writes what the camera saw
into --out. Exit code 1 when an object was left, dropped or hit, 2 when the task could not be run."""
import argparse
import json
import math
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


class Symmetries:
    """Equal poses of the known objects, from the package's own model_check."""

    def __init__(self, objects_yaml):
        with tempfile.NamedTemporaryFile(suffix=".json") as out:
            subprocess.run(["rosrun", "monocular_eye_hand", "model_check", objects_yaml, "--json", out.name],
                           stdout=subprocess.DEVNULL, check=True)
            self.models = {model["name"]: model for model in json.load(out)}

    def transforms(self, name):
        model = self.models[name]
        discrete = [rigid(s["rotation"], s["translation_m"]) for s in model["equal_pose_transforms"]]
        if "axis" not in model:
            return discrete
        point = numpy.array(model["axis"]["point_m"])
        turns = [rotation_about(numpy.array(model["axis"]["direction"]), math.radians(k)) for k in range(360)]
        return [s @ rigid(turn, point - turn @ point) for s in discrete for turn in turns]


def rigid(rotation, translation):
    m = numpy.eye(4)
    m[:3, :3], m[:3, 3] = rotation, translation
    return m


def rotation_about(axis, angle):
    k = numpy.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return numpy.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * (k @ k)


def matrix(pose):
    q = numpy.array([pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w])
    x, y, z, w = q / numpy.linalg.norm(q)
    m = numpy.eye(4)
    m[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                 [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                 [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    m[:3, 3] = [pose.position.x, pose.position.y, pose.position.z]
    return m


def grasp_error(estimate, truth, symmetries, at):
    """How far the hand is off at the point `at` (base) because the pose is: metres, radians."""
    best = (math.inf, math.inf)
    for s in symmetries:
        motion = truth @ s @ numpy.linalg.inv(estimate)
        moved = motion[:3, :3] @ at + motion[:3, 3]
        angle = math.acos(max(-1.0, min(1.0, (numpy.trace(motion[:3, :3]) - 1) / 2)))
        distance = float(numpy.linalg.norm(moved - at))
        if distance + 0.05 * angle < best[0] + 0.05 * best[1]:
            best = (distance, angle)
    return best


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


def report_of(run, result, symmetries):
    """What happened to every object that stood in the cell, by the truth."""
    rows = []
    for pick in run.picks:
        target = pick["target"]
        estimate = matrix(target.object.pose)
        known = [o for o in pick["truth"].objects if o.name == target.name]
        row = {"name": target.name, "instance": target.instance}
        if known:
            nearest = min(known, key=lambda o: numpy.linalg.norm(matrix(o.pose)[:3, 3] - estimate[:3, 3]))
            tcp = matrix(target.grasp)[:3, 3]
            distance, angle = grasp_error(estimate, matrix(nearest.pose), symmetries.transforms(target.name), tcp)
            row.update(label=nearest.label, grasp_error_mm=1e3 * distance, grasp_error_deg=math.degrees(angle),
                       pose_m=[float(v) for v in estimate[:3, 3]],
                       truth_m=[float(v) for v in matrix(nearest.pose)[:3, 3]])
        if "result" in pick:
            row.update(planning_s=pick["result"].planning_time, motion_s=pick["result"].motion_time,
                       outcome=pick["result"].outcome, reason=pick["result"].reason)
        rows.append(row)
    objects = []
    for o in run.truth.objects:
        if o.name == "frame":
            continue
        attempts = [r for r in rows if r.get("label") == o.label]
        last = attempts[-1] if attempts else {}
        objects.append({"label": o.label, "name": o.name, "in_drop_zone": o.in_drop_zone, "held": o.held,
                        "attempts": len(attempts), **{k: v for k, v in last.items() if k not in ("label", "name")}})
    cleared = bool(objects) and all(o["in_drop_zone"] for o in objects)
    return {"seed": run.options.seed, "cleared": cleared, "collisions": run.truth.collisions, "objects": objects,
            "picks": rows, "reason": result.reason if result else "", "cell_seconds": result.duration if result else None,
            "rounds": result.rounds if result else 0,
            "told": [{"name": c.object.name, "outcome": OUTCOMES[c.outcome], "reason": c.reason}
                     for c in (result.objects if result else [])]}


def print_table(report):
    print("\n%-12s %-26s %-26s %-18s %-18s %s" % ("object", "recognised (mm, base)", "truth", "grasp error", "plan / motion", "outcome"))
    millimetres = lambda v: "(%.1f, %.1f, %.1f)" % tuple(1e3 * x for x in v) if v else "-"
    for o in report["objects"]:
        error = "%.2f mm, %.2f deg" % (o["grasp_error_mm"], o["grasp_error_deg"]) if "grasp_error_mm" in o else "-"
        times = "%.0f ms / %.1f s" % (1e3 * o["planning_s"], o["motion_s"]) if "planning_s" in o else "-"
        outcome = "carried out" if o["in_drop_zone"] else "in the hand" if o["held"] else "left: " + o.get("reason", "never picked")
        print("%-12s %-26s %-26s %-18s %-18s %s" % (o["label"], millimetres(o.get("pose_m")), millimetres(o.get("truth_m")),
                                                    error, times, outcome))
    print("\n%s; %d collision%s; %.1f s of cell time, %d round%s" %
          (report["reason"] or "no result", report["collisions"], "" if report["collisions"] == 1 else "s",
           report["cell_seconds"] or math.nan, report["rounds"], "" if report["rounds"] == 1 else "s"))


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
    symmetries = Symmetries(objects)
    run = Run(options)
    try:
        run.connect()
        result = run.run()
        time.sleep(0.5)  # the truth's last words
        report = report_of(run, result, symmetries)
        print_table(report)
        if options.out:
            with open(os.path.join(options.out, "report.json"), "w") as f:
                json.dump(report, f, indent=1)
        if options.keep:
            print("running until Ctrl-C; ROS_MASTER_URI=" + os.environ["ROS_MASTER_URI"])
            signal.pause()
        return 0 if report["cleared"] and not report["collisions"] else 1
    except (RuntimeError, KeyboardInterrupt) as e:
        print("clear_frame: %s" % (e or "stopped"), file=sys.stderr)
        return 2
    finally:
        run.stop()


if __name__ == "__main__":
    sys.exit(main())
