"""A real server, as `reina serve` starts it, and a session's control over HTTP."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Generator, Mapping
    from pathlib import Path

    import httpx

PATIENCE_S = 30.0
"""A server that has not ended by then will not: it takes a fraction of a second on a machine of its own."""


@dataclass(frozen=True)
class Running:
    """A server that answers."""

    process: subprocess.Popen[str]
    address: str

    @property
    def api(self) -> str:
        return f"{self.address}/api/v1"

    def stream(self, session: str, **query: object) -> str:
        """The address of a session's WebSocket."""
        asked = "&".join(f"{name}={value}" for name, value in query.items())
        return f"{self.api.replace('http', 'ws', 1)}/sessions/{session}/stream?{asked}"

    def memory_bytes(self) -> int:
        """Resident memory of the server's process."""
        with open(f"/proc/{self.process.pid}/statm") as file:  # noqa: PTH123
            return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE")

    def stop(self) -> int:
        """SIGTERM, and the exit status."""
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(PATIENCE_S)


@contextmanager
def serve(
    data_dir: Path,
    *arguments: str,
    source: Path | None = None,
    log: Path | None = None,
    settings: Mapping[str, object] | None = None,
    files: int | None = None,
) -> Generator[Running]:
    """Start a server on a free port, from another work tree if one is named, and end it.

    What it logs goes into a file where one is named; settings are what its environment says besides; files
    are how many it may have open.
    """
    environment = os.environ | ({"PYTHONPATH": str(source / "server")} if source else {})
    environment |= {name: str(value) for name, value in (settings or {}).items()}
    program = "import sys; from reina.cli import main; sys.exit(main())"
    if files is not None:
        limited = f"import resource; resource.setrlimit(resource.RLIMIT_NOFILE, ({files}, {files}))"
        program = f"{limited}; {program}"
    command = [sys.executable, "-c", program]
    with open(log, "w") if log else nullcontext() as said:  # noqa: PTH123
        process = subprocess.Popen(
            [*command, "serve", "--port", "0", "--data-dir", str(data_dir), *arguments],
            stdout=subprocess.PIPE,
            stderr=said,
            text=True,
            env=environment,
            cwd=source,
        )
    try:
        assert process.stdout is not None
        address = process.stdout.readline().strip()
        assert address.startswith("http://"), f"the server did not start: {address!r}"
        yield Running(process, address)
    finally:
        if process.poll() is None:
            process.terminate()
            process.wait(PATIENCE_S)
        if process.stdout:
            process.stdout.close()


@dataclass(frozen=True)
class Owned:
    """A session and its token."""

    client: httpx.Client
    body: dict[str, Any]

    @property
    def id(self) -> str:
        return str(self.body["id"])

    @property
    def path(self) -> str:
        return f"/api/v1/sessions/{self.id}"

    @property
    def headers(self) -> dict[str, str]:
        return {"Authorization": f"Bearer {self.body['control_token']}"}

    def control(self, action: str, **fields: Any) -> dict[str, Any]:
        """Use the transport; returns its state."""
        answer = self.client.post(
            f"{self.path}/transport", json={"action": action, **fields}, headers=self.headers
        )
        assert answer.status_code == 200, answer.text
        state: dict[str, Any] = answer.json()
        return state

    def change(self, method: str, below: str = "", **options: Any) -> httpx.Response:
        """A request that needs the token."""
        return self.client.request(method, f"{self.path}{below}", headers=self.headers, **options)


def upload(client: httpx.Client, score: bytes, name: str = "score.mid", **form: Any) -> Owned:
    """Make a session of a score."""
    files: dict[str, Any] = {"score": (name, score)}
    files |= {key: form.pop(key) for key in ("song", "show") if key in form}
    answer = client.post("/api/v1/sessions", files=files, data=form)
    assert answer.status_code == 201, answer.text
    return Owned(client, answer.json())


def rendered(client: httpx.Client, href: str) -> httpx.Response:
    """A song, once it is made."""
    deadline = time.monotonic() + 60
    while (answer := client.get(href)).status_code == 202:
        assert answer.json()["status"] == "rendering"
        assert 0.0 <= answer.json()["progress"] < 1.0
        assert time.monotonic() < deadline
        time.sleep(0.05)
    return answer
