# make demo   renders the colour checker of monkeys into demo/
# make test   runs every test
PYTHON ?= python3.11
DEMO ?= demo
RENDERER ?= mitsuba
# Where `make setup` keeps Blender's user folder, so that nobody's own settings are touched.
export BLENDER_USER_RESOURCES ?= $(CURDIR)/build/blender-user

PY := .venv/bin/python

.PHONY: setup demo test lint build bench clean

setup: .venv/.ready

.venv/.ready: pyproject.toml
	$(PYTHON) -m venv .venv
	$(PY) -m pip install --quiet --upgrade pip
	$(PY) -m pip install --quiet --editable '.[blender,test]'
	touch $@

demo: setup
	$(PY) packaging/link_extension.py
	$(PY) examples/dragon_color_checker/model.py -- --output '$(DEMO)'
	$(PY) -m rtb_addon render '$(DEMO)' --renderer '$(RENDERER)'

test: setup lint
	$(PY) -m pytest tests/unit -n 2
	$(PY) -m pytest tests/renderings
	$(PY) -m pytest tests/blender
	$(PY) -m pytest tests/gui -rs

lint: setup
	$(PY) -m ruff check .
	$(PY) -m ruff format --check .
	$(PY) -m pyright

build: setup
	$(PY) packaging/build_extension.py --output dist

bench: setup
	for script in benchmarks/*.py; do $(PY) $$script || exit 1; done

clean:
	rm -rf build dist demo
