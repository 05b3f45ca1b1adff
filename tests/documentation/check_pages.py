#!/usr/bin/env python3
"""What a page of the documentation has to keep to.   check_pages.py ROOT

Case pages have at most 60 lines. No page names a commit, a day or an earlier program. Links within the project lead somewhere, anchors too. Cells of tables in the
pages of results and cases have at most 60 characters. Exit code 1 where one does not.
"""
import pathlib, re, sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"))
import results

LINES, CELL = 60, 60
COMMIT = re.compile(r"\b(?=[0-9a-f]*[a-f])(?=[0-9a-f]*[0-9])[0-9a-f]{7,40}\b")
NUMBER = re.compile(r"\d+e\d+")
MONTHS = "January|February|March|April|May|June|July|August|September|October|November|December"
HISTORY = re.compile(rf"earlier (?:program|scheme|build)|\b(?:{MONTHS}) 20\d\d\b")
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
PLAIN = re.compile(r"\[([^\]]*)\]\([^)]*\)")


def anchors(text):
    """The anchors that GitHub and the site make of the headings."""
    found = {}
    for line in results.without_code(text).splitlines():
        if re.match(r"#+ ", line):
            heading = PLAIN.sub(r"\1", line.lstrip("#").strip()).lower()
            slug = re.sub(r"[^\w\- ]", "", heading).replace(" ", "-")
            found[slug] = found.get(slug, -1) + 1
    return {slug if n == 0 else f"{slug}-{n}" for slug, count in found.items() for n in range(count + 1)}


def bad_links(root, path, text):
    for target in LINK.findall(re.sub(r"`[^`\n]*`", "", results.without_code(text))):
        name, _, anchor = target.partition("#")
        if ":" in name:
            continue
        there = (path.parent / name).resolve() if name else path
        if not there.exists():
            yield f"{target} leads nowhere"
        elif anchor and there.suffix == ".md" and anchor not in anchors(there.read_text()):
            yield f"{target}: no heading of {there.relative_to(root)} has this anchor"


def mistakes(root, path):
    page, text = path.relative_to(root).as_posix(), path.read_text()
    lines = text.splitlines()
    if page.startswith("cases/") and len(lines) > LINES:
        yield f"{len(lines)} lines; a case page has at most {LINES}"
    for number, line in enumerate(results.without_code(text).splitlines(), 1):
        for word in COMMIT.findall(line):
            if not NUMBER.fullmatch(word):
                yield f"line {number}: {word} looks like a commit"
        for words in HISTORY.findall(line):
            yield f"line {number}: `{words}`: a page says what holds; days stand in the files of results"
        if page.startswith(("cases/", "docs/results/")) and line.startswith("|"):
            for cell in PLAIN.sub(r"\1", line).strip("|").split("|"):
                if len(cell.strip()) > CELL:
                    yield f"line {number}: a cell of {len(cell.strip())} characters: {cell.strip()[:40]}..."
    yield from bad_links(root, path, text)


if __name__ == "__main__":
    root, bad = pathlib.Path(sys.argv[1]).resolve(), 0
    for path in results.pages(root):
        for mistake in mistakes(root, path):
            print(f"{path.relative_to(root)}: {mistake}", file=sys.stderr)
            bad += 1
    sys.exit(1 if bad else 0)
