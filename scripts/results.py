#!/usr/bin/env python3
"""Writes the measured figures of the documentation from the files of results (docs/develop/results.md).

  results.py write                   rewrites every marked table and value
  results.py check                   says where a page differs from its results; exit code 1 where one does
  results.py take STUDY FILE         cuts the table of a study's folder to a file of results, with its provenance

docs/results/results.toml describes what each mark shows; docs/results/*.csv holds the figures. Standard library only.
"""
import argparse, csv, datetime, difflib, functools, json, math, pathlib, re, sys, tomllib

DESCRIPTION = "docs/results/results.toml"
PAGES = ("README.md", "docs/**/*.md", "cases/*/README.md")
FENCE = re.compile(r"^(```|~~~).*?^\1", re.M | re.S)
MARK = re.compile(r"<!-- (table|value) (\S+) -->(.*?)<!-- end -->", re.S)
OPENING = re.compile(r"<!-- (?:table|value) \S+ -->")
BOOKKEEPING = ("run", "curve", "problem", "message", "cpu_time_largest_s", "wall_time_s", "timings", "threads", "time_s", "program",
               "particle_updates", "neighbour_interactions", "solver_memory_bytes", "bytes_per_particle", "peak_memory_bytes")


class Mistake(Exception):
    """Something in the description, a file of results or a page that a person has to mend; its text says where and how."""


# --- files of results -----------------------------------------------------------------------------------------------------------

class Results:
    """The files of results below a root, and the description of what the pages show of them."""

    def __init__(self, root):
        self.root = pathlib.Path(root)
        try:
            self.description = tomllib.loads((self.root / DESCRIPTION).read_text())
        except (OSError, tomllib.TOMLDecodeError) as error:
            raise Mistake(f"{DESCRIPTION}: {error}")
        self.read = functools.cache(self.read)
        self.figures = self.read_figures()

    def read(self, name):
        """Rows of a CSV as dictionaries. A bare name lies in docs/results; the lines that begin with # are provenance."""
        path = self.root / (name if "/" in name else f"docs/results/{name}")
        try:
            lines = path.read_text().splitlines()
        except OSError as error:
            raise Mistake(f"{path}: {error.strerror}; `results.py take` makes it from a study")
        if not lines or not lines[0].startswith("# "):
            raise Mistake(f"{path}: its first line has to say where it is from: # command; program; machine; date")
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        if any(None in row or None in row.values() for row in rows):
            raise Mistake(f"{path}: a row has more or fewer cells than the header")
        return rows

    def read_figures(self):
        """Single figures by name, from the files that the description calls files of figures."""
        found = {}
        for name in self.description.get("figures", []):
            for row in self.read(name):
                if row.get("name") in found:
                    raise Mistake(f"{name}: {row['name']} stands there twice")
                found[row["name"]] = row["figure"]
        return found

    def described(self, kind):
        return self.description.get(kind, {})

    def select(self, what, where):
        """The rows of a table's or value's file that its condition names."""
        rows = self.read(what["file"])
        for column, wanted in where.items():
            if rows and column not in rows[0]:
                raise Mistake(f"{what['file']}: no column `{column}`{nearest(column, rows[0])}")
            wanted = wanted if isinstance(wanted, list) else [wanted]
            rows = [row for row in rows if any(same(row[column], value) for value in wanted)]
        if not rows:
            raise Mistake(f"{what['file']}: no row where {where}")
        return rows

    def one(self, what, where):
        rows = self.select(what, where)
        if len(rows) > 1:
            raise Mistake(f"{what['file']}: {len(rows)} rows where {where}; one was wanted")
        return rows[0]


def same(cell, wanted):
    if isinstance(wanted, str):
        return cell == wanted
    try:
        return math.isclose(float(cell), wanted, rel_tol=1e-9)
    except ValueError:
        return False


def nearest(name, names):
    close = difflib.get_close_matches(name, names, 1)
    return f"; `{close[0]}` is meant?" if close else ""


# --- quantities -----------------------------------------------------------------------------------------------------------------

def number(text, place):
    try:
        return float(text.split("+-")[0])
    except ValueError:
        raise Mistake(f"{place}: `{text}` is not a number")


def cell_of(results, what, row, quantity, line=""):
    """The text of one quantity of one row; nothing where the run has no such metric. `{}` in a column's name is the line's."""
    if "largest" in quantity:
        return max((cell_of(results, what, row, one) for one in spread(quantity["largest"])), key=magnitude).lstrip("+-")
    text = entry(what["file"], row, quantity["column"].replace("{}", line))
    if text == "" or "format" not in quantity:
        return text
    value = number(text, what["file"]) * quantity.get("scale", 1)
    if "reference" in quantity:
        reference = reference_of(results, what, row, quantity, line)
        value = difference(value, reference, quantity.get("difference", "percent"))
    return formatted(value, quantity["format"])


