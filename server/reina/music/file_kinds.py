"""Files that are sent as a score and are none: what they are, by their first bytes, and what to send."""

from dataclasses import dataclass

HEAD_BYTES = 4096
"""How much of a file is looked at."""


@dataclass(frozen=True)
class FileKind:
    """A kind of file that is no score to Reina.

    Attributes:
        name: What it is: ``"a MuseScore score"``, ``"a PDF"``.
        advice: What to send in its place.
    """

    name: str
    advice: str

    def __str__(self) -> str:
        return f"this is {self.name}; {self.advice}"

    @property
    def is_recording(self) -> bool:
        """Whether it is sound, to be sent as the song."""
        return self.advice == RECORDING


EXPORT = "export it as MusicXML (.musicxml) or MIDI (.mid) from the program it is of"
CONVERT = "convert it to MIDI (.mid)"
RECORDING = "a score is notes, not sound: send their MIDI file as the score and this as the song"
PICTURE = (
    "a picture of notes is not read: export MusicXML (.musicxml) or MIDI (.mid) from the program that the "
    "sheet was made with"
)
ARCHIVE = "take the score out of it and send that"
DOWNLOAD = "the download gave a page and not the file: fetch the file itself"

MUSESCORE = FileKind("a MuseScore score", EXPORT)
GUITAR_PRO = FileKind("a Guitar Pro score", EXPORT)
WAV = FileKind("a WAV recording", RECORDING)
MP3 = FileKind("an MP3 recording", RECORDING)
GZIP = FileKind("a gzip'd file inside another archive", ARCHIVE)
ZIP = FileKind("a ZIP archive inside another", ARCHIVE)

SIGNATURES: tuple[tuple[int, bytes, FileKind], ...] = (
    (0, b"ID3", MP3),
    (0, b"\xff\xfb", MP3),
    (0, b"\xff\xfa", MP3),
    (0, b"\xff\xf3", MP3),
    (0, b"\xff\xf2", MP3),
    (0, b"\xff\xf1", FileKind("an AAC recording", RECORDING)),
    (0, b"\xff\xf9", FileKind("an AAC recording", RECORDING)),
    (8, b"WAVE", WAV),
    (0, b"OggS", FileKind("an Ogg recording", RECORDING)),
    (0, b"fLaC", FileKind("a FLAC recording", RECORDING)),
    (8, b"AIFF", FileKind("an AIFF recording", RECORDING)),
    (8, b"AIFC", FileKind("an AIFF recording", RECORDING)),
    (4, b"ftyp", FileKind("an MP4 recording or video", RECORDING)),
    (0, b"\x1aE\xdf\xa3", FileKind("a WebM or Matroska recording or video", RECORDING)),
    (8, b"AVI ", FileKind("an AVI video", RECORDING)),
    (0, b"%PDF", FileKind("a PDF", PICTURE)),
    (0, b"\x89PNG", FileKind("a PNG picture", PICTURE)),
    (0, b"\xff\xd8\xff", FileKind("a JPEG picture", PICTURE)),
    (0, b"GIF8", FileKind("a GIF picture", PICTURE)),
    (8, b"WEBP", FileKind("a WebP picture", PICTURE)),
    (0, b"II*\x00", FileKind("a TIFF picture", PICTURE)),
    (0, b"MM\x00*", FileKind("a TIFF picture", PICTURE)),
    (0, b"FLhd", FileKind("an FL Studio project", EXPORT)),
    (8, b"NUND", FileKind("a Cubase project", EXPORT)),
    (0, b"\x18FICHIER GUITAR PRO", GUITAR_PRO),
    (0, b"BCFZ", GUITAR_PRO),
    (0, b"BCFS", GUITAR_PRO),
    (0, b"\x0fSIBELIUS", FileKind("a Sibelius score", EXPORT)),
    (0, b"ENIGMA BINARY FILE", FileKind("a Finale score", EXPORT)),
    (0, b"[NoteWorthy", FileKind("a NoteWorthy Composer score", EXPORT)),
    (0, b"[NWZ]", FileKind("a NoteWorthy Composer score", EXPORT)),
    (0, b"CAKEWALK", FileKind("a Cakewalk project", EXPORT)),
    (0, b"XMF_", FileKind("XMF", CONVERT)),
    (0, b"MMMD", FileKind("a ringtone (SMAF)", CONVERT)),
    (0, b"IREZ", FileKind("RMF", CONVERT)),
    (0, b"Extended Module:", FileKind("a tracker module", CONVERT)),
    (0, b"IMPM", FileKind("a tracker module", CONVERT)),
    (1080, b"M.K.", FileKind("a tracker module", CONVERT)),
    (0, b"\x1f\x8b", GZIP),
    (0, b"PK\x03\x04", ZIP),
    (0, b"7z\xbc\xaf\x27\x1c", FileKind("a 7z archive", ARCHIVE)),
    (0, b"Rar!", FileKind("a RAR archive", ARCHIVE)),
    (0, b"BZh", FileKind("a bzip2 archive", ARCHIVE)),
    (0, b"\xfd7zXZ\x00", FileKind("an xz archive", ARCHIVE)),
    (0, b"\x28\xb5\x2f\xfd", FileKind("a Zstandard archive", ARCHIVE)),
    (257, b"ustar", FileKind("a tar archive", ARCHIVE)),
    (0, b"TVRoZ", FileKind("a MIDI file in base64", "decode it and send the MIDI file (.mid)")),
    (0, b"data:", FileKind("a data URL", "decode it and send the MIDI file (.mid)")),
    (0, b"MFile", FileKind("a MIDI file as text (mf2t)", "send the MIDI file (.mid) itself")),
    (0, b"0, 0, Header", FileKind("a MIDI file as text (midicsv)", "send the MIDI file (.mid) itself")),
    (0, b"X:", FileKind("ABC notation", CONVERT)),
    (0, b"%abc", FileKind("ABC notation", CONVERT)),
)
"""Where in the file which bytes stand; the first that fits counts."""

