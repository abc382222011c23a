# syntax=docker/dockerfile:1

# The page, and the soundfont that scores are rendered with.
FROM node:22-slim AS page
WORKDIR /app/web
COPY web/package.json web/package-lock.json web/.npmrc ./
RUN npm ci --no-fund --no-audit --loglevel=error
COPY web/ ./
RUN npm run build && node scripts/make-soundfont.mjs /app/data/soundfont.sf2

# The server's dependencies, pinned by hash as everywhere else.
FROM python:3.12-slim AS packages
RUN python -m venv /app/.venv
WORKDIR /app
COPY requirements/serve.txt requirements/serve.txt
RUN .venv/bin/pip install --no-cache-dir --disable-pip-version-check --require-hashes -r requirements/serve.txt
COPY pyproject.toml README.md LICENSE ./
COPY server/ server/
RUN .venv/bin/pip install --no-cache-dir --disable-pip-version-check --no-deps --no-build-isolation --editable . \
    && .venv/bin/python -m compileall -q server

FROM python:3.12-slim
LABEL org.opencontainers.image.title="Reina" \
      org.opencontainers.image.description="A music visualizer with a player in it" \
      org.opencontainers.image.licenses="MIT"
RUN groupadd --gid 10001 reina \
    && useradd --uid 10001 --gid reina --no-create-home --home-dir /nonexistent --shell /usr/sbin/nologin reina \
    && install --directory --owner reina --group reina /data
WORKDIR /app
COPY --from=packages /app/ ./
COPY LICENSE THIRD_PARTY.md ./
COPY examples/ examples/
COPY rigs/ rigs/
COPY --from=page /app/data/soundfont.sf2 data/soundfont.sf2
COPY --from=page /app/web/dist/ web/dist/
ENV PATH=/app/.venv/bin:$PATH \
    PYTHONUNBUFFERED=1 \
    PYTHONDONTWRITEBYTECODE=1 \
    REINA_DATA_DIR=/data
USER reina
VOLUME /data
EXPOSE 8000
HEALTHCHECK --interval=30s --timeout=5s --start-period=20s --start-interval=1s \
    CMD ["python", "-c", "import urllib.request; urllib.request.urlopen('http://127.0.0.1:8000/api/v1/health', timeout=4)"]
STOPSIGNAL SIGTERM
CMD ["reina", "serve", "--host", "0.0.0.0", "--port", "8000"]
