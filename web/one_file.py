#!/usr/bin/env python3
"""Makes the page one file, which works from a folder without a server.

usage: one_file.py DIST    DIST is the folder that scripts/web builds; writes DIST/page.html, and makes DIST/pictures smaller.

Style sheets stand in the page as they are. All other files are compressed, in Base64, in script elements that no browser runs: the
attribute data-file is a file's name, data-lecture the lecture that alone needs it. `tinta page` leaves out those of other lectures
and adds a model. web/page/one-file.js unpacks them.
"""

import base64
import gzip
import pathlib
import re
import sys

from smaller_png import smaller

POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; style-src 'unsafe-inline'; img-src data: blob:"
)

dist = pathlib.Path(sys.argv[1])
for picture in (dist / "pictures").glob("*.png"):
    picture.write_bytes(smaller(picture.read_bytes()))


def element(name, lecture=None):
    """A file as a script element on one line."""
    packed = base64.b64encode(gzip.compress((dist / name).read_bytes(), 9, mtime=0)).decode()
    of = f' data-lecture="{lecture}"' if lecture else ""
    return f'<script type="text/plain" data-file="{name}"{of}>{packed}</script>\n'


def pictures(text):
    """The pictures of a document, but for those of buffers, which the page draws live: they stand under the option that shows them."""
    found, heads = set(), None
    for line in text.splitlines():
        cells = line.split("|")
        heads = (heads or cells) if line.startswith("|") else None
        for head, cell in zip(heads or [""] * len(cells), cells):
            if not head.strip().startswith("`--show "):
                found.update(re.findall(r"pictures/[^)]*", cell))
    return sorted(found)


parts = [element(file.name) for file in sorted(dist.glob("*.js")) if file.name != "one-file.js"]
parts += [element("tinta_bg.wasm"), element("licences.txt")]
for document in sorted(dist.glob("how-*-works.md")):
    lecture = document.stem.split("-")[1]
    parts.append(element(document.name, lecture))
    for picture in pictures(document.read_text()):
        parts.append(element(picture, lecture))

page = (dist / "index.html").read_text()
for sheet in ["page.css", "web.css"]:
    page = page.replace(f'<link rel="stylesheet" href="{sheet}">', f"<style>\n{(dist / sheet).read_text()}</style>")
policy = f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
page = page.replace('<html lang="en">', '<html lang="en" data-one-file>').replace('<meta charset="utf-8">', f'<meta charset="utf-8">\n{policy}')
script = (dist / "one-file.js").read_text()
before, after = page.split('<script type="module" src="main.js"></script>\n')
(dist / "page.html").write_text(f"{before}{''.join(parts)}<!-- lesson -->\n<script>\n{script}</script>\n{after}")
