"""Unpacks a soundfont whose samples are Ogg Vorbis (SF3) into a plain SF2, which the synthesizer reads.

    python -m reina.sound.unpack_soundfont IN.sf3 OUT.sf2

The layout is that of SoundFont 2.04 (E-mu Systems, 2006), chapters 5 to 7. MuseScore's SF3 differs from it in
the samples alone: each is an Ogg Vorbis file in the chunk `smpl`, its header gives the first byte of it and
its end, and its loop counts from its own beginning.
"""

from __future__ import annotations

import io
import struct
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import soundfile

from reina.sound.font import MissingSoundfontError
from reina.system.durable import write_durably

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from typing import TypeAlias

    from numpy.typing import NDArray

    Table: TypeAlias = NDArray[Any]
    """Records of one of the types below; the last one of a table only ends it."""

PRESET = np.dtype([("name", "V20"), ("program", "<u2"), ("bank", "<u2"), ("bag", "<u2"), ("unused", "V12")])
INSTRUMENT = np.dtype([("name", "V20"), ("bag", "<u2")])
BAG = np.dtype([("generator", "<u2"), ("modulator", "<u2")])
GENERATOR = np.dtype([("kind", "<u2"), ("amount", "<u2")])
MODULATOR = np.dtype("V10")
SAMPLE = np.dtype(
    [
        ("name", "V20"),
        ("start", "<u4"),
        ("end", "<u4"),
        ("loop_start", "<u4"),
        ("loop_end", "<u4"),
        ("rate", "<u4"),
        ("key", "u1"),
        ("correction", "i1"),
        ("link", "<u2"),
        ("kind", "<u2"),
    ]
)

PLAYS_INSTRUMENT = 41
PLAYS_SAMPLE = 53
"""Generators that name what a zone plays."""
VORBIS = np.uint16(0x10)
"""Flag of a sample's kind."""
MONO = 1
FULL_SCALE = 32767
SILENCE_AFTER = 46
"""Zeros that the format wants between two samples."""
SF2_VERSION = struct.pack("<HH", 2, 4)

DRUMS_BANK = 128
MARCHING_KITS = (56, 57, 58, 95)
"""Four marching drumlines hold a sixth of all samples. Neither General MIDI nor GS has them; a file that asks
for their programs on the drum channel gets the standard kit, as on any General MIDI synthesizer."""


@dataclass(frozen=True)
class _Level:
    """Presets or instruments, their zones, and what these set."""

    headers: Table
    bags: Table
    generators: Table
    modulators: Table

    def only(self, kept: NDArray[np.bool_]) -> _Level:
        """Those headers alone, with what belongs to them."""
        bags = np.repeat(kept, np.diff(self.headers["bag"]))
        generators = np.repeat(bags, np.diff(self.bags["generator"]))
        modulators = np.repeat(bags, np.diff(self.bags["modulator"]))
        headers, zones = self.headers.copy(), self.bags.copy()
        headers["bag"] = _places(bags)[headers["bag"]]
        zones["generator"] = _places(generators)[zones["generator"]]
        zones["modulator"] = _places(modulators)[zones["modulator"]]
        return _Level(
            headers[_and_end(kept)],
            zones[_and_end(bags)],
            self.generators[_and_end(generators)],
            self.modulators[_and_end(modulators)],
        )

    def plays(self, kind: int, count: int) -> NDArray[np.bool_]:
        """Which of `count` instruments or samples are named by a generator of that kind."""
        named = np.zeros(count, np.bool_)
        named[self.generators["amount"][self.generators["kind"] == kind]] = True
        return named

    def renumbered(self, kind: int, kept: NDArray[np.bool_]) -> _Level:
        """The same, where only those of what is named are left."""
        generators = self.generators.copy()
        names = generators["kind"] == kind
        generators["amount"][names] = _places(kept)[generators["amount"][names]]
        return _Level(self.headers, self.bags, generators, self.modulators)

    def chunks(self, names: Sequence[bytes]) -> list[tuple[bytes, bytes]]:
        """As the format has them."""
        tables = (self.headers, self.bags, self.modulators, self.generators)
        return [(name, table.tobytes()) for name, table in zip(names, tables, strict=True)]


def unpack_soundfont(packed: bytes) -> bytes:
    """Return an SF3 as SF2, without the marching drumlines and what only they play.

    The same bytes give the same bytes, wherever libsndfile's decoder is the same.

    Raises:
        MissingSoundfontError: It is no SF3, or not whole.
    """
    try:
        return _unpacked(packed)
    except (KeyError, ValueError, IndexError, struct.error, soundfile.LibsndfileError) as error:
        raise MissingSoundfontError(f"the packed soundfont is damaged or is none: {error}") from error