def spread(each):
    """The same quantity for each of its names, which stand for `{}`."""
    return [json.loads(json.dumps({key: value for key, value in each.items() if key != "names"}).replace("{}", name))
            for name in each["names"]]


def magnitude(text):
    match = re.search(r"\d+(?:\.\d+)?(?:e[+-]?\d+)?", text)
    return float(match[0]) if match else -1.0


def entry(file, row, column):
    if column not in row:
        raise Mistake(f"{file}: no column `{column}`{nearest(column, row)}")
    return row[column]


def reference_of(results, what, row, quantity, line):
    """Of another file's row, or of the same row where the reference names no file."""
    there = quantity["reference"]
    if "file" in there:
        row = results.one(there, there.get("where", {}))
    file = there.get("file", what["file"])
    default = 1 if "file" in there else quantity.get("scale", 1)
    return number(entry(file, row, there["column"].replace("{}", line)), file) * there.get("scale", default)


def difference(value, reference, kind):
    if kind == "percent":
        return 100 * (value / reference - 1)
    if kind == "absolute":
        return value - reference
    raise Mistake(f"a difference is `percent` or `absolute`, not `{kind}`")


def formatted(value, form):
    """Of a printf format, or of `2 digits` that count."""
    match = re.fullmatch(r"(\d+) digits", form)
    if not match:
        return re.sub(r"^-(0(?:\.0*)?(?:e\+00)?)(?![\d.e])", "+\\1" if "+" in form else "\\1", form % value)  # no -0.0
    digits = int(match[1])
    if value == 0:
        return "0"
    return f"{value:.{max(0, digits - 1 - math.floor(math.log10(abs(float(f'{value:.{digits - 1}e}')))))}f}"


# --- tables ---------------------------------------------------------------------------------------------------------------------

def table_of_rows(results, what):
    """A row of the file a line: all of its columns, or those that are described. Of each row several lines where `lines` has names."""
    rows = results.select(what, what.get("where", {}))
    columns = what.get("columns", []) + (spread(what["each"]) if "each" in what else []) + what.get("then", [])
    columns = columns or [{"head": name, "column": name} for name in rows[0]]
    if "lines" not in what:
        return [[column["head"] for column in columns],
                *([cell_of(results, what, row, column) for column in columns] for row in rows)]
    return [[what.get("head", ""), *(column["head"] for column in columns)],
            *([line["head"], *(cell_of(results, what, row, column, line["name"]) for column in columns)]
              for row in rows for line in what["lines"])]


def table_across(results, what):
    """A curve of a study a line, its resolutions across: error / cost, a star on the Pareto front, the observed order."""
    rows = results.select(what, what.get("where", {}))
    across, keys = what["across"], what["rows"]
    steps = list(dict.fromkeys(row[across["column"]] for row in rows))
    lines = [[what.get("head", keys[0]), *(formatted(float(step) * across.get("scale", 1), across["format"]) for step in steps)]]
    if what.get("order"):
        lines[0].append("order")
    for curve in dict.fromkeys(tuple(row[key] for key in keys) for row in rows):
        runs = {row[across["column"]]: row for row in rows if tuple(row[key] for key in keys) == curve}
        lines.append([", ".join(curve), *(run_cell(results, what, runs.get(step)) for step in steps)])
        if what.get("order"):
            lines[-1].append(observed_order(what, runs))
    return lines


def run_cell(results, what, row):
    if row is None or row.get("status", "done") != "done":
        return row.get("status", "") if row else ""
    cells = [cell_of(results, what, row, quantity) for quantity in what["cell"]]
    if "star" in what and row[what["star"]] == "1":
        cells[0] += "*"
    return " / ".join(cells)


def observed_order(what, runs):
    """The least-squares slope of the first quantity's magnitude over the resolution, both in logarithms."""
    done = [(step, row) for step, row in runs.items() if row.get("status", "done") == "done" and row[what["cell"][0]["column"]]]
    points = [(math.log(float(step)), math.log(abs(float(row[what["cell"][0]["column"]])))) for step, row in done]
    if len(points) < 2:
        return ""
    x, y = (sum(values) / len(points) for values in zip(*points))
    return formatted(sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points), "%.1f")