WORDS: tuple[tuple[bytes, FileKind], ...] = (
    (b"<musescore", MUSESCORE),
    (b"<gpif", GUITAR_PRO),
    (b"<ableton", FileKind("an Ableton Live set", EXPORT)),
    (b"<reaper_project", FileKind("a REAPER project", EXPORT)),
    (b"http://www.music-encoding.org", FileKind("MEI", CONVERT)),
    (b"<!doctype html", FileKind("a web page", DOWNLOAD)),
    (b"<html", FileKind("a web page", DOWNLOAD)),
    (b"<svg", FileKind("an SVG picture", PICTURE)),
    (b'\\version "', FileKind("a LilyPond score", EXPORT)),
    (b"**kern", FileKind("Humdrum", CONVERT)),
    (b"\nx:", FileKind("ABC notation", CONVERT)),
)
"""What stands somewhere in the first bytes, in small letters; the first that is found counts."""

ZIPPED: tuple[tuple[str, FileKind], ...] = (
    (".mscx", MUSESCORE),
    ("score.gpif", GUITAR_PRO),
    ("[content_types].xml", FileKind("an Office document", PICTURE)),
)
"""How the name of a file ends, in small letters, by which a ZIP archive is a file of another program."""


def kind_of(data: bytes) -> FileKind | None:
    """Return what `data` is, if it is known and no score, else None."""
    head = data[:HEAD_BYTES]
    for at, magic, kind in SIGNATURES:
        if head.startswith(magic, at):
            return kind
    if head[:2] in {b"\xff\xfe", b"\xfe\xff"}:
        head = head.decode("utf-16", errors="ignore").encode()
    if not data.startswith((b"MThd", b"{", b"[")):
        head = head.lower()
        for word, kind in WORDS:
            if word in head:
                return kind
    return None


def kind_of_zip(names: list[str]) -> FileKind | None:
    """Return of which program's kind a ZIP archive of files with these `names` is, or None."""
    lowered = [name.lower() for name in names]
    return next((kind for end, kind in ZIPPED if any(name.endswith(end) for name in lowered)), None)
