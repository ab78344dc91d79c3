"""The paper for the Journal of Open Source Software as one page: `python paper/build.py paper.html`."""

import re
import sys
from pathlib import Path

import pypandoc

HERE = Path(__file__).parent
# What the journal's form has and pandoc reads otherwise: the authors' names; and fonts that know how formulas are set.
AUTHOR = re.compile(r"^  - name: (.*)\n    affiliation:", flags=re.MULTILINE)
FONTS = "<style>math { font-family: 'STIX Two Math', 'Cambria Math', 'DejaVu Math TeX Gyre', math; }</style>"


def build(out: Path) -> None:
    """Write paper.md with its citations resolved to `out`; raises RuntimeError for what pandoc warns of."""
    here = [f"--bibliography={HERE / 'paper.bib'}", f"--resource-path={HERE}"]
    whole = ["--standalone", "--embed-resources", "--mathml", "--fail-if-warnings", "--metadata=lang:en"]
    whole += [
        "--variable=include-before:<main>",
        "--variable=include-after:</main>",
        f"--variable=header-includes:{FONTS}",
    ]
    whole += [f"--metadata=author:{name}" for name in AUTHOR.findall((HERE / "paper.md").read_text(encoding="utf-8"))]
    pypandoc.convert_file(str(HERE / "paper.md"), "html", outputfile=str(out), extra_args=["--citeproc", *whole, *here])


if __name__ == "__main__":
    build(Path(sys.argv[1]))
