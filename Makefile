# Two commands for a fresh machine: `make book` and `make test`.
# Needed: Python >= 3.11 and < 3.14, make, and a package index that pip can reach.

.DEFAULT_GOAL := help
.PHONY: help book quick test check-book bench lint format lock clean
.DELETE_ON_ERROR:

BIN   := .venv/bin
READY := .venv/ready
# A pyenv shim exists for versions it cannot run, so every candidate is asked, not just found.
ASK   := import sys; sys.exit(not (3, 11) <= sys.version_info[:2] < (3, 14))

help:  ## say what there is to make
	@sed -n 's/^\([a-z-]*\):.*## /  make \1\t/p' $(MAKEFILE_LIST) | expand -t 20

book: $(READY)  ## execute the notebooks and build the HTML book; ends with its path
	@$(BIN)/wheelset book

quick: $(READY)  ## a coarse preview of the book, kept apart from it
	@$(BIN)/wheelset book --quick

test: $(READY)  ## run the tests of the package
	$(BIN)/python -m pytest --ignore=tests/book --numprocesses=auto --dist=worksteal

check-book: $(READY)  ## check the built book: links, figures, and every page in a browser
	$(BIN)/python -m pytest tests/book --numprocesses=auto --dist=worksteal

bench: $(READY)  ## measure the speed of the kernels
	$(BIN)/python -m benchmarks

lint: $(READY)  ## check format, style and types
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy

format: $(READY)  ## put the code into the house's format
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

lock: $(READY)  ## choose versions anew; the lock names no index
	$(BIN)/uv pip compile --quiet --universal --upgrade --generate-hashes --python-version 3.11 \
	  --no-header --no-emit-index-url --no-emit-find-links --no-annotate \
	  --group dev pyproject.toml --output-file requirements.lock

clean:  ## delete everything that make makes, the environment included
	rm -rf .venv _build _build-quick book/executed runs build dist
	rm -rf .mypy_cache .pytest_cache .ruff_cache .hypothesis .benchmarks
	find src tests -name __pycache__ -type d -prune -exec rm -rf {} +

$(READY): pyproject.toml requirements.lock
	@set -eu; \
	for python in $${PYTHON:-python3 python3.13 python3.12 python3.11}; do \
	  if $$python -c '$(ASK)' 2>/dev/null; then found=$$python; break; fi; \
	done; \
	if [ -z "$${found:-}" ]; then \
	  echo "No Python >= 3.11 and < 3.14 found. Install one, or name it: make book PYTHON=/path/to/python" >&2; \
	  exit 2; \
	fi; \
	if ! $(BIN)/python -c '$(ASK)' 2>/dev/null; then \
	  echo "creating .venv with $$($$found --version)"; rm -rf .venv; $$found -m venv .venv; \
	fi; \
	echo "installing the locked environment into .venv"; \
	$(BIN)/uv --version >/dev/null 2>&1 || $(BIN)/python -m pip install --quiet --disable-pip-version-check uv; \
	$(BIN)/uv pip sync --python $(BIN)/python --compile-bytecode --require-hashes requirements.lock; \
	$(BIN)/uv pip install --python $(BIN)/python --quiet --no-deps --no-build-isolation --editable .; \
	touch $@
