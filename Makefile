# Every target does its own set-up; a fresh machine needs only make and Python >= 3.11.
#
#   make figures   all figures and the film of the README (options: OUT=folder RTOL=1e-6): a minute
#   make test      lint, types, tests: a quarter of an hour on two cores, twice that on slow ones
#   make test-browser  the pages in a real browser (Debian: chromium, chromium-driver): a minute
#   make test-dist  wheel and source distribution, installed and used in clean environments: two minutes
#   make test-oldest  the tests with the oldest versions of all that it needs: twelve minutes
#   make paper     the write-up as a PDF, paper/out/sheetcrawl.pdf, with its figures
#   make docs      the documentation as one site, build/docs/index.html: a minute
#   make cost      error against time of every level, the price of each effect: four minutes
#   make peers   other codes on two scenes and a displacement, in an environment of their own: ten minutes
#   make bench-threads  times beside a busy core against one BLAS thread
#   make bench-shell  time and memory of the sheet that bends
#   make tables    every table that the figures, the paper and predict() read: one to three hours
#   make gaits     bending gaits: the map of figure 4, an hour and a half; trapezoids and terrain, an
#                  hour; 300 at random, hours
#   make movies    movies 1 to 4 of the paper into figures/out: five minutes
#   make lock      rewrite requirements.lock, and the oldest versions, after a change of dependencies
#   make clean     remove figures and caches; `make distclean` also the environment
#
# Another interpreter: make test PYTHON=python3.13

PYTHON ?= python3
WORKERS ?= auto
OUT ?=
RTOL ?=
LOCKFLAGS ?=

VENV := .venv
STAMP := $(VENV)/.installed
RUN := $(VENV)/bin/python
# Beside the environment and not in it: the tool that writes the lock is not part of the lock.
LOCK_VENV := build/lock-venv
PIP_TOOLS := pip-tools==7.6.2
# pip-tools does not know the lowest versions that are allowed.
UV := uv==0.13.9
OLDEST_VENV := build/oldest-venv
PEERS_VENV := build/peers-venv

# One BLAS thread per process: test workers do not fight for the cores, and sums are taken in
# the same order on every run, so figures keep their bytes.
export OMP_NUM_THREADS := 1
export OPENBLAS_NUM_THREADS := 1
export MKL_NUM_THREADS := 1
# Bytecode is kept, whatever the shell says: tests start a hundred processes, and each would compile the
# project anew, a fifth of its start.
unexport PYTHONDONTWRITEBYTECODE

FIGURE_OUT = $(if $(OUT),--out "$(OUT)")
FIGURE_RTOL = $(if $(RTOL),--rtol $(RTOL))

.PHONY: figures test types suite test-browser test-dist test-oldest dist paper docs cost peers bench-shell bench-threads gaits movies tables lock clean distclean
.DEFAULT_GOAL := figures
.DELETE_ON_ERROR:

figures: $(STAMP)
	$(RUN) -m figures.draw.fig3 $(FIGURE_OUT) $(FIGURE_RTOL)
	$(RUN) -m figures.draw.fig7 $(FIGURE_OUT) $(FIGURE_RTOL)
	$(RUN) -m figures.draw.turning $(FIGURE_OUT) $(FIGURE_RTOL)
	$(RUN) -m figures.draw.reach $(FIGURE_OUT)
	$(RUN) -m figures.draw.cost $(FIGURE_OUT)
	$(RUN) -m figures.draw.peers $(FIGURE_OUT)
	$(RUN) -m figures.draw.validation $(FIGURE_OUT)
	$(RUN) -m figures.draw.regimes $(FIGURE_OUT)
	$(RUN) -m figures.draw.directional $(FIGURE_OUT)
	$(RUN) -m figures.draw.energy $(FIGURE_OUT)
	$(RUN) -m figures.draw.optimise.best_outlines $(FIGURE_OUT)
	$(RUN) -m figures.draw.saddle $(FIGURE_OUT)
	$(RUN) -m figures.draw.optimise.best_waves $(FIGURE_OUT)
	$(RUN) -m figures.draw.excitable $(FIGURE_OUT)
	$(RUN) -m figures.draw.fig2 $(FIGURE_OUT)
	$(RUN) -m figures.draw.fig4 $(FIGURE_OUT)
	$(RUN) -m figures.draw.fig5 $(FIGURE_OUT)
	$(RUN) -m figures.draw.fig6 $(FIGURE_OUT)
	$(RUN) -m figures.draw.readme_movie $(FIGURE_OUT)

