#!/usr/bin/python3
"""run.py --programs DIR --out DIR [--list] [ROW...]   measures the rows (all by default), see benchmark/README.md.

Prints the table and writes OUT/results.json: {row, figure, value, unit, target, met, peer, peer_value, conditions}.
Exit code 0 when every row could be measured, whether or not its targets are met."""
import argparse
import importlib.util
import json
import os
import pathlib
import platform
import subprocess
import sys

sys.dont_write_bytecode = True
from figures import Bench, CannotMeasure

HERE = pathlib.Path(__file__).resolve().parent


def load_rows():
    """{name: module} of benchmark/rows/<name>.py, by name."""
    rows = {}
    for path in sorted((HERE / "rows").glob("*.py")):
        spec = importlib.util.spec_from_file_location(path.stem, path)
        rows[path.stem] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(rows[path.stem])
    return rows


def machine():
    """What the figures depend on besides the code."""
    cpu = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo", encoding="utf-8")
                if line.startswith("model name")), platform.machine())
    commit = subprocess.run(["git", "-C", str(HERE), "describe", "--always", "--dirty"], capture_output=True,
                            text=True, check=False).stdout.strip() or "unknown"
    return f"{cpu}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}; commit {commit}"


COLUMNS = ("row", "figure", "value", "unit", "target", "met", "peer", "peer_value", "conditions")


def cell(value):
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "NO"
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def print_table(records):
    lines = [COLUMNS[:-1]] + [tuple(cell(record[column]) for column in COLUMNS[:-1]) for record in records]
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
    for line in lines:
        print("  ".join(text.ljust(width) for text, width in zip(line, widths)).rstrip())
    targets = [record["met"] for record in records if record["met"] is not None]
    print(f"{sum(targets)} of {len(targets)} targets met")


def measure(rows, bench):
    """(records of the rows' figures, what could not be measured and why)"""
    records, unmeasured = [], []
    for name, module in rows.items():
        print(f"{name} ...", file=sys.stderr, flush=True)
        where = machine()
        try:
            figures = list(module.figures(bench))
        except CannotMeasure as reason:
            unmeasured.append(f"{name} could not be measured: {reason}")
            continue
        for figure in figures:
            figure.conditions = "; ".join(filter(None, [figure.conditions, where]))
            record = figure.record(name)
            records.append({column: record[column] for column in COLUMNS})
    return records, unmeasured


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", required=True)
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("rows", nargs="*", metavar="ROW")
    arguments = parser.parse_args()
    rows = load_rows()
    if arguments.list:
        for name, module in rows.items():
            print(f"{name:20} {module.__doc__.strip().splitlines()[0]}")
        return 0
    unknown = [name for name in arguments.rows if name not in rows]
    if unknown:
        parser.error(f"no row {', '.join(unknown)}; there are {', '.join(rows)}")

    arguments.out.mkdir(parents=True, exist_ok=True)
    wanted = {name: rows[name] for name in arguments.rows or rows}
    records, unmeasured = measure(wanted, Bench(arguments.programs, arguments.out))
    (arguments.out / "results.json").write_text(json.dumps(records, indent=1) + "\n", encoding="utf-8")
    if records:
        print_table(records)
    print("\n".join([*unmeasured, f"written: {arguments.out / 'results.json'}"]))
    return 1 if unmeasured else 0


if __name__ == "__main__":
    sys.exit(main())
