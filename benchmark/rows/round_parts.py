"""Parts without long sharp edges, each alone with its own kind in easy scenes of its own."""
import meshes
from figures import Figure

IMAGES = 16
TARGET = ">= 90"
SIZE = "640x480"


def figures(bench):
    shoulder = [(0, 0), (45, 0), (45, 10), (22, 10), (22, 35), (0, 35)]
    parts = {"filleted box": meshes.rounded_box((80, 50, 34), 8), "box with small fillets": meshes.rounded_box((70, 46, 30), 3),
             "can": meshes.turned([(0, 0), (33, 0), (33, 115), (0, 115)], 72),
             "can with rounded rims": meshes.turned(meshes.rounded([(0, 0), (33, 0), (33, 60), (0, 60)], 3), 72),
             "flange with rounded edges": meshes.turned(meshes.rounded(shoulder, 2), 72),
             "screw": meshes.screw(), "cone": meshes.turned([(0, 0), (35, 0), (0, 90)], 72),
             "flange": bench.root / "models" / "flange.ply"}
    for name, mesh in parts.items():
        folder = bench.out / f"round_{name.replace(' ', '_')}"
        folder.mkdir(exist_ok=True)
        objects = meshes.objects_file(folder, "part", mesh)
        bench.render(folder, objects, "easy", IMAGES, "--sizes", f"{SIZE}:1", "--appearance", "plain")
        scene, = bench.evaluate_folder(folder, "dev").values()
        found, instances, right, estimates = scene.counts()
        yield Figure(f"{name} found", scene.found, "%", TARGET,
                     conditions=f"{found} of {instances} in {IMAGES} easy images; right {right} of {estimates}; "
                                f"{scene.median_seconds:.2f} s, one thread")
