#!/usr/bin/env bash
# Installs what is missing, builds what it runs (the rest: cmake --build build), and shows both halves of the package:
# - recognises the objects in the images that ship with it: a table of objects (name, pose, probability, time) and
#   pictures in build/demo/<image>/: figures 9 to 11 of the method's paper (scene, line groups, ellipses, one
#   back-projection per object), and a page, index.html, with a picture of every stage;
# - lets the arm of the work cell clear the frame: a table of objects (recognised pose against truth, grasp error, times,
#   outcome) and what the camera saw, in build/demo/clear_frame/. Exit code 1 when an object was left, dropped or hit.
#   scripts/demo.sh [--seed N]     another arrangement of parts
# With a display, rviz shows it in real time.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_packages build ros test
build_targets demo
use_devel_space

say "recognising"
pictures=$build/demo
mkdir -p "$pictures"
cd "$root"
"$programs/recognize" --objects config/objects.yaml --camera data/demo/camera.yaml \
  --figures "$pictures" --explain "$pictures" data/demo/*.png

say "pictures"
find "$pictures" -name 'figure_*.png' -o -name index.html | sort
rviz=()
[ -z "${DISPLAY:-}" ] || rviz=(--rviz)
say "clearing the frame"
cleared=0
scripts/clear_frame.py --out "$pictures/clear_frame" "${rviz[@]}" "$@" || cleared=$?
find "$pictures/clear_frame" -name '*.ppm' | sort

cat <<EOF

Next: . devel/setup.bash && rosrun monocular_eye_hand recognize --help
      roslaunch monocular_eye_hand demo.launch rviz:=true    # then a goal to /task/clear_frame
EOF
exit $cleared
