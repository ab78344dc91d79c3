"""The documentation: the site builds without a warning or a dead link, and what its pages tell one to run runs."""

import re
import subprocess
import sys
from pathlib import Path
from urllib.parse import quote

import pytest

import flypend as fp
import flypend.envs
from benchmarks.commands import LINES
from flypend.cli.app import app
from flypend.studies.sweep.chunk import CAUSES

ROOT = Path(__file__).parents[1]
PAGES = sorted((ROOT / "docs").rglob("*.md"))
BLOCK = re.compile(r"^```python\n(.*?)^```$", flags=re.MULTILINE | re.DOTALL)


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The folder of the built site."""
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", "docs", str(folder)]
    built = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stderr
    return folder


def test_every_page_is_on_the_site(site):
    pages = {path.relative_to(ROOT / "docs").with_suffix(".html") for path in PAGES if "_build" not in path.parts}
    assert {path.relative_to(site) for path in site.rglob("*.html")} >= pages
    assert len(pages) > 40


def test_links_between_pages_hold_on_the_site(site):
    ends = {path: set(re.findall(r'\bid="([^"]+)"', path.read_text(encoding="utf-8"))) for path in site.rglob("*.html")}
    dead = []
    for page in ends:
        for link in re.findall(r'\bhref="([^"]+)"', page.read_text(encoding="utf-8")):
            if re.match(r"[a-z]+:", link):
                continue
            path, _, place = link.partition("#")
            target = (page.parent / path.split("?")[0]).resolve() if path else page
            if not target.exists() or (place and target in ends and place not in ends[target]):
                dead.append((page.name, link))
    assert not dead


def test_formulas_are_elements_that_browsers_draw(site):
    page = (site / "model" / "equations.html").read_text(encoding="utf-8")
    assert page.count('<math display="block"') >= 5
    source = (ROOT / "docs" / "model" / "equations.md").read_text(encoding="utf-8")
    assert page.count("<math ") == len(re.findall(r"\$\$.*?\$\$|\$[^$]+?\$", source, flags=re.DOTALL))


def test_the_site_needs_no_network(site):
    """Nothing is loaded from elsewhere; links may lead there."""
    loaded = re.compile(r'<(?:script|img|link|iframe)[^>]*\b(?:src|href)="(https?:[^"]+)"')
    found = [address for page in site.rglob("*.html") for address in loaded.findall(page.read_text(encoding="utf-8"))]
    assert not found


def test_tutorials_were_run_and_can_be_taken_along(site):
    tutorials = sorted((ROOT / "docs" / "tutorials").glob("*-*.md"))
    assert len(tutorials) > 5
    for path in tutorials:
        page = (site / "tutorials" / f"{path.stem}.html").read_text(encoding="utf-8")
        assert "cell_output" in page
        assert len(list((site / "_downloads").rglob(f"{path.stem}.ipynb"))) == 1


def test_the_paper_resolves_its_citations_and_cites_what_it_lists(tmp_path):
    out = tmp_path / "paper.html"
    subprocess.run([sys.executable, str(ROOT / "paper" / "build.py"), str(out)], check=True)  # a warning fails
    page = out.read_text(encoding="utf-8")
    listed = re.findall(r"^@\w+{(\w+),", (ROOT / "paper" / "paper.bib").read_text(encoding="utf-8"), flags=re.MULTILINE)
    assert len(listed) > 8
    assert set(re.findall(r'id="ref-(\w+)"', page)) == set(listed)


# What a newcomer types, and the page that answers.
QUESTIONS = {
    "install": "how-to/install", "own law in map": "how-to/map", "units of gains": "reference/gains",
    "why a flight failed": "how-to/why-failed", "how to fly a circle": "how-to/circle",
    "how to export": "how-to/export", "how to step the simulator": "how-to/step",
    "which plant is the default": "how-to/plant", "how long does it take": "reference/times",
}  # fmt: skip
FIRST = 3  # results that one sees without looking for them


@pytest.fixture(scope="module")
def searching(chromium, site):
    """A page of the site from disk, without a network."""
    context = chromium.new_context(offline=True)
    yield context.new_page()
    context.close()


@pytest.mark.parametrize("question", QUESTIONS)
def test_the_search_of_the_site_answers_what_newcomers_ask(site, searching, question):
    searching.goto(f"{(site / 'search.html').as_uri()}?q={quote(question)}")
    results = searching.locator("#search-results ul.search li > a")
    searching.locator("#search-results .search-summary", has_text="found").wait_for()
    found = [result.get_attribute("href").partition(".html")[0] for result in results.all()[:FIRST]]
    assert QUESTIONS[question] in found


# Seen in ways that differ: a phone by day, a desk by night. Pages with what others lack: a picture that moves, cells
# that were run, formulas, wide tables, options, signatures, an index, results of a search.
VIEWS = {"phone": (390, "light"), "desk": (1280, "dark")}
SEEN = (
    "index.html", "gallery.html", "tutorials/your-law.html", "how-to/step.html", "model/equations.html",
    "model/machine.html", "reference/commands.html", "reference/python.html", "genindex.html",
    "search.html?q=own law in map",
)  # fmt: skip


@pytest.fixture(scope="module", params=VIEWS)
def looking(request, chromium):
    """A page as one sees it, without a network."""
    width, scheme = VIEWS[request.param]
    context = chromium.new_context(offline=True, viewport={"width": width, "height": 900}, color_scheme=scheme)
    yield context.new_page()
    context.close()


def look(looking, site, name):
    """Open the page `name`; wait for what it does by itself."""
    path, _, query = name.partition("?")
    looking.goto((site / path).as_uri() + (f"?{quote(query, safe='=')}" if query else ""))
    if query:
        looking.locator("#search-results .search-summary", has_text="found").wait_for()
    looking.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def wider(page):
    """By how many pixels the page is wider than its window."""
    return page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")


@pytest.mark.parametrize("name", SEEN, ids=lambda name: name.partition(".")[0])
def test_a_page_is_for_everyone_and_fits(site, looking, axe, name):
    look(looking, site, name)
    assert axe(looking) == []
    assert wider(looking) <= 0


@pytest.mark.slow
def test_every_page_is_for_everyone_and_fits(site, looking, axe):
    pages = sorted(path.relative_to(site).as_posix() for path in site.rglob("*.html"))
    pages = [name for name in pages if not name.startswith(("gallery/", "_downloads/"))]  # those are not of the theme
    assert len(pages) > 55
    faults = {}
    for name in pages:
        look(looking, site, name)
        faults[name] = [*axe(looking), *([wider(looking)] if wider(looking) > 0 else [])]
    assert {name: found for name, found in faults.items() if found} == {}


@pytest.mark.parametrize(("wish", "seen"), [("no-preference", "moving"), ("reduce", "still")])
def test_who_wants_nothing_to_move_sees_the_flight_in_still_pictures(site, chromium, wish, seen):
    context = chromium.new_context(offline=True, reduced_motion=wish)
    page = context.new_page()
    page.goto((site / "index.html").as_uri())
    shown = [one.get_attribute("class") for one in page.locator("article img").all() if one.is_visible()]
    assert shown == [seen]
    context.close()


def table(page):
    """The first column of the tables of a page, without its heads."""
    text = (ROOT / "docs" / f"{page}.md").read_text(encoding="utf-8")
    return re.findall(r"^\| `([^`]+)` \|", text, flags=re.MULTILINE)


def test_every_command_says_how_long_it_takes_as_the_benchmark_types_it():
    assert table("reference/times") == list(LINES)
    assert {line.split()[1] for line in LINES} == set(app.commands)


def test_every_public_name_is_in_the_reference(site):
    page = (site / "reference" / "python.html").read_text(encoding="utf-8")
    described = set(re.findall(r'<dt class="sig sig-object py" id="flypend\.([\w.]+)"', page))
    names = {*fp.__all__} - {"laws"} | {f"laws.{name}" for name in fp.laws.__all__} - {"laws.AnyLaw"}  # a type alone
    names |= {f"envs.{name}" for name in flypend.envs.__all__} | {"export.compiled"}
    same = {name.rpartition(".")[2] for name in described}  # Law is an attribute of fp and of fp.laws
    assert not {name for name in names if name.rpartition(".")[2] not in same}


def test_every_cause_of_failure_is_explained():
    assert sorted(table("flight/causes")) == sorted(set(CAUSES) - {"success"})


def blocks():
    """The pages with Python in them."""
    return [path for path in PAGES if BLOCK.search(path.read_text(encoding="utf-8"))]


@pytest.mark.parametrize("path", blocks(), ids=lambda path: path.stem)
def test_the_python_of_a_page_runs(path, tmp_path, monkeypatch, capsys):
    """All blocks of a page one after the other, as a reader would type them into one session."""
    monkeypatch.chdir(tmp_path)
    session = {"__name__": "__main__"}
    for i, code in enumerate(BLOCK.findall(path.read_text(encoding="utf-8"))):
        exec(compile(code, f"{path.name}, block {i + 1}", "exec"), session)
    assert len(session) > 1
