"""What the rows share: one figure of a row, and the runs of `evaluate` they read their figures from."""
from __future__ import annotations

import dataclasses
import functools
import json
import os
import pathlib
import re
import subprocess
import sys


class CannotMeasure(Exception):
    """A row lacks what it measures on; the message says what to do."""


@dataclasses.dataclass
class Figure:
    figure: str                 # what is measured, unique within its row
    value: float
    unit: str
    target: str | None = None   # e.g. ">= 90", in the unit of the value
    peer: str | None = None     # the library or program compared with, measured side by side
    peer_value: float | None = None
    conditions: str = ""

    def met(self):
        """Whether the value reaches the target; None without one."""
        if self.target is None:
            return None
        relation, bound = self.target.split()
        return {">=": self.value >= float(bound), "<=": self.value <= float(bound)}[relation]

    def record(self, row):
        return {"row": row, **dataclasses.asdict(self), "met": self.met()}


@dataclasses.dataclass
class Scene:
    """One scene's line of `evaluate`, shares in per cent."""
    found: float
    right: float
    average_recall: float
    median_seconds: float
    instances: int              # that `found` counts
    estimates: int              # that `right` counts

    def counts(self):
        """[found, instances, right, estimates]"""
        return [round(self.found * self.instances / 100), self.instances, round(self.right * self.estimates / 100),
                self.estimates]


SCENE_LINE = re.compile(
    r"scene (\d+): found \S+ \((\d+)/(\d+)\) right \S+ \((\d+)/(\d+)\) AR (\S+) median (\S+) s")


def corpus_folders(kind):
    """Data sets of benchmark/corpus of this kind ("test", "absent", ...), below MONOCULAR_EYE_HAND_CORPUS."""
    root = os.environ.get("MONOCULAR_EYE_HAND_CORPUS")
    if not root:
        raise CannotMeasure("set MONOCULAR_EYE_HAND_CORPUS to the folder of the test scenes, see benchmark/README.md")
    folders = sorted(pathlib.Path(root).glob(f"{kind}_*"))
    if not folders:
        raise CannotMeasure(f"{root} holds no folder {kind}_*")
    return folders


def is_right(row):
    """Whether a row of a dump is a right pose: its image distance (MSPD) from the truth is below 10 px."""
    return bool(row["mspd_px"]) and float(row["mspd_px"]) < 10


def share(part, whole):
    return 100.0 * part / max(whole, 1)


def parse_scenes(text):
    """{scene: Scene} from what `evaluate` prints."""
    scenes = {}
    for match in SCENE_LINE.finditer(text):
        scene, found, instances, right, estimates = map(int, match.groups()[:5])
        scenes[scene] = Scene(share(found, instances), share(right, estimates), float(match[6]), float(match[7]),
                              instances, estimates)
    return scenes


class Bench:
    """The built programs, the data, and a folder for what a run leaves behind."""

    def __init__(self, programs, out):
        self.programs = pathlib.Path(programs)
        self.out = pathlib.Path(out)
        self.root = pathlib.Path(__file__).resolve().parents[1]

    def program(self, name):
        path = self.programs / name
        if not path.exists():
            raise CannotMeasure(f"{path} is not built")
        return path

    def speed(self, room, *options):
        """{name: result} of the room's Google Benchmark program, of repeated ones the medians; leaves its JSON in `out`."""
        program = self.out / f"bench_{room}"  # benchmark/ of the build folder is where it is built
        if not program.exists():
            raise CannotMeasure(f"{program} is not built")
        path = self.out / f"speed_{room}.json"
        print(f"  bench_{room}", *options, file=sys.stderr, flush=True)
        code = subprocess.run([program, f"--benchmark_out={path}", "--benchmark_out_format=json", *options],
                              stdout=subprocess.DEVNULL, check=False).returncode
        if code:
            raise CannotMeasure(f"{program} ended with code {code}")
        results = json.loads(path.read_text(encoding="utf-8"))["benchmarks"]
        errors = [result for result in results if result.get("error_occurred")]
        if errors:
            raise CannotMeasure(f"{errors[0]['name']}: {errors[0]['error_message']}")
        return {result["run_name"]: result for result in results
                if result["repetitions"] == 1 or result.get("aggregate_name") == "median"}

    def plot(self, row, svg):
        """Leaves a row's plot in `out`."""
        (self.out / f"{row}.svg").write_text(svg, encoding="utf-8")

    def data(self, name):
        root = os.environ.get("MONOCULAR_EYE_HAND_DATA")
        if not root:
            raise CannotMeasure("set MONOCULAR_EYE_HAND_DATA to the folder of the data sets")
        path = pathlib.Path(root) / name
        if not path.is_dir():
            raise CannotMeasure(f"{path} does not exist; MONOCULAR_EYE_HAND_DATA names another folder")
        return path

    def run(self, program, *arguments):
        """What one of the built programs prints."""
        print(" ", program, *arguments[:4], file=sys.stderr, flush=True)
        done = subprocess.run([self.program(program), *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, check=False)
        if done.returncode:
            raise CannotMeasure(f"{program} ended with code {done.returncode}: {done.stderr.strip().splitlines()[-1:]}")
        return done.stdout

    def render(self, folder, objects, level, count, *options, scene=1):
        """A scene of random images of the objects in a BOP data set, unless it is there already."""
        if not (folder / "dev" / f"{scene:06d}" / "scene_gt.json").exists():
            self.run("render_scene", "--objects", objects, "--bop", folder, "--split", "dev", "--scene", scene, "--level", level,
                     "--count", count, "--seed", scene, *options)

    @functools.lru_cache(maxsize=None)  # rows that read the same run share it
    def evaluate(self, dataset, split, *options):
        """{scene: Scene} of the recogniser with default options over a split; leaves CSVs and log in `out`."""
        return self._evaluate(self.data(dataset), split, self._name(dataset, split, *options), options)

    @functools.lru_cache(maxsize=None)
    def evaluate_folder(self, folder, split, *options):
        """The same of a data set that lies anywhere."""
        return self._evaluate(folder, split, self._name(folder.name, split, *options), options)

    def results(self, dataset, split, *options):
        """The results CSV of such a run."""
        self.evaluate(dataset, split, *options)
        return self.out / f"{self._name(dataset, split, *options)}.csv"

    @functools.lru_cache(maxsize=None)
    def dump(self, dataset, split, *options):
        """The CSV of all candidates that such a run judged: a run of its own, because dumping takes time."""
        name = self._name(dataset, split, *options, "dumped")
        path = self.out / f"{name}.candidates.csv"
        self._evaluate(self.data(dataset), split, name, (*options, "--dump", path))
        return path

    @staticmethod
    def _name(*parts):
        return re.sub(r"[^\w.]+", "_", "_".join(map(str, parts)))

    def _evaluate(self, folder, split, name, options):
        csv = self.out / f"{name}.csv"
        # One thread, unless the options say otherwise: times do not depend on the number of cores.
        command = [self.program("evaluate"), "--dataset", folder, "--split", split, "--set", "threads=1", *options,
                   "--out", csv]
        print("  evaluate", folder.name, split, *options, file=sys.stderr, flush=True)
        with open(csv.with_suffix(".log"), "w", encoding="utf-8") as log:
            code = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, check=False).returncode
        text = csv.with_suffix(".log").read_text(encoding="utf-8")
        scenes = parse_scenes(text)
        if code or not scenes:
            raise CannotMeasure(f"evaluate ended with code {code}: {text.strip().splitlines()[-1:]} ({csv.with_suffix('.log')})")
        return scenes
