"""What mkdocs does beside its own: a pattern in the nav of mkdocs.yml stands for all pages that match and are not named before it,
and lists and tables are found as GitHub finds them."""
import re
from pathlib import Path

OPENING = re.compile(r"- |1\. |\|")                     # of a list or table
BELONGS = re.compile(r"\s*- |\s*\d+\. |\||\s{2,}")  # a line of one

def named(nav):
    """All pages of a nav, patterns among them."""
    for item in nav:
        values = item.values() if isinstance(item, dict) else [item]
        for value in values:
            yield from named(value) if isinstance(value, list) else [value]


def expanded(nav, pages, taken):
    found = []
    for item in nav:
        if isinstance(item, str) and "*" in item:
            matches = sorted(str(path.relative_to(pages)) for path in pages.glob(item))
            found += [entry(path) for path in matches if path not in taken]
        elif isinstance(item, dict):
            found.append({title: expanded(value, pages, taken) if isinstance(value, list) else value for title, value in item.items()})
        else:
            found.append(item)
    return found


def entry(path):
    """A README is called as its folder is; other pages have the title of their first heading."""
    return {Path(path).parent.name: path} if Path(path).name == "README.md" else path


def on_config(config):
    pages = Path(config["docs_dir"])
    config["nav"] = expanded(config["nav"], pages, set(named(config["nav"])))
    return config


def on_page_markdown(markdown, **_):
    """A list or table that follows a line of text gets the empty line before it that mkdocs, unlike GitHub, asks for."""
    lines, fenced = [], False
    for line in markdown.split("\n"):
        fenced ^= line.startswith("```")
        before = lines[-1] if lines else ""
        if not fenced and OPENING.match(line) and before.strip() and not BELONGS.match(before):
            lines.append("")
        lines.append(line)
    return "\n".join(lines)
