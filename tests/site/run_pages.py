#!/usr/bin/python3
"""Runs what pages of the documentation tell a reader to type, and compares what comes with what the page prints.

Usage: run_pages.py PROGRAM PAGE.md... [--write] [--keep FOLDER]
       run_pages.py --self-test

PROGRAM is the undex to run; --write puts the present output into the pages; --keep runs in FOLDER and leaves it there.
Each page is followed from its top in an empty folder; a page beside the project's cases/ sees them there. Its blocks are

  ```toml title="NAME"            a file of that name (of any language: toml, python, ...)
  ```toml title="add to NAME"     more lines at the end of that file
  ```sh                           commands, run by bash; all must succeed
  ```text                         what the commands just above print; a line "…" stands for lines left out, … in a line for a part of it

and all others are only read. A comment before a block of commands changes that: <!-- not run: reason -->, <!-- exit code 2 -->.
<!-- varies: CPU s, steps --> before a block of output leaves columns under these headings out of the comparison.

Words must agree. A number must agree within 2 % or, if it has a decimal point, two units of its last digit; a percentage with a sign
within one point more; seconds, memory and speed, which depend on the machine, are not compared.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

SHARE = 0.02  # by which a number may be off
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
OF_THE_MACHINE = re.compile(r"\s?(s|min|GB|MB|kB|bytes|million|threads|seconds)\b")
GAP = "…"


@dataclass
class Block:
    language: str
    title: str
    body: list[str]
    first: int             # its first line in the page, from 0
    directives: list[str]  # comments just before it


def blocks_of(lines):
    blocks, directives, i = [], [], 0
    while i < len(lines):
        comment = re.fullmatch(r"<!-- (.*) -->", lines[i].strip())
        opening = re.fullmatch(r'```(\w+)(?: title="([^"]+)")?', lines[i])
        if comment:
            directives.append(comment[1])
        elif opening:
            end = lines.index("```", i + 1)
            blocks.append(Block(opening[1], opening[2] or "", lines[i + 1:end], i + 1, directives))
            directives, i = [], end
        elif lines[i].strip():
            directives = []
        i += 1
    return blocks


def directive(block, name):
    """What stands behind the name in one of the block's directives; None where there is none."""
    return next((text[len(name):].strip(" :") for text in block.directives if text.startswith(name)), None)


# ------------------------------------------------------------------------------------------------ comparison

def skeleton(line):
    """The line with its words alone."""
    return " ".join(NUMBER.sub("#", line).split())


def matches(shown, line):
    pattern = ".*".join(re.escape(part.strip()) for part in skeleton(shown).split(GAP))
    return re.fullmatch(pattern, skeleton(line)) is not None


def last_digit(text):
    """The value of one unit in a number's last digit."""
    mantissa, _, exponent = text.lower().partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def agree(shown, found, percent):
    a, b = float(shown), float(found)
    counts = shown.lstrip("+-").isdigit() and found.lstrip("+-").isdigit()
    room = (0 if counts else 2.0001 * max(last_digit(shown), last_digit(found))) + (1 if percent else 0)
    return abs(a - b) <= max(SHARE * max(abs(a), abs(b)), room)


def numbers(line, columns):
    """Each number with whether it is compared, and whether it is a difference in percent."""
    for found in NUMBER.finditer(line):
        behind = line[found.end():]
        compared = not OF_THE_MACHINE.match(behind) and not any(found.start() < end and found.end() > start for start, end in columns)
        yield found[0], compared, found[0][0] in "+-" and behind.startswith("%")


def differences(shown, line, columns=()):
    """Numbers of a shown line that the printed one, of the same words, does not have."""
    if GAP in shown:  # numbers before the first gap, one by one
        shown = shown.split(GAP)[0]
    pairs = zip(numbers(shown, columns), numbers(line, columns))
    return [f"{a} for {b}" for (a, compared, percent), (b, *_) in pairs if compared and not agree(a, b, percent)]


def columns_of(header, names):
    """Where columns of these headings stand: as wide as the heading, and to the left as far as the heading before."""
    spans = []
    for name in names:
        start = header.find(name)
        if start >= 0:
            spans.append((len(header[:start].rstrip()), start + len(name)))
    return spans


def segments_of(shown):
    """Runs of lines between gaps, as pairs of their first line's number and their lines."""
    segments, first = [], 0
    for i, line in enumerate([*shown, GAP]):
        if line.strip() == GAP:
            segments.append((first, shown[first:i]))
            first = i + 1
    return segments


def place_of(lines, printed, places):
    """Where the printed lines have the words of these, and of such places the one whose numbers differ least."""
    fitting = [i for i in places if all(i + k < len(printed) and matches(line, printed[i + k]) for k, line in enumerate(lines))]
    return min(fitting, key=lambda i: sum(len(differences(line, printed[i + k])) for k, line in enumerate(lines)), default=None)


def align(shown, printed):
    """For each shown line the printed line that it stands for, None for a gap; and the first segment that is not printed, if any."""
    found, at = [None] * len(shown), 0
    segments = segments_of(shown)
    for first, lines in segments:
        if not lines:
            continue
        places = range(at, len(printed)) if first else range(1)
        if first + len(lines) == len(shown):
            places = [i for i in places if i + len(lines) == len(printed)]
        at = place_of(lines, printed, places)
        if at is None:
            return found, "\n".join(lines)
        found[first:first + len(lines)] = range(at, at + len(lines))
        at += len(lines)
    return found, None


