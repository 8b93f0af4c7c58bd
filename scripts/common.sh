# Shared by the scripts; sourced, never run. Nothing happens before a function is called.
set -euo pipefail
export PATH=/usr/bin:/bin:$PATH  # another python first on the PATH breaks catkin and the message generators
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build
devel=$root/devel
programs=$devel/lib/monocular_eye_hand
needed_gb=5  # free space for the packages and their downloads

say() { printf '\n== %s\n' "$*"; }
die() { printf '\nerror: %s\n' "$*" >&2; exit 1; }

# packages SECTION...   the packages of these sections of packages.txt
packages() {
  awk -v want=" $* " '/^\[/ { on = index(want, " " substr($0, 2, length($0) - 2) " "); next }
                      !/^#/ && NF && on { print $1 }' "$root/scripts/packages.txt"
}

# install_packages SECTION...   installs what is missing; without anything missing neither network nor sudo is used
install_packages() {
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
    die "apt-get and dpkg-query not found. This script sets up Debian 12 (or a system like it); elsewhere install what scripts/packages.txt lists by hand and run cmake as the README says."
  local wanted missing
  mapfile -t wanted < <(packages "$@")
  mapfile -t missing < <(comm -23 <(printf '%s\n' "${wanted[@]}" | sort -u) \
    <(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null |
      awk '$1 == "installed" { print $2 }' | sort -u))
  [ ${#missing[@]} -gt 0 ] || return 0

  say "installing ${#missing[@]} missing packages: ${missing[*]}"
  local folder free_kb as_root=()
  for folder in /usr /var/cache/apt; do
    free_kb=$(df -Pk "$folder" | awk 'NR == 2 { print $4 }')
    [ "$free_kb" -ge $((needed_gb * 1024 * 1024)) ] ||
      die "$folder has $((free_kb / 1024)) MB free; installing needs $needed_gb GB. Free some space and run this again."
  done
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      die "not root and no sudo. As root run: apt-get update && apt-get install --no-install-recommends ${missing[*]}"
    sudo -v || die "sudo was refused. As root run: apt-get update && apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
  fi
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3)
  "${apt[@]}" update || die "apt-get update failed: is the network there, are the sources in /etc/apt right?"
  local name unknown=()
  for name in "${missing[@]}"; do
    apt-cache show "$name" >/dev/null 2>&1 || unknown+=("$name")
  done
  [ ${#unknown[@]} -eq 0 ] ||
    die "$(. /etc/os-release && echo "$PRETTY_NAME") has no package ${unknown[*]}. Debian 12 (bookworm, section main) has them all."
  "${apt[@]}" install -y --no-install-recommends "${missing[@]}" || die "apt-get install failed, see above."
}

# jobs   how many compilers run at once: one per core, each with 1.5 GB
jobs_at_once() {
  local cores memory
  cores=$(nproc)
  memory=$(awk '/^MemAvailable/ { print int($2 / 1572864) }' /proc/meminfo)
  [ "$memory" -lt 1 ] && memory=1
  echo $((cores < memory ? cores : memory))
}

# build_targets TARGET...   configures build/ with its devel space in devel/ and builds; CMAKE_ARGS adds options
build_targets() {
  local home free_kb
  home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt" 2>/dev/null || true)
  if [ -n "$home" ] && [ "$home" != "$root" ]; then
    say "build/ and devel/ were made for $home: starting over"
    rm -rf "$build" "$devel"
  fi
  if [ ! -d "$build" ]; then
    free_kb=$(df -Pk "$root" | awk 'NR == 2 { print $4 }')
    [ "$free_kb" -ge 1048576 ] || die "$root has $((free_kb / 1024)) MB free; the build needs 1 GB."
  fi
  local generator=()
  [ -e "$build/CMakeCache.txt" ] || generator=(-G Ninja)
  mkdir -p "$build"
  say "configuring ($build/configure.log)"
  # shellcheck disable=SC2086  # CMAKE_ARGS is a list of words
  cmake -S "$root" -B "$build" "${generator[@]}" -DCATKIN_DEVEL_PREFIX="$devel" ${CMAKE_ARGS:-} \
    >"$build/configure.log" 2>&1 || { tail -n 30 "$build/configure.log" >&2; die "cmake failed, see $build/configure.log"; }
  grep '^-- monocular_eye_hand:' "$build/configure.log" || true
  say "building: $*"
  cmake --build "$build" --parallel "$(jobs_at_once)" --target "$@" || die "the build failed, see above."
}

# use_devel_space   rosrun, roslaunch and rospack see the package
use_devel_space() {
  [ -e "$devel/setup.bash" ] || die "$devel/setup.bash is missing: ROS was not found, see $build/configure.log."
  set +u  # the setup files read variables that may be unset
  # shellcheck disable=SC1091
  . "$devel/setup.bash"
  set -u
}
