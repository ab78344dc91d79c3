"""The paper for the Journal of Open Source Software as one page: `python paper/build.py paper.html`."""

import sys
from pathlib import Path

import pypandoc

HERE = Path(__file__).parent


def build(out: Path) -> None:
    """Write paper.md with its citations resolved to `out`; raises RuntimeError for what pandoc warns of."""
    here = [f"--bibliography={HERE / 'paper.bib'}", f"--resource-path={HERE}"]
    whole = ["--standalone", "--embed-resources", "--mathml", "--fail-if-warnings", "--metadata=lang:en"]
    whole += ["--variable=include-before:<main>", "--variable=include-after:</main>"]
    pypandoc.convert_file(str(HERE / "paper.md"), "html", outputfile=str(out), extra_args=["--citeproc", *whole, *here])


if __name__ == "__main__":
    build(Path(sys.argv[1]))
