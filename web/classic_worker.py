#!/usr/bin/env python3
"""Joins the page's worker and what it imports to one script that is no module: a page opened from a folder starts no other in Chromium.

usage: classic_worker.py GLUE DIST    GLUE is the program's script by `wasm-bindgen --target no-modules`; DIST/worker.js is replaced
"""

import pathlib
import re
import sys

IMPORT = re.compile(r'^import (?P<names>\{[^}]*\}|\w+) from "\./(?P<file>[^"]+)";\n', re.MULTILINE)

glue, dist = (pathlib.Path(word) for word in sys.argv[1:])
joined = [glue.read_text()]
done = set()


def join(name):
    """A module after those that it imports, each once, all in one scope."""
    done.add(name)
    text = (dist / name).read_text()
    for found in IMPORT.finditer(text):
        if found["file"] not in done | {"tinta.js"}:
            join(found["file"])
    text = IMPORT.sub(lambda found: f"const {found['names']} = wasm_bindgen;\n" if found["file"] == "tinta.js" else "", text)
    joined.append(re.sub(r"^export ", "", text, flags=re.MULTILINE))


join("worker.js")
(dist / "worker.js").write_text("\n".join(joined))
