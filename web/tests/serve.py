#!/usr/bin/env python3
"""Tests web/dist in headless browsers: serves it with the test page, opens pages, waits for what they report.

usage: serve.py TINTA PAGE BROWSER…    TINTA is the command line that draws what the page is compared with

The first browser, Chromium, opens PAGE: tests.html or times.html. Unless it is times.html, every browser then opens pages that `tinta page`
makes from a folder, without a server: with workers, with none, and with failing ones. PAGE by_file does this alone.

Beside the page the server has what only the machine can do: /drawn?ARGUMENTS runs `tinta render ARGUMENTS` and answers the file,
/made?ARGUMENTS does so with `tinta page`, /models/NAME is a file of the folder TINTA_MODELS.
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
CHROMIUM = [
    "--headless=new",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--no-sandbox",
    "--no-first-run",
    "--disable-background-timer-throttling",
    # Tests in a page that is a file come from the server.
    "--disable-features=LocalNetworkAccessChecks",
    "--js-flags=--expose-gc",
    "--enable-precise-memory-info",
    "--window-size=1280,900",
]
# What becomes of workers in a page: each a script that runs before the page's own.
WORKERS = {
    "good": """
        globalThis.Worker = class extends Worker {
          postMessage(message) {
            if (globalThis.ends && message.number) this.dispatchEvent(new ErrorEvent("error", { message: "out of memory" }));
            else super.postMessage(message);
          }
        };""",
    "none": 'globalThis.Worker = class { constructor() { throw new Error("no workers"); } };',
    "failing": """
        globalThis.Worker = class extends Worker {
          constructor() { super(URL.createObjectURL(new Blob(["throw new Error()"]))); }
        };""",
}

tinta, page_name, *browsers = sys.argv[1:]
done = threading.Event()
results = []


def made(command, arguments, file):
    """What tinta writes with this command; its standard error where it fails."""
    ran = subprocess.run([tinta, *COMMANDS[command], *arguments, "-o", file], capture_output=True, check=False)
    return (200, file.read_bytes()) if ran.returncode == 0 else (500, ran.stderr)


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

    def end_headers(self):
        # A page from a folder has no origin.
        self.send_header("Access-Control-Allow-Origin", "*")
        super().end_headers()

    def do_GET(self):
        address = urllib.parse.urlsplit(self.path)
        if address.path not in COMMANDS:
            return super().do_GET()
        arguments = json.loads(urllib.parse.unquote(address.query))
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / arguments.pop()
            status, body = made(address.path, arguments, file)
        self.send_response(status)
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


def open_in(browser, address, seconds):
    """Opens an address in a new browser, and waits until its tests are done."""
    done.clear()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        is_firefox = "firefox" in browser
        profiled = ["--headless", "--no-remote", "--profile", profile] if is_firefox else [*CHROMIUM, f"--user-data-dir={profile}"]
        page = subprocess.Popen([browser, *profiled, address], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        in_time = done.wait(seconds)
        page.terminate()
        page.wait()
    if not in_time:
        results.append({"name": f"{address} was not done within {seconds} s", "ok": False})
        print(f"FAILED  {results[-1]['name']}", flush=True)


def by_file(browser, server, workers, folder):
    """A page as `tinta page` makes it, in a folder, with these workers and with its tests."""
    file = folder / f"{workers}.html"
    status, body = made("/made", ["builtin:gear", "--style", "phong", "--right", "three-pass"], file)
    if status != 200:
        sys.exit(body.decode())
    name = pathlib.Path(browser).name
    opening = json.dumps(f"{name}, from a folder, workers {workers}")
    before = f"<script>globalThis.opening = {opening}; globalThis.workers = {json.dumps(workers)}; {WORKERS[workers]}</script>"
    page = body.decode().replace("default-src 'none';", f"default-src 'none'; connect-src {server};").replace("script-src ", f"script-src {server} ")
    page = page.replace("<script", f"{before}\n<script", 1).replace("</body>", f'<script type="module" src="{server}/by_file.js"></script>\n</body>')
    file.write_text(page)
    open_in(browser, file.as_uri(), 240)


server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
threading.Thread(target=server.serve_forever, daemon=True).start()
address = f"http://127.0.0.1:{server.server_port}"
if page_name != "by_file":
    open_in(browsers[0], f"{address}/{page_name}", SECONDS)
if page_name != "times.html":
    with tempfile.TemporaryDirectory() as folder:
        for browser in browsers:
            for workers in WORKERS:
                by_file(browser, address, workers, pathlib.Path(folder))
failed = [result["name"] for result in results if not result["ok"]]
print(f"{len(results) - len(failed)} passed, {len(failed)} failed")
sys.exit(1 if failed or not results else 0)
