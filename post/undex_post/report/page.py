"""The page itself: one HTML file with styles, scripts and data inside, which asks for nothing from anywhere."""
import base64
import hashlib
import json
import math
import re
from datetime import datetime
from html import escape
from pathlib import Path
from typing import Any

from ..errors import Missing
from .movie import base64_of

ASSETS = Path(__file__).parent / "assets"
SCRIPTS = ("common.js", "chart.js", "movie.js", "page.js")  # in this order, in one scope
DYGRAPHS = Path("/usr/share/javascript/dygraphs")
COLOURS = {"viridis": "viridis", "cividis": "cividis", "magma": "magma", "blues": "Blues", "greys": "Greys_r", "strain": "YlOrRd"}


class Raw(str):
    """Text that is HTML already."""


def html(value: Any) -> str:
    """Text made safe for HTML; Raw stays as it is."""
    return value if isinstance(value, Raw) else escape(str(value))


def join(parts) -> Raw:
    return Raw("\n".join(parts))


def tag(name: str, *children: Any, **attributes: Any) -> Raw:
    """An element; a trailing underscore of an attribute's name is left out, others become hyphens."""
    said = "".join(
        f' {key.rstrip("_").replace("_", "-")}="{escape(str(value))}"' for key, value in attributes.items() if value is not None
    )
    return Raw(f"<{name}{said}>{''.join(html(child) for child in children)}</{name}>")


def table(head: list[Any], rows: list[list[Any]], numeric: set[int] = frozenset(), row_ids: list[str] | None = None) -> Raw:
    """A table that scrolls by itself where it is wider than the screen. Columns of `numeric` stand to the right."""
    style = lambda column: "n" if column in numeric else None
    header = tag("tr", *(tag("th", cell, class_=style(i), scope="col") for i, cell in enumerate(head)))
    body = [
        tag("tr", *(tag("td", cell, class_=style(i)) for i, cell in enumerate(row)), id=row_ids[k] if row_ids else None)
        for k, row in enumerate(rows)
    ]
    return tag(
        "div",
        tag("table", tag("thead", header), tag("tbody", *body)),
        class_="wide",
        tabindex="0",
        role="region",
        aria_label="table",
    )


def notes(items: list[str]) -> Raw:
    return tag("ul", *(tag("li", item) for item in items), class_="notes") if items else Raw("")


def chips(items: list[tuple[str, str, str]]) -> Raw:
    return tag(
        "ul",
        *(tag("li", tag("b", value, class_=colour or None), tag("span", what)) for value, what, colour in items),
        class_="chips",
    )


def without_nan(value: Any) -> Any:
    """The same with null for what is not a finite number, and plain numbers for NumPy's."""
    if isinstance(value, dict):
        return {str(key): without_nan(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [without_nan(each) for each in value]
    if hasattr(value, "item"):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _script(text: str) -> tuple[str, str]:
    """A script element and the source of the content security policy that allows it."""
    digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
    return f"<script>{text}</script>", f"'sha256-{digest}'"


def _dygraphs() -> tuple[str, str]:
    """Script and styles of Debian's libjs-dygraphs."""
    try:
        script = (DYGRAPHS / "dygraph.min.js").read_text(encoding="utf-8")
        style = (DYGRAPHS / "dygraph.min.css").read_text(encoding="utf-8")
    except OSError as error:
        raise Missing(
            f"{DYGRAPHS}: the charts' library is missing ({error.strerror}). Install it: apt-get install libjs-dygraphs"
        ) from error
    without_map = lambda text: re.sub(r"(//#|/\*#) sourceMappingURL=.*", "", text)
    return without_map(script), without_map(style)


def colour_tables() -> dict[str, str]:
    """The colour maps as 256 times three bytes in base64."""
    import numpy as np
    from matplotlib import colormaps

    places = np.linspace(0, 1, 256)
    return {
        name: base64_of((255 * colormaps[known](places)[:, :3] + 0.5).astype(np.uint8).tobytes())
        for name, known in COLOURS.items()
    }


def page(title: str, eyebrow: str, head: Raw, sections: list[tuple[str, str, Raw]], data: dict) -> str:
    """The whole file. A section is (identifier, heading, content); `data` goes to the script."""
    library, library_style = _dygraphs()
    own = "".join((ASSETS / name).read_text(encoding="utf-8") for name in SCRIPTS)
    scripts = [_script(library), _script(f'(function () {{\n"use strict";\n{own}}})();')]
    policy = f"default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; script-src {' '.join(source for _, source in scripts)}"
    text = json.dumps(without_nan(data), allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    links = tag("nav", *(tag("a", heading, href=f"#{name}") for name, heading, _ in sections), aria_label="Sections")
    body = [tag("section", tag("h2", heading), content, id=name) for name, heading, content in sections]
    made = datetime.now().astimezone().strftime("%Y-%m-%d %H:%M %Z")
    style = library_style + (ASSETS / "report.css").read_text(encoding="utf-8")
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>{escape(title)}</title>
<style>{style}</style>
</head>
<body>
<header>
<p class="eyebrow">{escape(eyebrow)}</p>
<h1>{escape(title)}</h1>
{head}
{links}
</header>
<main>
{join(body)}
<noscript><p class="warn">Charts and the animation need JavaScript.</p></noscript>
</main>
<footer>Made by undex report on {escape(made)}. The file stands alone: it loads nothing from anywhere. Charts are drawn by Dygraphs (MIT licence).</footer>
<script type="application/json" id="report-data">{text}</script>
{"".join(script for script, _ in scripts)}
</body>
</html>
"""
