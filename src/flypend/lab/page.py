"""The page of the laboratory: what there is to choose from, inside a shell that loads one program."""

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
    """The page, as text, with laws of one's `own` to choose from."""
    data = {"title": "flypend laboratory", "layout": "overlay", "speed": 1.0, "palette": palette.PAGE, "runs": []}
    return PAGE.format(data=replay.embedded({**data, "offer": offer(own)}))
