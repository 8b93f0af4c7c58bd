"""Plots as SVG, without any library: curves over logarithmic or linear axes, bars in groups."""
import math
from xml.sax.saxutils import escape

COLOURS = ("#c0392b", "#e08e0b", "#1f77b4", "#2e8b57", "#7b4fa3", "#555555")
WIDTH, HEIGHT = 720, 420
LEFT, RIGHT, TOP, BOTTOM = 80, 200, 40, 60  # margins; the legend stands in the right one


class LogAxis:
    """Whole decades around positive values."""

    def __init__(self, values):
        self.low = math.floor(math.log10(min(values)))
        self.high = max(math.ceil(math.log10(max(values))), self.low + 1)

    def place(self, value):
        """0 at the low end, 1 at the high end."""
        return (math.log10(value) - self.low) / (self.high - self.low)

    def ticks(self):
        step = 1 if self.high - self.low < 9 else 2
        return [(10.0 ** k, f"{10 ** k:g}" if abs(k) < 5 else f"1e{k}") for k in range(self.low, self.high + 1, step)]


class LinearAxis:
    """Round steps around the values."""

    def __init__(self, values):
        span = max(max(values) - min(values), 1e-12)
        decade = 10.0 ** math.floor(math.log10(span / 4))
        self.step = next(m * decade for m in (1, 2, 5, 10) if span / (m * decade) <= 6)
        self.low = math.floor(min(values) / self.step + 1e-9)
        self.high = max(math.ceil(max(values) / self.step - 1e-9), self.low + 1)

    def place(self, value):
        return (value / self.step - self.low) / (self.high - self.low)

    def ticks(self):
        return [(k * self.step, f"{k * self.step:g}") for k in range(self.low, self.high + 1)]


def log_plot(curves, title, x_label, y_label):
    """SVG text of {name: [(x, y), ...]}, all coordinates positive."""
    return plot(curves, title, x_label, y_label, LogAxis)


def linear_plot(curves, title, x_label, y_label):
    """SVG text of {name: [(x, y), ...]}."""
    return plot(curves, title, x_label, y_label, LinearAxis)


def bar_plot(groups, title, y_label, axis=LinearAxis):
    """SVG text of {group: {series: value}}; every group has the same series. On a logarithmic axis 0 is no bar."""
    series = list(next(iter(groups.values())))
    values = [value for bars in groups.values() for value in bars.values()]
    y_axis = axis([value for value in values if value > 0] if axis is LogAxis else [0.0, *values])
    left, right, bottom = LEFT, WIDTH - RIGHT, HEIGHT - BOTTOM
    svg = frame(title, "", y_label, y_axis)
    slot = (right - left) / len(groups)
    width = 0.8 * slot / len(series)
    for g, (group, bars) in enumerate(groups.items()):
        for i, name in enumerate(series):
            x, value = left + (g + 0.1) * slot + i * width, bars[name]
            height = max(0.0, y_axis.place(value)) * (bottom - TOP) if value > 0 else 0.0
            svg.append(f'<rect x="{x:.1f}" y="{bottom - height:.1f}" width="{width:.1f}" height="{height:.1f}" '
                       f'fill="{COLOURS[i % len(COLOURS)]}"/>')
            svg.append(f'<text x="{x + width / 2:.1f}" y="{bottom - height - 4:.1f}" text-anchor="middle" '
                       f'font-size="9">{value:.3g}</text>')
        x, y = left + (g + 0.5) * slot, bottom + 18
        how = (f'text-anchor="end" font-size="11" transform="rotate(-30 {x:.1f} {y})"' if len(groups) > 5
               else 'text-anchor="middle"')
        svg.append(f'<text x="{x:.1f}" y="{y}" {how}>{escape(group)}</text>')
    return "\n".join(svg + legend(series) + ["</svg>"]) + "\n"


def plot(curves, title, x_label, y_label, axis):
    x_axis, y_axis = (axis([point[k] for points in curves.values() for point in points]) for k in (0, 1))
    left, right, bottom = LEFT, WIDTH - RIGHT, HEIGHT - BOTTOM

    def place(x, y):
        return left + x_axis.place(x) * (right - left), bottom - y_axis.place(y) * (bottom - TOP)

    svg = frame(title, x_label, y_label, y_axis)
    for value, text in x_axis.ticks():
        x = left + x_axis.place(value) * (right - left)
        svg.append(f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{bottom}" stroke="#ddd"/>')
        svg.append(f'<text x="{x:.1f}" y="{bottom + 18}" text-anchor="middle">{text}</text>')
    for i, points in enumerate(curves.values()):
        colour = COLOURS[i % len(COLOURS)]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in (place(*point) for point in points))
        svg.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        for x, y in (place(*point) for point in points):
            svg.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>')
    return "\n".join(svg + legend(curves) + ["</svg>"]) + "\n"


def frame(title, x_label, y_label, y_axis):
    """The plot's opening: white ground, title, labels, the lines and numbers of its y axis."""
    left, right, bottom, middle = LEFT, WIDTH - RIGHT, HEIGHT - BOTTOM, (TOP + HEIGHT - BOTTOM) / 2
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
           'font-size="13">', f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           f'<text x="{LEFT}" y="24" font-size="15">{escape(title)}</text>',
           f'<text x="{(left + right) / 2}" y="{HEIGHT - 16}" text-anchor="middle">{escape(x_label)}</text>',
           f'<text x="22" y="{middle}" text-anchor="middle" transform="rotate(-90 22 {middle})">{escape(y_label)}</text>']
    for value, text in y_axis.ticks():
        y = bottom - y_axis.place(value) * (bottom - TOP)
        svg.append(f'<line x1="{left}" y1="{y:.1f}" x2="{right}" y2="{y:.1f}" stroke="#ddd"/>')
        svg.append(f'<text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">{text}</text>')
    return svg


def legend(names):
    svg = []
    for i, name in enumerate(names):
        y, x = TOP + 16 + 22 * i, WIDTH - RIGHT + 14
        svg.append(f'<line x1="{x}" y1="{y - 4}" x2="{x + 24}" y2="{y - 4}" '
                   f'stroke="{COLOURS[i % len(COLOURS)]}" stroke-width="2"/>')
        svg.append(f'<text x="{x + 30}" y="{y}">{escape(name)}</text>')
    return svg
