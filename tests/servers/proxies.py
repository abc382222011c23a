"""Proxies of Debian's packages as they are set up in `deploy`, started on ports of their own."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import time
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from tests.servers.find_servers import server_path

if TYPE_CHECKING:
    from collections.abc import Generator

DEPLOY = Path(__file__).parents[2] / "deploy"
PACKAGES = {"nginx": "nginx-light", "caddy": "caddy"}
"""A program and the Debian package that brings it."""
PATIENCE_S = 30.0
NGINX_MAIN = """
daemon off;
{user}
pid {folder}/pid;
error_log stderr;
worker_rlimit_nofile {files};
events {{ worker_connections {files}; }}
http {{
    client_body_temp_path {folder}/body;
    proxy_temp_path {folder}/proxy;
    fastcgi_temp_path {folder}/fastcgi;
    uwsgi_temp_path {folder}/uwsgi;
    scgi_temp_path {folder}/scgi;
    include {folder}/reina.conf;
}}
"""


def program(name: str) -> str:
    """Where a proxy's program is."""
    return str(server_path(PACKAGES[name]))


@dataclass(frozen=True)
class Proxy:
    """A proxy that answers by TLS, with a certificate of its own."""

    name: str
    address: str
    certificate: Path
    folder: Path


@contextmanager
def proxy(name: str, upstream_port: int, folder: Path) -> Generator[Proxy]:
    """Start a proxy in front of a port, as `deploy` has it but for names, ports and places."""
    port = free_port()
    certificate, key = make_certificate(folder)
    make = {"nginx": nginx_command, "caddy": caddy_command}[name]
    with running(make(folder, port, upstream_port, certificate, key), port, folder):
        yield Proxy(name, f"https://localhost:{port}", certificate, folder)


@contextmanager
def running(command: list[str], port: int, folder: Path) -> Generator[None]:
    """Run a proxy, from when it answers on."""
    with (folder / "said").open("w") as said:
        environment = os.environ | {"HOME": str(folder), "XDG_DATA_HOME": str(folder)}
        process = subprocess.Popen(command, stdout=said, stderr=said, env=environment)
    try:
        until = time.monotonic() + PATIENCE_S
        while not answers(port):
            assert process.poll() is None, (folder / "said").read_text()
            assert time.monotonic() < until, "it does not answer"
            time.sleep(0.05)
        yield
    finally:
        process.send_signal(signal.SIGTERM)
        process.wait(PATIENCE_S)


def nginx_command(folder: Path, port: int, upstream: int, certificate: Path, key: Path) -> list[str]:
    """Write nginx's configuration; returns what starts it."""
    config = replaced(
        (DEPLOY / "nginx.conf").read_text(),
        ("127.0.0.1:8000", f"127.0.0.1:{upstream}"),
        ("    listen 80;\n    listen [::]:80;\n", f"    listen 127.0.0.1:{free_port()};\n"),
        (
            "    listen 443 ssl http2;\n    listen [::]:443 ssl http2;\n",
            f"    listen 127.0.0.1:{port} ssl http2;\n",
        ),
        ("music.example.org", "localhost"),
        ("/etc/ssl/reina/fullchain.pem", str(certificate)),
        ("/etc/ssl/reina/privkey.pem", str(key)),
        ("/var/log/nginx/reina.log", str(folder / "access")),
        ("/var/cache/nginx/reina", str(folder / "cache")),
        ("Host $host;", "Host $http_host;"),
    )
    (folder / "reina.conf").write_text(config)
    return nginx(folder)


def nginx(folder: Path, files: int = 1024) -> list[str]:
    """What starts nginx with the configuration that is in a folder, and how many files it may have open."""
    # What is only for who runs the tests its workers could not keep blocks in.
    user = "user root;" if os.geteuid() == 0 else ""
    (folder / "nginx.conf").write_text(NGINX_MAIN.format(folder=folder, user=user, files=files))
    return [program("nginx"), "-p", str(folder), "-c", str(folder / "nginx.conf"), "-e", "stderr"]


@contextmanager
def replicas_proxy(upstream_ports: list[int], folder: Path, *, files: int = 1024) -> Generator[Proxy]:
    """Start nginx in front of several servers, as `deploy/replicas.conf` has it but for names and places."""
    port = free_port()
    servers = "".join(f"    server 127.0.0.1:{each} fail_timeout=2s;\n" for each in upstream_ports)
    both = "    server reina-1:8000 fail_timeout=2s;\n    server reina-2:8000 fail_timeout=2s;\n"
    config = replaced(
        (DEPLOY / "replicas.conf").read_text(),
        (both, servers),
        ("    listen 8080;\n", f"    listen 127.0.0.1:{port};\n"),
        ("/dev/stdout", str(folder / "access")),
        ("/var/cache/nginx/reina", str(folder / "cache")),
    )
    (folder / "reina.conf").write_text(config)
    with running(nginx(folder, files), port, folder):
        yield Proxy("nginx", f"http://127.0.0.1:{port}", folder / "none", folder)


def caddy_command(folder: Path, port: int, upstream: int, certificate: Path, key: Path) -> list[str]:
    """Write Caddy's configuration; returns what starts it."""
    config = replaced(
        (DEPLOY / "Caddyfile").read_text(),
        ("127.0.0.1:8000", f"127.0.0.1:{upstream}"),
        ("\nmusic.example.org {\n", f"\nhttps://localhost:{port} {{\n\ttls {certificate} {key}\n"),
        ("music.example.org", "localhost"),
        ("\n{\n", "\n{\n\tadmin off\n\tauto_https disable_redirects\n"),
    )
    (folder / "Caddyfile").write_text(config)
    return [program("caddy"), "run", "--config", str(folder / "Caddyfile"), "--adapter", "caddyfile"]


def replaced(text: str, *pairs: tuple[str, str]) -> str:
    """A text with other words in the place of some, each of which is there."""
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new)
    return text


def make_certificate(folder: Path) -> tuple[Path, Path]:
    """A certificate for localhost, and its key."""
    certificate, key = folder / "certificate.pem", folder / "key.pem"
    subprocess.run(
        [
            *("openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "1"),
            *("-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost"),
            *("-keyout", str(key), "-out", str(certificate)),
        ],
        check=True,
        capture_output=True,
    )
    return certificate, key


def answers(port: int) -> bool:
    """Whether something listens on a port."""
    with socket.socket() as trying:
        return trying.connect_ex(("127.0.0.1", port)) == 0


def free_port() -> int:
    """A port that is free now."""
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return int(taken.getsockname()[1])
