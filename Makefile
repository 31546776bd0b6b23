# `make run` and `make test` prepare everything they need; `make help` lists the rest.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PYTEST := $(BIN)/pytest
PIP := $(BIN)/python -m pip --disable-pip-version-check
# What was tested with this version of Python; one without such a file gets the newest of all.
TESTED = .ci/constraints/$(shell $(BIN)/python -c 'import sys; print("%d.%d" % sys.version_info[:2])').txt
CONSTRAINTS = $(addprefix --constraint ,$(wildcard $(TESTED)))

# The Qt platform that must work: empty for the one of the display in use.
QT_PLATFORM := offscreen
# What tests use besides: an assembler, long ones a window on a screen of their own.
PROGRAMS :=

# A .venv can be used when no installation into it was cut off and its Python still runs.
USABLE := test ! -e $(VENV)/.unfinished && $(BIN)/python -c 'import pip' 2>/dev/null
REBUILD := $(shell $(USABLE) || echo rebuild)

EXTRAS_run :=
EXTRAS_test := [test]
EXTRAS_slow := [test,docs,bench,dask]
EXTRAS_lint := [lint]
EXTRAS_bench := [test,bench]
EXTRAS_screenshots := [test]
EXTRAS_docs := [docs]
EXTRAS_release := [release]

.NOTPARALLEL:
.PHONY: run test test-slow soak latest lint bench screenshots structure languages viewer docs dist bundle clean help system rebuild

run: QT_PLATFORM :=
run: system $(VENV)/.run  ## open the program with the built-in simulator
	@$(BIN)/rotemina

test: PROGRAMS := --assembler
# In the order of the folders: by number of tests, the few long ones would all come last.
test: system $(VENV)/.test  ## run the quick tests
	@$(PYTEST) --numprocesses auto --maxprocesses 4 --dist loadfile --no-loadscope-reorder \
	-m "not slow"

# pytest fails when it selects nothing, which is right as soon as one slow test is written.
test-slow: PROGRAMS := --screen --assembler
test-slow: system $(VENV)/.slow $(VENV)/src  ## run the long tests
	@if grep -rqs --include='*.py' '^ *@pytest\.mark\.slow\|^pytestmark.*slow' tests; \
	then $(PYTEST) --numprocesses auto --maxprocesses 2 --dist loadgroup -m slow; else echo 'There are no slow tests.'; fi

soak: system $(VENV)/.test  ## hours of random faults, requests, stops and kills
	@ROTEMINA_SOAK_S=3600 ROTEMINA_OPERATIONS=100000 ROTEMINA_STRESS=10000 ROTEMINA_KILLS=50 \
	$(PYTEST) -s -m slow tests/drivers/mc68hc11/test_soak.py \
	tests/drivers/mc68hc11/test_random_run.py tests/app/motion/test_gate_stress.py \
	tests/app/motion/recording/test_kill.py

# The other extras are installed along with it so that their versions are written down as well.
latest:  ## run the quick tests with the newest versions; those that pass are the tested ones
	@rm -rf .latest
	@$(MAKE) --no-print-directory VENV=.latest CONSTRAINTS= \
	EXTRAS_test='[test,lint,bench,docs,release,dask]' test
	@mkdir -p .ci/constraints
	@$(MAKE) --no-print-directory VENV=.latest .latest/.tested

.latest/.tested:
	@$(PIP) freeze --exclude-editable > $(TESTED)
	@echo 'Tested versions: $(TESTED)'

lint: system $(VENV)/.lint $(VENV)/src  ## check style, types and the layers
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/lint-imports --no-logo --no-cache
	@$(BIN)/mypy

bench: system $(VENV)/.bench  ## measure (tests/benchmarks), and write docs/benchmarks.md
	@$(PYTEST) --override-ini python_files='bench_*.py' --page docs/benchmarks.md tests/benchmarks

