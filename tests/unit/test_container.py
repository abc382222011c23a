"""The Dockerfile and the compose files against the repository."""

import json
import os
import re
import subprocess
from typing import Any

import pytest
import yaml
from tests.dockerfile import ROOT, is_sent, stages
from tests.servers.find_servers import find_compose

WITH_POSTGRESQL = ("docker-compose.yml", "docker-compose.postgres.yml")


def copied_from_context() -> list[str]:
    """What the Dockerfile copies out of the repository."""
    copies = [copy.words for stage in stages() for copy in stage.all("COPY")]
    return [source for words in copies if not words[0].startswith("--from") for source in words[:-1]]


@pytest.mark.parametrize("source", copied_from_context())
def test_what_is_copied_is_there_and_sent(source: str) -> None:
    assert (ROOT / source).exists()
    assert is_sent(source.rstrip("/"))


@pytest.mark.parametrize(
    "path",
    [
        "data/soundfont.sf2",
        "dist/reina-0.1.0-py3-none-any.whl",
        ".venv/bin/python",
        ".git/config",
        "web/node_modules/three/package.json",
        "web/dist/index.html",
        "rigs/build/build.py",
        "server/reina/__pycache__/x.pyc",
        "tests/conftest.py",
    ],
)
def test_what_is_built_or_private_is_not_sent(path: str) -> None:
    assert not is_sent(path)


def test_stages_are_declared_before_they_are_copied_from() -> None:
    declared: set[str] = set()
    for stage in stages():
        for copy in stage.all("COPY"):
            if copy.words[0].startswith("--from="):
                assert copy.words[0].removeprefix("--from=") in declared
        declared.add(stage.name)


def test_bases_are_named_by_their_exact_versions() -> None:
    node, *pythons = [stage.base for stage in stages()]
    found = re.fullmatch(r"node:(\d+)\.(\d+)\.\d+-bookworm-slim", node)
    assert found
    engines = json.loads((ROOT / "web" / "package.json").read_text())["engines"]["node"]
    least = re.search(rf"\^{found[1]}\.(\d+)", engines)
    assert least
    assert int(found[2]) >= int(least[1])
    assert len(pythons) == 2
    assert len(set(pythons)) == 1
    assert re.fullmatch(r"python:3\.1[1-9]\.\d+-slim-bookworm", pythons[0])


def test_it_runs_as_nobody_in_particular_and_asks_for_its_health() -> None:
    last = {instruction.name: instruction for instruction in stages()[-1].instructions}
    made = re.search(r"useradd --uid (\d+) --gid \w+ .*--shell /usr/sbin/nologin (\w+)", last["RUN"].text)
    assert made
    assert int(made[1]) >= 10_000
    assert last["USER"].words == [made[2]]
    assert last["VOLUME"].words == ["/data"]
    assert "HEALTHCHECK" in last
    assert "REINA_DATA_DIR=/data" in last["ENV"].words


def compose_config(*files: str, **variables: str) -> dict[str, Any]:
    """What Docker Compose makes of compose files, with these variables alone set."""
    command = find_compose()
    assert command, "there is neither `docker compose` nor `docker-compose`; `make .venv/.servers` brings one"
    named = [word for file in files for word in ("-f", file)]
    kept = {name: value for name, value in os.environ.items() if not name.startswith("REINA_")}
    said = subprocess.run(
        [*command, *named, "config"],
        cwd=ROOT,
        env=kept | variables,
        capture_output=True,
        text=True,
        check=False,
    )
    assert said.returncode == 0, said.stderr
    # Compose's older versions say in the format's version how they read it.
    config: dict[str, Any] = yaml.safe_load(said.stdout)
    return config


def assert_confined(service: dict[str, Any]) -> None:
    """A container that can do no more than it needs, and take no more than it is given."""
    assert service["read_only"] is True
    assert service["cap_drop"] == ["ALL"]
    assert service["security_opt"] == ["no-new-privileges:true"]
    assert {"mem_limit", "pids_limit", "restart", "stop_grace_period"} <= service.keys()
    assert service["logging"]["options"].keys() == {"max-size", "max-file"}
    assert service["init"] is True


def volumes_of(config: dict[str, Any], name: str) -> set[str]:
    """The volumes that a service writes to."""
    mounts = config["services"][name]["volumes"]
    # 1.29 writes them in one line, later versions as an object.
    return {mount["source"] if isinstance(mount, dict) else mount.split(":")[0] for mount in mounts}


