"""The site of these pages: `make docs` writes it to docs/_build, without a network."""

import os
import sys
from pathlib import Path
from typing import Any

from flypend import __version__

project = "flypend"
author = "The flypend authors"
release = version = __version__
extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_click",
    "sphinx_copybutton",
    "sphinxcontrib.programoutput",
]

exclude_patterns = ["_build", "jupyter_execute"]
html_theme = "furo"
html_title = "flypend"
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_theme_options = {"navigation_with_keys": True}
html_search_scorer = str(Path(__file__).with_name("search_scorer.js"))

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
autodoc_default_options = {"members": True, "exclude-members": "__new__"}
maximum_signature_line_length = 100

# The commands whose output a page shows: of this installation, as wide as the page.
os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
os.environ["COLUMNS"] = "100"


def _escaped(lines: list[str]) -> None:
    """Keep |y| and x* in docstrings from being markup."""
    lines[:] = [line.replace("|", r"\|").replace("*", r"\*") for line in lines]


def _site(app: Any) -> None:
    """Tell the gallery where to leave the pages that it links to."""
    os.environ["FLYPEND_SITE"] = str(app.outdir)


def setup(app: Any) -> None:
    """Escape docstrings before their sections are read, and say where the site is."""
    app.connect("builder-inited", _site)
    app.connect("autodoc-process-docstring", lambda *given: _escaped(given[-1]), priority=400)
    app.connect("sphinx-click-process-description", lambda *given: _escaped(given[-1]))
