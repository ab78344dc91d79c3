"""What a page itself does for a frame: `python -m benchmarks.frames` plays a replay and lets a live page fly on.

Processor time of the page's main thread, which other programs do not lengthen: scripts, style, layout and painting.
Draw calls are left out, so that the browser of the tests, which has no graphics card, draws as often as a display does.
"""

import shutil
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import sync_playwright

import flypend as fp
from benchmarks.lab import OPTIONS, SHOWN

SIZE = {"width": 1280, "height": 800}
SECONDS = 4.0
UNDRAWN = """for (const name of ["drawElements", "drawArrays", "drawElementsInstanced", "clear"]) {
  WebGL2RenderingContext.prototype[name] = () => {};
}"""
# Take over from a page that plays by itself: it rests at its start, with all controls in sight.
AT_REST = "() => { flypend.pause(); flypend.seek(0); document.querySelector('.open')?.click(); }"
# What the browser counts, from scripts on to all that it does.
SCRIPTS = ("ScriptDuration",)
PARTS = {
    "scripts": SCRIPTS, "scripts, style and layout": (*SCRIPTS, "RecalcStyleDuration", "LayoutDuration"),
    "with painting and all else that the browser does": ("TaskDuration",),
}  # fmt: skip
BUDGET = 4.0  # ms of scripts a frame, a quarter of what 60 frames a second leave


def opened(browser, file):
    """The page in `file`, and a session that knows its processor time."""
    page = browser.new_context(viewport=SIZE, offline=True).new_page()
    page.add_init_script(UNDRAWN)
    session = page.context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})
    page.goto(Path(file).as_uri())
    return page, session


def spent(page, session, seconds=SECONDS):
    """Milliseconds of processor for each frame of the next `seconds`, by part, and frames a second."""

    def told():
        metrics = {entry["name"]: entry["value"] for entry in session.send("Performance.getMetrics")["metrics"]}
        return metrics, page.evaluate("[flypend.frames().count, performance.now()]")

    before, (count, begun) = told()
    page.wait_for_timeout(1e3 * seconds)
    after, (last, ended) = told()
    frames = last - count
    times = {words: 1e3 * sum(after[name] - before[name] for name in names) / frames for words, names in PARTS.items()}
    return times | {"frames a second": 1e3 * frames / (ended - begun)}


def replayed(browser, folder):
    """A replay that plays."""
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, -1)), duration=8)
    run.to_html(Path(folder) / "replay.html")
    page, session = opened(browser, Path(folder) / "replay.html")
    page.evaluate("flypend.play()")
    page.wait_for_timeout(500)
    return spent(page, session)


def live(browser, folder):
    """A flight that goes on, past the time from which on no plot grows any more."""
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, -1)), duration=6)
    run.to_html(Path(folder) / "live.html", live=True)
    page, session = opened(browser, Path(folder) / "live.html")
    page.wait_for_function(SHOWN)
    page.evaluate("flypend.seek(6), flypend.go(true)")
    page.wait_for_timeout(3000)
    return spent(page, session)


def main():
    """Print milliseconds for a frame of both; exit with 1 where scripts take more than their budget."""
    with sync_playwright() as playwright, TemporaryDirectory() as folder:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=OPTIONS)
        both = replayed(browser, folder), live(browser, folder)
    print("| | a replay | a live flight beside its ghost |\n|---|---|---|")
    for words in both[0]:
        unit = "" if words == "frames a second" else " ms"
        print(f"| {words} | " + " | ".join(f"{times[words]:.2f}{unit}" for times in both) + " |")
    if max(times["scripts"] for times in both) > BUDGET:
        sys.exit(f"scripts take more than {BUDGET:g} ms a frame")


if __name__ == "__main__":
    main()