test: $(STAMP)
	$(RUN) -m ruff check .
	$(RUN) -m ruff format --check .
	+$(MAKE) --no-print-directory $(if $(findstring jobserver,$(MAKEFLAGS)),,-j 2) types suite

# Side by side: mypy takes a minute of one core.
types: $(STAMP)
	$(RUN) -m mypy

suite: $(STAMP)
	$(RUN) -m pytest -n $(WORKERS) --dist worksteal

# One test after the other, since times are measured. CI_BROWSER=1 makes a missing browser an error.
BROWSER = /usr/bin/chromium /usr/bin/chromedriver
test-browser: $(STAMP)
	@if [ -n "$(CI_BROWSER)" ] || ls $(BROWSER) > /dev/null 2>&1; then $(RUN) -m pytest tests/browser; \
	else echo "make test-browser: skipped, needs $(BROWSER) (apt-get install chromium chromium-driver)"; fi

dist: $(STAMP)
	$(RUN) -m build --no-isolation

test-dist: $(STAMP)
	$(RUN) -m tests.release.clean_install

# The figures are compared with their pictures by the newest matplotlib only. Newer packages below the oldest ones deprecate what those use: that is no fault here.
test-oldest: $(OLDEST_VENV)/.installed
	$(OLDEST_VENV)/bin/python -m pytest -n $(WORKERS) --dist worksteal -p no:cacheprovider -W ignore::DeprecationWarning

cost: $(STAMP)
	$(RUN) -m figures.measure.cost
	$(RUN) -m figures.draw.cost

peers: $(STAMP) $(PEERS_VENV)/.installed
	$(RUN) -m figures.measure.peers
	$(PEERS_VENV)/bin/python -m figures.measure.peers.field
	$(RUN) -m figures.draw.peers $(FIGURE_OUT)
	$(RUN) -m figures.draw.peers.page

bench-shell: $(STAMP)
	$(RUN) -m figures.measure.bench.shell

movies: $(STAMP)
	$(RUN) -m figures.draw.movies $(FIGURE_OUT)

# Hours; goes on where its tables end.
gaits: $(STAMP)
	$(RUN) -m figures.measure.paper.gait_paths
	$(RUN) -m figures.measure.paper.decisive --workers 2
	$(RUN) -m figures.measure.paper.trapezoids --workers 2
	for form in cosine printed; do for friction in dry viscous; do \
	$(RUN) -m figures.measure.paper.terrain --workers 2 --form $$form --friction $$friction || exit 1; done; done
	$(RUN) -m figures.measure.paper.gait_map --workers 2
	$(RUN) -m figures.measure.gaits --workers 2
	$(RUN) -m figures.measure.gaits_checked --workers 2
	$(RUN) -m figures.draw.gait_page

bench-threads: $(STAMP)
	$(RUN) -m figures.measure.bench.threads

# In the order in which one reads the other; what is measured in seconds is left to `make cost`.
tables: $(STAMP)
	$(RUN) -m figures.measure.second_order
	$(RUN) -m figures.measure.model_error
	$(RUN) -m figures.measure.limits.model_error_between
	$(RUN) -m figures.measure.limits.friction_strength
	$(RUN) -m figures.measure.nonlinear
	$(RUN) -m figures.measure.reach
	$(RUN) -m figures.measure.regimes
	$(RUN) -m figures.measure.directional
	$(RUN) -m figures.measure.optimise.line
	$(RUN) -m figures.measure.optimise.scan
	$(RUN) -m figures.measure.optimise.buys
	$(RUN) -m figures.draw.optimise.page
	$(RUN) -m figures.measure.optimise.outlines
	$(RUN) -m figures.measure.gradient
	$(RUN) -m figures.measure.gradient.others
	$(RUN) -m figures.measure.energy.gaits
	$(RUN) -m figures.measure.energy.errors
	$(RUN) -m figures.measure.saddle
	$(RUN) -m figures.measure.plate.saddle_range
	$(RUN) -m figures.measure.plate.lower_face
	$(RUN) -m figures.measure.plate.bent_alone
	$(RUN) -m figures.draw.saddle.page
	$(RUN) -m figures.measure.schemes
	$(RUN) -m figures.measure.self_contact
	$(RUN) -m figures.measure.turning
	$(RUN) -m figures.measure.excitable
	$(RUN) -m figures.measure.validation
	$(RUN) -m figures.validation.page
	$(RUN) -m tests.robust.hard_cases_page
	$(RUN) -m tests.robust.trials.table
	$(RUN) -m tests.robust.trials.settings
	$(RUN) -m tests.robust.reliability_page
	$(RUN) -m paper.numbers.shell
	$(RUN) -m paper.derive
	$(RUN) -m paper.numbers

