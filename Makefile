# Touchline on a fresh machine: `make match` and `make test` require Python 3.11, git and make, and install the rest
# into .venv. Its packages are pinned by hash in requirements.lock.

.DEFAULT_GOAL := help
.PHONY: help match quick test test-all check bench bench-against bench-network bench-play bench-scheduling soak lowest mutants clean
READY := .venv/.ready
# Compiled once: where Python writes no bytecode, as in many containers, each process would compile them at its start.
PACKAGES := schemas runtime sim_host robot_agent coach_gateway recordings touchline
export PIP_DISABLE_PIP_VERSION_CHECK := 1
# The tests start hundreds of processes: each would compile what was edited since, and pytest all tests in each worker.
unexport PYTHONDONTWRITEBYTECODE

help: ## show this list
	@sed -n 's/^\([a-z-]*\):.*## /make \1\t/p' Makefile | expand -t 14

match: $(READY) ## play a match, for example: make match ARGS="--seed 7 --duration 60"
	@.venv/bin/touchline match $(ARGS)

# Four processes on two cores: a third of the time of the tests is waiting for real time.
# The files come in the mixed order of tests/conftest.py, not by their number of tests: the long ones would come last.
PYTEST := .venv/bin/pytest --dist loadfile --no-loadscope-reorder

quick: $(READY) ## run the tests without processes, browser and attacks, for example: make quick ARGS=tests/sim_host
	$(PYTEST) -n 2 -m "not processes and not browser and not hostile and not slow and not long" $(ARGS)

test: $(READY) ## run the tests, file by file in four processes, for example: make test ARGS=tests/touchline
	$(PYTEST) -n 4 -m "not long" $(ARGS)

test-all: $(READY) ## run the long tests as well: long cuts, floods, every size of the page, whole cups
	$(PYTEST) -n 3 -m "not alone" $(ARGS)
	$(PYTEST) -m alone $(ARGS) || [ $$? -eq 5 ]  # none of these is in ARGS

check: $(READY) ## format, lint, types, the contracts on imports, and the lines of each package against their budget
	.venv/bin/ruff format --check
	.venv/bin/ruff check
	.venv/bin/mypy
	.venv/bin/lint-imports
	@.venv/bin/python .ci/check_budgets.py

bench: $(READY) ## run every benchmark but those of play and of plans of matches
	@for bench in $(filter-out benchmarks/bench_against.py benchmarks/bench_play.py benchmarks/bench_scheduling.py, $(wildcard benchmarks/bench_*.py)); do echo "$$bench"; .venv/bin/python "$$bench" || exit 1; done

bench-against: $(READY) ## compare the CPU time of matches with another revision's: make bench-against REV=main~20 ARGS="--rounds 8"
	@.venv/bin/python benchmarks/bench_against.py $(REV) $(ARGS)

bench-network: $(READY) ## measure match quality over delay, loss and cuts, for example: make bench-network ARGS="--seconds 60"
	@.venv/bin/python benchmarks/bench_network.py $(ARGS)

bench-play: $(READY) ## play the ladder of the shipped teams, the reference team against sparring teams and itself, for example: make bench-play ARGS="--matches 4 --duration 120"
	@.venv/bin/python benchmarks/bench_play.py $(ARGS)

bench-scheduling: $(READY) ## measure plans of many matches, for example: make bench-scheduling ARGS="many --matches 1000 --seconds 30"
	@.venv/bin/python benchmarks/bench_scheduling.py $(ARGS)

soak: $(READY) ## play in real time and fail if memory, threads or descriptors grow: make soak ARGS="--minutes 10"
	@.venv/bin/python benchmarks/check_soak.py $(ARGS)

LOWEST_TESTS := tests/schemas tests/runtime tests/robot_agent tests/recordings tests/coach_gateway/access \
	tests/touchline/commands

lowest: $(READY) ## run tests with the lowest supported versions of all dependencies, in .venv-lowest
	@test -x .venv-lowest/bin/python || .venv/bin/python -m venv --without-pip .venv-lowest
	.venv/bin/python .ci/lowest_versions.py > .venv-lowest/constraints.txt
	.venv/bin/python -m pip --python .venv-lowest/bin/python install --quiet -c .venv-lowest/constraints.txt -e '.[dev]'
	.venv-lowest/bin/pytest -n 2 --dist loadfile -m "not processes" $(LOWEST_TESTS)

mutants: $(READY) ## change the program at random and count what the tests notice, for example: make mutants ARGS="--sample 60"
	@.venv/bin/python -m pip install --quiet 'mutmut>=3.8,<4'
	.venv/bin/python benchmarks/check_mutants.py $(ARGS)

clean: ## remove .venv and all caches; recordings in runs/ stay
	rm -rf .venv .venv-lowest mutants .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

$(READY): requirements.lock pyproject.toml
	@echo "Installing Touchline and its packages into .venv; this takes a few minutes, once"
	@test -x .venv/bin/python || ( $(NEW_VENV) )
	.venv/bin/python -m pip install --quiet --require-hashes -r requirements.lock
	.venv/bin/python -m pip install --quiet --no-deps --no-build-isolation -e .
	@.venv/bin/python -m compileall -q $(PACKAGES)
	@touch $@

# Of the versions that Touchline supports, PyBullet has binary wheels for 3.11 only. The system's Python comes first,
# because a distribution builds it with profile-guided optimization: it plays a match a quarter faster than a build
# without, such as pyenv's. PYTHON=/path/to/python3.11 selects another. Without any, uv installs one: the uv on the path,
# or one from the package index in a temporary folder.
PYTHON ?= /usr/bin/python3.11 python3.11
define NEW_VENV
found=""; \
for python in $(PYTHON); do \
	$$python -c 'import sys; sys.exit(sys.version_info[:2] != (3, 11))' 2>/dev/null || continue; \
	found=$$python; \
	if $$python -c 'import ensurepip' 2>/dev/null && $$python -m venv .venv >/dev/null; then exit 0; fi; \
	rm -rf .venv; \
done; \
if [ -n "$$found" ]; then \
	echo "$$found has no working venv; apt-get install python3.11-venv, then make again" >&2; exit 1; \
elif uv --version >/dev/null 2>&1; then \
	uv venv --seed --python 3.11 .venv; \
else \
	uv=$$(mktemp -d) && trap 'rm -rf "$$uv"' EXIT && { python3 -m venv "$$uv" && "$$uv/bin/pip" install --quiet uv && \
		"$$uv/bin/uv" venv --seed --python 3.11 .venv; } >/dev/null 2>&1 || { rm -rf .venv; \
		echo "Python 3.11 is missing and uv could not install it; install python3.11 and its venv, then make again" >&2; \
		exit 1; }; \
fi
endef
