"""Results inside a document, between two comments."""


def put(document, text, name="league"):
    """Replaces the text between the comments `name: begin` and `name: end`."""
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    before, found, rest = document.read_text().partition(begin)
    _, ends, after = rest.partition(end)
    if not found or not ends:
        raise SystemExit(f"{document} has no place for results; put the lines {begin} and {end} into it")
    document.write_text(f"{before}{begin}\n\n{text.strip()}\n\n{end}{after}")
