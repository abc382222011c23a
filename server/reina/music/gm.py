"""General MIDI's names of programs, as published in General MIDI System Level 1."""

PROGRAM_NAMES = tuple(
    """Acoustic Grand Piano,Bright Acoustic Piano,Electric Grand Piano,Honky-tonk Piano,Electric Piano 1,
Electric Piano 2,Harpsichord,Clavinet,Celesta,Glockenspiel,Music Box,Vibraphone,Marimba,Xylophone,
Tubular Bells,Dulcimer,Drawbar Organ,Percussive Organ,Rock Organ,Church Organ,Reed Organ,Accordion,
Harmonica,Tango Accordion,Acoustic Guitar (nylon),Acoustic Guitar (steel),Electric Guitar (jazz),
Electric Guitar (clean),Electric Guitar (muted),Overdriven Guitar,Distortion Guitar,
Guitar Harmonics,Acoustic Bass,Electric Bass (finger),Electric Bass (pick),Fretless Bass,
Slap Bass 1,Slap Bass 2,Synth Bass 1,Synth Bass 2,Violin,Viola,Cello,Contrabass,Tremolo Strings,
Pizzicato Strings,Orchestral Harp,Timpani,String Ensemble 1,String Ensemble 2,Synth Strings 1,
Synth Strings 2,Choir Aahs,Voice Oohs,Synth Voice,Orchestra Hit,Trumpet,Trombone,Tuba,Muted Trumpet,
French Horn,Brass Section,Synth Brass 1,Synth Brass 2,Soprano Sax,Alto Sax,Tenor Sax,Baritone Sax,
Oboe,English Horn,Bassoon,Clarinet,Piccolo,Flute,Recorder,Pan Flute,Blown Bottle,Shakuhachi,Whistle,
Ocarina,Lead 1 (square),Lead 2 (sawtooth),Lead 3 (calliope),Lead 4 (chiff),Lead 5 (charang),
Lead 6 (voice),Lead 7 (fifths),Lead 8 (bass + lead),Pad 1 (new age),Pad 2 (warm),Pad 3 (polysynth),
Pad 4 (choir),Pad 5 (bowed),Pad 6 (metallic),Pad 7 (halo),Pad 8 (sweep),FX 1 (rain),
FX 2 (soundtrack),FX 3 (crystal),FX 4 (atmosphere),FX 5 (brightness),FX 6 (goblins),FX 7 (echoes),
FX 8 (sci-fi),Sitar,Banjo,Shamisen,Koto,Kalimba,Bagpipe,Fiddle,Shanai,Tinkle Bell,Agogo,Steel Drums,
Woodblock,Taiko Drum,Melodic Tom,Synth Drum,Reverse Cymbal,Guitar Fret Noise,Breath Noise,Seashore,
Bird Tweet,Telephone Ring,Helicopter,Applause,Gunshot"""
    .replace("\n", "")
    .split(",")
)  # fmt: skip
"""128 names; the index is the program counted from 0."""

DRUM_CHANNEL = 9
"""The channel of the drums, counted from 0."""

VARIANTS = (
    frozenset({16, 17, 18, 19, 20}),  # organs: registrations
    frozenset(
        {24, 25, 26, 27, 28, 29, 30, 31, 120}
    ),  # guitars: open, muted, overdriven, harmonics, fret noise
    frozenset({32, 33, 34, 35, 36, 37, 38, 39}),  # basses: fingers, pick, slap
    frozenset({40, 44, 45, 48, 49, 50, 51}),  # violins: bowed, tremolo, plucked, a section
    frozenset({41, 44, 45, 48, 49, 50, 51}),
    frozenset({42, 44, 45, 48, 49, 50, 51}),
    frozenset({43, 32, 44, 45, 48, 49, 50, 51}),
    frozenset({52, 53, 54}),  # voices
    frozenset({56, 59}),  # brass, open and muted; there is one program for all that is muted
    frozenset({57, 59}),
    frozenset({58, 59}),
    frozenset({60, 59}),
    frozenset({61, 62, 63, 59}),
)
"""Programs that one player has on one instrument, and changes between."""


def are_variants(program: int, other: int) -> bool:
    """Return whether two programs are one instrument, played in different ways."""
    return program == other or any(program in variants and other in variants for variants in VARIANTS)
