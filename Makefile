# Needs: Python 3.11 or later with venv, a C++20 compiler, GNU make and git. Everything else, cmake
# and ninja too, comes into .venv from requirements.lock, by hash.

PYTHON ?= $(shell command -v python3.11 || command -v python3)
WORKERS ?= 2

VENV := .venv
BIN := $(VENV)/bin
SANITIZED := .venv-sanitize
UV_VERSION := 0.13.9
NATIVE := pyproject.toml $(shell find native -type f)
PURELIB := -c "import sysconfig; print(sysconfig.get_path('purelib'))"
PIP_INSTALL := install -qq --disable-pip-version-check --no-deps
# The path is for cmake and ninja.
INSTALL_SELF := $(PIP_INSTALL) --no-build-isolation --no-index --editable .
STRICT := --config-settings=cmake.define.CMAKE_COMPILE_WARNING_AS_ERROR=ON

export PATH := $(CURDIR)/$(BIN):$(PATH)

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.NOTPARALLEL:
.PHONY: help build demo docs test lint types contracts pytest browser slow soundness sanitize bench lock format clean

help: ## say what there is to make
	@awk -F ':.*## ' '/^[a-z]+:.*## / {printf "  make %-10s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

# --- setting up -----------------------------------------------------------------------------

build: $(VENV)/built ## set up .venv and build the native module
	@$(BIN)/python -m compileall -q src

$(VENV)/locked: requirements.lock
	@rm -rf $(VENV)
	"$(PYTHON)" -m venv $(VENV)
	$(BIN)/pip $(PIP_INSTALL) --require-hashes --only-binary :all: --requirement requirements.lock
	@touch $@

$(VENV)/built: $(VENV)/locked $(NATIVE)
	$(BIN)/pip $(INSTALL_SELF) $(STRICT)
	@find src -name '*.py' > $@

# The editable install knows its modules by path: when one has moved it is made anew.
KNOWN := $(shell cat $(VENV)/built 2>/dev/null)
ifneq ($(filter-out $(wildcard $(KNOWN)),$(KNOWN)),)
.PHONY: $(VENV)/built
endif

# --- using ----------------------------------------------------------------------------------

demo: build ## plan peg-in-hole, run it 1,000 times under all adversaries, leave pictures in build/demo
	@mkdir -p build/demo
	$(BIN)/preimage plan --example peg-in-hole --method combined \
	    -o build/demo/peg-in-hole.json --figure build/demo/peg-in-hole.png
	$(BIN)/preimage run build/demo/peg-in-hole.json --adversary all --runs 1000 \
	    --figure build/demo/runs.png

docs: build ## make the site of the documentation in build/docs, without a network
	$(BIN)/sphinx-build --fail-on-warning --keep-going --quiet -j $(WORKERS) docs build/docs
	@echo "build/docs/index.html"

bench: build ## run the benchmarks
	$(BIN)/python -m benchmarks --page docs/benchmarks.md

# --- checking -------------------------------------------------------------------------------

# CI makes the site, and looks at the native module under the sanitizers, too.
test: build lint types contracts pytest browser $(if $(CI),docs sanitize) ## run every check and test

lint: build ## ruff: rules and format
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: build ## mypy --strict
	$(BIN)/mypy

contracts: build ## import-linter: the floors
	$(BIN)/lint-imports --no-logo

pytest: build ## tests and doctests, without the slow ones
	$(BIN)/pytest -n $(WORKERS) -m "not slow and not browser"

browser: build ## the studio's tests in a real browser (Chromium), pictures in build/screenshots
	$(BIN)/pytest -m "browser and not slow" tests/studio

slow: build ## the slow tests: the laws and the sweep on many more scenes, some 20 minutes
	$(BIN)/pytest -n $(WORKERS) -m slow

soundness: build ## every named task's plans 1,000 times under each pair of adversaries
	$(BIN)/python examples/tables/soundness.py --runs 1000 --workers $(WORKERS) docs/soundness.md

format: build ## ruff: mend what can be mended
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

# A second environment sees the packages of the first, and has its own build of the native module.
$(SANITIZED)/built: $(VENV)/built
	@rm -rf $(SANITIZED)
	"$(PYTHON)" -m venv --without-pip $(SANITIZED)
	@$(BIN)/python $(PURELIB) > "$$($(SANITIZED)/bin/python $(PURELIB))/locked.pth"
	$(BIN)/pip --python $(SANITIZED)/bin/python $(INSTALL_SELF) --ignore-installed \
	    --config-settings=build-dir=build/sanitize \
	    --config-settings=cmake.define.PREIMAGE_SANITIZE=ON
	@touch $@

# For gcc on Linux. Python keeps memory until it ends, so leaks are not looked for. The studio's
# workers live within a limit on memory, which the sanitizers' shadow exceeds.
sanitize: build $(SANITIZED)/built ## run the tests under the address and undefined-behaviour sanitizers
	LD_PRELOAD="$$($${CXX:-c++} -print-file-name=libasan.so) $$($${CXX:-c++} -print-file-name=libubsan.so)" \
	ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 \
	    $(SANITIZED)/bin/python -m pytest -n $(WORKERS) -m "not slow and not browser" \
	    --ignore=tests/studio --ignore=tests/docs

# --- keeping --------------------------------------------------------------------------------

lock: ## resolve the dependencies anew, into requirements.lock
	"$(PYTHON)" -m venv build/lock
	build/lock/bin/pip install -qq --disable-pip-version-check uv==$(UV_VERSION)
	build/lock/bin/uv pip compile --quiet --upgrade --universal --python-version 3.11 \
	    --generate-hashes --no-emit-index-url --no-emit-find-links --no-header \
	    --extra draw --group dev --output-file requirements.lock pyproject.toml

clean: ## remove what was made
	rm -rf $(VENV) $(SANITIZED) build dist .mypy_cache .pytest_cache .ruff_cache \
	    .import_linter_cache .hypothesis
	find src tests benchmarks -depth -name __pycache__ -type d -exec rm -rf {} +
