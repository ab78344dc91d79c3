"""The documentation: the site builds without a warning or a dead link, and what its pages tell one to run runs."""

import importlib.util
import json
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from urllib.parse import quote

import casadi as ca
import gymnasium
import matplotlib.pyplot as plt
import numpy as np
import pytest
from PIL import Image, ImageColor

import flypend as fp
import flypend.envs
from benchmarks.commands import LINES
from benchmarks.diagrams import DIAGRAMS
from flypend import palette
from flypend.cli.app import app
from flypend.envs.task import upright
from flypend.lab.controls import figures, story
from flypend.model.table import vehicle_names
from flypend.studies.sweep.chunk import CAUSES
from tests.few import each_once

ROOT = Path(__file__).parents[1]
PAGES = sorted((ROOT / "docs").rglob("*.md"))
BLOCK = re.compile(r"^```python\n(.*?)^```$", flags=re.MULTILINE | re.DOTALL)


@pytest.fixture(autouse=True)
def _figures_are_closed():
    """Examples leave their figures open, as a reader's session does; Matplotlib warns of more than twenty."""
    yield
    plt.close("all")


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


def test_a_step_of_a_derivation_leads_to_its_line(site):
    page = (site / "laws" / "theorem-proof.html").read_text(encoding="utf-8")
    found = re.search(r'href="\.\./(src/flypend/laws/repaired\.html)#line-(\d+)">\(A3\)</a>', page)
    code = (site / found[1]).read_text(encoding="utf-8")
    line = code.partition(f'id="line-{found[2]}"')[2].partition('id="line-')[0]
    assert "f_p" in line
    assert "(A3)" in line


def test_formulas_are_elements_that_browsers_draw(site):
    page = (site / "model" / "equations.html").read_text(encoding="utf-8")
    assert page.count('<math display="block"') >= 5
    source = (ROOT / "docs" / "model" / "equations.md").read_text(encoding="utf-8")
    assert page.count("<math ") == len(re.findall(r"\$\$.*?\$\$|\$[^$]+?\$", source, flags=re.DOTALL))


def test_live_figures_are_loaded_where_they_are_seen_and_pictures_without_scripts(site, chromium):
    stills = {path.stem.partition("-")[2] for path in (ROOT / "docs" / "img").glob("live-*.png")}
    assert stills == {"chapters"} | {step["name"] for step in [*story(), *figures()]}
    page = (site / "laws" / "inverted.html").read_text(encoding="utf-8")
    assert (
        len(re.findall(r'<iframe src="\.\./gallery/chapters\.html\?figure=\w+" title="[^"]+" loading="lazy">', page))
        == 2
    )
    for scripts, seen in ((True, "iframe"), (False, "img")):
        context = chromium.new_context(offline=True, java_script_enabled=scripts)
        page = context.new_page()
        page.goto((site / "laws" / "theorem.html").as_uri())
        assert [
            one.evaluate("one => one.localName") for one in page.locator(".live > *").all() if one.is_visible()
        ] == [seen]
        context.close()


# Pages that are looked up, or worked through with a pencil.
LONG = ("theorem-proof", "-appendix")
MOST_WORDS = 1500


