from pathlib import Path

import pytest

from reina.system import resources
from reina.system.resources import IN_CHECKOUT, bundled, default_data_dir

ROOT = Path(__file__).parents[3]


def test_a_checkout_uses_its_own_files() -> None:
    assert resources.checkout() == ROOT
    assert bundled("rigs") == ROOT / "rigs"
    assert default_data_dir(environment={"XDG_DATA_HOME": "/elsewhere"}) == ROOT / "data"


@pytest.fixture
def installed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """As if the package lay among others, away from its repository; the home folder."""
    monkeypatch.setattr(resources, "__file__", str(tmp_path / "lib" / "reina" / "system" / "resources.py"))
    monkeypatch.setattr(Path, "home", lambda: tmp_path)
    return tmp_path


def test_an_installed_package_uses_what_it_has_inside(installed: Path) -> None:
    assert resources.checkout() is None
    assert [bundled(what).parts[-3:] for what in IN_CHECKOUT] == [
        ("reina", "bundled", what) for what in IN_CHECKOUT
    ]


@pytest.mark.parametrize(
    ("platform", "environment", "expected"),
    [
        ("linux", {}, ".local/share/reina"),
        ("linux", {"XDG_DATA_HOME": "relative"}, ".local/share/reina"),
        ("darwin", {"XDG_DATA_HOME": "/elsewhere"}, "Library/Application Support/reina"),
        ("win32", {}, "AppData/Local/reina"),
    ],
)
def test_data_goes_where_the_system_keeps_a_users(
    installed: Path, platform: str, environment: dict[str, str], expected: str
) -> None:
    assert default_data_dir(environment=environment, platform=platform) == installed / expected


def test_the_systems_variables_are_heard(installed: Path) -> None:
    there = str(installed / "there")
    for platform, variable in (("linux", "XDG_DATA_HOME"), ("win32", "LOCALAPPDATA")):
        found = default_data_dir(environment={variable: there}, platform=platform)
        assert found == Path(there) / "reina"


def test_a_user_without_a_home_has_the_current_folder(
    installed: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def homeless() -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.setattr(Path, "home", homeless)
    monkeypatch.chdir(installed)
    assert default_data_dir(environment={}, platform="linux") == installed / "reina-data"