screenshots: system $(VENV)/.screenshots  ## draw the pictures of the documentation
	@$(BIN)/python -m rotemina.app.shell.startup.screenshots docs/screenshots

structure:  ## draw the folders for docs/structure.md, and print lines and lengths
	@$(PYTHON) .ci/structure.py --page

# One file of texts for each folder that shows some, named as their context; all make one .qm.
LUPDATE := $(BIN)/pyside6-lupdate -silent -tr-function-alias QT_TRANSLATE_NOOP+=marked,QT_TRANSLATE_NOOP+=message \
-disable-heuristic sametext -disable-heuristic similartext \
-locations none -no-obsolete -source-language en -target-language de
LRELEASE := $(BIN)/pyside6-lrelease -silent

# What refuses and reports below the window; the diagnosis has a file of its own.
ENGINE := app/motion app/operation app/microscope app/cameras app/calibration app/records app/scene \
app/plugin_kit app/panel app/settings app/system drivers \
$(filter-out sim/gap sim/blind%,$(wildcard sim/*))
# lupdate knows no context that a panel's folder names once: it reads copies that name it at each text.
languages: system $(VENV)/.run  ## find what is to be translated, make resources/languages/*.qm
	@rm -rf build/languages; mkdir -p build/languages; cp -R app plugins build/languages
	@for file in $$(find build/languages/plugins -mindepth 2 -name '*.py'); do \
	context=$${file#build/languages/plugins/}; context=$${context%%/*}; \
	sed -e "s/\([^[:alnum:]_.]\)tr(/\1translate(\"$$context\", /g" \
	-e "s/\([^[:alnum:]_.]\)mark(/\1marked(\"$$context\", /g" $$file >$$file.new && mv $$file.new $$file || exit 1; done
	@$(BIN)/python -c 'from rotemina.plugins.effects.words import iterate_translatable_texts; \
	print(*(f"translate(\"effects\", {text!r})" for text in iterate_translatable_texts()), sep="\n")' \
	>build/languages/plugins/effects/catalogue.py
	@for folder in app/shell app/widgets app/cli plugins/*/; do \
	name=$$(basename $$folder); folders=$${folder%/}; \
	case $$name in shell) folders="$$folders app/language app/workbench";; gap) folders="$$folders sim/gap";; esac; \
	$(BIN)/python .ci/translations.py raised $$folders >build/languages/raised_$$name.py; \
	copies=$$(for each in $$folders; do [ -d build/languages/$$each ] && echo build/languages/$$each || echo $$each; done); \
	$(LUPDATE) $$(find $$copies -name '*.py') build/languages/raised_$$name.py \
	-ts resources/languages/de/$$name.ts || exit 1; \
	done
	@$(BIN)/python .ci/translations.py raised $(ENGINE) >build/languages/raised_engine.py
	@$(LUPDATE) $$(find $(ENGINE) -name '*.py') build/languages/raised_engine.py \
	-ts resources/languages/de/engine.ts
	@$(LRELEASE) resources/languages/de/*.ts -qm resources/languages/de.qm

viewer: $(VENV)/.python  ## take the viewer of the 3-D view from the newest package meshcat
	@$(PIP) download --quiet --no-deps --only-binary :all: --dest build/meshcat meshcat
	@$(BIN)/python -m zipfile -e build/meshcat/meshcat-*.whl build/meshcat
	@cp build/meshcat/meshcat/viewer/dist/main.min.js* build/meshcat/meshcat/viewer/LICENSE \
	resources/meshcat

# The site of a later version of a theme is not this one's business, nor are its makers' notices.
docs: system $(VENV)/.docs $(VENV)/src  ## make the site of the documentation, build/docs
	@NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --quiet --strict --config-file docs/site/mkdocs.yml
	@echo build/docs/index.html

dist: system $(VENV)/.release  ## make the wheel and the source archive, build/dist
	@rm -rf build/lib build/bdist.*
	@$(BIN)/python -m build --outdir build/dist .

# The folder is tried before it is called done.
bundle: system $(VENV)/.release $(VENV)/src  ## make a folder that runs without Python, build/bundle
	@$(BIN)/pyinstaller --noconfirm --log-level ERROR --distpath build/bundle \
	--workpath build/pyinstaller .ci/bundle/rotemina.spec
	@QT_QPA_PLATFORM=offscreen build/bundle/rotemina/rotemina doctor
	@build/bundle/rotemina/rotemina simulate resources/trajectories/six_axis_tour.csv \
	-o build/bundle/tried.csv
	@echo build/bundle/rotemina

clean:  ## remove .venv and everything else that was generated
	rm -rf $(VENV) .latest build dist *.egg-info .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find app drivers plugins resources sim tests -name __pycache__ -prune -exec rm -rf {} +

help:  ## list these targets
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/make \1	\2/p' Makefile | expand -t 18

# Python itself (python3-minimal alone lacks ctypes), then what Python can check: its version,
# venv and the libraries of Qt.
system:
	@$(PYTHON) -c 'import ctypes' 2>/dev/null || { $(INSTALL_PYTHON); }
	@$(PYTHON) -I -B app/system/system_check.py --install $(PROGRAMS) $(QT_PLATFORM)

APT_GET := apt-get install -y --no-install-recommends python3 python3-venv
define INSTALL_PYTHON
if [ "$(PYTHON)" != python3 ]; then echo 'PYTHON=$(PYTHON) is no complete Python.' >&2; exit 1; fi; \
if ! command -v apt-get >/dev/null; then echo 'Missing: Python >= 3.11.' >&2; exit 1; fi; \
if [ "$$(id -u)" = 0 ]; then root='env'; \
elif sudo -n true 2>/dev/null; then root='sudo -n env'; \
elif command -v sudo >/dev/null; then \
	echo 'Missing: Python. Install with: sudo apt-get update && sudo $(APT_GET)' >&2; exit 1; \
else echo "Missing: Python. Install with: su -c 'apt-get update && $(APT_GET)'" >&2; exit 1; fi; \
echo 'Installing python3 and python3-venv'; \
$$root apt-get -qq update </dev/null; \
$$root DEBIAN_FRONTEND=noninteractive $(APT_GET) -qq </dev/null >/dev/null || \
{ echo 'apt-get could not install python3 and python3-venv (its messages are above).' >&2; exit 1; }
endef

$(VENV)/.python: $(REBUILD) | system
	@{ $(USABLE); } || { \
	$(PYTHON) -m venv --clear --without-pip $(VENV) && touch $(VENV)/.unfinished && \
	$(BIN)/python -m ensurepip --upgrade --default-pip >/dev/null && rm $(VENV)/.unfinished; }
	@touch $@

# Killed on the way, pip leaves packages that look complete: .unfinished has them made again.
$(VENV)/.run $(VENV)/.test $(VENV)/.slow $(VENV)/.lint $(VENV)/.bench $(VENV)/.screenshots $(VENV)/.docs $(VENV)/.release: \
$(VENV)/.%: pyproject.toml $(wildcard .ci/constraints/*.txt) $(VENV)/.python
	@echo 'Installing RoTeMiNa into $(VENV) (the first time this takes minutes)'
	@touch $(VENV)/.unfinished
	@$(PIP) install --quiet $(CONSTRAINTS) --editable '.$(EXTRAS_$*)' || { rm -f $(VENV)/.unfinished; exit 1; }
	@rm -f $(VENV)/.unfinished
	@touch $@

# mypy cannot follow an editable install: it reads the folders under their import names.
$(VENV)/src: $(VENV)/.python Makefile
	@rm -rf $@ && mkdir -p $@/rotemina
	@for layer in app docs drivers plugins resources sim; do \
	ln -s ../../../$$layer $@/rotemina/$$layer; done
