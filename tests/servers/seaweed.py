"""SeaweedFS, a real store that speaks S3: one for all tests of a run that ask for it."""

from __future__ import annotations

import json
import shutil
import socket
import subprocess
import time
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

import httpx

if TYPE_CHECKING:
    from collections.abc import Generator
    from pathlib import Path

PROGRAM = "weed"
PATIENCE_S = 60.0
ACCESS_KEY, SECRET_KEY, REGION, BUCKET = "reina", "only-for-tests", "us-east-1", "reina"


@dataclass(frozen=True)
class Seaweed:
    """A store that answers."""

    process: subprocess.Popen[bytes]
    endpoint: str

    def url(self, prefix: str) -> str:
        """The address of a place of one's own in its bucket."""
        return f"s3://{BUCKET}/{prefix}?endpoint={self.endpoint}"

    @property
    def environment(self) -> dict[str, str]:
        """What lets somebody in."""
        return {"AWS_ACCESS_KEY_ID": ACCESS_KEY, "AWS_SECRET_ACCESS_KEY": SECRET_KEY, "AWS_REGION": REGION}


@contextmanager
def seaweed(folder: Path) -> Generator[Seaweed]:
    """Start it on free ports with its files in a folder, and end it."""
    program = shutil.which(PROGRAM)
    assert program is not None, "`make .venv/.servers` brings the program `weed`"
    who = {"accessKey": ACCESS_KEY, "secretKey": SECRET_KEY}
    rights = ["Admin", "Read", "Write", "List", "Tagging"]
    access = folder / "access.json"
    access.write_text(
        json.dumps({"identities": [{"name": "tests", "credentials": [who], "actions": rights}]})
    )
    data = folder / "data"
    data.mkdir()
    ports = _free_ports("master", "volume", "filer", "s3")
    command = [
        *(program, "server", "-filer", "-s3", f"-dir={data}", "-ip=127.0.0.1", "-ip.bind=127.0.0.1"),
        *(f"-{name}={port}" for name, port in ports.items()),
        *("-s3.port.iceberg=0", "-s3.port.lance=0", f"-s3.config={access}"),
        *("-master.telemetry=false", "-master.volumeSizeLimitMB=64", "-volume.max=16"),
    ]
    with (folder / "log").open("wb") as log:
        process = subprocess.Popen(command, stdout=log, stderr=log, cwd=folder)
    try:
        endpoint = f"http://127.0.0.1:{ports['s3.port']}"
        _wait_until_it_answers(process, endpoint, folder / "log")
        store = Seaweed(process, endpoint)
        _make_bucket(store)
        yield store
    finally:
        # It takes half a minute to end when asked to, and nobody needs its files any more.
        process.kill()
        process.wait()


def _free_ports(*services: str) -> dict[str, int]:
    """A port for HTTP and one for what they tell each other, for each service; all differ."""
    names = [name for service in services for name in (f"{service}.port", f"{service}.port.grpc")]
    with ExitStack() as held:
        ports: dict[str, int] = {}
        for name in names:
            taken = held.enter_context(socket.socket())
            taken.bind(("127.0.0.1", 0))
            ports[name] = taken.getsockname()[1]
    return ports


def _wait_until_it_answers(process: subprocess.Popen[bytes], endpoint: str, log: Path) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while True:
        assert process.poll() is None, log.read_text(errors="replace")[-2000:]
        try:
            if httpx.get(f"{endpoint}/healthz").status_code == 200:
                return
        except httpx.TransportError:
            pass
        assert time.monotonic() < deadline, log.read_text(errors="replace")[-2000:]
        time.sleep(0.1)


def _make_bucket(store: Seaweed) -> None:
    """Make the bucket, and wait until it takes a file: its parts find one another only then."""
    from obstore.exceptions import BaseError
    from obstore.store import S3Store

    client = S3Store(
        BUCKET,
        endpoint=store.endpoint,
        access_key_id=ACCESS_KEY,
        secret_access_key=SECRET_KEY,
        region=REGION,
        client_options={"allow_http": True},
        retry_config={"max_retries": 0},
    )
    deadline = time.monotonic() + PATIENCE_S
    while True:
        try:
            # The store makes a bucket with the first file in it.
            client.put("made", b"here")
            client.delete("made")
        except (BaseError, FileNotFoundError):
            assert time.monotonic() < deadline
            time.sleep(0.1)
        else:
            return
