"""How soon a live page shows a flight that it has flown: `python -m benchmarks.start` opens one from disk, offline.

First it tells how much processor time the package takes to write it, with nothing compiled and again. The browser is
the chromium of the tests. Without a graphics card it draws in software, on the processor that the page needs too: how
long the page waits for that is told beside its own time.
"""

import os
import shutil
import statistics
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import sync_playwright

import flypend as fp
from benchmarks.lab import OPTIONS
from flypend.compile.cache import VARIABLE

SIZE = {"width": 1280, "height": 800}
# Milliseconds in the calls of WebGL until the mark "flypend drawn", and when two frames later the picture is shown.
WATCH = """(() => {
  let waited = 0;
  const timed = (of, name) => {
    const call = of[name];
    of[name] = function (...given) {
      const begun = performance.now();
      try { return call.apply(this, given); } finally { waited += performance.now() - begun; }
    };
  };
  const of = WebGL2RenderingContext.prototype;
  for (const [name, { value }] of Object.entries(Object.getOwnPropertyDescriptors(of))) {
    if (typeof value === "function" && name !== "constructor") timed(of, name);
  }
  timed(HTMLCanvasElement.prototype, "getContext");
  const at = (name) => performance.getEntriesByName(name)[0]?.startTime;
  window.started = new Promise((resolve) => {
    const look = () => {
      const drawn = at("flypend drawn");
      if (drawn === undefined) return requestAnimationFrame(look);
      const graphics = waited;
      requestAnimationFrame(() => requestAnimationFrame((shown) =>
        resolve({ flown: at("flypend flown"), drawn, graphics, own: drawn - graphics, shown })));
    };
    requestAnimationFrame(look);
  });
})();"""
WORDS = {
    "flown": "the first flight has been flown",
    "drawn": "the page has drawn it",
    "graphics": "of that, waiting in calls of WebGL",
    "own": "of that, the rest: the page's own time",
    "shown": "it is on the screen",
    "processor": "processor time of the main thread",
}


def started(browser, file):
    """Milliseconds from the navigation to `file`, as in `WORDS`, in a page and a context of their own."""
    context = browser.new_context(viewport=SIZE, offline=True)
    page = context.new_page()
    page.add_init_script(WATCH)
    session = context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})
    page.goto(Path(file).as_uri())
    told = page.evaluate("window.started")
    metrics = {entry["name"]: entry["value"] for entry in session.send("Performance.getMetrics")["metrics"]}
    context.close()
    return told | {"processor": 1e3 * metrics["TaskDuration"]}


def written(run, file):
    """Seconds of processor to write the live page of `run`."""
    begun = time.process_time()
    run.to_html(file, live=True)
    return time.process_time() - begun


def main(count=20):
    """Print medians and the least of `count` openings of the page of the swing-up."""
    with TemporaryDirectory() as empty:
        os.environ[VARIABLE] = empty
        opened(count)


def opened(count):
    """As `main`, in an empty cache of compiled kernels."""
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, -1)), duration=6)
    with sync_playwright() as playwright, TemporaryDirectory() as folder:
        file = Path(folder) / "live.html"
        print(f"processor time to write it {written(run, file):.2f} s, again {written(run, file):.2f} s")
        times = []
        for _ in range(count):  # a browser each: nothing that one compiled is left for the next
            browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=OPTIONS)
            times.append(started(browser, file))
            browser.close()
    for name, words in WORDS.items():
        values = [entry[name] for entry in times]
        print(f"{words:42s} median {statistics.median(values):6.0f} ms   least {min(values):6.0f} ms")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
