"""The league: every program draws every model in every view, each drawing in a process of its own, and tinta judges the drawings.

    python benches/league/run.py --models DIR -o league
    python benches/league/report.py league

Each drawing is a line of OUT/runs.jsonl, so that a run that was interrupted goes on where it stopped. Rounds are outermost, and in each
round the programs take turns in another order. A program that is not installed is named in OUT/missing.json with the reason.
"""

import argparse
import datetime
import json
import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE / "tools")]

import cameras  # noqa: E402
import models  # noqa: E402
from common import read_triangles  # noqa: E402
from programs import MISSING, PROGRAMS  # noqa: E402

# A drawing that takes longer than this is made in the first round only: its time varies little, and the others' rounds go on.
ONCE_SECONDS = 10
OPTIONS = {"TINTA": "tinta", "PYTHON": "python", "BLENDER": "blender-python", "NODE": "node-modules", "LARNT": "larnt"}
QUICK_MODELS = ["ant", "cow", "suzanne"]


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--models", type=Path, required=True, help="folder of the fetched models")
    parser.add_argument("-o", "--output", type=Path, required=True, help="folder for drawings, runs.jsonl and what is judged")
    parser.add_argument("--tinta", default=str(HERE.parents[1] / "target/release/tinta"), help="tinta's program")
    parser.add_argument("--python", default=sys.executable, help="Python with requirements.txt")
    parser.add_argument("--blender-python", default="", help="Python 3.11 with requirements-blender.txt")
    parser.add_argument("--node-modules", default=str(HERE / "three/node_modules"), help="where npm installed three/package.json")
    parser.add_argument("--larnt", default=str(HERE / "larnt/target/release/league-larnt"), help="program built from larnt/")
    parser.add_argument("--rounds", type=int, default=3, help="drawings of each kind; times are medians")
    parser.add_argument("--limit", type=float, default=60, help="seconds after which a drawing is given up")
    parser.add_argument("--quick", action="store_true", help="three models, one view, one round")
    parser.add_argument("--only", default="", help="programs whose names contain one of these, separated by commas")
    return parser.parse_args()


def command_of(program, asked, paths):
    """The words of a command; None with a reason where the program is not there."""
    runners = {"TINTA": asked.tinta, "PYTHON": asked.python, "BLENDER": asked.blender_python, "NODE": "node", "LARNT": asked.larnt}
    words = []
    for word in program.command.split():
        if word in runners:
            found = shutil.which(runners[word]) if runners[word] else None
            if not found:
                return None, f"its script needs what run.py's --help calls --{OPTIONS[word]}, and that is not there"
            words.append(found)
        elif word.endswith((".py", ".mjs")):
            words.append(str(HERE / ("tools" if word.endswith(".py") else "") / word))
        else:
            words.append(str(paths.get(word, word)))
    return words, None


def draw(words, limit, environment):
    """Runs one command: seconds by the clock, the largest process's peak memory in MiB, its status and output."""
    # -S and -I keep the starter small.
    starter = [sys.executable, "-I", "-S", str(HERE / "measured.py"), str(limit), *words]
    result = subprocess.run(starter, stdout=subprocess.PIPE, text=True, env=environment, check=True)
    return json.loads(result.stdout)


def last_record(output):
    """The JSON object that a script prints last."""
    for line in reversed(output.splitlines()):
        if line.startswith("{"):
            return json.loads(line)
    return {}


def why_failed(result):
    if result["gave_up"]:
        return f"given up after {result['seconds']:.0f} s"
    lines = [line for line in result["output"].splitlines() if line.strip()]
    return f"exit {result['status']}: {lines[-1] if lines else 'it says nothing'}"


def display(folder):
    """A virtual screen for programs that need one, and its process; the screen that is there already is left alone."""
    if not shutil.which("Xvfb"):
        return None, None
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1024x1024x24"],
        pass_fds=[write],
        stderr=(folder / "xvfb.log").open("w"),
    )
    os.close(write)
    with os.fdopen(read) as answer:
        return f":{answer.readline().strip()}", server


