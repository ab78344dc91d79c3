# Two commands: `make paper` runs the main job, `make test` the tests. Both set everything up on a fresh machine that
# has Python 3.11 or newer with venv, and make.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
OUT ?= paper-out

.PHONY: setup paper test test-tools fuzz lint lock clean

setup: $(VENV)/.ready

$(VENV)/.ready: requirements.lock pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit("flypend needs Python 3.11 or newer" if sys.version_info < (3, 11) else 0)'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	touch $@

paper: setup
	$(BIN)/flypend paper --out $(OUT)

lint: setup
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy

test: test-tools lint
	$(BIN)/pytest -n 2

# What the tests need besides Python: compilers and checkers of the exported C.
TEST_PACKAGES := g++ clang libclang-rt-14-dev cppcheck gcc-arm-none-eabi libnewlib-arm-none-eabi valgrind cmake
AS_ROOT := $(shell test "$$(id -u)" = 0 || echo sudo)

test-tools:
	@dpkg -s $(TEST_PACKAGES) > /dev/null 2>&1 || { $(AS_ROOT) apt-get update -qq \
	    && $(AS_ROOT) apt-get install -y -qq --no-install-recommends $(TEST_PACKAGES); }

# A minute of libFuzzer per law and precision under ASan and UBSan, and cppcheck on each.
fuzz: test-tools setup
	$(BIN)/pytest -m slow tests/test_c_tools.py

# Needs uv on the PATH; writes versions and hashes, no registry and no address.
lock:
	uv pip compile --universal --python-version 3.11 --generate-hashes --no-emit-index-url --no-annotate \
	    --custom-compile-command "make lock" --group dev pyproject.toml --upgrade --output-file requirements.lock

clean:
	rm -rf $(VENV) paper-out .pytest_cache .mypy_cache .ruff_cache
