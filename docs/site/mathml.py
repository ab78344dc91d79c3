"""Formulas as MathML, which browsers draw by themselves: nothing to load or to run."""

import re
from functools import reduce
from typing import Any

import pypandoc
from docutils import nodes
from sphinx.application import Sphinx

FORMULA = re.compile(r"<math.*?</math>", flags=re.DOTALL)
# Where browsers draw what pandoc writes in another way than TeX: accents that combine with
# nothing hang beside their letter, arrows are too wide, fractions in tables are small.
MENDS = {
    '<mo accent="true">\u0307': '<mo accent="true" stretchy="false">\u02d9',
    '<mo accent="true">\u0308': '<mo accent="true" stretchy="false">\u00a8',
    '<mo accent="true">\u0302': '<mo accent="true" stretchy="false">\u02c6',
    '<mo accent="true">\u0304': '<mo accent="true" stretchy="false">\u00af',
    '<mo accent="true">→': '<mo accent="true" stretchy="false" mathsize="60%">→',
    "<mtable": '<mtable displaystyle="true"',
}
Writer = Any  # of HTML, with `body`, a list of strings


def mathml(formulas: list[str]) -> list[str]:
    """Return the element of each of `formulas`, LaTeX between its dollars.

    Raises RuntimeError for what is no LaTeX.
    """
    paragraphs = "\n\n".join(formulas)
    page = pypandoc.convert_text(
        paragraphs, "html", "markdown", ["--mathml", "--wrap=none", "--fail-if-warnings"]
    )
    found = FORMULA.findall(page)
    if len(found) != len(formulas):
        raise RuntimeError(f"{len(formulas)} formulas became {len(found)}: {formulas}")
    return [
        reduce(lambda text, mend: text.replace(*mend), MENDS.items(), one) for one in found
    ]


def _translate(app: Sphinx, doctree: nodes.document, name: str) -> None:
    """Give every formula of a page its element, by one call of pandoc."""
    found = [
        node
        for node in doctree.findall()
        if isinstance(node, nodes.math | nodes.math_block)
    ]
    around = ["$$" if isinstance(node, nodes.math_block) else "$" for node in found]
    texts = [
        f"{mark}{node.astext().strip()}{mark}"
        for mark, node in zip(around, found, strict=True)
    ]
    for node, element in zip(found, mathml(texts) if texts else [], strict=True):
        node["mathml"] = element


def _inline(writer: Writer, node: nodes.math) -> None:
    writer.body.append(node["mathml"])
    raise nodes.SkipNode


def _block(writer: Writer, node: nodes.math_block) -> None:
    writer.body.append(f'<div class="math">{node["mathml"]}</div>\n')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """Add the renderer `mathml`."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    app.connect("doctree-resolved", _translate)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