def cases(asked):
    """Models and views, with the mesh and the camera written."""
    names = QUICK_MODELS if asked.quick else [model[0] for model in models.FETCHED]
    views = {"30,15": cameras.VIEWS["30,15"]} if asked.quick else cameras.VIEWS
    for name in names:
        mesh = models.prepare(name, asked.models, asked.output / "models")
        points, triangles = read_triangles(mesh)
        for view, (azimuth, elevation) in views.items():
            case = f"{name}-{view.replace(',', '+')}"
            matrix, words = cameras.write(cameras.camera(points, azimuth, elevation), asked.output / "cameras", case)
            yield {"model": name, "view": view, "case": case, "triangles": len(triangles), "MODEL": mesh, "MATRIX": matrix, "CAMERA": words}


def processor():
    """The processor's name, as far as the system tells it."""
    try:
        names = [line.partition(":")[2].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")]
    except OSError:
        names = []
    return names[0] if names else platform.processor() or "unknown processor"


def main():
    asked = options()
    asked.output = asked.output.resolve()
    (asked.output / "drawings").mkdir(parents=True, exist_ok=True)
    log = asked.output / "runs.jsonl"
    runs = [json.loads(line) for line in log.read_text().splitlines()] if log.exists() else []
    finished = {(run["program"], run["case"], run["round"]) for run in runs}
    failed = {(run["program"], run["model"]) for run in runs if run["failure"]}
    slow = {(run["program"], run["case"]) for run in runs if run["seconds"] > ONCE_SECONDS}
    wanted = [word for word in asked.only.split(",") if word]
    programs = [program for program in PROGRAMS if not wanted or any(word in program.name for word in wanted)]
    missing = dict(MISSING)
    for program in programs:
        _, reason = command_of(program, asked, {})
        if reason:
            missing[program.name] = reason
    (asked.output / "missing.json").write_text(json.dumps(missing, indent=1) + "\n")
    programs = [program for program in programs if program.name not in missing]
    tinta_version = subprocess.run([asked.tinta, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    about = {
        "date": datetime.date.today().isoformat(),
        "system": f"{platform.system()} {platform.machine()}",
        "processor": processor(),
        "cores": os.cpu_count(),
        "tinta": tinta_version,
    }
    (asked.output / "about.json").write_text(json.dumps(about, indent=1) + "\n")
    all_cases = list(cases(asked))
    screen, server = display(asked.output)
    environment = {**os.environ, "LEAGUE_NODE_MODULES": asked.node_modules}
    try:
        for round_now in range(1 if asked.quick else asked.rounds):
            for number, case in enumerate(all_cases):
                turn = (round_now * 5 + number) % len(programs)
                for program in programs[turn:] + programs[:turn]:
                    key = (program.name, case["case"], round_now)
                    if key in finished or (program.name, case["model"]) in failed or key[:2] in slow:
                        continue
                    drawing = asked.output / "drawings" / f"{case['case']}-{program.name.replace(' ', '-').replace(',', '')}.{program.ends}"
                    words, _ = command_of(program, asked, {**case, "DRAWING": drawing})
                    now = {**environment, "DISPLAY": screen} if program.needs_display and screen else environment
                    result = draw(words, asked.limit, now)
                    said = last_record(result["output"]) if "TINTA" not in program.command else {"version": tinta_version}
                    failure = why_failed(result) if result["status"] != 0 or not drawing.exists() else None
                    if failure:
                        failed.add((program.name, case["model"]))
                    if result["seconds"] > ONCE_SECONDS:
                        slow.add(key[:2])
                    run = {
                        "program": program.name,
                        "model": case["model"],
                        "view": case["view"],
                        "case": case["case"],
                        "triangles": case["triangles"],
                        "round": round_now,
                        "version": said.get("version"),
                        "renderer": said.get("renderer"),
                        "drawing_seconds": said.get("drawing_seconds"),
                        "seconds": result["seconds"],
                        "peak_mib": result["peak_mib"],
                        "failure": failure,
                        "drawing": str(drawing.relative_to(asked.output)),
                        "command": " ".join(words),
                    }
                    with log.open("a") as lines:
                        lines.write(json.dumps(run) + "\n")
                    print(f"{run['case']:16} {program.name:34} {run['seconds']:7.2f} s  {failure or ''}", flush=True)
    finally:
        if server:
            server.terminate()
            server.wait()


if __name__ == "__main__":
    main()