def table_of_metrics(results, what):
    """A metric a line: the runs, then the sources of the table of references."""
    names = what.get("metrics")
    references = [row for row in results.read(what["reference"]) if names is None or row["metric"] in names]
    runs = [results.one({"file": run.get("file", what.get("file"))}, run["where"]) for run in what["runs"]]
    lines = [["", *(run["head"] for run in what["runs"]), *what["sources"]]]
    for reference in references:
        cells = [metric_cell(row.get(reference["metric"], ""), reference, what["sources"]) for row in runs]
        if not any(cells):
            continue
        lines.append([f"{reference['label']} ({reference['unit']})" if reference["unit"] not in ("", "-") else reference["label"], *cells,
                      *(reference[source].replace("+-", " ± ") for source in what["sources"])])
    return lines


def table_of_texts(results, what):
    """Lines as they are written; `{name}` in a cell is the value of that name."""
    fill = lambda cell: re.sub(r"\{([\w.]+)\}", lambda match: shown(results, "value", match[1]), cell)
    return [what["head"], *([fill(cell) for cell in line] for line in what["lines"])]


def metric_cell(text, reference, sources):
    """With as many decimals as the first source has; three digits where it says nothing."""
    if not text:
        return ""
    value = float(text) * float(reference["scale"])
    known = next((reference[source] for source in sources if reference[source]), "")
    return f"{value:.{len(known.split('+-')[0].partition('.')[2])}f}" if known else formatted(value, "3 digits")


KINDS = {"rows": table_of_rows, "across": table_across, "metrics": table_of_metrics, "texts": table_of_texts}


def table(results, what):
    kind = what.get("kind", "rows")
    if kind not in KINDS:
        raise Mistake(f"a table's kind is one of {', '.join(KINDS)}, not `{kind}`")
    head, *body = KINDS[kind](results, what)
    lines = [head, ["---"] * len(head), *body]
    rows = ("|" + "".join(f" {cell} |" if cell else " |" for cell in line) for line in lines)
    return "\n\n" + "\n".join(rows) + "\n\n"  # the blank lines make it a table in every kind of Markdown


def value(results, what):
    return cell_of(results, what, results.one(what, what.get("where", {})), what)


# --- pages ----------------------------------------------------------------------------------------------------------------------

def pages(root):
    return sorted(path for pattern in PAGES for path in pathlib.Path(root).glob(pattern))


def without_code(text):
    """The text with its code blocks blanked, so that places stay where they are."""
    return FENCE.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def marks(text):
    """Marked places outside code blocks: kind, name, where their content begins and ends."""
    plain = without_code(text)
    found = [(match[1], match[2], match.start(3), match.end(3)) for match in MARK.finditer(plain)]
    if len(found) != len(OPENING.findall(plain)):
        line = plain[:next(m.start() for m in OPENING.finditer(plain) if m.end() not in {f[2] for f in found})].count("\n") + 1
        raise Mistake(f"{line}: a mark without its <!-- end -->")
    for match in re.finditer(r"^ *<!-- value ", plain, re.M):
        raise Mistake(f"{plain.count(chr(10), 0, match.start()) + 1}: a value begins the line, which Markdown takes for HTML; break the line elsewhere")
    return found


def inherited(described, name):
    """What is described under a name, over what it is like."""
    what = described[name]
    return {**inherited(described, what["like"]), **what} if "like" in what else what


def shown(results, kind, name):
    """What a mark should hold."""
    described = results.described(kind)
    if kind == "value" and name in results.figures:
        return results.figures[name]
    if name not in described:
        raise Mistake(f"no {kind} `{name}` in {DESCRIPTION}{nearest(name, [*described, *(results.figures if kind == 'value' else [])])}")
    try:
        return (table if kind == "table" else value)(results, inherited(described, name))
    except KeyError as error:
        raise Mistake(f"{DESCRIPTION}: {kind}.{name} has no key {error}")
    except Mistake as mistake:
        raise Mistake(f"{kind}.{name}: {mistake}")


def rewritten(results, text):
    """The page with every marked place as its results say, and what is wrong with it, as texts that begin with the line."""
    pieces, end, wrong = [], 0, []
    for kind, name, first, last in marks(text):
        line, stands = text[:first].count("\n") + 1, text[first:last]
        try:
            wanted = shown(results, kind, name)
        except Mistake as mistake:
            wanted = stands
            wrong.append(f"{line}: {mistake}")
        if wanted != stands:
            wrong.append("{}: {}\n  stands there: {}\n  should be:    {}".format(line, name, *first_difference(stands, wanted)))
        pieces += [text[end:first], wanted]
        end = last
    return "".join(pieces) + text[end:], wrong


def first_difference(stands, should):
    if "\n" not in stands + should:
        return stands, should
    one, other = stands.splitlines() + [""], should.splitlines() + [""]
    return next(((a, b) for a, b in zip(one, other) if a != b), (f"{len(one) - 1} lines", f"{len(other) - 1} lines"))


