#!/usr/bin/env bash
# Installs what is missing, builds, and recognises the objects in the images that ship with the package: prints a
# table of objects (name, pose, probability, time) and the paths of the pictures, which land in build/demo/.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_packages build ros test
build_targets all
use_devel_space

say "recognising"
pictures=$build/demo
mkdir -p "$pictures"
cd "$root"
demo() { "$programs/recognize" --help; }  # the main job: writes into $pictures
demo

say "pictures"
find "$pictures" -name '*.png' -o -name '*.html' | sort
cat <<EOF

Next: . devel/setup.bash && rosrun monocular_eye_hand recognize --help
EOF
