"""What the node adds to the recognition: from the image's stamp to the objects, in a graph of real nodes."""
import json
import statistics
import subprocess

from figures import CannotMeasure, Figure

IMAGES = 20


def figures(bench):
    setup = bench.programs.parents[1] / "setup.bash"
    if not setup.exists():
        raise CannotMeasure(f"{setup} is missing: the nodes need the build with ROS")
    data = bench.root / "data" / "demo"
    run = subprocess.run(["bash", "-c", f". '{setup}' && '{bench.root}/benchmark/latency.py' '{data}' "
                          f"'{data}/camera.yaml' {IMAGES}"], stdout=subprocess.PIPE, text=True, check=False)
    if run.returncode != 0:
        raise CannotMeasure("the nodes did not run")
    overheads = [1e3 * seconds for seconds in json.loads(run.stdout)]
    conditions = f"{IMAGES} images of data/demo, one every 3 s; arrival of ~objects less stamp less the time of recognition"
    yield Figure("time beyond recognition, median", statistics.median(overheads), "ms", "<= 5", conditions=conditions)
    yield Figure("time beyond recognition, longest", max(overheads), "ms", conditions=conditions)
