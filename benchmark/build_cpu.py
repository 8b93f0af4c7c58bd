#!/usr/bin/python3
"""build_cpu.py BUILD [--every N]   CPU seconds that compiling everything in the build folder takes.

Runs each compile command of BUILD (Ninja) again, without a compiler cache and with its output thrown away, one at a time,
and adds up user and system time: of two checkouts on one machine the figures can be compared, whatever runs beside them.
With --every N only each N-th command of a target is run, and the sum scaled. What is compiled must have been built once, or
at least the messages and the precompiled headers."""
import argparse
import collections
import json
import os
import resource
import shlex
import subprocess
import sys
import tempfile


def commands(build):
    """(target, command) of every object and precompiled header."""
    out = subprocess.run(["ninja", "-C", build, "-t", "compdb"], capture_output=True, text=True, check=True).stdout
    for entry in json.loads(out):
        words = shlex.split(entry["command"].split(" && ")[0])
        if "-c" in words and words[-2] == "-c":
            yield entry["output"].split(".dir/")[0], words


def seconds_of(words, build, output):
    """CPU seconds of one compiler call that writes to `output` instead."""
    while not os.path.basename(words[0]).startswith(("c++", "g++", "clang++", "x86_64")):
        words = words[1:]  # a compiler cache
    call = list(words)
    call[call.index("-o") + 1] = output
    for option in ("-MF", "-MT"):
        if option in call:
            call[call.index(option) + 1] = output + ".d"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(call, cwd=build, check=True, env={**os.environ, "CCACHE_DISABLE": "1"}, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("build")
    parser.add_argument("--every", type=int, default=1, help="run only each N-th command of a kind of target")
    parser.add_argument("--dearest", type=int, default=0, help="name so many targets, those that took the most")
    options = parser.parse_args()

    kinds = collections.defaultdict(list)
    for target, words in commands(options.build):
        kinds["tests" if "/test_" in target or target.startswith("test") else "other"].append((target, words))

    total = 0
    of_target = collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        for kind, all_commands in sorted(kinds.items()):
            taken = all_commands[::options.every]
            spent = 0
            for target, words in taken:
                seconds = seconds_of(words, options.build, os.path.join(folder, "out.o"))
                spent += seconds
                of_target[os.path.basename(target)] += seconds
            scaled = spent * len(all_commands) / len(taken)
            total += scaled
            print(f"{kind}: {len(all_commands)} compiler calls, {scaled:.0f} s of CPU ({len(taken)} measured)", flush=True)
    print(f"all: {total:.0f} s of CPU")
    for target, seconds in of_target.most_common(options.dearest):
        print(f"  {seconds:4.0f} s  {target}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
