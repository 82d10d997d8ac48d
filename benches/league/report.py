"""Judges what run.py drew and writes the tables, the plot and a sheet of pictures.

    python benches/league/report.py league
    python benches/league/report.py league --document docs/results/league.md

Writes OUT/table.md and OUT/plot.svg, with --document also into that file, between the comments "league: begin" and "league: end";
OUT/sheet.png (agreed ink black, missed lines red, invented ink blue); and OUT/page, the page of `tinta measure --merge`.
"""

import argparse
import json
import math
import re
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from document import put  # noqa: E402
from plot import plot  # noqa: E402
from programs import PROGRAMS  # noqa: E402

CLASSES = ["silhouette", "crease", "boundary", "non-manifold", "intersection"]
SHEET_VIEW = "30,15"
SHEET_MODELS = ["ant", "suzanne", "teapot", "bunny"]
THUMBNAIL_PX = 180


def records(text):
    """The JSON objects that stand one after the other."""
    decoder, at = json.JSONDecoder(), 0
    while at < len(text.rstrip()):
        record, at = decoder.raw_decode(text, at)
        yield record
        at += len(text[at:]) - len(text[at:].lstrip())


def drawn(runs):
    """For each case and program its drawing, version and the medians of its rounds."""
    found = {}
    for run in runs:
        if not run["failure"]:
            found.setdefault((run["case"], run["program"]), []).append(run)
    for own in found.values():
        inside = [run["drawing_seconds"] for run in own if run["drawing_seconds"] is not None]
        yield {
            **own[0],
            "seconds": statistics.median(run["seconds"] for run in own),
            "peak_mib": min(run["peak_mib"] for run in own),
            "drawing_seconds": statistics.median(inside) if inside else None,
            "rounds": len(own),
        }


def judge(tinta, folder, case, drawings, again):
    """tinta's records for all drawings of one model and view, in their order."""
    answer = folder / "judged" / f"{case}.json"
    if again or not answer.exists() or answer.stat().st_mtime < (folder / "runs.jsonl").stat().st_mtime:
        rows = folder / "judged" / case
        shutil.rmtree(rows, ignore_errors=True)
        rows.mkdir(parents=True)
        mesh = rows / f"{case}.obj"
        mesh.symlink_to(folder / "models" / f"{drawings[0]['model']}.obj")
        words = [tinta, "judge", *[str(folder / drawing["drawing"]) for drawing in drawings]]
        words += ["--model", str(mesh), "--camera", str(folder / "cameras" / f"{case}.txt"), "--crease-angle", "30", "--json", "-o", str(rows)]
        words += ["--names", ",".join(drawing["program"].replace(",", "") for drawing in drawings)]
        words += ["--seconds", ",".join(f"{drawing['seconds']:.4f}" for drawing in drawings)]
        result = subprocess.run(words, capture_output=True, text=True)
        # With 1 it doubts a drawing, such as the bunny black with edges, and gives its numbers nevertheless.
        if result.returncode not in (0, 1):
            raise SystemExit(f"{case}: {result.stderr.strip()}")
        answer.write_text(result.stdout)
    return list(records(answer.read_text()))


def mean(values):
    values = [value for value in values if value is not None]
    return statistics.fmean(values) if values else None


def share(value):
    return "" if value is None else f"{100 * value:.1f} %"


def summary(name, rows):
    """One program's numbers over all cases that it drew."""
    lines = [row["judged"]["lines"] for row in rows]
    worst = min(rows, key=lambda row: row["judged"]["lines"]["f1"])
    hidden = sum(row["judged"]["hidden"]["length_px"] for row in rows)
    inside = [row["drawing_seconds"] for row in rows]
    return {
        "name": name,
        "is_reference": next(program.is_reference for program in PROGRAMS if program.name == name),
        "version": rows[0]["version"],
        "f1": mean(line["f1"] for line in lines),
        "worst": f"{worst['judged']['lines']['f1']:.3f} {worst['case']}",
        "recall": mean(line["recall"] for line in lines),
        "precision": mean(line["precision"] for line in lines),
        "one": mean(row["judged"]["one_to_one"][0]["f1"] for row in rows),
        "hidden": sum(row["judged"]["hidden"]["drawn_px"] for row in rows) / hidden if hidden else None,
        "seconds": math.exp(mean(math.log(row["seconds"]) for row in rows)),
        "inside": None if None in inside else math.exp(mean(math.log(value) for value in inside)),
        "peak": max(row["peak_mib"] for row in rows),
        "classes": {kind: mean(line["recall_of_class"].get(kind) for line in lines) for kind in CLASSES},
    }


