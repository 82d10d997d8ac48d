"""How wrong the exact lines are themselves: random points of each model's edges, each judged by casting a ray at it.

    python benches/league/truth.py --models DIR -o truth --document docs/results/league.md

Twelve models, nine fetched and three made here, from 26 sides. Edges, their classes, and who hides what are found here anew, in f64,
with nothing of tinta's: points are spread evenly over the length in the picture of all silhouettes, creases, borders and non-manifold
edges, visible or not, and a ray from the eye is tested against every triangle that covers the point in the picture. Embree then answers
the same rays in f32. A point disagrees if the ray says visible and no visible line lies within NEAR_PX of it, or the ray says hidden and
a visible piece of its own edge covers it. Edges of faces seen edge-on are not among the points. Lines where faces cut one another are
taken from tinta, and only whether they are visible is asked: of our ray, by whether the first that it meets are two faces that cut one another.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE / "tools")]

import cameras  # noqa: E402
import models  # noqa: E402
from common import CREASE_DEGREES, edges, read_triangles  # noqa: E402
from document import put  # noqa: E402

# A ray's hit hides a point if it is nearer by more than this share of the distance.
HIT_NEARER = 1e-9
EMBREE_NEARER = 1e-4
# A ray that misses a face by no more than this share of it meets it, so that none slips through between two faces.
RIM = 1e-10
# Two faces meet on a ray if they are equally far but for this share.
MEETING = 1e-6
# Faces whose normals have a smaller sine between them are parallel.
PARALLEL = 1e-6
# A face whose normal is nearer to a right angle to the sight than this, as a sine, is seen edge-on.
EDGE_ON = 1e-9
NEAR_PX = 0.01
CELLS = 128


def project(points, camera):
    """Pixels, y down, and w."""
    clip = np.c_[points, np.ones(len(points))] @ np.array(camera["clip_from_world"]).T
    half = camera["size"] / 2
    return np.c_[half + half * clip[:, 0] / clip[:, 3], half - half * clip[:, 1] / clip[:, 3]], clip[:, 3]


def feature_edges(points, triangles, eye):
    """Edges that any drawing of lines would have, with the faces beside them."""
    pairs, both, counts, angles = edges(points, triangles)
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sight = corners.mean(1) - eye
    sine = (normals * sight).sum(1) / (np.linalg.norm(normals, axis=1) * np.linalg.norm(sight, axis=1))
    other = np.where(both[:, 1] < 0, both[:, 0], both[:, 1])
    same_way = runs_the_same_way(pairs, both, triangles)
    facing = np.sign(sine)
    silhouette = (facing[both[:, 0]] * facing[other] * np.where(same_way, -1, 1)) < 0
    edge_on = (np.abs(sine[both[:, 0]]) < EDGE_ON) | (np.abs(sine[other]) < EDGE_ON)
    wanted = ((counts != 2) | silhouette | (angles > CREASE_DEGREES)) & ~edge_on
    return pairs[wanted]


def runs_the_same_way(pairs, both, triangles):
    """Whether an edge's two faces run along it the same way, that is, are wound against each other."""

    def ascending(faces):
        corners = triangles[faces]
        following = corners[:, [1, 2, 0]]
        return ((corners == pairs[:, :1]) & (following == pairs[:, 1:])).any(1)

    return (ascending(both[:, 0]) == ascending(both[:, 1])) & (both[:, 1] >= 0)


