"""The page of the laboratory: an HTML shell that embeds the choices and loads one script."""

from __future__ import annotations

from flypend import palette
from flypend.lab.controls import offer
from flypend.lab.own import OwnLaws
from flypend.pages import replay

PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>flypend laboratory</title>
</head>
<body>
<noscript>The laboratory needs JavaScript.</noscript>
<script id="flypend-data" type="application/json">{data}</script>
<script src="lab.js"></script>
</body>
</html>
"""


def page(own: OwnLaws | None = None) -> str:
    """Return the page as HTML, offering the custom laws `own`."""
    data = {"title": "flypend laboratory", "layout": "overlay", "speed": 1.0, "palette": palette.PAGE, "runs": []}
    return PAGE.format(data=replay.embedded({**data, "offer": offer(own)}))