paper: figures
	$(RUN) -m paper.build

# Pages, examples as they run, and the API; fails where a link leads nowhere.
docs: $(STAMP)
	$(RUN) -m docs.site

# setuptools comes with the lock and build isolation is off: pip fetches nothing that is not pinned.
$(STAMP): requirements.lock pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit("sheetcrawl needs Python >= 3.11, not " + sys.version if sys.version_info < (3, 11) else 0)'
	test -x $(VENV)/bin/pip || $(PYTHON) -m venv $(VENV)
	$(RUN) -m pip install --disable-pip-version-check -r requirements.lock
	$(RUN) -m pip install --disable-pip-version-check --no-build-isolation --no-deps -e .
	@touch $@

# The oldest supported Python decides: a release that runs there still runs on newer ones, while
# the newest numpy has often dropped it. Pins that still fit stay; LOCKFLAGS=--upgrade renews all.
# The output names no index: the lock says what to install, the user's pip says where from.
lock:
	@$(PYTHON) -c 'import sys; sys.exit("make lock needs Python 3.11: make lock PYTHON=python3.11" if sys.version_info[:2] != (3, 11) else 0)'
	test -x $(LOCK_VENV)/bin/pip || $(PYTHON) -m venv $(LOCK_VENV)
	$(LOCK_VENV)/bin/python -m pip install --disable-pip-version-check --quiet $(PIP_TOOLS)
	CUSTOM_COMPILE_COMMAND="make lock" $(LOCK_VENV)/bin/python -m piptools compile --quiet \
	    --extra test --extra paper --extra docs --build-deps-for editable --allow-unsafe --strip-extras \
	    --no-emit-index-url --no-emit-find-links --no-emit-trusted-host \
	    $(LOCKFLAGS) --output-file requirements.lock pyproject.toml

	$(LOCK_VENV)/bin/python -m pip install --disable-pip-version-check --quiet $(UV)
	$(LOCK_VENV)/bin/uv pip compile --quiet --resolution lowest-direct --python-version 3.11 \
	    --extra test --extra paper --extra docs --no-annotate --no-emit-index-url \
	    --custom-compile-command "make lock" --output-file requirements-oldest.lock pyproject.toml

$(PEERS_VENV)/.installed: requirements-peers.lock requirements.lock
	test -x $(PEERS_VENV)/bin/pip || $(PYTHON) -m venv $(PEERS_VENV)
	$(PEERS_VENV)/bin/python -m pip install --disable-pip-version-check -r requirements-peers.lock -r requirements.lock
	@touch $@

$(OLDEST_VENV)/.installed: requirements-oldest.lock pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit("make test-oldest needs Python 3.11: make test-oldest PYTHON=python3.11" if sys.version_info[:2] != (3, 11) else 0)'
	test -x $(OLDEST_VENV)/bin/pip || $(PYTHON) -m venv $(OLDEST_VENV)
	$(OLDEST_VENV)/bin/python -m pip install --disable-pip-version-check -r requirements-oldest.lock
	$(OLDEST_VENV)/bin/python -m pip install --disable-pip-version-check --no-build-isolation --no-deps -e .
	@touch $@

clean:
	rm -rf figures/out paper/out build dist .mypy_cache .ruff_cache .pytest_cache .hypothesis
	find . -path ./$(VENV) -prune -o -type d -name __pycache__ -prune -exec rm -rf {} +

distclean: clean
	rm -rf $(VENV) *.egg-info