def test_compose_reads_it_as_it_is_meant() -> None:
    config = compose_config("docker-compose.yml", REINA_PORT="9001", REINA_MEMORY="12g")
    # What has a profile is started where that is named, and only then.
    assert {name for name, service in config["services"].items() if "profiles" not in service} == {"reina"}
    reina = config["services"]["reina"]
    assert_confined(reina)
    # 1.29 writes sizes as they were given, later versions in bytes.
    assert str(reina["mem_limit"]) in {"12g", str(12 * 1024**3)}
    assert "9001" in json.dumps(reina["ports"])
    assert "127.0.0.1" in json.dumps(reina["ports"])
    assert reina["ulimits"] == {"core": 0, "nofile": 65536}
    assert volumes_of(config, "reina") == {"data"}


def test_compose_joins_a_postgresql_where_it_is_asked_to() -> None:
    config = compose_config(*WITH_POSTGRESQL, REINA_DATABASE_PASSWORD="a-secret")
    services = {name: service for name, service in config["services"].items() if "profiles" not in service}
    assert services.keys() == {"reina", "postgres"}
    for service in services.values():
        assert_confined(service)
    assert (
        services["reina"]["environment"]["REINA_DATABASE_URL"] == "postgresql://reina:a-secret@postgres/reina"
    )
    assert services["reina"]["depends_on"]["postgres"]["condition"] == "service_healthy"
    database = services["postgres"]
    assert re.fullmatch(r"postgres:\d+\.\d+-bookworm", database["image"])
    assert database["environment"] == {
        "POSTGRES_USER": "reina",
        "POSTGRES_DB": "reina",
        "POSTGRES_PASSWORD": "a-secret",
    }
    # Nobody beyond the two containers reaches it.
    assert "ports" not in database
    assert volumes_of(config, "postgres") == {"database"}


def test_compose_has_several_servers_where_they_are_asked_for() -> None:
    config = compose_config("docker-compose.yml", REINA_DATABASE_PASSWORD="a-secret", REINA_PORT="9001")
    services = {name: service for name, service in config["services"].items() if "profiles" in service}
    assert services.keys() == {"nginx", "reina-1", "reina-2", "database", "bus"}
    for service in services.values():
        assert service["profiles"] == ["replicas"]
        assert_confined(service)
    # Nobody beyond them reaches any but nginx, and that from this machine alone.
    assert [name for name, service in services.items() if "ports" in service] == ["nginx"]
    assert "9001" in json.dumps(services["nginx"]["ports"])
    assert "127.0.0.1" in json.dumps(services["nginx"]["ports"])
    address = services["nginx"]["networks"]["replicas"]["ipv4_address"]
    for name in ("reina-1", "reina-2"):
        said = services[name]["environment"]
        assert said["REINA_DATABASE_URL"] == "postgresql://reina:a-secret@database/reina"
        assert said["REINA_BUS_URL"] == "redis://bus:6379"
        assert said["REINA_TRUSTED_PROXY"] == address
        assert said["REINA_FILES"] == "/files"
        # The large files are one volume's, and each has a folder of its own besides.
        assert volumes_of(config, name) == {"files", name.replace("reina", "replica")}
        assert f"server {name}:8000" in (ROOT / "deploy" / "replicas.conf").read_text()
    made = next(instruction for instruction in stages()[-1].instructions if "useradd" in instruction.text)
    assert "/files" in made.text, "who it runs as may write there"


def test_a_database_without_a_password_is_refused_in_words() -> None:
    with pytest.raises(AssertionError, match="a password for the database"):
        compose_config(*WITH_POSTGRESQL)


@pytest.mark.parametrize(
    "line",
    [
        r"    mem_limit: \"\$\{REINA_MEMORY:-\d+g\}\"",
        r"    pids_limit: \d{3}",
        r"    ulimits:\n      nofile: \d{4,5}",
        r"    logging:\n      driver: json-file\n      options: \{max-size: \d+m, max-file: \"\d\"\}",
    ],
)
def test_memory_processes_files_and_logs_of_a_container_are_bounded(line: str) -> None:
    text = (ROOT / "docker-compose.yml").read_text()
    assert re.search(rf"^{line}$", text, re.MULTILINE)