def write(results, check):
    """Rewrites the pages, or says where they differ. Returns the number of mistakes that are left."""
    bad = 0
    for path in pages(results.root):
        page, text = path.relative_to(results.root), path.read_text()
        try:
            new, wrong = rewritten(results, text)
        except Mistake as mistake:
            new, wrong = text, [str(mistake)]
        if not check and new != text:
            path.write_text(new)
            print(f"{page} written")
            wrong = rewritten(results, new)[1]
        for what in wrong:
            print(f"{page}:{what}", file=sys.stderr)
        bad += len(wrong)
    return bad


def shown_nowhere(results):
    """Names that are described, and files of results, that no page shows."""
    seen = {(kind, name) for path in pages(results.root) for kind, name, _, _ in marks(path.read_text())}
    seen |= {(kind, what.get("like")) for kind in ("table", "value") for what in results.described(kind).values()}
    seen |= {("value", name) for what in results.described("table").values() if what.get("kind") == "texts"
             for line in what["lines"] for cell in line for name in re.findall(r"\{([\w.]+)\}", cell)}
    names = [f"{kind}.{name}" for kind in ("table", "value") for name in results.described(kind) if (kind, name) not in seen]
    names += [f"figure {name}" for name in results.figures if ("value", name) not in seen]
    text = (results.root / DESCRIPTION).read_text()
    return names + [path.name for path in sorted((results.root / DESCRIPTION).parent.glob("*.csv")) if f'"{path.name}"' not in text]


# --- taking over a study --------------------------------------------------------------------------------------------------------

def rounded(text):
    try:
        return f"{float(text):.6g}"
    except ValueError:
        return text


def take(root, folder, target, machine):
    """Cuts study.csv to what results need: the axes, errors, Pareto fronts, CPU time, ledgers and metrics, in six digits."""
    source = pathlib.Path(folder) / "study.csv"
    try:
        table = csv.DictReader(source.open())
        rows = [row for row in table if row["status"] not in ("not run", "interrupted", "failed")]
    except OSError as error:
        raise Mistake(f"{source}: {error.strerror}; it is what `undex study` leaves")
    twice = {name for name in table.fieldnames if table.fieldnames.count(name) > 1}
    if twice:
        raise Mistake(f"{source}: two columns are called {', '.join(twice)}; give the study's axis another name")
    if not rows:
        raise Mistake(f"{source}: no run of it has ended")
    columns = [name for name in rows[0] if name not in BOOKKEEPING and not name.startswith("exact_") and any(row[name] for row in rows)]
    target, origin = pathlib.Path(root) / target, provenance(root, folder, rows, source, machine)
    with target.open("w", newline="") as out:
        out.write(origin)
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows([rounded(row[name]) for name in columns] for row in rows)
    print(f"{target}: {len(rows)} runs, {len(columns)} columns")


def provenance(root, folder, rows, source, machine):
    programs = sorted({re.sub(r" \([^)]*\)", "", row["program"]) for row in rows if row["program"]})
    date = datetime.date.fromtimestamp(source.stat().st_mtime).isoformat()
    return f"# undex study {study_file(root, folder)}; {' and '.join(programs)}, numerics {numerics(root)}; {machine}; {date}\n"


def study_file(root, folder):
    """The study of cases/ whose text is the copy in the folder."""
    copy = (pathlib.Path(folder) / "study.toml").read_bytes()
    found = [path for path in pathlib.Path(root).glob("cases/*/*.toml") if path.read_bytes() == copy]
    if not found:
        raise Mistake(f"{folder}/study.toml is no study of cases/: run the shipped one again")
    return found[0].relative_to(root).as_posix()


def numerics(root):
    match = re.search(r"numerics_version = (\d+)", (pathlib.Path(root) / "app/version.cpp").read_text())
    return match[1] if match else "unknown"


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--root", default=pathlib.Path(__file__).resolve().parent.parent, help="the project's folder")
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("write", help="rewrites every marked table and value")
    commands.add_parser("check", help="says where a page differs from its results")
    taking = commands.add_parser("take", help="cuts a study's table to a file of results")
    taking.add_argument("study", help="the folder that undex study wrote")
    taking.add_argument("file", help="docs/results/NAME.csv")
    taking.add_argument("--machine", default="AMD EPYC, 2 cores, shared", help="named in the provenance")
    chosen = parser.parse_args(arguments)
    try:
        if chosen.command == "take":
            take(chosen.root, chosen.study, chosen.file, chosen.machine)
            return 0
        results = Results(chosen.root)
        bad = write(results, chosen.command == "check")
        if chosen.command == "check" and not bad:
            for name in shown_nowhere(results):
                print(f"no page shows {name}")
        return 1 if bad else 0
    except Mistake as mistake:
        print(mistake, file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
