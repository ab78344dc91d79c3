"""The site of these pages: `make docs` writes it to docs/_build, without a network."""

import os
import re
import runpy
import sys
from pathlib import Path
from typing import Any

from docutils import nodes

from flypend import __version__
from flypend.palette import SERIES

SITE = Path(__file__).with_name("site")  # what makes the pages, beside what is on them
sys.path.insert(0, str(SITE))

project = "flypend"
author = "The flypend authors"
release = version = __version__
extensions = [
    "accessible",
    "live",
    "mathml",
    "sources",
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx_click",
    "sphinx_copybutton",
    "sphinxcontrib.programoutput",
]

exclude_patterns = ["_build", "jupyter_execute", "notebooks"]  # which are for Colab
templates_path = ["site/templates"]
html_static_path = ["site/static"]
html_css_files = ["flypend.css"]
html_js_files = [("pages.js", {"defer": "defer"})]
html_favicon = "site/static/icon.svg"  # else browsers ask for one that is not there
html_theme = "furo"
html_title = "flypend"
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_theme_options = {"navigation_with_keys": True}
html_search_scorer = str(SITE / "search_scorer.js")

html_math_renderer = "mathml"

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3  # headings are link targets, as where the repository is read
suppress_warnings = ["myst.header"]

# The tutorials are run with every build.
nb_execution_mode = "force"
nb_execution_show_tb = True
nb_execution_timeout = 300
nb_merge_streams = True

napoleon_google_docstring = False
napoleon_use_rtype = False
autodoc_member_order = "bysource"
autodoc_typehints = "none"
autodoc_preserve_defaults = True
autodoc_mock_imports = ["stable_baselines3"]  # gigabytes, for two names
autodoc_default_options = {"members": True, "exclude-members": "__new__"}
maximum_signature_line_length = 100

# A page for each public object, with its cell of reference/examples.py and a picture.
CELL = re.compile(r"^# %% ([\w., ]+?)(?: \| (\S+): (.+))?\n", flags=re.MULTILINE)
_cells = CELL.split(
    Path(__file__).with_name("reference").joinpath("examples.py").read_text()
)
autosummary_generate = True
autosummary_context = {
    "examples": {
        name: {"picture": picture, "alt": alt, "code": code.strip()}
        for names, picture, alt, code in zip(
            *(_cells[i::4] for i in (1, 2, 3, 4)), strict=True
        )
        for name in names.split(", ")
    }
}
# Pages whose names differ by case alone would be one file on some systems.
autosummary_filename_map = {
    f"flypend.{name}": f"flypend.{name}-class"
    for name in ("Check", "Metrics", "Plan", "Sensitivity", "Study", "Trial", "Vehicle")
} | {"flypend.envs.Environment": "flypend.envs.Environment-class"}

# The commands whose output a page shows: of this installation, as wide as the page.
os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
os.environ["COLUMNS"] = "88"


def _escaped(lines: list[str]) -> None:
    """Keep |y| and x* in docstrings from being markup."""
    lines[:] = [line.replace("|", r"\|").replace("*", r"\*") for line in lines]


def _site(app: Any) -> None:
    """Say where the gallery leaves its pages, and in which colours tutorials plot."""
    os.environ["FLYPEND_SITE"] = str(app.outdir)
    settings = Path(app.doctreedir) / "matplotlibrc"
    colours = [colour.strip("#") for colour in SERIES]  # which begins a comment there
    settings.write_text(f"axes.prop_cycle: cycler('color', {colours})\n")
    os.environ["MATPLOTLIBRC"] = str(settings)


def _paper(app: Any, failed: Exception | None) -> None:
    """Write the paper beside the pages; the first of them leads to it."""
    if failed is None and app.builder.format == "html":
        build = runpy.run_path(str(Path(__file__).parents[1] / "paper" / "build.py"))[
            "build"
        ]
        build(Path(app.outdir) / "paper.html")


COMMANDS = ("flypend ", "make ", "pip ", "pytest ", "python ")


def _commands(_: Any, page: nodes.document) -> None:
    """Let what is typed into a shell look like that: its comments are not part of it."""
    for block in page.findall(nodes.literal_block):
        if block.get("language") == "none" and block.astext().startswith(COMMANDS):
            block["language"] = "shell"


def setup(app: Any) -> None:
    """Escape docstrings before their sections are read, and say where the site is."""
    app.connect("builder-inited", _site)
    app.connect("build-finished", _paper)
    app.connect("doctree-read", _commands)
    app.connect(
        "autodoc-process-docstring", lambda *given: _escaped(given[-1]), priority=400
    )
    app.connect("sphinx-click-process-description", lambda *given: _escaped(given[-1]))
