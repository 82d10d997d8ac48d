"""Error against time, each program a named dot, as an SVG."""

import math
from html import escape

WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM = 860, 520, 60, 50, 30, 50
OURS, PEERS = "#b0302a", "#245a8a"
# F1 is printed to three digits; less error than half of the last is drawn here.
LEAST_ERROR = 0.0005


def plot(points, title):
    """`points`: name, seconds, error. Both axes are logarithmic."""
    seconds = [point[1] for point in points]
    errors = [max(point[2], LEAST_ERROR) for point in points]
    low_x, high_x = math.log10(min(seconds)) - 0.1, math.log10(max(seconds)) + 0.1
    low_y, high_y = math.log10(min(errors)) - 0.1, math.log10(max(errors)) + 0.1

    def x_of(value):
        return LEFT + (math.log10(value) - low_x) / (high_x - low_x) * (WIDTH - LEFT - RIGHT)

    def y_of(value):
        return HEIGHT - BOTTOM - (math.log10(value) - low_y) / (high_y - low_y) * (HEIGHT - TOP - BOTTOM)

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="12">',
        '<rect width="100%" height="100%" fill="#fff"/>',
        f'<text x="{LEFT}" y="20" font-size="15" font-weight="bold">{escape(title)}</text>',
        f'<text x="{LEFT}" y="38">left is faster (seconds of the whole process), low is better (1 − F1; 0.0005 stands for that or less); red: tinta</text>',
    ]
    for low, high, of, is_x in ((low_x, high_x, x_of, True), (low_y, high_y, y_of, False)):
        for exponent in range(math.floor(low), math.ceil(high) + 1):
            for digit in (1, 2, 5):
                value = digit * 10.0**exponent
                if not low <= math.log10(value) <= high:
                    continue
                at = of(value)
                if is_x:
                    parts.append(f'<path d="M{at:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>')
                    parts.append(f'<text x="{at:.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">{value:g}</text>')
                else:
                    parts.append(f'<path d="M{LEFT} {at:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>')
                    parts.append(f'<text x="{LEFT - 6}" y="{at + 4:.1f}" text-anchor="end">{value:g}</text>')
    taken = [(x_of(s) - 5, y_of(e) - 5, x_of(s) + 5, y_of(e) + 5) for s, e in zip(seconds, errors)]
    for (name, _, _), second, error in sorted(zip(points, seconds, errors), key=lambda entry: entry[1]):
        x, y = x_of(second), y_of(error)
        color = OURS if name.startswith(("tinta", "(tinta")) else PEERS
        # What stands in brackets is the reference: a ring.
        fill = "#fff" if name.startswith("(") else color
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.5" fill="{fill}" stroke="{color}"/>')
        box = place(x, y, 7.2 * len(name), taken)
        taken.append(box)
        if abs(box[1] + 7 - y) > 12:
            parts.append(f'<path d="M{x:.1f} {y:.1f}L{min(max(x, box[0]), box[2]):.1f} {box[1] + 7:.1f}" stroke="{color}" stroke-width="0.6"/>')
        parts.append(f'<text x="{box[0]:.1f}" y="{box[1] + 11:.1f}" fill="{color}">{escape(name)}</text>')
    return "\n".join([*parts, "</svg>", ""])


def place(x, y, width, taken):
    """The free place for a name that is nearest to its dot: right, left, then farther above and below."""
    for step in range(40):
        shift = (step + 1) // 2 * 14 * (1 if step % 2 else -1)
        for left in (x + 8, x - 8 - width):
            box = (left, y - 7 + shift, left + width, y + 7 + shift)
            inside = box[0] > LEFT and box[2] < WIDTH - 4 and box[1] > TOP - 8 and box[3] < HEIGHT - BOTTOM
            if inside and not any(box[0] < b[2] and b[0] < box[2] and box[1] < b[3] and b[1] < box[3] for b in taken):
                return box
    return (x + 8, y - 7, x + 8 + width, y + 7)
