# Everything runs in .venv, which holds exactly the versions of constraints.txt, each checked by its hash, and needs
# no compiler. An environment is only touched when pyproject.toml or constraints.txt is newer than it.

PYTHON ?= python3
BIN := .venv/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet
LOCKED := --require-hashes --only-binary :all: --constraint constraints.txt

.PHONY: demo test benchmark dev lock clean
.NOTPARALLEL:

demo: .venv/for-use
	$(BIN)/sphear run cavity --scheme incompressible --resolution 40 --out demo --overwrite
	$(BIN)/sphear reproduce zheng2018 table-1 table-2 figure-3 figure-5 figure-12 --out demo

test: .venv/for-test
	$(BIN)/python -m pytest -n 2 --dist worksteal

benchmark: .venv/for-use
	set -e; for script in benchmarks/[!_]*.py; do $(BIN)/python $$script; done

# All extras, and the checks before every commit.
dev: .venv/for-development
	$(BIN)/pre-commit install

# The newest versions that pyproject.toml allows and that have wheels, the same for every Python and platform if possible.
lock: .venv/installer
	$(PIP) install $(LOCKED) uv
	$(BIN)/uv pip compile pyproject.toml --all-extras --group installer --universal --python-version 3.11 \
		--fork-strategy fewest --only-binary :all: --generate-hashes --no-annotate --no-emit-index-url --upgrade --quiet \
		--custom-compile-command "make lock" --output-file constraints.txt

clean:
	rm -rf .venv demo build src/*.egg-info .mypy_cache .pytest_cache .ruff_cache .hypothesis

.venv/for-use: requirement := sphear
.venv/for-test: requirement := sphear[test,cluster,cuda]
.venv/for-development: requirement := sphear[dev]

# A folder has no hash that pip could check, so sphear goes in alone; pip then takes what it requires from the lock.
.venv/for-use .venv/for-test .venv/for-development: .venv/installer pyproject.toml
	$(PIP) install --no-deps --no-build-isolation --editable .
	$(PIP) install $(LOCKED) '$(requirement)'
	@touch $@

# Only a recent pip takes hashes from constraints, so the lock's own pip comes first, by its lines in the lock.
.venv/installer: constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "sphear needs Python 3.11 or later, and $(PYTHON) is %d.%d: name another one, as in make PYTHON=python3.12." % sys.version_info[:2])'
	$(PYTHON) -m venv .venv
	sed -n '/^pip==/,/[^\\]$$/p' constraints.txt | $(PIP) install --require-hashes --requirement /dev/stdin
	$(PIP) install $(LOCKED) setuptools
	@touch $@
