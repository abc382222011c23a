"""The JSON that Tone.js's MIDI converter writes, of the present and of the older form: what stands where.

Fields that are known and not read (other metas, measures, the end of a track) may hold anything.
"""

from reina.music.document.fields import Span

DOCUMENT = frozenset({"header", "tracks", "duration", "startTime"})
HEADER = frozenset(
    {"name", "ppq", "PPQ", "bpm", "tempos", "timeSignature", "timeSignatures", "keySignatures", "meta"}
)
TEMPO = frozenset({"bpm", "ticks", "time"})
TIME_SIGNATURE = frozenset({"ticks", "timeSignature", "measures", "time"})
KEY_SIGNATURE = frozenset({"key", "scale", "ticks"})
TRACK = frozenset(
    {"name", "channel", "channelNumber", "instrument", "instrumentNumber", "instrumentFamily"}
    | {"isPercussion", "notes", "controlChanges", "pitchBends", "endOfTrackTicks"}
    | {"id", "length", "duration", "startTime"}
)
INSTRUMENT = frozenset({"number", "name", "family", "percussion"})
NOTE = frozenset(
    {"midi", "name", "time", "ticks", "duration", "durationTicks", "velocity"}
    | {"noteOffVelocity", "channel", "pitch", "octave", "bars"}
)
"""A note's own channel is not read: a track has one program and one set of controllers for all its notes."""
CHANGE = frozenset({"number", "value", "time", "ticks", "name", "channel"})

CONTROLLERS = {
    "modulationWheel": 1,
    "breath": 2,
    "footController": 4,
    "portamentoTime": 5,
    "volume": 7,
    "balance": 8,
    "pan": 10,
    "expression": 11,
    "sustain": 64,
    "sostenuto": 66,
    "softPedal": 67,
    "legatoFootswitch": 68,
    "portamentoControl": 84,
}
"""Controllers by the names that the converter gives them."""

KEYS = ("Cb", "Gb", "Db", "Ab", "Eb", "Bb", "F", "C", "G", "D", "A", "E", "B", "F#", "C#")
"""Key signatures from seven flats to seven sharps. The converter names minor ones by these too, with the
scale beside: ``{"key": "C", "scale": "minor"}`` is A minor."""

MIDI_NUMBER = Span(0, 127, whole=True)
CHANNEL = Span(0, 15, whole=True)
PPQ = Span(1, 1e6)
TICKS = Span(0, 1e12)
BPM = Span(1, 1e8)
METRE_NUMBER = Span(1, 1024, whole=True)
CONTROLLER_VALUE = Span(0, 127)
"""Values are 0 to 1; above 1 they are MIDI's own."""
BEND_VALUE = Span(-2, 2)
"""-1 to 1 is the bend's whole range."""
