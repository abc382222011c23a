"""Nchan, the module of nginx that fans messages out, with a publisher; for bench_stream.py to watch.

Starts nginx with one worker, prints ``port N``, and from the first line of its input on posts a message of so
many bytes so many times a second, at absolute deadlines, over one connection. Who watches opens a WebSocket
at ``/``. ``--install`` installs Debian's package where it can be.
"""

from __future__ import annotations

import argparse
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

PACKAGE = "libnginx-mod-nchan"
MODULE = Path("/usr/lib/nginx/modules/ngx_nchan_module.so")
CONFIGURATION = """
load_module {module};
daemon off;
worker_processes 1;
worker_rlimit_nofile 65536;
pid {folder}/pid;
error_log {folder}/error.log;
events {{ worker_connections 20000; }}
http {{
    access_log off;
    client_body_temp_path {folder}/body;
    proxy_temp_path {folder}/proxy;
    fastcgi_temp_path {folder}/fastcgi;
    uwsgi_temp_path {folder}/uwsgi;
    scgi_temp_path {folder}/scgi;
    keepalive_requests 100000000;
    keepalive_timeout 1h;
    server {{
        listen 127.0.0.1:{port} backlog=1024;
        location = / {{
            nchan_subscriber websocket;
            nchan_channel_id frames;
            nchan_subscriber_first_message newest;
        }}
        location = /publish {{
            nchan_publisher http;
            nchan_channel_id frames;
            nchan_store_messages off;
        }}
    }}
}}
"""


def nginx() -> Path | None:
    """The program, where the module is there too."""
    found = shutil.which("nginx") or shutil.which("nginx", path="/usr/sbin:/usr/local/sbin")
    return Path(found) if found and MODULE.exists() else None


def install() -> None:
    """Install Debian's package where it is missing and can be; it is not started as a service."""
    if nginx() is not None or shutil.which("apt-get") is None or os.geteuid() != 0:
        return
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive", "RUNLEVEL": "1"}
    packages = ["apt-get", "install", "--yes", "--no-install-recommends", "nginx-light", PACKAGE]
    for command in (["apt-get", "update"], packages):
        if subprocess.run(command, env=environment, check=False).returncode != 0:
            return


def free_port() -> int:
    """A port that nobody listens at now."""
    with socket.create_server(("127.0.0.1", 0)) as listening:
        return int(listening.getsockname()[1])


def connected(port: int, running: subprocess.Popen[bytes]) -> socket.socket:
    """A connection, as soon as there is one to be had.

    Raises:
        RuntimeError: The server ended instead.
    """
    while running.poll() is None:
        try:
            connection = socket.create_connection(("127.0.0.1", port))
        except ConnectionRefusedError:
            time.sleep(0.01)
        else:
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            return connection
    raise RuntimeError("nginx did not start")


def publish(port: int, connection: socket.socket, size: int, rate: float) -> None:
    """Post messages until the input ends."""
    head = f"POST /publish HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nContent-Type: application/octet-stream\r\n"
    request = f"{head}Content-Length: {size}\r\n\r\n".encode() + bytes(size)
    print("port", port, flush=True)
    sys.stdin.readline()
    over = threading.Thread(target=sys.stdin.readline, daemon=True)
    over.start()
    due_s = time.monotonic()
    while over.is_alive():
        connection.sendall(request)
        if not connection.recv(65_536).startswith(b"HTTP/1.1 20"):
            raise RuntimeError("nginx did not take the message")
        due_s += 1 / rate
        time.sleep(max(0.0, due_s - time.monotonic()))


def main() -> int:
    """Serve until the input ends; 1 without nginx and its module."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bytes", type=int, default=1536)
    parser.add_argument("--rate", type=float, default=60.0)
    parser.add_argument("--install", action="store_true", help="see that it is there, and go")
    options = parser.parse_args()
    if options.install:
        install()
        return 0
    program = nginx()
    if program is None:
        print(f"there is no nginx with Nchan: install Debian's package {PACKAGE}", file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as folder:
        port = free_port()
        configuration = Path(folder) / "nginx.conf"
        configuration.write_text(CONFIGURATION.format(module=MODULE, folder=folder, port=port))
        with subprocess.Popen([str(program), "-p", folder, "-c", str(configuration)]) as running:
            try:
                with connected(port, running) as connection:
                    publish(port, connection, options.bytes, options.rate)
            finally:
                running.terminate()
    return 0


if __name__ == "__main__":
    sys.exit(main())
