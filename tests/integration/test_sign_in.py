"""Uploads for those alone who are signed in: by one password, by names, by a proxy that is trusted."""

from __future__ import annotations

import subprocess
import sys
from typing import TYPE_CHECKING, Any

import httpx
import pytest
from tests.integration.scores import scale, song
from tests.integration.server import serve

from reina.system.passwords import hash_password, is_password_hash, password_matches

if TYPE_CHECKING:
    from pathlib import Path

API = "/api/v1"
PASSWORD = "correct horse"
FILES: dict[str, Any] = {"score": ("a.mid", scale(2)), "song": ("s.wav", song(0.2))}


def kind(answer: httpx.Response) -> str:
    return str(answer.json()["type"]).removeprefix("urn:reina:problem:")


def test_nobody_is_asked_by_default(client: httpx.Client) -> None:
    told = client.get(f"{API}/sign-in").json()
    assert told == {"needed": False, "asks": None, "signed_in": False, "name": None, "by": None}
    assert kind(client.post(f"{API}/sign-in", json={"password": PASSWORD})) == "no-sign-in"
    # Whatever anybody says of himself is nothing.
    forged = {"X-Forwarded-User": "ada", "Cookie": "reina-sign-in=e30.0"}
    made = client.post(f"{API}/sessions", files=FILES, headers=forged)
    assert made.status_code == 201
    assert made.json()["mine"] is False


def test_one_password_for_all(tmp_path: Path) -> None:
    file = tmp_path / "password"
    file.write_text(f"{PASSWORD}\n")
    environment = {"REINA_UPLOAD_PASSWORD_FILE": str(file)}
    with (
        serve(tmp_path / "data", settings=environment) as running,
        httpx.Client(base_url=running.address, timeout=30) as client,
    ):
        refused = client.post(f"{API}/sessions", files=FILES)
        assert (refused.status_code, kind(refused)) == (401, "sign-in-needed")
        assert refused.headers["www-authenticate"] == "Reina"
        refused = client.post(f"{API}/transcriptions", files=FILES)
        assert (refused.status_code, kind(refused)) == (401, "sign-in-needed")
        # Watching, and the page, are for everybody.
        assert client.get(f"{API}/examples").status_code == 200

        wrong = client.post(f"{API}/sign-in", json={"password": "wrong"})
        assert (wrong.status_code, kind(wrong)) == (401, "wrong-password")
        assert "set-cookie" not in wrong.headers
        right = client.post(f"{API}/sign-in", json={"password": PASSWORD})
        assert right.json() == {
            "needed": True,
            "asks": "password",
            "signed_in": True,
            "name": None,
            "by": "password",
        }
        cookie = right.headers["set-cookie"]
        for word in ("HttpOnly", "SameSite=strict", "Path=/"):
            assert word in cookie
        assert "Secure" not in cookie, "this is plain HTTP"
        kept = client.cookies["reina-sign-in"]
        made = client.post(f"{API}/sessions", files=FILES)
        assert made.status_code == 201
        assert made.json()["mine"] is False, "it is not known who it is"

        # Nothing of it can be made up or changed, and signing out ends it.
        text, _, signature = kept.partition(".")
        for forged in (f"{text}.{'0' * 64}", f"{text[:-2]}AA.{signature}", text, "", ".", "a.b.c"):
            with httpx.Client(
                base_url=running.address, timeout=30, cookies={"reina-sign-in": forged}
            ) as other:
                assert other.get(f"{API}/sign-in").json()["signed_in"] is False, forged
        assert client.delete(f"{API}/sign-in").status_code == 204
        assert client.get(f"{API}/sign-in").json()["signed_in"] is False

    # It outlives the server, and ends with the password.
    for line, is_in in ((PASSWORD, True), (f"{PASSWORD}s", False)):
        file.write_text(line)
        with (
            serve(tmp_path / "data", settings=environment) as running,
            httpx.Client(base_url=running.address, timeout=30, cookies={"reina-sign-in": kept}) as client,
        ):
            assert client.get(f"{API}/sign-in").json()["signed_in"] is is_in
    assert (tmp_path / "data" / "signing-key").stat().st_mode & 0o077 == 0


def test_people_have_their_own_pieces_and_guesses_are_few(tmp_path: Path) -> None:
    file = tmp_path / "people"
    file.write_text(f"# who may\nada:{hash_password(PASSWORD)}\nbob:{hash_password('battery staple')}\n")
    environment = {"REINA_UPLOAD_PASSWORD_FILE": str(file), "REINA_TRUSTED_PROXY": "127.0.0.1"}
    with serve(tmp_path / "data", settings=environment) as running:

        def browser(address: str) -> httpx.Client:
            seen = {"X-Forwarded-For": address}
            return httpx.Client(base_url=running.address, timeout=30, headers=seen)

        with browser("192.0.2.1") as ada, browser("192.0.2.2") as bob, browser("192.0.2.3") as eve:
            for client, name, password in ((ada, "ada", PASSWORD), (bob, "bob", "battery staple")):
                told = client.post(f"{API}/sign-in", json={"name": name, "password": password}).json()
                assert (told["name"], told["asks"]) == (name, "name-and-password")
            made = ada.post(f"{API}/sessions", files=FILES).json()
            assert made["mine"] is True
            listed = {
                name: [each["id"] for each in client.get(f"{API}/sessions?mine=1").json()["sessions"]]
                for name, client in (("ada", ada), ("bob", bob))
            }
            assert listed == {"ada": [made["id"]], "bob": []}
            path = f"{API}/sessions/{made['id']}"
            assert ada.patch(path, json={"title": "Hers"}).status_code == 200, "without the token"
            assert kind(bob.patch(path, json={"title": "His"})) == "no-token"
            foreign = {"Origin": "http://evil.example"}
            assert kind(ada.patch(path, json={"title": "Theirs"}, headers=foreign)) == "foreign-origin"

            guesses = [{"name": "ada", "password": f"guess {number}"} for number in range(7)]
            answers = [eve.post(f"{API}/sign-in", json=guess) for guess in guesses]
            assert [answer.status_code for answer in answers] == [401] * 5 + [429] * 2
            assert int(answers[-1].headers["retry-after"]) > 0
            # Even the right one, for a while; other addresses are not held up.
            right = {"name": "ada", "password": PASSWORD}
            assert eve.post(f"{API}/sign-in", json=right).status_code == 429
            assert ada.post(f"{API}/sign-in", json=right).status_code == 200


