#!/usr/bin/env python3
"""Tests web/dist in a headless browser: serves it with the test page, opens the page, waits for what it reports.

usage: serve.py BROWSER TINTA [PAGE]    BROWSER is Chromium, TINTA the command line that draws what the page is compared with, PAGE
tests.html or times.html. Beside the page the server has what only the machine can do: /drawn?ARGUMENTS runs `tinta render ARGUMENTS`
and answers the file, /made?ARGUMENTS does so with `tinta page`, /models/NAME is a file of the folder TINTA_MODELS.
"""

import http.server
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import urllib.parse

HERE = pathlib.Path(__file__).resolve().parent
DIST = HERE.parent / "dist"
SECONDS = 540
COMMANDS = {"/drawn": ["render"], "/made": ["page", "--from", DIST / "page.html"]}

browser, tinta, *rest = sys.argv[1:]
page_name = rest[0] if rest else "tests.html"
done = threading.Event()
results = []
outside = []


class Handler(http.server.SimpleHTTPRequestHandler):
    """Files of web/dist, then of web/tests; pictures of the command line; what the page reports."""

    def translate_path(self, path):
        name = urllib.parse.urlsplit(path).path.lstrip("/")
        if name.startswith("models/"):
            return str(pathlib.Path(os.environ.get("TINTA_MODELS", "models")) / pathlib.Path(name).name)
        for folder in (DIST, HERE):
            if (folder / name).is_file():
                return str(folder / name)
        return str(DIST / name)

    def do_GET(self):
        address = urllib.parse.urlsplit(self.path)
        if address.path not in COMMANDS:
            return super().do_GET()
        arguments = json.loads(urllib.parse.unquote(address.query))
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / arguments.pop()
            ran = subprocess.run([tinta, *COMMANDS[address.path], *arguments, "-o", file], capture_output=True, check=False)
            body = file.read_bytes() if ran.returncode == 0 else ran.stderr
        self.send_response(200 if ran.returncode == 0 else 500)
        self.send_header("Content-Length", str(len(body)))
        if address.path == "/made":
            self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(body)

    def do_POST(self):
        report = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        self.send_response(204)
        self.end_headers()
        if report.get("done"):
            done.set()
        else:
            results.append(report)
            print(("ok      " if report["ok"] else "FAILED  ") + report["name"] + report.get("note", ""), flush=True)

    def log_message(self, *_):
        pass


server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
threading.Thread(target=server.serve_forever, daemon=True).start()
with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
    page = subprocess.Popen(
        [
            browser,
            "--headless=new",
            "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader",
            "--no-sandbox",
            "--no-first-run",
            "--disable-background-timer-throttling",
            "--js-flags=--expose-gc",
            "--enable-precise-memory-info",
            "--window-size=1280,900",
            f"--user-data-dir={profile}",
            f"http://127.0.0.1:{server.server_port}/{page_name}",
        ],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    in_time = done.wait(SECONDS)
    page.terminate()
    page.wait()
failed = [result["name"] for result in results if not result["ok"]]
if not in_time:
    failed.append(f"the page was not done within {SECONDS} s")
print(f"{len(results) - len(failed)} passed, {len(failed)} failed")
sys.exit(1 if failed or not results else 0)