def _unpacked(packed: bytes) -> bytes:
    if packed[:4] != b"RIFF" or packed[8:12] != b"sfbk":
        raise ValueError("it does not begin as a soundfont does")
    lists = {
        packed[at : at + 4]: _chunks(packed, at + 4, end) for _, at, end in _spans(packed, 12, len(packed))
    }
    info = _chunk_list(packed, lists[b"INFO"])
    smpl = packed[slice(*dict(lists[b"sdta"])[b"smpl"])]
    pdta = dict(lists[b"pdta"])

    def table(name: bytes, kind: np.dtype[Any]) -> Table:
        start, end = pdta[name]
        return np.frombuffer(packed[start:end], kind)

    presets = _Level(
        table(b"phdr", PRESET), table(b"pbag", BAG), table(b"pgen", GENERATOR), table(b"pmod", MODULATOR)
    )
    instruments = _Level(
        table(b"inst", INSTRUMENT), table(b"ibag", BAG), table(b"igen", GENERATOR), table(b"imod", MODULATOR)
    )
    samples = table(b"shdr", SAMPLE)

    heads = presets.headers[:-1]
    presets = presets.only(~((heads["bank"] == DRUMS_BANK) & np.isin(heads["program"], MARCHING_KITS)))
    played = presets.plays(PLAYS_INSTRUMENT, len(instruments.headers) - 1)
    presets = presets.renumbered(PLAYS_INSTRUMENT, played)
    instruments = instruments.only(played)
    sounding = instruments.plays(PLAYS_SAMPLE, len(samples) - 1)
    linked = (samples["kind"][:-1] & ~VORBIS) != MONO
    # The other side of a sample in stereo is told by its number, too.
    sounding[samples["link"][:-1][sounding & linked]] = True
    instruments = instruments.renumbered(PLAYS_SAMPLE, sounding)

    samples = samples.copy()
    samples["link"][:-1][linked] = _places(sounding)[samples["link"][:-1][linked]]
    samples = samples[_and_end(sounding)]
    waves = _decoded(samples, smpl)
    return _riff(
        [
            (b"INFO", [(name, SF2_VERSION if name == b"ifil" else data) for name, data in info]),
            (b"sdta", [(b"smpl", waves)]),
            (
                b"pdta",
                [
                    *presets.chunks((b"phdr", b"pbag", b"pmod", b"pgen")),
                    *instruments.chunks((b"inst", b"ibag", b"imod", b"igen")),
                    (b"shdr", samples.tobytes()),
                ],
            ),
        ]
    )


def _decoded(samples: Table, smpl: bytes) -> bytes:
    """The samples one after another, 16 bit; their headers (changed in place) say where each stands."""
    waves: list[bytes] = []
    at = 0
    for sample in samples[:-1]:
        if not sample["kind"] & VORBIS:
            raise ValueError("a sample is not packed as Ogg Vorbis")
        packed = io.BytesIO(smpl[int(sample["start"]) : int(sample["end"])])
        # As numbers from -1 to 1, since Vorbis overshoots and libsndfile's own integers would wrap around.
        wave = soundfile.read(packed, always_2d=True)[0][:, 0]
        whole = np.clip(np.rint(wave * FULL_SCALE), -FULL_SCALE, FULL_SCALE).astype("<i2")
        waves.append(whole.tobytes() + b"\0\0" * SILENCE_AFTER)
        sample["start"], sample["end"] = at, at + len(wave)
        sample["loop_start"] += at
        sample["loop_end"] += at
        sample["kind"] &= ~VORBIS
        at += len(wave) + SILENCE_AFTER
    return b"".join(waves)


def _places(kept: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Where each stands among those that are kept, and one more: how many these are."""
    return np.concatenate(([0], np.cumsum(kept)))


def _and_end(kept: NDArray[np.bool_]) -> NDArray[np.bool_]:
    return np.append(kept, True)


def _spans(data: bytes, start: int, end: int) -> Iterable[tuple[bytes, int, int]]:
    """Each chunk's name, first byte and end."""
    while start + 8 <= end:
        name, size = struct.unpack_from("<4sI", data, start)
        yield name, start + 8, start + 8 + size
        start += 8 + size + size % 2


def _chunks(data: bytes, start: int, end: int) -> list[tuple[bytes, tuple[int, int]]]:
    return [(name, (at, until)) for name, at, until in _spans(data, start, end)]


def _chunk_list(data: bytes, chunks: list[tuple[bytes, tuple[int, int]]]) -> list[tuple[bytes, bytes]]:
    return [(name, data[at:until]) for name, (at, until) in chunks]


def _riff(lists: Iterable[tuple[bytes, Sequence[tuple[bytes, bytes]]]]) -> bytes:
    pieces: list[bytes] = []
    for kind, chunks in lists:
        sizes = [8 + len(data) + len(data) % 2 for _, data in chunks]
        pieces.append(struct.pack("<4sI4s", b"LIST", 4 + sum(sizes), kind))
        for name, data in chunks:
            pieces += [struct.pack("<4sI", name, len(data)), data, b"\0" * (len(data) % 2)]
    return b"".join((struct.pack("<4sI4s", b"RIFF", 4 + sum(map(len, pieces)), b"sfbk"), *pieces))


def main(arguments: Sequence[str]) -> int:
    """Unpack one file; returns the exit status."""
    if len(arguments) != 2:
        print("usage: python -m reina.sound.unpack_soundfont IN.sf3 OUT.sf2", file=sys.stderr)  # noqa: T201
        return 2
    source, target = map(Path, arguments)
    try:
        unpacked = unpack_soundfont(source.read_bytes())
        target.parent.mkdir(parents=True, exist_ok=True)
        write_durably(target, unpacked)
    except (OSError, MissingSoundfontError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        print(reason, file=sys.stderr)  # noqa: T201
        return 1
    print(f"{target}: {len(unpacked) / 1e6:.1f} MB")  # noqa: T201
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
