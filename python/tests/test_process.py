"""The package in its process: threads, signals, memory, a machine without OpenGL."""

import os
import signal
import subprocess
import sys
import textwrap
import threading

import numpy as np
import pytest
import tinta_npr as tn

#: Enough triangles for a second or more of work.
LARGE = """
import numpy as np
import tinta_npr as tn

def sheet(count):
    x, y = np.meshgrid(np.arange(count), np.arange(count), indexing="ij")
    vertices = np.stack([x, y, 3 * np.sin(x / 5) * np.cos(y / 7)], axis=-1).reshape(-1, 3).astype(float)
    a = (x * count + y)[:-1, :-1].ravel()
    return vertices, np.stack([a, a + count, a + count + 1, a + 1], axis=-1)
"""


def python(script, *words, **more):
    """A Python of its own that runs a script, and stops at Ctrl-C whatever started the tests."""
    hears = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"
    return subprocess.Popen(
        [sys.executable, *words, "-c", hears + textwrap.dedent(script)],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more,
    )


def ended(process, seconds=120):
    said, _ = process.communicate(timeout=seconds)
    assert process.returncode == 0, said
    return said


def test_ctrl_c_stops_lines_and_the_thread_that_finds_them():
    process = python(LARGE + """
    import os, sys, time
    mesh = tn.mesh(*sheet(700))
    threads = len(os.listdir("/proc/self/task"))
    print("begun", flush=True)
    try:
        tn.lines(mesh, classes="all", crease_angle=1)
        print("found")
    except KeyboardInterrupt:
        deadline = time.monotonic() + 60
        while len(os.listdir("/proc/self/task")) > threads:
            assert time.monotonic() < deadline, "the work goes on"
        print("stopped")
    """.replace("\n    ", "\n"))
    assert process.stdout.readline() == "begun\n"
    # It has a second of making edges before it, and minutes after.
    with pytest.raises(subprocess.TimeoutExpired):
        process.wait(timeout=0.7)
    process.send_signal(signal.SIGINT)
    assert ended(process) == "stopped\n"


def test_other_threads_go_on_meanwhile():
    counted, is_over = [0], threading.Event()

    def count():
        while not is_over.is_set():
            counted[0] += 1

    other = threading.Thread(target=count)
    other.start()
    before = counted[0]
    mesh = tn.mesh("builtin:bust")
    tn.lines(mesh)
    after = counted[0]
    is_over.set()
    other.join()
    assert after - before > 1000


def test_two_threads_find_and_draw_at_once_what_one_does():
    mesh = tn.mesh("builtin:gear")
    views = [(azimuth, 20) for azimuth in range(0, 160, 20)]
    draw = lambda view: (tn.lines(mesh, view=view).svg(), tn.render(mesh, view=view, size=64, style="inking").tobytes())
    expected = [draw(view) for view in views]
    found = [{}, {}]

    def work(number):
        for view in views:
            found[number][view] = draw(view)

    threads = [threading.Thread(target=work, args=(number,)) for number in (0, 1)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert all([of_one[view] for view in views] == expected for of_one in found)


def test_arrays_that_another_thread_changes_do_no_harm():
    vertices = np.random.default_rng(1).normal(size=(3000, 3))
    faces = np.random.default_rng(2).integers(0, 3000, size=(2000, 3))
    is_over = threading.Event()

    def scribble():
        while not is_over.is_set():
            faces[:] = 2**40
            vertices[:] = np.nan
            faces[:] = np.arange(6000).reshape(-1, 3) % 3000
            vertices[:] = 1.0

    other = threading.Thread(target=scribble)
    other.start()
    try:
        for _ in range(100):
            try:
                tn.mesh(vertices, faces)
            except ValueError:
                pass
    finally:
        is_over.set()
        other.join()


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="no /proc here")
def test_ten_thousand_calls_leave_memory_as_it_was(cube):
    vertices, faces = cube

    def calls(count):
        for _ in range(count):
            lines = tn.lines(vertices, faces, size=64)
            assert lines.svg() and len(lines.segments)
            with pytest.raises(ValueError):
                tn.lines(vertices, faces + 3)

    calls(500)
    tn.render(vertices, faces, size=64)
    before = resident_bytes()
    # Two calls each.
    calls(5000)
    assert resident_bytes() - before < 4e6, "400 bytes a call at most"


