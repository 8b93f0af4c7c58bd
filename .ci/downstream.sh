#!/usr/bin/env bash
# Installs the build to a folder of its own and compiles a program of another package against it: headers, libraries,
# messages and the package configuration are all there, and what was installed finds its libraries.
. "$(dirname "${BASH_SOURCE[0]}")/../scripts/common.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# catkin's setup files go to the prefix of the configuration, whatever --prefix says.
prefix=$work$(sed -n 's/^CMAKE_INSTALL_PREFIX:PATH=//p' "$build/CMakeCache.txt")
DESTDIR=$work cmake --install "$build" >"$work/install.log" 2>&1 || { tail "$work/install.log"; die "the installation failed"; }

mkdir -p "$work/source"
cat >"$work/source/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.16)
project(downstream CXX)
set(CMAKE_CXX_STANDARD 17)
find_package(monocular_eye_hand REQUIRED)
add_executable(downstream main.cpp)
target_include_directories(downstream PRIVATE ${monocular_eye_hand_INCLUDE_DIRS})
target_link_libraries(downstream ${monocular_eye_hand_LIBRARIES})
CMAKE
cat >"$work/source/main.cpp" <<'CXX'
#include <monocular_eye_hand/RecognizedObjectArray.h>

#include <cstdio>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/recognition/recognizer.h"

int main() {
  try {
    monocular_eye_hand::Recognizer recognizer({});
  } catch (const monocular_eye_hand::BadInput& error) {
    std::printf("as it should, an empty model base is refused: %s\n", error.what());
    monocular_eye_hand::RecognizedObjectArray message;  // core and messages share one namespace
    message.objects.resize(1);
    return message.objects.size() == 1 ? 0 : 1;
  }
  return 1;
}
CXX
cmake -S "$work/source" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >"$work/configure.log" 2>&1 ||
  { cat "$work/configure.log"; die "find_package(monocular_eye_hand) failed"; }
cmake --build "$work/build" >"$work/build.log" 2>&1 || { tail -n 30 "$work/build.log"; die "does not compile"; }
"$work/build/downstream"

for file in "$prefix"/lib/monocular_eye_hand/* "$prefix"/lib/libmonocular_eye_hand_*.so; do
  [ "$(head -c 2 "$file")" != '#!' ] || continue  # a script
  if ! libraries=$(ldd "$file") || grep -q 'not found' <<<"$libraries" || grep -q "$devel" <<<"$libraries"; then
    echo "$libraries"
    die "$(basename "$file") does not find its libraries where it was installed"
  fi
done
for installed in launch config models rviz; do
  [ -n "$(ls "$prefix/share/monocular_eye_hand/$installed")" ] || die "$installed/ was not installed"
done

# As somebody who has the install space alone: launch files find their nodes and files, scripts start, a part is found.
cat >"$work/use.sh" <<'USE'
prefix=$1
. "$prefix/setup.bash"
set -e
cd "$prefix/share/monocular_eye_hand"
[ "$(rospack find monocular_eye_hand)" = "$PWD" ]
for script in ask clear_frame.py play_bag; do rosrun monocular_eye_hand $script --help >/dev/null; done
for file in launch/*.launch; do
  roslaunch --files monocular_eye_hand "$(basename "$file")" bag:=x source:=x camera_info:=x | grep -v "^$prefix" && exit 1
done
port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
export ROS_MASTER_URI=http://127.0.0.1:$port ROS_IP=127.0.0.1
roslaunch -p "$port" monocular_eye_hand image.launch source:=data/golden/bridge.png camera_info:=data/golden/camera.yaml &
trap 'kill $!; wait $!' EXIT
until rostopic list >/dev/null 2>&1; do sleep 0.2; kill -0 $!; done
rosrun monocular_eye_hand ask bridge
USE
env -u CMAKE_PREFIX_PATH -u ROS_PACKAGE_PATH -u PYTHONPATH -u LD_LIBRARY_PATH bash "$work/use.sh" "$prefix" >"$work/use.log" 2>&1 ||
  { cat "$work/use.log"; die "the install space alone cannot be used"; }
grep -E '^bridge_0 ' "$work/use.log"
