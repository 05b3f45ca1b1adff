#!/usr/bin/env python3
"""Finds measured figures in the documentation that no file of results stands behind.   audit.py ROOT

Every percentage, every time that a run takes and every table of numbers has to stand in a marked place (scripts/results.py), or in a
place that docs/results/results.toml declares as no result, with the reason. Exit code 1 where one does not.
"""
import fnmatch, pathlib, re, sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"))
import results

PERCENTAGE = re.compile(r"[+-]?\d[\d.,]*(?: to [+-]?\d[\d.,]*)? ?%")
TIME = re.compile(r"(?<![\w.^-])\d[\d.,]* (?:s|min|h|seconds?|minutes?|hours?)\b(?!/)")
NUMBER = re.compile(r"^[~<>+*-]*\d[\d.,]*(?:e[+-]?\d+)?\*?(?: ?(?:%|[A-Za-z^/0-9]{1,7}))?(?:[ ,/;].*)?$")
GENERATED = re.compile(r"<!-- tables?: .*?<!-- end -->", re.S)  # by `undex keys`, of the program itself
RULE = re.compile(r"^\|[-:| ]+\|?$")


def prose(text):
    """The page with code, marked places, links' targets and comments blanked; lines stay where they are."""
    blank = lambda match: re.sub(r"[^\n]", " ", match[0])
    text = GENERATED.sub(blank, results.MARK.sub(blank, results.without_code(text)))
    text = re.sub(r"`[^`\n]*`", blank, text)
    return re.sub(r"\]\([^)\n]*\)|<!--.*?-->", blank, text, flags=re.S)


def sections(lines):
    """The heading above each line."""
    heading = ""
    for line in lines:
        if line.startswith("#"):
            heading = line.lstrip("#").strip()
        yield heading


def tables(lines):
    """First and last line of each table."""
    first = None
    for number, line in enumerate([*lines, ""]):
        if line.lstrip().startswith("|"):
            first = number if first is None else first
        elif first is not None:
            yield first, number
            first = None


def holds_numbers(rows):
    """Whether two cells or more below the head, besides the first of each row, are numbers."""
    cells = [cell.strip() for row in rows if not RULE.match(row.strip()) for cell in row.strip().strip("|").split("|")[1:]]
    return sum(bool(NUMBER.match(cell)) for cell in cells) >= 2


def suspects(text):
    """Line, first column, last column and words of what looks measured."""
    lines = prose(text).splitlines()
    inside = set()
    for first, last in tables(lines):
        inside.update(range(first, last))
        if holds_numbers(lines[first + 1:last]):
            yield first, 0, len(lines[first]), "a table of numbers: " + lines[first].strip()[:60]
        else:
            inside.difference_update(range(first, last))
    for number, line in enumerate(lines):
        if number not in inside:
            for pattern in (PERCENTAGE, TIME):
                yield from ((number, match.start(), match.end(), match[0]) for match in pattern.finditer(line))


class Declared:
    """A place that is no result: a page, and in it a section or a text, or all of it."""

    def __init__(self, entry):
        unknown = set(entry) - {"page", "section", "text", "reason"}
        if unknown or not entry.get("page") or not entry.get("reason"):
            raise results.Mistake(f"{results.DESCRIPTION}: a declared place has page, reason, and section or text: {entry}")
        self.entry, self.used = entry, 0

    def covers(self, page, section, line, first, last):
        entry = self.entry
        if not fnmatch.fnmatch(page, entry["page"]) or ("section" in entry and entry["section"] != section):
            return False
        if "text" in entry and not any(match.start() < last and first < match.end()
                                       for match in re.finditer(re.escape(entry["text"]), line)):
            return False
        self.used += 1
        return True


def untraced(root, declared):
    for path in results.pages(root):
        page, text = path.relative_to(root).as_posix(), path.read_text()
        lines, above = text.splitlines(), list(sections(results.without_code(text).splitlines()))
        for number, first, last, words in suspects(text):
            if not any([place.covers(page, above[number], lines[number], first, last) for place in declared]):
                yield page, number + 1, words


def audit(root):
    """Prints what is not traced; returns the number of mistakes."""
    description = results.Results(root).description
    declared = [Declared(entry) for entry in description.get("declared", [])]
    owed = {entry["page"]: entry["count"] for entry in description.get("owed", [])}
    bad, counts = 0, {}
    for page, line, words in untraced(root, declared):
        counts[page] = counts.get(page, 0) + 1
        if page not in owed:
            print(f"{page}:{line}: {words}: no file of results stands behind it", file=sys.stderr)
            bad += 1
    for place in declared:
        if not place.used:
            print(f"{results.DESCRIPTION}: nothing is at the declared place {place.entry}", file=sys.stderr)
            bad += 1
    for page, count in owed.items():
        if counts.get(page, 0) != count:
            print(f"{page}: {counts.get(page, 0)} figures have no file of results; {results.DESCRIPTION} owes {count}", file=sys.stderr)
            bad += counts.get(page, 0) > count
    marked = sum(len(results.marks(path.read_text())) for path in results.pages(root))
    print(f"{marked} marked places; {sum(place.used for place in declared)} places declared as no results by {len(declared)} entries; "
          f"{sum(owed.values())} figures owed by {len(owed)} pages")
    return bad


if __name__ == "__main__":
    try:
        sys.exit(1 if audit(pathlib.Path(sys.argv[1]).resolve()) else 0)
    except results.Mistake as mistake:
        sys.exit(str(mistake))
