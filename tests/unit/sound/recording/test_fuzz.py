"""Recordings made worse at random are read, or refused with a reason; nothing else comes of them."""

from tests.unit.sound.recording.recording_mutations import check_recording, mutated, seeds


def test_every_seed_is_read() -> None:
    assert all(check_recording(seed) for seed in seeds())


def test_broken_recordings_are_read_or_refused() -> None:
    read = [check_recording(data) for data in mutated(400, seed=1)]
    assert 40 < sum(read) < 390
