"""What several test files share: a cache of their own, a browser without a screen, and a checker of what it shows."""

import os
import shutil
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest
from playwright.sync_api import sync_playwright

from tests.machine_code import keep_what_was_used_last, use_machine_code_by_text

# Drawn in software, and nothing that the browser itself would send out.
OPTIONS = [
    "--headless", "--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
]  # fmt: skip


def pytest_configure(config):
    """Keep the machine code of tests, and of what they start, away from the user's; keep bytecode."""
    kept = config.rootpath / ".pytest_cache"
    os.environ["FLYPEND_CACHE"] = str(kept / "machine-code")
    os.environ.pop("FLYPEND_CACHE_LIMIT", None)
    # Without bytecode each of the many processes that tests start compiles all of its imports again.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    sys.dont_write_bytecode = False
    use_machine_code_by_text(kept / "machine-code-by-text")
    if not hasattr(config, "workerinput"):
        keep_what_was_used_last(kept / "machine-code-by-text")


def pytest_collection_modifyitems(items):
    """Begin with the tests of the whole project, which build the site, wheel and environments for minutes.

    At the end, a worker out of work would take half of them from the other, and build all of that once more.
    """
    items.sort(key=lambda item: item.path.parent != Path(__file__).parent)


@pytest.fixture(scope="module")
def one_plan():
    """Let `check` plan from one random start where a law fails: eight plans take longer than all of its flights."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(import_module("flypend.studies.check"), "STARTS", 1)
        yield


@pytest.fixture(scope="module")
def chromium():
    program = shutil.which("chromium")
    assert program, "make test-tools installs chromium"
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=OPTIONS)
        yield browser
        browser.close()


KEPT = 4  # pages, each with a process of its own
LEFT = "() => location.protocol === 'about:' ? [] : [...Object.keys(localStorage), ...Object.keys(sessionStorage)]"


@pytest.fixture(scope="module")
def pages(chromium):
    """Return a function that lends a blank page of a context with some settings, and one that takes it back.

    To begin a context, with its process, takes a processor thrice as long as to open a page in one that was used.
    """
    from benchmarks.frames import UNDRAWN  # imported here: most tests open no page

    kept = []

    def lend(drawn, setting):
        key = drawn, repr(sorted(setting.items()))
        found = next((i for i, (other, _) in enumerate(kept) if other == key), None)
        if found is not None:
            return kept.pop(found)
        context = chromium.new_context(**setting)
        if not drawn:
            context.add_init_script(UNDRAWN)
        return key, context.new_page()

    def take_back(key, page):
        if page.is_closed():
            return
        for other in page.context.pages:
            if other is not page:
                other.close()
        page.goto("about:blank")
        kept.append((key, page))
        if len(kept) > KEPT:
            kept.pop(0)[1].context.close()

    return lend, take_back


@pytest.fixture
def offline(pages):
    """Return a function that opens a file in a context that no other page has, without a network; takes its arguments.

    Unless `drawn`, it leaves out draw calls: the scene takes a processor more time than all else that a page does.
    A page of a server is opened with offline=False, and may ask that server. At the end no page has asked for anything
    but itself and the files `beside` it, none has complained, and none has left anything to the next in its context.
    """
    lend, take_back = pages
    lent, asked, complaints, known = [], [], [], ["data:,", "blob:", "about:srcdoc"]
    heard = {
        "request": lambda request: asked.append(request.url),
        "console": lambda said: complaints.append(said.text) if said.type == "error" else None,
        "pageerror": lambda error: complaints.append(str(error)),
    }

    def open_(address, *, drawn=False, beside=(), **setting):
        key, page = lend(drawn, {"offline": True} | setting)
        lent.append((key, page))
        known.extend((address.partition("#")[0], *beside))
        for event, listener in heard.items():
            page.on(event, listener)
        if "viewport" in setting and page.viewport_size != setting["viewport"]:
            page.set_viewport_size(setting["viewport"])
        page.goto(address)
        return page

    yield open_
    left = []
    for key, page in lent:
        left += [] if page.is_closed() else page.evaluate(LEFT)
        take_back(key, page)
        for event, listener in heard.items():
            page.remove_listener(event, listener)
    assert left == []
    assert complaints == []
    assert [url for url in asked if not url.startswith(tuple(known))] == []


@pytest.fixture(scope="session")
def node_modules(tmp_path_factory):
    """Return the folder of the packages that pages and their tests use, installed if need be."""
    web = Path(__file__).parents[1] / "web"
    modules = web / "node_modules"
    if not all((modules / name).is_dir() for name in ("axe-core", "jsqr")):
        copy = tmp_path_factory.mktemp("web")
        for name in ("package.json", "package-lock.json", ".npmrc"):
            shutil.copy(web / name, copy)
        subprocess.run(["npm", "ci", "--silent"], cwd=copy, check=True, timeout=300)
        modules = copy / "node_modules"
    return modules


@pytest.fixture(scope="session")
def axe(node_modules):
    """Return a function from an open page to what axe-core finds wrong with it: (rule, elements)."""
    program = (node_modules / "axe-core" / "axe.min.js").read_text(encoding="utf-8")

    def find(page):
        page.evaluate(program)
        found = page.evaluate("axe.run(document, { resultTypes: ['violations'] })")
        return [(one["id"], [node["html"][:120] for node in one["nodes"]]) for one in found["violations"]]

    return find