class Caster:
    """Rays from the eye, in f64: in each cell of the picture the triangles that may cover it."""

    def __init__(self, points, triangles, camera):
        self.corners, self.triangles, self.eye = points[triangles], triangles, np.array(camera["eye"])
        normals = np.cross(self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0])
        self.normals = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
        self.scale = CELLS / camera["size"]
        pixels = project(points, camera)[0][triangles]
        low = np.clip(((pixels.min(1) - 1e-6) * self.scale).astype(int), 0, CELLS - 1)
        high = np.clip(((pixels.max(1) + 1e-6) * self.scale).astype(int), 0, CELLS - 1)
        wide, tall = (high - low + 1).T
        faces = np.repeat(np.arange(len(triangles)), wide * tall)
        step = np.arange(len(faces)) - np.repeat(np.cumsum(wide * tall) - wide * tall, wide * tall)
        x, y = low[faces, 0] + step % wide[faces], low[faces, 1] + step // wide[faces]
        cells = y * CELLS + x
        order = np.argsort(cells, kind="stable")
        self.faces = faces[order]
        self.starts = np.searchsorted(cells[order], np.arange(CELLS * CELLS + 1))

    def hidden(self, points, pixels, pairs):
        """Whether something is before each point, the faces at its own edge left out."""
        which, faces, t = self.hits(points, pixels)
        before = (t < 1 - HIT_NEARER) & ~beside(self.triangles[faces], pairs[which])
        return np.bincount(which[before], minlength=len(points)) > 0

    def faces_meet_first(self, points, pixels):
        """Whether the first that each ray meets are two faces that cut one another there, as at a visible line of intersection."""
        which, faces, t = self.hits(points, pixels)
        order = np.lexsort((t, which))
        which, faces, t = which[order], faces[order], t[order]
        first = np.searchsorted(which, which)
        together = t - t[first] < MEETING * t[first]
        # Faces that lie on one another are one surface.
        cut = np.linalg.norm(np.cross(self.normals[faces], self.normals[faces[first]]), axis=1) > PARALLEL
        # Faces beside one edge of the mesh do not cut one another.
        shared = (self.triangles[faces][:, :, None] == self.triangles[faces[first]][:, None, :]).sum((1, 2))
        return np.bincount(which[together & cut & (shared < 2)], minlength=len(points)) > 0

    def hits(self, points, pixels):
        """All faces that the rays to these points meet: the ray's number, the face, and how far, 1 at the point."""
        x, y = np.clip((pixels * self.scale).astype(int), 0, CELLS - 1).T
        cells = y * CELLS + x
        counts = self.starts[cells + 1] - self.starts[cells]
        which = np.repeat(np.arange(len(points)), counts)
        step = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
        faces = self.faces[self.starts[cells][which] + step]
        a, b, c = self.corners[faces].transpose(1, 0, 2)
        ray = points[which] - self.eye
        across = np.cross(ray, c - a)
        determinant = ((b - a) * across).sum(1)
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = 1 / determinant
            u = ((self.eye - a) * across).sum(1) * inverse
            q = np.cross(self.eye - a, b - a)
            v = (ray * q).sum(1) * inverse
            t = ((c - a) * q).sum(1) * inverse
            hit = (u >= -RIM) & (v >= -RIM) & (u + v <= 1 + RIM) & (t > 0)
        return which[hit], faces[hit], t[hit]


def beside(faces, pairs):
    """Whether each face has both of an edge's corners."""
    return (faces == pairs[:, :1]).any(1) & (faces == pairs[:, 1:]).any(1)


def embree_hidden(points, triangles, pairs, on, eye):
    """The same rays by Embree; None where it is not installed."""
    try:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene
    except ImportError:
        return None
    # Embree's numbers have seven digits: the model's middle goes to the origin, so that none is lost to where it stands.
    middle = points.mean(0)
    scene = EmbreeScene()
    TriangleMesh(scene, (points - middle)[triangles].astype(np.float32))
    start = np.repeat((eye - middle)[None].astype(np.float32), len(on), 0)
    result = scene.run(start, (on - eye).astype(np.float32), output=True)
    face, distance = result["primID"], result["tfar"]
    return (face >= 0) & (distance < 1 - EMBREE_NEARER) & ~beside(triangles[np.maximum(face, 0)], pairs)


