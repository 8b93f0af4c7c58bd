#!/usr/bin/env bash
# Installs what is missing, builds, runs every test. Exit code 0 only when all tests ran and none failed.
#   scripts/test.sh [CTEST_ARGUMENT...]     e.g. scripts/test.sh -L pose   or   -R recogni
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_packages build ros test
build_targets all tests
use_devel_space

say "testing"
results=$build/test_results
rm -rf "$results" && mkdir -p "$results"
failed=0
(cd "$build" && ctest --output-on-failure --no-tests=error -j "$(nproc)" "$@") || failed=1
catkin_test_results "$results" || failed=1
python3 "$root/scripts/test_summary.py" "$results" || failed=1
exit $failed
