#!/usr/bin/env bash
# Installs the build to a folder of its own and compiles a program of another package against it: headers, libraries,
# messages and the package configuration are all there, and what was installed finds its libraries.
. "$(dirname "${BASH_SOURCE[0]}")/../scripts/common.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
prefix=$folder/prefix
cmake --install "$build" --prefix "$prefix" >"$folder/install.log" 2>&1 || { tail "$folder/install.log"; die "the installation failed"; }

mkdir -p "$folder/source"
cat >"$folder/source/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.16)
project(downstream CXX)
set(CMAKE_CXX_STANDARD 17)
find_package(monocular_eye_hand REQUIRED)
add_executable(downstream core.cpp messages.cpp)
target_include_directories(downstream PRIVATE ${monocular_eye_hand_INCLUDE_DIRS})
target_link_libraries(downstream ${monocular_eye_hand_LIBRARIES})
CMAKE
# Two files: message and core both call their struct monocular_eye_hand::RecognizedObject.
cat >"$folder/source/messages.cpp" <<'CXX'
#include <monocular_eye_hand/RecognizedObjectArray.h>

#include <cstddef>

std::size_t objectsInMessage() {
  monocular_eye_hand::RecognizedObjectArray message;
  message.objects.resize(1);
  return message.objects.size();
}
CXX
cat >"$folder/source/core.cpp" <<'CXX'
#include <cstddef>
#include <cstdio>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/recognition/recognizer.h"

std::size_t objectsInMessage();

int main() {
  try {
    monocular_eye_hand::Recognizer recognizer({});
  } catch (const monocular_eye_hand::BadInput& error) {
    std::printf("as it should, an empty model base is refused: %s\n", error.what());
    return objectsInMessage() == 1 ? 0 : 1;
  }
  return 1;
}
CXX
cmake -S "$folder/source" -B "$folder/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >"$folder/configure.log" 2>&1 ||
  { cat "$folder/configure.log"; die "find_package(monocular_eye_hand) failed"; }
cmake --build "$folder/build" >"$folder/build.log" 2>&1 || { tail -n 30 "$folder/build.log"; die "does not compile"; }
"$folder/build/downstream"

for file in "$prefix"/lib/monocular_eye_hand/* "$prefix"/lib/libmonocular_eye_hand_*.so; do
  if ! libraries=$(ldd "$file") || grep -q 'not found' <<<"$libraries" || grep -q "$devel" <<<"$libraries"; then
    echo "$libraries"
    die "$(basename "$file") does not find its libraries where it was installed"
  fi
done
for installed in launch config models rviz; do
  [ -n "$(ls "$prefix/share/monocular_eye_hand/$installed")" ] || die "$installed/ was not installed"
done
