#!/usr/bin/python3
"""test_summary.py FOLDER   skipped and failed cases by name, and the counts, from the JUnit files below FOLDER.

Exit code 0 when at least one case passed and none failed."""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def outcome(case):
    """'passed', 'failed' or 'skipped', and the message that says why."""
    for tag in ("failure", "error"):
        bad = case.find(tag)
        if bad is not None:
            return "failed", bad.get("message") or bad.text or ""
    skipped = case.find("skipped")
    if skipped is not None:
        return "skipped", skipped.get("message") or skipped.text or ""
    return ("skipped", "disabled") if case.get("status") == "notrun" else ("passed", "")


def main(folder):
    counts = {"passed": 0, "failed": 0, "skipped": 0}
    for path in sorted(pathlib.Path(folder).rglob("*.xml")):
        try:
            cases = list(ElementTree.parse(path).iter("testcase"))
        except ElementTree.ParseError as error:
            counts["failed"] += 1
            print(f"FAILED  {path.name}: {error}")
            continue
        for case in cases:
            result, message = outcome(case)
            counts[result] += 1
            if result != "passed":
                why = message.strip().splitlines()
                why = " ".join(line.strip() for line in why if ".cpp:" not in line)[:200]
                print(f"{result.upper():7} {case.get('classname')}.{case.get('name')}: {why}")
    print(f"{counts['passed']} passed, {counts['failed']} failed, {counts['skipped']} skipped")
    return 0 if counts["passed"] and not counts["failed"] else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
