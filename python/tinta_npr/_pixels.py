"""Areas and lines as one picture, for figures of PyVista. pillow, which PyVista brings, reads the lines.

In: areas of a view, with colours, and a PNG of the lines over nothing. Out: pixels. Each pixel is the mean of the areas in it, by their exact
shares, as if they were drawn together: no seam lies between neighbours.
"""

import io

import numpy as np


def of_png(content):
    """The pixels of a PNG: (H, W, 4), from 0 to 1."""
    from PIL import Image

    return np.asarray(Image.open(io.BytesIO(content)).convert("RGBA")) / 255.0


def laid(below, above, opacity=1.0):
    """A picture over another. Colours are multiplied by their opacities: (H, W, 4)."""
    return above * opacity + below * (1 - above[..., 3:] * opacity)


def multiplied(pixels):
    """The colours of pixels multiplied by their opacities."""
    return np.concatenate([pixels[..., :3] * pixels[..., 3:], pixels[..., 3:]], axis=-1)


def divided(pixels):
    """The bytes of a picture whose colours are multiplied by their opacities."""
    colors = pixels[..., :3] / np.maximum(pixels[..., 3:], 1e-9)
    return np.round(np.concatenate([colors, pixels[..., 3:]], axis=-1).clip(0, 1) * 255).astype(np.uint8)


def of_areas(size, areas, colors):
    """Areas as pixels (H, W, 4), multiplied by their opacities.

    Parameters
    ----------
    areas : list of lists of ndarray (K, 2)
        Each area's loops, holes the other way around than the outer loop, which comes first; pixels, y down. No two overlap.
    colors : ndarray (N, 3)
    """
    width, height = size
    starts, ends, values = [np.empty((0, 2))], [np.empty((0, 2))], [np.empty((0, 4))]
    for loops, color in zip(areas, colors):
        (x, y), (next_x, next_y) = loops[0].T, np.roll(loops[0], -1, axis=0).T
        value = np.sign((x * next_y - next_x * y).sum()) * np.array([*color, 1.0])
        for corners in loops:
            starts.append(corners)
            ends.append(np.roll(corners, -1, axis=0))
            values.append(np.broadcast_to(value, (len(corners), 4)))
    # What each pixel has more than the one to its left; the last columns lie outside.
    steps = np.zeros((height * (width + 2), 4))
    for pixels, shares in _steps(np.concatenate(starts), np.concatenate(ends), np.concatenate(values), width, height):
        for channel in range(4):
            steps[:, channel] += np.bincount(pixels, shares[:, channel], len(steps))
    return np.cumsum(steps.reshape(height, width + 2, 4), axis=1)[:, :width].clip(0, 1)


def _steps(starts, ends, values, width, height):
    """The pixels where sides change what lies to their right, and by how much."""
    # Outside of the picture only the part to the left counts, at its border.
    (x, y), (to_x, to_y) = starts.T, ends.T
    y, to_y = y.clip(0, height), to_y.clip(0, height)
    rises = to_y != y
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = (to_x - x) / (ends - starts)[:, 1]
    x, y, to_y, slope, values, origin = (part[rises] for part in (x, y, to_y, slope, values, starts[:, 1]))
    values = -values * np.sign(to_y - y)[:, None]
    low, high = np.minimum(y, to_y), np.maximum(y, to_y)
    # The part of each side in each row.
    side, row = _pieces(np.floor(low), np.ceil(high))
    top, bottom = np.maximum(low[side], row), np.minimum(high[side], row + 1)
    at = lambda y: (x[side] + (y - origin[side]) * slope[side]).clip(0, width)
    left, right = np.minimum(at(top), at(bottom)), np.maximum(at(top), at(bottom))
    # And in each pixel of the row.
    part, column = _pieces(np.floor(left), np.floor(right) + 1)
    enter, leave = np.maximum(left[part], column), np.minimum(right[part], column + 1)
    length = (right - left)[part]
    share = np.divide(leave - enter, length, out=np.ones_like(length), where=length > 0)
    whole = ((bottom - top)[part] * share)[:, None] * values[side[part]]
    beside = ((enter + leave) / 2 - column)[:, None] * whole
    pixel = (row[part] * (width + 2) + column).astype(np.int64)
    return [(pixel, whole - beside), (pixel + 1, beside)]


def _pieces(first, end):
    """The numbers of ranges, and the numbers in them: of the range from `first` to `end`, `end` excluded."""
    counts = (end - first).astype(np.int64)
    number = np.repeat(np.arange(len(counts)), counts)
    return number, first[number] + np.arange(len(number)) - (np.cumsum(counts) - counts)[number]