def renew(shown, printed):
    """The printed line, cut where the shown one is."""
    if GAP not in shown:
        return printed
    before = shown.split(GAP)[0].rstrip()
    return f"{printed[:len(before)].rstrip()} {GAP}"


# -------------------------------------------------------------------------------------------------- one page

class Page:
    def __init__(self, path, program, folder):
        self.path, self.folder = path, folder
        self.lines = path.read_text(encoding="utf-8").splitlines()
        self.environment = os.environ | {"PATH": f"{program.parent}:{os.environ['PATH']}", "OMP_WAIT_POLICY": "passive"}
        self.environment.setdefault("OMP_NUM_THREADS", "1")
        self.printed, self.faults, self.renewed = None, [], {}

    def fault(self, block, text):
        self.faults.append(f"{self.path}:{block.first}: {text}")

    def follow(self):
        for block in blocks_of(self.lines):
            if block.title:
                self.write_file(block)
            elif block.language == "sh":
                self.run(block)
            elif block.language == "text" and self.printed is not None:
                self.compare(block)

    def write_file(self, block):
        name, mode = (block.title[7:], "a") if block.title.startswith("add to ") else (block.title, "w")
        with open(self.folder / name, mode, encoding="utf-8") as file:
            file.write("\n".join(block.body) + "\n")

    def run(self, block):
        if directive(block, "not run") is not None:
            self.printed = None
            return
        done = subprocess.run(["bash", "-e", "-c", "\n".join(block.body)], cwd=self.folder, env=self.environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        self.printed = done.stdout.splitlines()
        if done.returncode != int(directive(block, "exit code") or 0):
            self.fault(block, f"'{block.body[0]}' ended with {done.returncode}:\n{done.stdout[-2000:]}")

    def compare(self, block):
        found, missing = align(block.body, self.printed)
        if missing is not None:
            self.fault(block, f"not printed: {missing}\n  printed were:\n    " + "\n    ".join(self.printed[:400]))
            return
        names = [name.strip() for name in (directive(block, "varies") or "").split(",") if name.strip()]
        headers = [line for line in block.body if any(name in line for name in names)]
        columns = columns_of(headers[0], names) if headers else []
        for i, place in enumerate(found):
            if place is None:
                continue
            for difference in differences(block.body[i], self.printed[place], columns):
                self.fault(block, f"the page has {difference} in: {block.body[i].strip()}")
            self.renewed[block.first + i] = renew(block.body[i], self.printed[place])

    def write(self):
        lines = [self.renewed.get(i, line) for i, line in enumerate(self.lines)]
        if lines != self.lines:
            self.path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def self_test():
    page = ["words", '```toml title="a.toml"', "x = 1", "```", "<!-- exit code 2 -->", "", "```sh", "false", "```", "```text", "y", "```"]
    blocks = blocks_of(page)
    assert [b.language for b in blocks] == ["toml", "sh", "text"] and directive(blocks[1], "exit code") == "2"
    assert directive(blocks[2], "exit code") is None and blocks[0].title == "a.toml" and blocks[2].first == 10
    assert matches("a  1.5 mm", "a 200 mm") and not matches("a 1 mm", "a 1 cm") and matches(f"peak 3 {GAP}", "peak 3 and more")
    assert align(["one 1", GAP, "three 3"], ["one 4", "two 2", "three 5"]) == ([0, None, 2], None)
    assert align(["one 1", "three 3"], ["one 1", "two 2", "three 3"])[1] == "one 1\nthree 3"
    assert align([GAP, "at 2 us 5", GAP], ["at 1 us 5", "at 2 us 5", "at 3 us 5"])[0] == [None, 1, None]
    assert align(["at 1"], ["at 1", "more"])[1] and align([GAP, "at 1"], ["at 1", "more"])[1]
    assert not differences("x 1.00 mm", "x 1.02 mm") and differences("x 1.00 mm", "x 1.04 mm")
    assert not differences("x 7 s, 9 MB", "x 70 s, 1 MB") and differences("at 7 us", "at 70 us")
    assert not differences("y +2.4%", "y +3.4%") and differences("y +2.4%", "y +4.4%")
    header = "spacing   CPU s   steps"
    assert not differences("2 mm       0.67     260", "2 mm       9.67     260", columns_of(header, ["CPU s"]))
    assert differences("2 mm       0.67     260", "2 mm       0.67     360", columns_of(header, ["CPU s"]))
    assert renew(f"a 1 {GAP}", "a 2 and much more") == f"a 2 {GAP}"
    print("run_pages.py: the test of itself has passed")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", type=Path)
    parser.add_argument("pages", nargs="*", type=Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--self-test", action="store_true")
    options = parser.parse_args()
    if options.self_test:
        return self_test()
    if not options.program or not options.pages:
        parser.error("a program and a page are needed")
    faults = []
    for path in options.pages:
        with tempfile.TemporaryDirectory() as temporary:
            folder = options.keep / path.stem if options.keep else Path(temporary)
            folder.mkdir(parents=True, exist_ok=True)
            cases = path.resolve().parent / "cases"
            if cases.is_dir() and not (folder / "cases").exists():
                (folder / "cases").symlink_to(cases)
            page = Page(path, options.program.resolve(), folder)
            page.follow()
            if options.write:
                page.write()
            faults += page.faults
            print(f"{path}: {len(page.faults)} faults" if page.faults else f"{path}: as printed")
    print("\n".join(faults), file=sys.stderr)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