def test_a_cookie_by_tls_is_for_tls_alone(tmp_path: Path) -> None:
    file = tmp_path / "password"
    file.write_text(hash_password(PASSWORD))
    environment = {"REINA_UPLOAD_PASSWORD_FILE": str(file), "REINA_TRUSTED_PROXY": "127.0.0.0/8"}
    tls = {"X-Forwarded-Proto": "https"}
    with (
        serve(tmp_path / "data", settings=environment) as running,
        httpx.Client(base_url=running.address, timeout=30, headers=tls) as client,
    ):
        cookie = client.post(f"{API}/sign-in", json={"password": PASSWORD}).headers["set-cookie"]
        assert cookie.startswith("__Host-reina-sign-in=")
        assert "Secure" in cookie
        kept = {"Cookie": cookie.partition(";")[0]}
        assert client.get(f"{API}/sign-in", headers=kept).json()["signed_in"] is True


@pytest.mark.parametrize("trusted", ["192.0.2.1", "10.0.0.0/8 192.0.2.0/24"])
def test_a_persons_header_from_anybody_but_the_proxy_is_nothing(tmp_path: Path, trusted: str) -> None:
    environment = {"REINA_USER_HEADER": "X-Forwarded-User", "REINA_TRUSTED_PROXY": trusted}
    with (
        serve(tmp_path, settings=environment) as running,
        httpx.Client(base_url=running.address, timeout=30, headers={"X-Forwarded-User": "ada"}) as client,
    ):
        told = client.get(f"{API}/sign-in").json()
        assert told == {"needed": True, "asks": "proxy", "signed_in": False, "name": None, "by": None}
        # Nor does it help to say that one is the proxy.
        named = {"X-Forwarded-For": trusted.split("/")[0]}
        assert client.get(f"{API}/sign-in", headers=named).json()["signed_in"] is False
        assert kind(client.post(f"{API}/sessions", files=FILES, headers=named)) == "sign-in-needed"


@pytest.mark.parametrize(
    ("environment", "told"),
    [
        ({"REINA_USER_HEADER": "X-Forwarded-User"}, "REINA_TRUSTED_PROXY"),
        ({"REINA_USER_HEADER": "X User", "REINA_TRUSTED_PROXY": "10.0.0.1"}, "name of a header"),
        ({"REINA_TRUSTED_PROXY": "proxy"}, "an address or a network"),
        ({"REINA_UPLOAD_PASSWORD_FILE": "/nowhere"}, "cannot be read"),
        ({"REINA_UPLOAD_PASSWORD_FILE": "short"}, "8 to 200 characters"),
        ({"REINA_UPLOAD_PASSWORD_FILE": "several"}, "one password, or lines"),
        ({"REINA_UPLOAD_PASSWORD_FILE": "long", "REINA_SIGNING_KEY_FILE": "short"}, "holds 7 bytes"),
        ({"REINA_UPLOAD_PASSWORD_FILE": "long", "REINA_SIGNING_KEY_FILE": "none"}, "none cannot be read"),
    ],
)
def test_what_cannot_be_meant_keeps_the_server_from_starting(
    tmp_path: Path, environment: dict[str, str], told: str
) -> None:
    (tmp_path / "short").write_text("1234567")
    (tmp_path / "long").write_text(f"{PASSWORD}\n")
    (tmp_path / "several").write_text(f"{PASSWORD}\n{PASSWORD}\n")
    command = "import sys, os; os.environ |= eval(sys.argv[1]); from reina.cli import main; "
    command += "sys.exit(main(['serve', '--port', '0', '--no-page', '--data-dir', 'data']))"
    done = subprocess.run(
        [sys.executable, "-c", command, repr(environment)], cwd=tmp_path, capture_output=True, text=True
    )
    assert done.returncode == 1
    assert told in done.stderr
    assert "Traceback" not in done.stderr


def test_a_line_is_made_by_a_command() -> None:
    command = "import sys; from reina.cli import main; sys.exit(main(['password', '--name', sys.argv[1]]))"

    def made(name: str, password: str) -> subprocess.CompletedProcess[str]:
        asked = [sys.executable, "-c", command, name]
        return subprocess.run(asked, input=f"{password}\n", capture_output=True, text=True)

    name, _, stored = made("ada", PASSWORD).stdout.strip().partition(":")
    assert name == "ada"
    assert is_password_hash(stored)
    assert password_matches(stored, PASSWORD)
    assert not password_matches(stored, f"{PASSWORD} ")
    assert made("a:b", PASSWORD).returncode == 1
    assert made("ada", "short").returncode == 1