@pytest.mark.parametrize("path", [path for path in PAGES if not path.stem.endswith(LONG)], ids=lambda path: path.stem)
def test_a_page_is_read_in_one_sitting(path):
    text = re.sub(r"```.*?```|\$\$.*?\$\$", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
    text = re.sub(r"^(?:    |\||#).*$", "", text, flags=re.MULTILINE)  # code, tables, headings
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)|(?<=\])\([^)]*\)|\$[^$]*\$|`[^`]*`", "", text)
    assert len(re.findall(r"[A-Za-z']+", text)) <= MOST_WORDS


def test_the_site_needs_no_network(site):
    """Nothing is loaded from elsewhere; links may lead there."""
    loaded = re.compile(r'<(?:script|img|link|iframe)[^>]*\b(?:src|href)="(https?:[^"]+)"')
    found = [address for page in site.rglob("*.html") for address in loaded.findall(page.read_text(encoding="utf-8"))]
    assert not found


def test_tutorials_were_run_and_can_be_taken_along(site):
    tutorials = {path.stem: path for path in (ROOT / "docs" / "tutorials").glob("*-*.md")}
    del tutorials["learn-by-gradient"]  # needs PyTorch: `make learners` runs it
    assert len(tutorials) > 5
    for path in tutorials.values():
        page = (site / "tutorials" / f"{path.stem}.html").read_text(encoding="utf-8")
        assert "cell_output" in page
        assert len(list((site / "_downloads").rglob(f"{path.stem}.ipynb"))) == 1


def test_plots_of_tutorials_have_the_colours_of_the_package(site):
    page = site / "tutorials" / "your-law.html"
    plots = [
        Image.open(page.parent / name).convert("RGB") for name in re.findall(r'src="([^"]+\.png)"', page.read_text())
    ]
    found = {colour for plot in plots for _, colour in plot.getcolors(plot.width * plot.height)}
    assert ImageColor.getrgb(palette.BLUE) in found
    assert ImageColor.getrgb("#1f77b4") not in found  # the first of Matplotlib's own


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
    "video": "how-to/video", "python api simulate": "reference/api/flypend.simulate", "units": "model/conventions",
    "real hardware": "how-to/export", "cite": "how-to/cite", "why does LQR fail": "how-to/lqr",
    "my own drone": "how-to/vehicle", "ulog": "how-to/flight-log", "train ppo": "envs/environments",
    "plot": "how-to/plot", "install on mac": "how-to/install", "gpu": "how-to/gpu", "px4": "how-to/export",
    'error "singular"': "flight/causes", "how fast": "how-to/gpu",
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
    "model/machine.html", "reference/commands.html", "reference/python.html",
    "reference/api/flypend.Trajectory.html", "genindex.html",
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


# What one reads line by line must fit; tables and code may be scrolled, each by itself.
SIDEWAYS = """() => [...document.querySelectorAll("article :is(p, li, dd, h1, h2, h3, div.math)")]
  .filter((one) => !one.querySelector("table, pre"))
  .filter((one) => !one.closest("pre, .table-wrapper, .output, .sig"))
  .filter((one) => one.scrollWidth > one.clientWidth + 1 && getComputedStyle(one).display !== "inline")
  .map((one) => one.textContent.trim().slice(0, 60))"""


def wider(page):
    """By how many pixels the page is wider than its window."""
    return page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")


@pytest.mark.parametrize(
    ("looking", "name"), each_once(VIEWS, SEEN), ids=lambda name: name.partition(".")[0], indirect=["looking"]
)
def test_a_page_is_for_everyone_and_fits(site, looking, axe, name):
    look(looking, site, name)
    assert axe(looking) == []
    assert wider(looking) <= 0


def test_prose_and_formulas_fit_a_phone(site, chromium):
    context = chromium.new_context(offline=True, viewport={"width": 390, "height": 844})
    page = context.new_page()
    pages = [
        path.relative_to(ROOT / "docs").with_suffix(".html").as_posix() for path in PAGES if "_build" not in path.parts
    ]
    faults = {}
    for name in pages:
        look(page, site, name)
        faults[name] = page.evaluate(SIDEWAYS)
    context.close()
    assert {name: found for name, found in faults.items() if found} == {}


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


def test_every_public_name_has_a_page_with_an_example(site):
    pages = {path.stem: path.read_text(encoding="utf-8") for path in (site / "reference" / "api").glob("*.html")}
    assert all("highlight-python" in page for page in pages.values())
    described = {
        name
        for page in pages.values()
        for name in re.findall(r'<dt class="sig sig-object py" id="flypend\.([\w.]+)"', page)
    }
    names = {*fp.__all__} - {"laws"} | {f"laws.{name}" for name in fp.laws.__all__} - {"laws.AnyLaw"}  # a type alone
    names |= {f"envs.{name}" for name in flypend.envs.__all__} | {"export.compiled"}
    same = {name.rpartition(".")[2] for name in described}  # Law is an attribute of fp and of fp.laws
    assert not {name for name in names if name.rpartition(".")[2] not in same}


CELLS = re.split(
    r"^# %% (.+)\n", (ROOT / "docs" / "reference" / "examples.py").read_text(encoding="utf-8"), flags=re.MULTILINE
)
DRAWN = re.compile(r" \| api/(\S+): ")  # the picture that a cell draws
LEARNERS = ("sb3.make_vec_env", "sb3.VecWorlds")  # where Stable-Baselines3 is: tests/envs/learners.py
SLOW = ("trial, Trial",)  # it flies for minutes of flight
# Points of a picture each of which compiles a law of its own: fewer in every run, all in the slow one.
FEWER = {"sensitivity, Sensitivity": ("1.2, 15)", "1.2, 3)"), "Objective": ("1.2, 6)", "1.2, 2)")}


def cells():
    """The cells as parameters."""
    for name, code in zip(CELLS[1::2], CELLS[2::2], strict=True):
        called = name.partition(" | ")[0]
        if called in FEWER:
            assert FEWER[called][0] in code
            yield pytest.param(name, code.replace(*FEWER[called]), id=f"{called}, fewer")
        yield pytest.param(name, code, id=called, marks=[pytest.mark.slow] if called in (*SLOW, *FEWER) else [])


@pytest.mark.parametrize(("name", "code"), list(cells()))
def test_the_example_of_an_object_runs(name, code, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    if name.partition(" | ")[0] in LEARNERS and importlib.util.find_spec("stable_baselines3") is None:
        with pytest.raises(fp.InputError, match=r"^flypend\.envs\.sb3: expected Stable-Baselines3 \(pip install"):
            exec(compile(code, name, "exec"), {"__name__": "__main__"})
        return
    exec(compile(code, name, "exec"), {"__name__": "__main__"})
    assert all(Path(picture).exists() for picture in DRAWN.findall(name))


def test_pictures_of_objects_and_vehicles_are_there():
    pictures = {picture for name in CELLS[1::2] for picture in DRAWN.findall(name)}
    assert {path.name for path in (ROOT / "docs" / "img" / "api").iterdir()} == pictures
    machine = (ROOT / "docs" / "model" / "machine.md").read_text(encoding="utf-8")
    assert set(re.findall(r"\(\.\./img/vehicle-(\S+)\.png\)", machine)) == set(vehicle_names())


def test_the_notebook_for_colab_runs(tmp_path, monkeypatch, capsys):
    """Every cell but what installs, in an empty folder; the last values are those that a notebook would show."""
    notebook = json.loads((ROOT / "docs" / "notebooks" / "swing-up.ipynb").read_text(encoding="utf-8"))
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert re.search(r"^ +%pip install --quiet \{source\}$", cells[0], flags=re.MULTILINE)
    assert not any(cell["outputs"] for cell in notebook["cells"] if cell["cell_type"] == "code")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("matplotlib.pyplot.show", lambda: None)
    names = {}
    for cell in cells[1:]:
        exec(compile(cell, "swing-up.ipynb", "exec"), names)
    assert "completed" in capsys.readouterr().out
    assert names["run"].y[-1, 2] > 0.99
    assert names["runs"].success.mean() > 0.9
    assert {path.name for path in tmp_path.iterdir()} == {"swing-up.nc", "swing-up.html"}


# What a page types or calls, and the extra that it then names.
NEEDS = {
    r"flypend (map|sweep|tune)\b|to_xarray|engine=\"scipy\"": "studies", r"flypend lab\b": "lab",
    r"flypend movie\b": "movies", r"plant[= ]mujoco|plant=\"mujoco\"": "mujoco", r"\.mcap\b": "logs",
    r"import gymnasium": "rl",
}  # fmt: skip


@pytest.mark.parametrize("path", sorted((ROOT / "docs" / "how-to").glob("*.md")), ids=lambda path: path.stem)
def test_a_how_to_names_the_extra_that_it_needs(path):
    page = path.read_text(encoding="utf-8")
    for typed, extra in NEEDS.items():
        if path.stem != "install" and re.search(typed, page):  # that page lists them all
            assert re.search(rf"extra `{extra}`", page), (typed, extra)


def test_the_readme_is_read_in_three_minutes():
    """700 words beside what one types."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert len(re.sub(r"(?m)^    .*$|(?s:^```.*?^```)", "", text).split()) <= 700


def test_diagrams_are_those_that_the_command_draws():
    computed = {"lyapunov", "throw-phases", "throw-forces", "certified-set"}  # which take a moment, and a flight
    drawn = set(DIAGRAMS) - computed
    found = {name: (ROOT / "docs" / "img" / f"{name}.svg").read_text(encoding="utf-8") for name in drawn}
    assert found == {name: DIAGRAMS[name]().svg() for name in drawn}


def test_the_map_has_the_colour_of_every_cause():
    picture = Image.open(ROOT / "docs" / "img" / "map.png").convert("RGB")
    found = {colour for _, colour in picture.getcolors(picture.width * picture.height)}
    assert {ImageColor.getrgb(colour) for colour in palette.CAUSES.values()} <= found


def test_clips_are_small():
    sizes = {path.stem: path.stat().st_size for path in (ROOT / "docs" / "img").glob("*.svg")}
    clips = {name: size for name, size in sizes.items() if name.startswith(("cause-", "env-"))}
    assert {f"cause-{cause}" for cause in set(CAUSES) - {"success"}} < set(clips)
    assert max(clips.values()) < 150e3
    assert sum(size for name, size in clips.items() if name.startswith("cause-")) < 900e3


TASKS = (ROOT / "docs" / "envs" / "tasks.md").read_text(encoding="utf-8")
CARDS = {f"flypend/{card.partition(chr(10))[0]}": card for card in TASKS.split("\n## ")[1:-1]}


def test_the_card_of_an_environment_counts_its_observations():
    for name, card in CARDS.items():
        world = gymnasium.make(name)
        ranges = [(int(a), int(b)) for a, b in re.findall(r"^\| (\d+)–(\d+) \|", card, flags=re.MULTILINE)]
        assert [a for a, _ in ranges] == [0, *(b + 1 for _, b in ranges[:-1])]
        assert ranges[-1][1] + 1 == world.observation_space.shape[0]
    # In a process of its own: other tests register environments, too.
    listed = "import flypend.envs, gymnasium; print(*(one for one in gymnasium.registry if one.startswith('flypend/')))"
    done = subprocess.run([sys.executable, "-c", listed], capture_output=True, text=True, check=True)
    versions = {f"flypend/{name}" for name in re.findall(r"^### (\S+-v\d+)$", TASKS, flags=re.MULTILINE)}  # of a card
    assert set(CARDS) | versions == set(done.stdout.split())


UP = np.array([0.0, 0.0, 1.0])


def moment(change=0.0, **sizes):
    """A moment with the rod up and everything else far off or, if `sizes` say so, of that size, along e₁."""
    parts = {name: ca.DM([sizes.get(name, 1e9), 0, 0]) for name in ("x", "x_dot", "y_dot", "omega")}
    state = SimpleNamespace(y=ca.DM(UP), **parts)
    return SimpleNamespace(state=state, error=state, change=ca.DM([change] * 4))


def test_the_card_of_an_environment_says_when_it_ends():
    for name, card in CARDS.items():
        task = gymnasium.make(name).unwrapped.worlds.env.task
        assert float(re.search(r"cut off after \| ([\d.]+) s", card)[1]) == task.duration
        radius = float(re.search(r"the pivot is (\d+) m (?:off|from the goal)", card)[1])
        assert [float(task.ended(moment(x=radius + off))) for off in (-1e-6, 1e-6)] == [0, 1]


def test_the_table_of_rewards_has_the_weights_and_scales_of_the_code():
    parts = {"pivot near": "x", "pivot as fast": "x_dot", "rod at rest": "y_dot", "vehicle does not turn": "omega"}
    rows = [line.strip("| ").split(" | ") for line in TASKS.rpartition("½ at |")[2].splitlines() if "| 0." in line]
    base = float(upright(moment()))
    assert base == pytest.approx(float(rows[0][0]))
    for weight, term, _, half in rows[1:]:
        (part,) = (part for begin, part in parts.items() if term.startswith(begin))
        assert float(upright(moment(**{part: 0}))) - base == pytest.approx(float(weight))
        assert float(upright(moment(**{part: float(half.split()[0])}))) - base == pytest.approx(float(weight) / 2)
    assert len(rows) == 1 + len(parts)
    assert "| −0.02 | squared change of the action, summed over the rotors |" in TASKS
    assert float(upright(moment(change=1.0))) - base == pytest.approx(-0.02 * 4)


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
