"""Results inside a document, between two comments."""

BEGIN, END = "<!-- league: begin -->", "<!-- league: end -->"


def put(document, text):
    """Replaces what stands between the comments."""
    before, found, rest = document.read_text().partition(BEGIN)
    _, ends, after = rest.partition(END)
    if not found or not ends:
        raise SystemExit(f"{document} has no place for results; put the lines {BEGIN} and {END} into it")
    document.write_text(f"{before}{BEGIN}\n\n{text.strip()}\n\n{END}{after}")
