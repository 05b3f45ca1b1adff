#!/usr/bin/python3
"""Every link of the documentation leads somewhere, and its site loads nothing from the network.

Usage: check_links.py pages FOLDER     the Markdown pages of a repository: files, and anchors as GitHub names them
       check_links.py site FOLDER      a built site: files, anchors, and what pages and style sheets load
       check_links.py --self-test
"""
import re
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

PAGES = ["*.md", "docs/**/*.md", "cases/**/*.md"]
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\[\]]*\])*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
LOADED = {"script": "src", "img": "src", "iframe": "src", "source": "src", "video": "src", "audio": "src", "embed": "src", "object": "data"}
LOADING_LINKS = {"stylesheet", "preload", "modulepreload", "prefetch", "preconnect", "dns-prefetch", "icon", "manifest"}


def external(target):
    parts = urlsplit(target)
    return bool(parts.scheme or parts.netloc)


# --------------------------------------------------------------------------------------------------- Markdown

def prose(text):
    """The lines of a page without fenced blocks and code spans, and with the numbers of the lines."""
    fenced = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif not fenced:
            yield number, line


def slug(heading):
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


def anchors_of(text):
    found, seen = set(), {}
    for _, line in prose(text):
        heading = re.match(r"#{1,6}\s+(.*?)\s*#*$", line)
        if heading:
            name = slug(heading[1])
            count = seen.get(name, 0)
            seen[name] = count + 1
            found.add(f"{name}-{count}" if count else name)
        found.update(re.findall(r"<a (?:id|name)=\"([^\"]+)\"", line))
    return found


def faults_of_pages(root):
    pages = sorted({path for pattern in PAGES for path in root.glob(pattern)})
    anchors = {path.resolve(): anchors_of(path.read_text(encoding="utf-8")) for path in pages}
    faults = []
    for page in pages:
        for number, line in prose(page.read_text(encoding="utf-8")):
            for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
                fault = None if external(target) else fault_of_link(page, target, anchors, root)
                if fault:
                    faults.append(f"{page.relative_to(root)}:{number}: {target}: {fault}")
    return len(pages), faults


def fault_of_link(page, target, anchors, root):
    path, _, anchor = target.partition("#")
    file = (page.parent / unquote(path)).resolve() if path else page.resolve()
    if not file.exists():
        return "no such file"
    if root.resolve() not in [file, *file.parents]:
        return "outside of the project"
    if anchor and file not in anchors:
        return "an anchor in what is no page"
    if anchor and unquote(anchor) not in anchors[file]:
        return "no such heading"
    return None


# ------------------------------------------------------------------------------------------------------- site

class Html(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.loads = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.ids.update(value for key, value in attributes if value and (key == "id" or (tag == "a" and key == "name")))
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        if tag in LOADED and values.get(LOADED[tag]):
            self.loads.append(values[LOADED[tag]])
        if tag == "link" and values.get("href") and LOADING_LINKS & set((values.get("rel") or "").split()):
            self.loads.append(values["href"])
        if values.get("style"):
            self.loads += loads_of_style(values["style"])


def loads_of_style(text):
    return [target.strip("'\" ") for target in re.findall(r"url\(([^)]*)\)", text) + re.findall(r"@import\s+['\"]([^'\"]+)", text)]


def faults_of_site(root):
    pages = {path.resolve(): Html(path.read_text(encoding="utf-8")) for path in root.rglob("*.html")}
    faults = []
    for path, page in pages.items():
        for target in page.links + page.loads:
            fault = fault_on_site(root, path, target, target in page.loads, pages)
            if fault:
                faults.append(f"{path.relative_to(root.resolve())}: {target}: {fault}")
    for path in root.rglob("*.css"):
        faults += [f"{path.relative_to(root)}: loads {target}" for target in loads_of_style(path.read_text(encoding="utf-8"))
                   if external(target) and not target.startswith("data:")]
    return len(pages), faults


def fault_on_site(root, page, target, loaded, pages):
    if target.startswith("data:"):
        return None
    if external(target):
        return "loaded from elsewhere" if loaded else None
    parts = urlsplit(target)
    file = page
    if parts.path:
        base = root if parts.path.startswith("/") else page.parent
        file = (base / unquote(parts.path.lstrip("/"))).resolve()
    if file.is_dir():
        file = file / "index.html"
    if not file.exists():
        return "no such file"
    if parts.fragment and file in pages and unquote(parts.fragment) not in pages[file].ids | {"__top"}:
        return "no such anchor"
    return None


# -------------------------------------------------------------------------------------------------- self-test

def self_test():
    assert slug("[[structures]]") == "structures" and slug("Fields, and `ParaView`") == "fields-and-paraview"
    assert slug("2. Kernels") == "2-kernels" and slug("A / b") == "a--b"
    assert anchors_of("# One\n```\n# no\n```\n## One\n") == {"one", "one-1"}
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        (root / "a.md").write_text("# Top\n[x](b.md#part) [y](b.md#none) [z](c.md) `[q](d.md)` ![p](e.png) [w](https://x.y/z)\n", encoding="utf-8")
        (root / "b.md").write_text("## Part\n[up](../outside.md)\n", encoding="utf-8")
        faults = faults_of_pages(root)[1]
        assert len(faults) == 4 and all(any(name in fault for fault in faults) for name in ("none", "c.md", "e.png", "outside"))
        (root / "a.html").write_text('<h1 id="x"></h1><a href="#x"><a href="#y"><a href="b.html"><script src="https://a/b.js"></script>'
                                     '<a href="https://fine"><img src="data:,">', encoding="utf-8")
        (root / "a.css").write_text("a { background: url(data:,) } @import 'https://a/b.css';", encoding="utf-8")
        faults = faults_of_site(root)[1]
        assert len(faults) == 4 and all(any(name in fault for fault in faults) for name in ("#y", "b.html", "b.js", "b.css"))
    print("check_links.py: the test of itself has passed")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    if len(sys.argv) != 3 or sys.argv[1] not in ("pages", "site"):
        sys.exit(__doc__)
    count, faults = (faults_of_pages if sys.argv[1] == "pages" else faults_of_site)(Path(sys.argv[2]))
    print("\n".join(faults), file=sys.stderr)
    print(f"{count} pages, {len(faults)} faults")
    sys.exit(1 if faults or not count else 0)


if __name__ == "__main__":
    main()
