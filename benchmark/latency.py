#!/usr/bin/python3
"""latency.py FOLDER CAMERA_INFO COUNT   from an image's stamp to its objects, beyond the recognition itself [s].

Starts launch/image.launch on a folder of images, slowly enough that each finds the recogniser free, and prints a JSON list
with an entry per image: when ~objects arrived, less the stamp, less `seconds` of the message."""
import json
import os
import queue
import signal
import socket
import subprocess
import sys
import time

PERIOD = 3.0        # between images; recognition must be done by then [s]
LONGEST_WAIT = 180  # for the first image: the model base is compiled before [s]
WARM_UP = 2         # images whose time holds what is done but once


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


def main():
    folder, camera_info, count = sys.argv[1], sys.argv[2], int(sys.argv[3])
    port = free_port()
    os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1", ROS_HOSTNAME="127.0.0.1")
    launch = subprocess.Popen(["roslaunch", "-p", str(port), "monocular_eye_hand", "image.launch", f"source:={folder}",
                               f"camera_info:={camera_info}", f"rate:={1 / PERIOD}"], stdout=subprocess.DEVNULL)
    try:
        print(json.dumps(overheads(count)))
    finally:
        launch.send_signal(signal.SIGINT)
        launch.wait()


def overheads(count):
    import rosgraph
    import rospy
    from monocular_eye_hand.msg import RecognizedObjectArray
    deadline = time.time() + LONGEST_WAIT
    while not rosgraph.is_master_online():
        if time.time() > deadline:
            raise RuntimeError("roslaunch did not start")
        time.sleep(0.1)
    rospy.init_node("latency", disable_signals=True)
    arrived = queue.Queue()

    def on_objects(message):
        arrived.put((rospy.Time.now() - message.header.stamp).to_sec() - message.seconds)

    rospy.Subscriber("recognizer/objects", RecognizedObjectArray, on_objects, queue_size=10, tcp_nodelay=True)
    return [arrived.get(timeout=LONGEST_WAIT) for _ in range(WARM_UP + count)][WARM_UP:]


if __name__ == "__main__":
    main()
