# Two commands: `make paper` runs the main job, `make test` the tests. Both set everything up on a fresh machine that
# has Python 3.11 or newer with venv, and make.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
OLDEST := .venv-lowest
FRESH := .venv-size
BASE := .venv-base
LEARNERS := .venv-learners
OUT ?= paper-out

.PHONY: setup paper lab docs pictures test mutants lowest learners first-contact size bench results test-tools fuzz loops web lint lock release clean

setup: $(VENV)/.ready

$(VENV)/.ready: requirements.lock pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit("flypend needs Python 3.11 or newer" if sys.version_info < (3, 11) else 0)'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	touch $@

paper: setup
	$(BIN)/flypend paper --out $(OUT)

# The live page; prints its address and opens it in a browser.
lab: setup
	$(BIN)/flypend lab

lint: setup
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy

# Three workers on two cores, since tests of pages wait for real time. The slowest test takes four minutes. One that takes
# twenty hangs: all stacks are shown, and its worker ends with it, since what hangs may be a child process for which the
# end of the test waits.
test: lint test-tools
	$(BIN)/pytest -n 3 --dist worksteal --durations=20 --timeout 1200 --timeout-method thread \
	    -o faulthandler_timeout=1190

# Plants 200 mutations in the source, and reports those that no test catches; parts of it: make mutants WHERE=board
mutants: setup test-tools
	$(BIN)/python tests/mutants.py $(WHERE)

# The kernels and their peers side by side; the peers are locked by themselves, so that the tests need none of them.
bench: setup
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements-bench.lock
	$(BIN)/python -m benchmarks bench-out
	$(BIN)/python -m benchmarks.planned_peers

# Which results of the ledger are older than the code that they measure; make results ONLY="mounts circles" measures
# those again.
results: setup
	$(BIN)/python -m benchmarks.results $(ONLY)

# The site of the documentation, in docs/_build: open index.html there. Needs no network once set up.
docs: setup
	$(BIN)/python -m sphinx -q -W --keep-going -b html docs docs/_build
	@echo open docs/_build/index.html

# The pictures of README and docs, but for those of `flypend check`, `flypend limit` and the plan through a window, whose
# pages have their commands: these take minutes to an hour.
pictures: setup
	$(BIN)/python -m benchmarks.diagrams
	$(BIN)/python -m benchmarks.clips
	$(BIN)/python -m benchmarks.pages
	$(BIN)/python -m benchmarks.hero

# What the tests need beyond Python: compilers and checkers of the exported C; a browser without a screen, and npm, which
# rebuilds the bundle of the pages.
TEST_PACKAGES := g++ clang libclang-rt-14-dev cppcheck gcc-arm-none-eabi libnewlib-arm-none-eabi valgrind cmake chromium \
    qemu-system-arm
AS_ROOT := $(shell test "$$(id -u)" = 0 || echo sudo)

INSTALL := $(AS_ROOT) apt-get update --quiet=2 && $(AS_ROOT) apt-get install --yes --quiet=2 --no-install-recommends

test-tools:
	dpkg -s $(TEST_PACKAGES) >/dev/null 2>&1 || { $(INSTALL) $(TEST_PACKAGES); }
	command -v npm >/dev/null || { $(INSTALL) npm; }

# Compiles src/flypend/compile/loops to bitcode, which is tracked: whoever installs flypend needs no compiler. Debian 12's
# clang 14.0.6 writes it; a test compares.
loops: test-tools
	sh src/flypend/compile/loops/build.sh

# Bundles web/ into src/flypend/pages/web, which is tracked: whoever installs flypend needs no npm.
web:
	cd web && npm ci --silent && npm run --silent build

# A minute of libFuzzer per law and precision under ASan and UBSan, and cppcheck on each.
fuzz: test-tools setup
	$(BIN)/pytest -m slow tests/export/test_c_tools.py

# Needs uv on the PATH; writes versions and hashes, no registry and no address.
COMPILE := uv pip compile --universal --python-version 3.11 --generate-hashes --no-emit-index-url --no-annotate \
    --custom-compile-command "make lock" --upgrade pyproject.toml
OLDEST_EXTRAS := --extra studies --extra lab --extra mujoco --extra movies --extra rl --extra logs --extra onnx

lock:
	$(COMPILE) --all-extras --group dev --output-file requirements.lock
	$(COMPILE) --all-extras --group bench --constraint requirements.lock --output-file requirements-bench.lock
	$(COMPILE) --extra rl --extra onnx --group learners --output-file requirements-learners.lock
	$(COMPILE) $(OLDEST_EXTRAS) --resolution lowest-direct --output-file requirements-lowest.lock

# The lower bounds of pyproject.toml, installed as a wheel and flown, with every extra: a minute and a half.
# `make lock` resolves them.
lowest: setup $(OLDEST)/.ready
	rm -rf $(OLDEST)/wheel
	$(BIN)/python -m hatchling build --target wheel --directory $(OLDEST)/wheel
	$(OLDEST)/bin/python -m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall \
	    $(OLDEST)/wheel/*.whl
	$(OLDEST)/bin/python -m flypend.selftest

$(OLDEST)/.ready: requirements-lowest.lock
	$(PYTHON) -m venv --clear $(OLDEST)
	$(OLDEST)/bin/python -m pip install --quiet --disable-pip-version-check --require-hashes \
	    -r requirements-lowest.lock
	touch $@

# The first lines of five training libraries, in an environment of their own, which takes seven gigabytes.
learners: setup $(LEARNERS)/.ready
	rm -rf $(LEARNERS)/wheel
	$(BIN)/python -m hatchling build --target wheel --directory $(LEARNERS)/wheel
	$(LEARNERS)/bin/python -m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall \
	    $(LEARNERS)/wheel/*.whl
	FLYPEND_CACHE=$(LEARNERS)/machine-code $(LEARNERS)/bin/python -m pytest --noconftest \
	    -o filterwarnings=default tests/envs/learners.py

$(LEARNERS)/.ready: requirements-learners.lock
	$(PYTHON) -m venv --clear $(LEARNERS)
	$(LEARNERS)/bin/python -m pip install --quiet --disable-pip-version-check --require-hashes \
	    -r requirements-learners.lock
	touch $@

# Sets the version, builds wheel and sdist, tries both in empty environments, commits and tags: make release VERSION=0.3.0
release: setup
	$(BIN)/python .ci/release.py $(VERSION)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .

# What README and the first pages tell one to type, on installations without extras: tests/first_contact.py.
first-contact: setup
	rm -rf $(BASE)/wheel
	$(BIN)/python -m hatchling build --target wheel --directory $(BASE)/wheel
	$(BIN)/python -m tests.first_contact $(BASE)/wheel/*.whl $(BASE)

# Megabytes of a fresh installation without extras; more than 700 is an error.
size:
	$(PYTHON) -m venv --clear $(FRESH)
	$(FRESH)/bin/python -m pip install --quiet --disable-pip-version-check .
	du -sm $(FRESH)/lib/python3*/site-packages | tee $(FRESH)/size
	test $$(cut -f1 $(FRESH)/size) -le 700

clean:
	rm -rf $(VENV) $(OLDEST) $(FRESH) $(BASE) $(LEARNERS) web/node_modules paper-out bench-out docs/_build docs/jupyter_execute .pytest_cache .mypy_cache .ruff_cache
