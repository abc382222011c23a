from pathlib import Path

import pytest
from tests.unit.sound.material import write_click_soundfont

from reina.sound import font as sound_font
from reina.sound.font import soundfont_id
from reina.sound.renderer import MissingSoundfontError, find_soundfont


@pytest.fixture(autouse=True)
def _an_empty_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:  # pyright: ignore[reportUnusedFunction]
    monkeypatch.setattr(sound_font, "default_data_dir", lambda: tmp_path / "usual")
    (tmp_path / "usual").mkdir()
    (tmp_path / "data").mkdir()


def test_looks_in_the_data_folder_before_the_usual_one(tmp_path: Path) -> None:
    shared = write_click_soundfont(tmp_path / "usual" / "soundfont.sf2")
    assert find_soundfont(tmp_path / "data", environment={}) == shared
    own = write_click_soundfont(tmp_path / "data" / "soundfont.sf2")
    assert find_soundfont(tmp_path / "data", environment={}) == own


def test_the_variable_comes_first(tmp_path: Path) -> None:
    write_click_soundfont(tmp_path / "data" / "soundfont.sf2")
    named = write_click_soundfont(tmp_path / "other.sf2")
    assert find_soundfont(tmp_path / "data", environment={"REINA_SOUNDFONT": str(named)}) == named


def test_without_any_the_message_says_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(MissingSoundfontError, match=r"make setup.*REINA_SOUNDFONT"):
        find_soundfont(tmp_path / "data", environment={})


def test_a_named_file_that_is_none_is_told(tmp_path: Path) -> None:
    with pytest.raises(MissingSoundfontError, match="No such file"):
        find_soundfont(tmp_path, environment={"REINA_SOUNDFONT": str(tmp_path / "none.sf2")})
    wrong = tmp_path / "wrong.sf2"
    wrong.write_bytes(b"RIFF\0\0\0\0WAVE")
    with pytest.raises(MissingSoundfontError, match="no SF2"):
        find_soundfont(tmp_path, environment={"REINA_SOUNDFONT": str(wrong)})


def test_the_id_follows_the_content(tmp_path: Path) -> None:
    one, two = write_click_soundfont(tmp_path / "1.sf2"), write_click_soundfont(tmp_path / "2.sf2")
    assert soundfont_id(one) == soundfont_id(two)
    two.write_bytes(two.read_bytes() + b"\0")
    assert soundfont_id(one) != soundfont_id(two)
    with pytest.raises(MissingSoundfontError):
        soundfont_id(tmp_path / "none.sf2")