# F1 is printed to three digits; smaller differences count as equal.
EQUAL_F1 = 0.002


def beaten(summaries):
    """Which programs have less error than which of tinta's styles, in no more time."""
    ours = [row for row in summaries if row["name"].startswith("tinta") and not row["is_reference"]]
    peers = [row for row in summaries if not row["name"].startswith("tinta")]
    better = [(peer, own) for peer in peers for own in ours if peer["f1"] > own["f1"] + EQUAL_F1 and peer["seconds"] <= own["seconds"]]
    if better:
        return [f"- {peer['name']} has less error than {own['name']} ({peer['f1']:.3f}, {own['f1']:.3f}) in {peer['seconds'] / own['seconds']:.2f} of its time" for peer, own in better] + [""]
    fastest, slowest = min(peers, key=lambda row: row["seconds"]), max(ours, key=lambda row: row["seconds"])
    return [
        f"On average, tinta's slowest style ({slowest['name']}, {slowest['seconds']:.2f} s) is faster than every peer ({fastest['name']}, {fastest['seconds']:.2f} s), "
        'so no comparison at equal time is possible. "Of that, drawing" excludes the start.',
        "",
    ]


def by_class_and_model(summaries, rows):
    """What each program found of every class, and its seconds on the smallest, the middle and the largest model."""
    triangles = {row["model"]: row["triangles"] for row in rows}
    models = sorted(triangles, key=triangles.get)
    models = [models[0], models[len(models) // 2], models[-1]]
    heads = ["found of", *CLASSES, *(f"s: {model}, {triangles[model]} triangles" for model in models)]
    having = [sum(1 for row in first_of_cases(rows) if kind in row["judged"]["lines"]["recall_of_class"]) for kind in CLASSES]
    text = ["", "| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    text.append("| " + " | ".join(["pictures with such lines", *map(str, having), *([""] * len(models))]) + " |")
    for row in summaries:
        own = [[run["seconds"] for run in rows if (run["program"], run["model"]) == (row["name"], model)] for model in models]
        seconds = [f"{statistics.median(values):.2f}" if values else "–" for values in own]
        text.append("| " + " | ".join([row["name"], *(share(row["classes"][kind]) for kind in CLASSES), *seconds]) + " |")
    return text


def tables(about_run, summaries, rows, failures, missing):
    """The report's Markdown."""
    text = [f"{about_run['date']}, {about_run['system']}, {about_run['processor']}, {about_run['cores']} cores, OpenGL in software, {about_run['tinta']}; {about_run['rounds']} rounds.", ""]
    text += beaten(summaries)
    text += ["| program | version | F1 | worst | found | of the ink right | one to one, 1 px | hidden drawn | s | of that, drawing | MiB |"]
    text.append("|" + "---|" * 11)
    for row in summaries:
        # A single executable has no modules to load: all of it counts.
        inside = "all" if row["inside"] is None or row["inside"] > 0.95 * row["seconds"] else f"{row['inside']:.2f}"
        hidden = "–" if program_of(row).draws.startswith("all") else share(row["hidden"])
        text.append(
            f"| {named(row)} | {row['version']} ({program_of(row).year}) | {row['f1']:.3f} | {row['worst']} | {share(row['recall'])} | {share(row['precision'])} | {row['one']:.3f} | "
            f"{hidden} | {row['seconds']:.2f} | {inside} | {row['peak']:.0f} |"
        )
    text += by_class_and_model(summaries, rows)
    text += ["", "| program | can draw | settings |", "|---|---|---|"]
    for row in (row for row in summaries if not row["name"].startswith("tinta")):
        program = program_of(row)
        text.append(f"| {row['name']} | {program.draws} | {program.settings} |")
    text += ["", "Not drawn:", ""] + [f"- {name}: {reason}" for name, reason in sorted({**missing, **failures}.items())]
    return "\n".join(text) + "\n"


def program_of(row):
    return next(program for program in PROGRAMS if program.name == row["name"])


def named(row):
    return f"({row['name']}: the reference)" if row["is_reference"] else row["name"]


def first_of_cases(rows):
    """One row for each model and view."""
    return {row["case"]: row for row in rows}.values()


def sheet(folder, rows, names):
    """Error pictures of each program, of some models in one view."""
    from PIL import Image, ImageDraw, ImageFilter, ImageFont

    try:
        font = ImageFont.truetype("DejaVuSans.ttf", 13)
    except OSError:
        font = ImageFont.load_default()
    half = (len(names) + 1) // 2
    wide, high = THUMBNAIL_PX * len(SHEET_MODELS) + 24, THUMBNAIL_PX + 20
    picture = Image.new("RGB", (2 * wide, high * half), "white")
    draw = ImageDraw.Draw(picture)
    for row in rows:
        if row["view"] != SHEET_VIEW or row["model"] not in SHEET_MODELS:
            continue
        # As `tinta judge` names its files.
        ending = "512x512-" + re.sub("[^A-Za-z0-9._#+=-]", "-", row["program"].replace(",", ""))
        found = [path for path in (folder / "judged" / row["case"] / "errors").iterdir() if path.stem.endswith(ending)]
        number = names.index(row["program"])
        x, y = number // half * wide + SHEET_MODELS.index(row["model"]) * THUMBNAIL_PX, number % half * high
        if found:
            # Lines of two pixels stay as dark where they are made small.
            large = Image.open(found[0]).convert("RGB").filter(ImageFilter.MinFilter(3))
            picture.paste(large.resize((THUMBNAIL_PX, THUMBNAIL_PX), Image.Resampling.LANCZOS), (x, y + 20))
    for number, name in enumerate(names):
        draw.text((number // half * wide + 4, number % half * high + 2), name, fill="black", font=font)
    picture.quantize(32).save(folder / "sheet.png", optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="folder that run.py wrote")
    parser.add_argument("--tinta", default=str(HERE.parents[1] / "target/release/tinta"), help="tinta's program")
    parser.add_argument("--document", type=Path, help="document whose results are replaced")
    parser.add_argument("--again", action="store_true", help="judge again although nothing was drawn since")
    asked = parser.parse_args()
    folder = asked.folder.resolve()
    (folder / "judged").mkdir(exist_ok=True)
    runs = [json.loads(line) for line in (folder / "runs.jsonl").read_text().splitlines()]
    rows = list(drawn(runs))
    by_case = {}
    for row in rows:
        by_case.setdefault(row["case"], []).append(row)
    for case, own in by_case.items():
        for row, record in zip(own, judge(asked.tinta, folder, case, own, asked.again), strict=True):
            row["judged"] = record
        print(case, flush=True)
    by_program = {}
    for row in rows:
        by_program.setdefault(row["program"], []).append(row)
    summaries = sorted((summary(name, own) for name, own in by_program.items()), key=lambda row: -row["f1"])
    failures = {f"{run['program']}, {run['model']}": run["failure"] for run in runs if run["failure"]}
    missing = json.loads((folder / "missing.json").read_text())
    about_run = {**json.loads((folder / "about.json").read_text()), "rounds": max(row["rounds"] for row in rows)}
    text = tables(about_run, summaries, rows, failures, missing)
    (folder / "table.md").write_text(text)
    picture = plot([(named(row), row["seconds"], 1 - row["f1"]) for row in summaries], "Error against time")
    (folder / "plot.svg").write_text(picture)
    sheet(folder, rows, [row["name"] for row in summaries])
    if asked.document:
        pictures = asked.document.parent.parent / "pictures"
        (pictures / "league.svg").write_text(picture)
        shutil.copy(folder / "sheet.png", pictures / "league-sheet.png")
        put(asked.document, f"![error against time](../pictures/league.svg)\n\n{text}")
    page = folder / "page"
    shutil.rmtree(page, ignore_errors=True)
    merged = [str(folder / "judged" / case / "results.jsonl") for case in by_case]
    subprocess.run([asked.tinta, "measure", "--merge", *merged, "-o", str(page)], check=True)
    print(text)


if __name__ == "__main__":
    main()
