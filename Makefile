# make run        sets everything up and opens the viewer; without a screen: writes ./figures
# make test       style, types, then the quick tests
# make test-slow  the tests that take minutes
# make contexts   the quick tests in OpenGL 4.1 (as macOS has it) and in 3.3, as Mesa plays them
# make lint       style and types
# make parity     our evaluators against what the real OpenGL and GLU computed; CASES=folder: others
# make bench      our frames against others', as ratios in one run
# make gallery    draws the README's pictures anew
# make format     brings the code into style
# make clean      removes the virtual environment and what the tools keep
# PYTHON=python3.12 chooses another Python than python3.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin

RUN_PACKAGES := python3-venv libegl1 libgl1
TEST_PACKAGES := libglu1-mesa glslang-tools xvfb xauth xdotool
ifeq ($(shell uname -sm),Linux aarch64) # moderngl has no wheel there: pip compiles it
RUN_PACKAGES += g++ python3-dev libegl-dev libx11-dev
endif

export PIP_DISABLE_PIP_VERSION_CHECK := 1
.DELETE_ON_ERROR:
.NOTPARALLEL:
.PHONY: run test test-slow contexts parity bench gallery lint format clean run-packages test-packages

run: run-packages $(VENV)/run
	@$(BIN)/reparam

test: test-packages lint
	$(BIN)/pytest -n 2 --dist worksteal

test-slow: test-packages $(VENV)/test
	$(BIN)/pytest -m slow

contexts: test-packages $(VENV)/test
	MESA_GL_VERSION_OVERRIDE=4.1 MESA_GLSL_VERSION_OVERRIDE=410 \
		$(BIN)/pytest -n 2 --dist worksteal
	GALLIUM_DRIVER=softpipe LIBGL_ALWAYS_SOFTWARE=1 $(BIN)/pytest -n 2 --dist worksteal

lint: $(VENV)/test
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy

parity: run-packages $(VENV)/test
	@$(BIN)/python tests/parity/parity.py $(CASES)

bench: run-packages $(VENV)/test
	$(BIN)/reparam bench

gallery: run-packages $(VENV)/run
	$(BIN)/python -m reparam.gallery docs/gallery 560x400 $(basename $(notdir $(wildcard docs/gallery/*.png)))

format: $(VENV)/test
	$(BIN)/ruff check --fix
	$(BIN)/ruff format

clean:
	rm -rf $(VENV) .mypy_cache .pytest_cache .ruff_cache build dist

run-packages:
	@.ci/system-packages $(PYTHON) $(RUN_PACKAGES)

test-packages:
	@.ci/system-packages $(PYTHON) $(RUN_PACKAGES) $(TEST_PACKAGES)

# A copied checkout brings a .venv that imports the original: .venv/of says whose it is.
ifneq ($(shell cat $(VENV)/of 2>/dev/null),$(CURDIR) $(PYTHON))
.PHONY: $(BIN)/python
endif

$(BIN)/python:
	@.ci/system-packages $(PYTHON) python3-venv
	@echo "setting up $(CURDIR)/$(VENV) (once; a minute)"
	@test ! -L $(VENV) || rm $(VENV) # another checkout's, which --clear would empty
	@$(PYTHON) -m venv --clear $(VENV)
	@echo "$(CURDIR) $(PYTHON)" >$(VENV)/of

$(VENV)/run: $(BIN)/python pyproject.toml
	@$(BIN)/python -m pip install --quiet --only-binary imgui-bundle --editable '.[panel]' || \
		$(BIN)/python -m pip install --quiet --editable . # where the panel has no wheel
	@$(BIN)/python -m compileall -q app # or each start compiles, where Python keeps nothing
	@touch $@

$(VENV)/test: $(BIN)/python pyproject.toml
	@$(BIN)/python -m pip install --quiet --editable '.[dev]'
	@$(BIN)/python -m compileall -q app
	@touch $(VENV)/run $@
