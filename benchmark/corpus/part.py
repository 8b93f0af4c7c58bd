"""One part while it is built: its random draws, its solid, and the details that can be left out."""
import random

import cad


class Failure(Exception):
    """The draw makes no usable part; the next one is tried."""


class Part:
    """A solid that grows by `add` and `cut`. A step that carries the name of a detail is skipped when that detail is
    to be left out, while its random draws happen all the same: the rest of the part stays what it was."""
    def __init__(self, seed, without=(), member=0):
        self.random = random.Random(seed)
        self.member = member
        self.without = without
        self.details = []
        self.solid = None

    # Draws: lengths are rounded as a draughtsman rounds them.

    def mm(self, low, high, step=0.5):
        return round(self.random.uniform(low, high) / step) * step

    def whole(self, low, high):
        return self.random.randint(low, high)

    def chance(self, probability=0.5):
        return self.random.random() < probability

    def choice(self, options):
        return self.random.choice(options)

    def variant(self, options):
        """The option whose turn it is: members of a family that follow each other differ in it."""
        return options[self.member % len(options)]

    def text(self, length):
        return "".join(self.random.choice(sorted(cad.DIGITS)) for _ in range(length))

    # Steps

    def add(self, *solids, detail=None):
        if self.leaves_out(detail) or not solids:
            return

        self.solid = cad.fused([*([self.solid] if self.solid else []), *solids])

    def cut(self, *solids, detail=None):
        if self.leaves_out(detail) or not solids:
            return

        self.solid = self.solid.cut(list(solids))

    def common(self, solid):
        self.solid = self.solid.common(solid)

    def leaves_out(self, detail):
        if detail and detail not in self.details:
            self.details.append(detail)

        return detail in self.without

    def clean(self):
        """Joins faces that lie in one surface."""
        try:
            self.solid = self.solid.removeSplitter()
        except cad.KernelError:
            pass

    def fillet(self, radius, choose=lambda edge: True):
        """Rounds the chosen edges; where the kernel cannot, by less, or not at all."""
        self.soften("makeFillet", radius, choose)

    def chamfer(self, size, choose=lambda edge: True):
        self.soften("makeChamfer", size, choose)

    def soften(self, operation, size, choose):
        self.clean()
        edges = [edge for edge in self.solid.Edges if edge.Length > 1e-3 and choose(edge)]
        for factor in (1, 0.6, 0.3):
            if not edges:
                return
            try:
                result = getattr(self.solid, operation)(factor * size, edges)
            except cad.KernelError:
                continue
            if result.isValid() and len(result.Solids) == 1 and result.Volume > 0:
                self.solid = result
                return


# Choices of edges


def along(axis):
    """Straight edges in the direction of an axis."""
    direction = cad.vector(axis)

    def choose(edge):
        return edge.Curve.TypeId == "Part::GeomLine" and abs(edge.tangentAt(edge.FirstParameter).dot(direction)) > 0.999

    return choose


def at(axis, value):
    """Edges that lie in a plane across an axis."""
    def choose(edge):
        box = edge.BoundBox
        low, high = {"x": (box.XMin, box.XMax), "y": (box.YMin, box.YMax), "z": (box.ZMin, box.ZMax)}[axis]
        return abs(low - value) < 1e-4 and abs(high - value) < 1e-4

    return choose


def circular(low=0, high=1e9):
    """Circles and arcs with a radius in a range."""
    return lambda edge: edge.Curve.TypeId == "Part::GeomCircle" and low <= edge.Curve.Radius <= high


def both(*choices):
    return lambda edge: all(choose(edge) for choose in choices)


def either(*choices):
    return lambda edge: any(choose(edge) for choose in choices)
