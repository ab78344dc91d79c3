"""Links from a step of a page to the line of code that computes it.

On a page, `[low_rod](../../src/flypend/laws/throw.py#low_rod)` names a file and, behind
`#`, a function, a class, a constant or an equation's label such as A1. Where the
repository is read, that opens the file; on the site, the line.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import PythonLexer
from sphinx.application import Sphinx
from sphinx.util.logging import getLogger

ROOT = Path(__file__).parents[2]
LINK = re.compile(r"\[([^\]\n]+)\]\((?:\.\./)+(src/flypend/[\w/]+\.py)(?:#(\w+))?\)")
log = getLogger(__name__)


def line_of(code: str, name: str) -> int | None:
    """Return the line, from 1, that defines `name` or has the label (`name`), else None."""
    for place in (
        rf"^ *(?:def|class) {name}\b",
        rf"^{name}\b.* = ",
        rf"#.*\({name}\)",
        rf"\({name}\)",
    ):
        if found := re.search(place, code, re.MULTILINE):
            return code.count("\n", 0, found.end()) + 1
    return None


def _link(app: Sphinx, page: str, content: list[str]) -> None:
    def anchor(found: re.Match[str]) -> str:
        said, path, name = found.groups()
        line = line_of((ROOT / path).read_text(encoding="utf-8"), name) if name else 1
        if line is None:
            log.warning("%s has no %s", path, name, location=page)
        linked: set[str] = app.env.linked_sources
        linked.add(path)
        to = "../" * page.count("/") + path.removesuffix(".py")
        return f'<a class="reference" href="{to}.html#line-{line}">{said}</a>'

    if app.builder.format == "html":
        content[0] = LINK.sub(anchor, content[0])


def _begin(app: Sphinx) -> None:
    app.env.linked_sources = getattr(app.env, "linked_sources", set())


def _pages(app: Sphinx) -> Iterator[tuple[str, dict[str, Any], str]]:
    look = HtmlFormatter(
        linenos="inline", anchorlinenos=True, lineanchors="line", wrapcode=True
    )
    for path in sorted(app.env.linked_sources):
        code = highlight((ROOT / path).read_text(encoding="utf-8"), PythonLexer(), look)
        title = path.removeprefix("src/")
        yield (
            path.removesuffix(".py"),
            {"title": title, "body": f"<h1>{title}</h1>{code}"},
            "page.html",
        )


def setup(app: Sphinx) -> dict[str, bool]:
    """Turn the links, and add a page for each file that is linked."""
    app.connect("builder-inited", _begin)
    app.connect("source-read", _link)
    app.connect("html-collect-pages", _pages)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
