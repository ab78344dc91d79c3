"""What axe-core misses on pages, put in after the theme, Sphinx and MyST-NB."""

import re
from typing import Any

from sphinx.application import Sphinx

MENDS = (
    (r'role="heading"', 'role="heading" aria-level="2"'),  # captions of the navigation
    (r'<aside class="sidebar-drawer', '<aside aria-label="Pages" class="sidebar-drawer'),
    (r'<aside class="toc-drawer', '<aside aria-label="On this page" class="toc-drawer'),
    (
        r'<th class="head[^"]*"><p></p></th>',
        "<td></td>",
    ),  # the empty corner of a table heads nothing
    (r' aria-label="Toggle hidden content"', ""),  # what is folded says so itself
    # A signature of several lines is a list of descriptions without terms.
    (
        r"<dl>\s*((?:<dd><em class=\"sig-param\">.*?</em>,?</dd>\s*)+)</dl>",
        r'<div class="sig-lines">\1</div>',
    ),
    (r"<dd>(<em class=\"sig-param\">.*?</em>,?)</dd>", r"<div>\1</div>"),
)


def accessible(page: str) -> str:
    """Return the body of a page with `MENDS`."""
    for found, better in MENDS:
        page = re.sub(found, better, page, flags=re.DOTALL)
    return page


def _add(app: Sphinx) -> None:
    templates: Any = app.builder.templates  # of Jinja
    if app.builder.format == "html":
        templates.environment.filters["accessible"] = accessible


def setup(app: Sphinx) -> dict[str, bool]:
    """Add the filter `accessible`, which docs/site/templates/page.html uses."""
    app.connect("builder-inited", _add)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
