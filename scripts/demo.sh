#!/usr/bin/env bash
# Installs what is missing, builds, and recognises the objects in the images that ship with the package: prints a
# table of objects (name, pose, probability, time) and the paths of the pictures, which land in build/demo/<image>/:
# figures 9 to 11 of the method's paper (scene, line groups, ellipses, one back-projection per object), and a page,
# index.html, with a picture of every stage.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_packages build ros test
build_targets all
use_devel_space

say "recognising"
pictures=$build/demo
mkdir -p "$pictures"
cd "$root"
"$programs/recognize" --objects config/objects.yaml --camera data/demo/camera.yaml \
  --figures "$pictures" --explain "$pictures" data/demo/*.png

say "pictures"
find "$pictures" -name 'figure_*.png' -o -name index.html | sort
cat <<EOF

Next: . devel/setup.bash && rosrun monocular_eye_hand recognize --help
EOF
