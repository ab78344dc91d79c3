"""Live figures: a picture img/live-NAME.png is, on the site, the figure NAME itself.

The figure is a step of `flypend.lab.controls`, flown by the page of all chapters, which
is written once and loaded where it comes into sight. The picture is there where the page
is read elsewhere, printed, or without scripts.
"""

import re
from html import escape
from pathlib import Path

from docutils import nodes
from sphinx.application import Sphinx

from flypend.lab.standalone import chapters_page

PAGE = "gallery/chapters.html"
ALL = "chapters"  # the picture of the page with all of them
PICTURE = re.compile(r"img/live-(\w+)\.png$")


def _enliven(app: Sphinx, page: nodes.document, name: str) -> None:
    if app.builder.format != "html":
        return
    for image in list(page.findall(nodes.image)):
        if not (found := PICTURE.search(image["uri"])):
            continue
        asked = "" if found[1] == ALL else f"?figure={found[1]}"
        address, told = "../" * name.count("/") + PAGE + asked, escape(image["alt"])
        image["loading"] = "lazy"
        frame = (
            f'<span class="live {found[1]}">'
            f'<iframe src="{address}" title="{told}" loading="lazy"></iframe>'
        )
        start, end = (nodes.raw("", text, format="html") for text in (frame, "</span>"))
        image.replace_self([start, image.deepcopy(), end])


def _write(app: Sphinx, failed: Exception | None) -> None:
    if failed is None and app.builder.format == "html":
        path = Path(app.outdir) / PAGE
        path.parent.mkdir(exist_ok=True)
        path.write_text(chapters_page(), encoding="utf-8")


def setup(app: Sphinx) -> dict[str, bool]:
    """Turn the pictures into figures, and write the page that flies them."""
    app.connect("doctree-resolved", _enliven)
    app.connect("build-finished", _write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