def test_pictures_leave_memory_as_it_was(cube):
    def calls(count):
        for _ in range(count):
            tn.render(*cube, size=64, style="inking").png()

    calls(100)
    before = resident_bytes()
    calls(400)
    assert resident_bytes() - before < 4e6


NOTHING_OF_GL = """
import tinta_npr as tn
lines = tn.lines("builtin:gear")
assert lines.svg() and lines.pdf() and len(tn.edges("builtin:ant")) and len(tn.silhouette("builtin:ant", (0, 0, 9)))
loaded = open("/proc/self/maps").read()
assert not any(name in loaded for name in ("libEGL", "libGL", "libOSMesa", "libX11", "libwayland"))
"""


def test_lines_load_no_opengl():
    ended(python(NOTHING_OF_GL, env={**os.environ, "LD_LIBRARY_PATH": "/nowhere", "DISPLAY": "", "WAYLAND_DISPLAY": ""}))


def test_without_any_opengl_lines_are_found_and_render_says_what_is_missing():
    known = subprocess.run(["/sbin/ldconfig", "-p"], capture_output=True, text=True).stdout.splitlines()
    libraries = [line.split(" => ")[1] for line in known if line.strip().startswith(("libEGL", "libOSMesa"))]
    # In a separate file system, where these libraries are empty files.
    hide = " && ".join(f"mount --bind /dev/null {path}" for path in {os.path.realpath(path) for path in libraries})
    if not libraries or subprocess.run(["unshare", "-rm", "sh", "-c", hide], capture_output=True).returncode:
        pytest.skip("this machine lets nobody have a file system of their own")
    script = NOTHING_OF_GL + """
try:
    tn.render("builtin:gear")
except RuntimeError as error:
    print(error)
"""
    environment = {**os.environ, "LD_LIBRARY_PATH": "/nowhere"}
    process = subprocess.run(
        ["unshare", "-rm", "sh", "-c", f'{hide} && exec "$0" -c "$1"', sys.executable, script],
        capture_output=True, text=True, env=environment,
    )
    assert process.returncode == 0, process.stderr
    assert process.stdout.startswith("no OpenGL 2.1 context could be made (tried EGL: "), process.stdout
    assert process.stdout.count("\n") == 1 and "apt-get install" in process.stdout


def test_a_process_that_is_forked_after_a_picture_says_so_and_one_that_is_not_draws():
    script = """
import os, warnings
import tinta_npr as tn
warnings.simplefilter("ignore", DeprecationWarning)
if {draws_before}:
    tn.render("builtin:gear", size=32)
child = os.fork()
if child == 0:
    try:
        print(tn.lines("builtin:gear") is not None, tn.render("builtin:gear", size=32).shape, flush=True)
    except RuntimeError as error:
        print(error, flush=True)
    os._exit(0)
os.waitpid(child, 0)
"""
    assert ended(python(script.format(draws_before=False))) == "True (32, 32, 4)\n"
    assert ended(python(script.format(draws_before=True))).startswith("this process was forked from one that had drawn")


def test_the_package_needs_nothing_but_numpy():
    script = """
import sys
import numpy
before = set(sys.modules)
import tinta_npr
new = {name.split(".")[0] for name in set(sys.modules) - before}
assert new <= {"tinta_npr", "atexit", "os", "math"}, new
"""
    ended(python(script))


def test_it_is_the_installed_package_that_is_tested():
    # Not the one in the source tree, which has no compiled part.
    source = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    assert not os.path.abspath(tn.__file__).startswith(source + os.sep) or os.environ.get("TINTA_IN_PLACE")
