#!/bin/sh
# Pins versions and hashes, for every platform and without the address of any index.
set -eu
cd "$(dirname "$0")/.."
compile() { uv pip compile --quiet --universal --python-version 3.11 --generate-hashes --no-emit-index-url --no-header "$@"; }
compile pyproject.toml requirements/build.in -o requirements/serve.txt
compile pyproject.toml requirements/build.in --extra film -c requirements/serve.txt -o requirements/film.txt
compile pyproject.toml requirements/build.in --extra transcribe -c requirements/serve.txt -o requirements/transcribe.txt
compile pyproject.toml requirements/build.in --extra postgres --extra redis --extra s3 -c requirements/serve.txt -o requirements/storage.txt
compile pyproject.toml requirements/build.in --extra cluster -c requirements/serve.txt -o requirements/cluster.txt
compile pyproject.toml requirements/build.in --group dev --group assets -c requirements/serve.txt -o requirements/dev.txt
compile pyproject.toml requirements/build.in requirements/bench.in --group dev --group assets -c requirements/dev.txt -o requirements/bench.txt
compile requirements/node.in -o requirements/node.txt
compile requirements/servers.in -o requirements/servers.txt
compile requirements/peers.in -o requirements/peers.txt