def covered(pixels, pairs, segments):
    """Whether a visible piece of each point's own edge covers it."""
    pieces = {}
    for segment in segments:
        if segment["visible"] and segment["edge"]:
            pieces.setdefault(tuple(sorted(segment["edge"])), []).append((segment["a"], segment["b"]))
    answer = np.zeros(len(pixels), bool)
    for number, (point, pair) in enumerate(zip(pixels, pairs.tolist())):
        for a, b in pieces.get(tuple(pair), []):
            along = np.subtract(b, a)
            share = np.dot(point - a, along) / max(np.dot(along, along), 1e-300)
            answer[number] |= 0 <= share <= 1
    return answer


def near_visible(pixels, segments):
    """Whether any visible line is within NEAR_PX of each point."""
    visible = [(segment["a"], segment["b"]) for segment in segments if segment["visible"]]
    if not visible or not len(pixels):
        return np.zeros(len(pixels), bool)
    a, b = np.array(visible).transpose(1, 0, 2)
    along = b - a
    length = np.maximum((along**2).sum(1), 1e-300)
    answer = []
    for point in pixels:
        share = np.clip(((point - a) * along).sum(1) / length, 0, 1)
        answer.append((((a + share[:, None] * along - point) ** 2).sum(1)).min() < NEAR_PX**2)
    return np.array(answer, bool)


