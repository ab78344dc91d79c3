"""Makes a release: `make release VERSION=0.3.0`.

Sets version and date, builds wheel and sdist, tries both in empty environments, then commits and tags. Nothing is
committed if anything fails, and nothing is published: push the commit and its tag yourself.
"""

from __future__ import annotations

import datetime
import re
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

ROOT = Path(__file__).parents[1]
FILES = {
    "src/flypend/__init__.py": re.compile(r'(?<=__version__ = ")[^"]+'),
    "CITATION.cff": re.compile(r"(?<=^version: ).+$", re.MULTILINE),
}
NUMBER = re.compile(r"\d+\.\d+\.\d+")


def stamped(changelog: str, version: str, day: str) -> str:
    """Return `changelog` with the section of `version` dated; SystemExit if its first one is not that, unreleased."""
    head = f"## {version} (unreleased)"
    sections = re.findall(r"^## .+$", changelog, re.MULTILINE)
    if not sections or sections[0] != head:
        sys.exit(f"CHANGELOG.md: expected {head!r} at the top, got {sections[:1]}")
    return changelog.replace(head, f"## {version} ({day})", 1)


def git(*arguments: str) -> str:
    """Run git here and return what it prints."""
    done = subprocess.run(["git", *arguments], cwd=ROOT, check=True, capture_output=True, text=True)
    return done.stdout.strip()


def try_out(package: Path) -> None:
    """Install `package` into an empty environment, and run the self-test there."""
    with tempfile.TemporaryDirectory() as folder:
        venv.create(folder, with_pip=True)
        python = Path(folder) / ("Scripts" if sys.platform == "win32" else "bin") / "python"
        subprocess.run([python, "-m", "pip", "install", "--quiet", package], check=True, cwd=folder)
        subprocess.run([python, "-m", "flypend.selftest"], check=True, cwd=folder)


def main() -> None:
    """Release the version that is named."""
    if len(sys.argv) != 2 or not NUMBER.fullmatch(sys.argv[1]):
        sys.exit("expected a version such as 0.3.0")
    version, tag = sys.argv[1], f"v{sys.argv[1]}"
    if git("status", "--porcelain"):
        sys.exit("expected a clean work tree")
    if tag in git("tag").split():
        sys.exit(f"expected a new version, got {tag}, which has a tag")
    changelog = ROOT / "CHANGELOG.md"
    changes = {changelog: stamped(changelog.read_text(encoding="utf-8"), version, f"{datetime.date.today()}")}
    for name, pattern in FILES.items():
        text, count = pattern.subn(version, (ROOT / name).read_text(encoding="utf-8"))
        if count != 1:
            sys.exit(f"{name}: expected one version, got {count}")
        changes[ROOT / name] = text
    for path, text in changes.items():
        path.write_text(text, encoding="utf-8")
    try:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-m", "hatchling", "build", "--directory", folder], cwd=ROOT, check=True)
            for package in sorted(Path(folder).iterdir()):
                try_out(package)
    except BaseException:
        git("checkout", "--", *(str(path) for path in changes))
        raise
    git("commit", "--all", "--message", f"Release {version}")
    git("tag", "--annotate", tag, "--message", f"flypend {version}")
    print(f"{tag} is committed and tagged.")


if __name__ == "__main__":
    main()
