"""Every call of the description × who asks × from where: what it is answered follows from one rule a call.

The calls are read from the application's own description as the tests run. A call that takes a session is
for who controls it, unless it only reads; a call that writes without a session has to be named here.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import httpx
import pytest
from tests.integration.scores import scale, song
from tests.integration.server import Owned, serve, upload
from tests.integration.test_every_route import FILLED

from reina.api.app import create_app

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

PATHS: dict[str, dict[str, Any]] = create_app().openapi()["paths"]
API = "/api/v1"
SESSION = f"{API}/sessions/{{session_id}}"
READING = frozenset({"get", "head"})
PERSON, OTHER = "ada", "bob"
USER, PROXY = "X-Forwarded-User", "127.0.0.1"
QUERY = {"start_s": "0", "end_s": "0.1", "parameter": "camera/fov"}

Rule = Literal["open", "watch", "control", "upload"]

OPEN_WRITES = frozenset(
    {
        ("post", f"{API}/files/role"),  # keeps nothing
        ("post", f"{API}/sign-in"),
        ("delete", f"{API}/sign-in"),
        # Who has a search's id may end it.
        ("delete", f"{API}/transcriptions/{{transcription_id}}"),
    }
)
"""What anybody may send without a session; the laboratory's calls beside, which keep nothing and are off
where the server listens beyond its own machine."""
UPLOADS = frozenset({("post", f"{API}/sessions"), ("post", f"{API}/transcriptions")})


@dataclass(frozen=True)
class Call:
    """A call of the description."""

    method: str
    path: str
    operation: dict[str, Any]

    @property
    def rule(self) -> Rule | None:
        """Who may; None where no rule says it."""
        if self.path.startswith(SESSION):
            return "watch" if self.method in READING else "control"
        if (self.method, self.path) in UPLOADS:
            return "upload"
        is_open = self.method in READING or (self.method, self.path) in OPEN_WRITES
        return "open" if is_open or self.path.startswith(f"{API}/lab/") else None

    @property
    def schemes(self) -> set[str]:
        """What the description says that it asks for."""
        return {scheme for entry in self.operation.get("security", []) for scheme in entry}

    def address(self, session: str) -> str:
        """Where it is asked of a session."""
        values = FILLED | {"session_id": session}
        path = re.sub(r"{(\w+)[^}]*}", lambda match: values[match[1]], self.path)
        asked = [each["name"] for each in self.operation.get("parameters", []) if each["in"] == "query"]
        query = "&".join(f"{name}={QUERY[name]}" for name in asked if name in QUERY)
        return f"{path}?{query}"


CALLS = [
    Call(method, path, operation)
    for path, operations in PATHS.items()
    for method, operation in operations.items()
]
SCHEMES: dict[Rule, set[str]] = {
    "open": set(),
    "watch": set(),
    "control": {"control_token"},
    "upload": {"sign_in"},
}


@dataclass
class World:
    """A server behind a proxy that says who asks, with sessions of somebody."""

    client: httpx.Client
    folder: Path
    session: Owned
    other: Owned
    revoked: str

    def renewed(self) -> None:
        """Other sessions, where the calls so far have ended or changed these."""
        mine = {USER: PERSON}
        files = {"score": ("a.mid", scale(2)), "song": ("s.wav", song(0.2))}
        made = [
            Owned(self.client, self.client.post(f"{API}/sessions", files=files, headers=mine).json())
            for _ in range(2)
        ]
        self.session, self.other = made
        self.revoked = str(self.session.body["control_token"])
        answer = self.session.change("POST", "/control_token")
        assert answer.status_code == 200
        self.session.body["control_token"] = answer.json()["control_token"]

    def credentials(self) -> dict[str, dict[str, str]]:
        """Who asks: the headers of each."""
        return {
            "nobody": {},
            "another scheme": {"Authorization": "Basic cmVpbmE6cmVpbmE="},
            "a wrong token": {"Authorization": "Bearer wrong"},
            "an empty token": {"Authorization": "Bearer"},
            "another session's token": self.other.headers,
            "a revoked token": {"Authorization": f"Bearer {self.revoked}"},
            "somebody else, signed in": {USER: OTHER},
            "two who are signed in at once": {USER: PERSON, "x-forwarded-user": OTHER},
            "the token": self.session.headers,
            "its owner, signed in": {USER: PERSON},
        }


CONTROLS = frozenset({"the token", "its owner, signed in"})
SIGNED_IN = frozenset({"somebody else, signed in", "its owner, signed in"})
NO_TOKEN = frozenset(
    {
        "nobody",
        "another scheme",
        "an empty token",
        "somebody else, signed in",
        "two who are signed in at once",
    }
)
ORIGINS: dict[str, str | None] = {"none": None, "own": "", "other": "http://evil.example"}


@pytest.fixture(scope="module")
def world(tmp_path_factory: pytest.TempPathFactory) -> Iterator[World]:
    folder = tmp_path_factory.mktemp("matrix")
    environment = {"REINA_USER_HEADER": USER, "REINA_TRUSTED_PROXY": PROXY}
    with (
        serve(folder, "--lab", settings=environment) as running,
        httpx.Client(base_url=running.address, timeout=30.0) as client,
    ):
        nobody = Owned(client, {"id": "", "control_token": ""})
        made = World(client, folder, nobody, nobody, "")
        made.renewed()
        yield made


def asked(world: World, call: Call, headers: dict[str, str], origin: str | None) -> httpx.Response:
    client = world.client
    sent = list(headers.items())
    if origin is not None:
        sent.append(("Origin", origin or f"http://{client.base_url.netloc.decode()}"))
    return client.request(call.method.upper(), call.address(world.session.id), headers=sent)


def expected(call: Call, who: str, origin: str) -> tuple[int, str] | None:
    """The refusal that follows from the rule; None where the call goes on."""
    if origin == "other" and call.method not in READING:
        return 403, "foreign-origin"
    if call.rule == "control" and who not in CONTROLS:
        return (401, "no-token") if who in NO_TOKEN else (403, "wrong-token")
    if call.rule == "upload" and who not in SIGNED_IN:
        return 401, "sign-in-needed"
    return None


ENDING = frozenset({("delete", SESSION), ("post", f"{SESSION}/control_token")})
"""After these the session, or its token, is another."""
REFUSALS = frozenset({"foreign-origin", "no-token", "wrong-token", "sign-in-needed"})


def kind(answer: httpx.Response) -> str:
    if answer.headers.get("content-type") != "application/problem+json":
        return ""
    return str(answer.json()["type"]).removeprefix("urn:reina:problem:")


@pytest.mark.parametrize("call", CALLS, ids=lambda call: f"{call.method} {call.path}")
def test_each_call_is_answered_by_its_rule(world: World, call: Call) -> None:
    rule = call.rule
    assert rule is not None, "say in OPEN_WRITES or UPLOADS who may, or take a session"
    assert call.schemes == SCHEMES[rule], "the description says otherwise who may"
    for who in world.credentials():
        for origin, value in ORIGINS.items():
            answer = asked(world, call, world.credentials()[who], value)
            refusal = expected(call, who, origin)
            if refusal is not None:
                assert (answer.status_code, kind(answer)) == refusal, (who, origin)
            else:
                assert answer.status_code < 500, (who, origin, answer.text)
                assert kind(answer) not in REFUSALS, (who, origin, answer.text)
            if refusal is None and (call.method, call.path) in ENDING:
                assert answer.status_code in {200, 204}, (who, origin)
                world.renewed()


def test_a_token_is_kept_as_its_hash_alone(world: World) -> None:
    token = str(world.session.body["control_token"]).encode()
    kept = [path for path in world.folder.rglob("*") if path.is_file()]
    assert kept
    for path in kept:
        assert token not in path.read_bytes(), path


def test_the_one_before_ends_at_once_and_the_new_one_outlives_the_server(tmp_path: Path) -> None:
    with serve(tmp_path) as running, httpx.Client(base_url=running.address, timeout=30) as client:
        session = upload(client, scale(2), song=("s.wav", song(0.2)))
        before = session.headers
        session.body["control_token"] = session.change("POST", "/control_token").json()["control_token"]
        path = f"{session.path}/transport"
        refused = client.post(path, json={"action": "pause"}, headers=before)
        assert (refused.status_code, kind(refused)) == (403, "wrong-token")
    with serve(tmp_path) as running, httpx.Client(base_url=running.address, timeout=30) as client:
        refused = client.post(path, json={"action": "pause"}, headers=before)
        assert refused.status_code == 403
        assert client.post(path, json={"action": "pause"}, headers=session.headers).status_code == 200


def test_unlisted_sessions_are_their_owners_alone(world: World) -> None:
    public = world.client.get(f"{API}/sessions").json()["sessions"]
    assert public == [], "private unless it is said otherwise"
    for who, is_owner in ((PERSON, True), (OTHER, False)):
        signed_in = {USER: who}
        answer = world.client.get(f"{API}/sessions", params={"mine": True}, headers=signed_in)
        listed = [each["id"] for each in answer.json()["sessions"]]
        assert (world.session.id in listed) is is_owner
        assert world.client.get(world.session.path, headers=signed_in).json()["mine"] is is_owner
    nobody = world.client.get(f"{API}/sessions", params={"mine": True})
    assert (nobody.status_code, kind(nobody)) == (401, "sign-in-needed")