def judge(points, triangles, camera, segments, count, random):
    """Samples and how many of them disagree, by our rays and by Embree's."""
    eye = np.array(camera["eye"])
    pairs = feature_edges(points, triangles, eye)
    pixels, w = project(points, camera)
    lengths = np.linalg.norm(pixels[pairs[:, 1]] - pixels[pairs[:, 0]], axis=1)
    chosen = pairs[random.choice(len(pairs), count, p=lengths / lengths.sum())]
    share = random.uniform(size=count)
    wa, wb = w[chosen].T
    # The share of the way in the picture, as a share of the way in space.
    depth_share = share * wa / (share * wa + (1 - share) * wb)
    on = points[chosen[:, 0]] + depth_share[:, None] * (points[chosen[:, 1]] - points[chosen[:, 0]])
    at = pixels[chosen[:, 0]] + share[:, None] * (pixels[chosen[:, 1]] - pixels[chosen[:, 0]])
    drawn = covered(at, chosen, segments)
    uncovered = ~drawn
    near = drawn.copy()
    near[uncovered] = near_visible(at[uncovered], segments)
    result = {"points": count, "length_px": float(lengths.sum()), "visible_share": float(drawn.mean())}
    caster = Caster(points, triangles, camera)
    ours = caster.hidden(on, at, chosen)
    theirs = embree_hidden(points, triangles, chosen, on, eye)
    for name, hidden in (("f64", ours), ("embree", theirs)):
        if hidden is not None:
            result[f"{name}_missed"] = int((~hidden & ~near).sum())
            result[f"{name}_invented"] = int((hidden & drawn).sum())
    return result | judge_intersections(caster, camera, segments, count // 4, random)


def check(points, triangles, camera, segments, count):
    """Ends the run unless a line that is wrongly hidden is noticed: then the check itself would be broken."""
    longest = max((s for s in segments if s["visible"]), key=lambda s: np.hypot(*np.subtract(s["a"], s["b"])))
    spoilt = [{**segment, "visible": segment["visible"] and segment is not longest} for segment in segments]
    if judge(points, triangles, camera, spoilt, count, np.random.default_rng(0))["f64_missed"] == 0:
        raise SystemExit("a visible line was left out, and no ray missed it: the check is broken")


def judge_intersections(caster, camera, segments, count, random):
    """Random points of the lines where faces cut one another: how many are visible though the ray meets something else first, or hidden
    though it does not."""
    pieces = [segment for segment in segments if segment["class"] == "intersection"]
    if not pieces:
        return {"intersection_points": 0, "intersection_wrong": 0}
    a, b = np.array([(piece["a"], piece["b"]) for piece in pieces]).transpose(1, 0, 2)
    lengths = np.linalg.norm(b - a, axis=1)
    chosen = random.choice(len(pieces), count, p=lengths / lengths.sum())
    at = a[chosen] + random.uniform(size=(count, 1)) * (b - a)[chosen]
    half = camera["size"] / 2
    tangent = np.tan(np.radians(camera["fov_y_degrees"]) / 2)
    axes = np.array([camera["right"], camera["up"], camera["backward"]])
    ray = np.c_[(at[:, 0] - half) / half * tangent, (half - at[:, 1]) / half * tangent, -np.ones(count)] @ axes
    visible = np.array([piece["visible"] for piece in pieces])[chosen]
    meet = caster.faces_meet_first(caster.eye + camera["distance"] * ray, at)
    # A hidden line behind a visible one is where the ray meets that one's faces.
    missed = ~visible & meet
    missed[missed] = ~near_visible(at[missed], segments)
    wrong = (visible & ~meet) | missed
    return {"intersection_points": count, "intersection_wrong": int(wrong.sum())}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--models", type=Path, required=True, help="folder of the fetched models")
    parser.add_argument("-o", "--output", type=Path, required=True, help="folder for meshes, cameras, lines and truth.jsonl")
    parser.add_argument("--tinta", default=str(HERE.parents[1] / "target/release/tinta"), help="tinta's program")
    parser.add_argument("--points", type=int, default=2000, help="points for each model and view")
    parser.add_argument("--document", type=Path, help="document whose table is replaced")
    parser.add_argument("--only", default="", help="models, separated by commas")
    asked = parser.parse_args()
    names = [name for name in asked.only.split(",") if name] or [model[0] for model in models.FETCHED] + list(models.MADE)
    rows = []
    asked.output.mkdir(parents=True, exist_ok=True)
    with (asked.output / "truth.jsonl").open("w") as log:
        for name in names:
            mesh = models.prepare(name, asked.models, asked.output / "models")
            points, triangles = read_triangles(mesh)
            for number, (view, angles) in enumerate(cameras.around().items()):
                camera = cameras.camera(points, *angles)
                matrix, _ = cameras.write(camera, asked.output / "cameras", f"{name}-{number}")
                lines = asked.output / "lines.json"
                crease = str(CREASE_DEGREES)
                words = ["render", str(mesh), "--camera", str(matrix), "--size", "512x512", "--style", "lines", "--crease-angle", crease]
                result = subprocess.run([asked.tinta, *words, "-o", str(lines)], capture_output=True, text=True)
                if result.returncode != 0:
                    raise SystemExit(result.stderr.strip())
                segments = json.loads(lines.read_text())["segments"]
                if not rows:
                    check(points, triangles, camera, segments, asked.points)
                row = judge(points, triangles, camera, segments, asked.points, np.random.default_rng(number))
                rows.append({"model": name, "triangles": len(triangles), "view": view, **row})
                log.write(json.dumps(rows[-1]) + "\n")
                log.flush()
    text = table(rows)
    if asked.document:
        put(asked.document, text, "truth")
    print(text)


def table(rows):
    """A Markdown table: for each model the share of all points that disagree."""
    casters = [name for name in ("f64", "embree") if all(f"{name}_missed" in row for row in rows)]
    lines = ["| model |" + "".join(f" {name} |" for name in casters) + " intersections, f64 |"]
    lines.append("|---|" + "---|" * len(casters) + "---|")
    for model in [*dict.fromkeys(row["model"] for row in rows), "all"]:
        own = [row for row in rows if model in (row["model"], "all")]
        points = sum(row["points"] for row in own)
        wrong = [sum(row[f"{caster}_missed"] + row[f"{caster}_invented"] for row in own) for caster in casters]
        crossed = sum(row["intersection_points"] for row in own)
        share = f"{100 * sum(row['intersection_wrong'] for row in own) / crossed:.4f} %" if crossed else ""
        cells = [model, *(f"{100 * count / points:.4f} %" for count in wrong), share]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
