"""A plot with logarithmic axes as SVG, without any library."""
import math
from xml.sax.saxutils import escape

COLOURS = ("#c0392b", "#e08e0b", "#1f77b4", "#2e8b57")
WIDTH, HEIGHT = 720, 420
LEFT, RIGHT, TOP, BOTTOM = 80, 200, 40, 60  # margins; the legend stands in the right one


def decades(values):
    """(lowest, highest) exponent of ten that enclose the values."""
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    return low, max(high, low + 1)


def log_plot(curves, title, x_label, y_label):
    """SVG text of {name: [(x, y), ...]}, all coordinates positive."""
    x_low, x_high = decades([x for points in curves.values() for x, _ in points])
    y_low, y_high = decades([y for points in curves.values() for _, y in points])
    across = (WIDTH - LEFT - RIGHT) / (x_high - x_low)
    up = (HEIGHT - TOP - BOTTOM) / (y_high - y_low)

    def place(x, y):
        return LEFT + (math.log10(x) - x_low) * across, HEIGHT - BOTTOM - (math.log10(y) - y_low) * up

    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
           'font-size="13">', f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           f'<text x="{LEFT}" y="24" font-size="15">{escape(title)}</text>']
    for k in range(x_low, x_high + 1):
        x, bottom = place(10.0 ** k, 10.0 ** y_low)
        svg.append(f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{bottom:.1f}" stroke="#ddd"/>')
        svg.append(f'<text x="{x:.1f}" y="{bottom + 18:.1f}" text-anchor="middle">{10 ** k:g}</text>')
    for k in range(y_low, y_high + 1, 1 if y_high - y_low < 9 else 2):
        x, y = place(10.0 ** x_low, 10.0 ** k)
        svg.append(f'<line x1="{x:.1f}" y1="{y:.1f}" x2="{WIDTH - RIGHT}" y2="{y:.1f}" stroke="#ddd"/>')
        svg.append(f'<text x="{x - 8:.1f}" y="{y + 4:.1f}" text-anchor="end">1e{k}</text>')
    for i, (name, points) in enumerate(curves.items()):
        colour = COLOURS[i % len(COLOURS)]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in (place(*point) for point in points))
        svg.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        for x, y in (place(*point) for point in points):
            svg.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>')
        y = TOP + 16 + 22 * i
        svg.append(f'<line x1="{WIDTH - RIGHT + 14}" y1="{y - 4}" x2="{WIDTH - RIGHT + 38}" y2="{y - 4}" '
                   f'stroke="{colour}" stroke-width="2"/>')
        svg.append(f'<text x="{WIDTH - RIGHT + 44}" y="{y}">{escape(name)}</text>')
    svg.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 16}" text-anchor="middle">{escape(x_label)}</text>')
    middle = (TOP + HEIGHT - BOTTOM) / 2
    svg.append(f'<text x="22" y="{middle}" text-anchor="middle" transform="rotate(-90 22 {middle})">{escape(y_label)}</text>')
    return "\n".join(svg + ["</svg>"]) + "\n"
