#!/usr/bin/env bash
# Measures what the package promises: accuracy and time, each figure against its target.
#   scripts/benchmark.sh [ROW...]    all rows by default; prints the table, writes build/benchmark/results.json
#   scripts/benchmark.sh --list      the rows
# Data sets are found by MONOCULAR_EYE_HAND_DATA.
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
run=(python3 "$root/benchmark/run.py" --programs "$programs" --out "$build/benchmark")

if [ "${1:-}" != --list ]; then
  install_packages build ros test benchmark
  CMAKE_ARGS="-DMONOCULAR_EYE_HAND_BENCHMARKS=ON ${CMAKE_ARGS:-}" build_targets all benchmarks
  say "measuring"
fi
"${run[@]}" "$@"
