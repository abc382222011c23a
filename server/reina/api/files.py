"""Files that are served: found below a folder, and nowhere else."""

from pathlib import Path


def file_below(folder: Path, name: str) -> Path | None:
    """The regular file of a name below a folder, links followed; None where there is none.

    A name that leads out of the folder is none, nor is one that no file system can hold (NUL, too long).

    Args:
        folder: Where to look.
        name: A path below it, as it came in a request.
    """
    try:
        root = folder.resolve()
        path = (root / name).resolve()
        return path if path.is_relative_to(root) and path.is_file() else None
    except (OSError, ValueError):
        return None
