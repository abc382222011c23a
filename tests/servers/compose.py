"""Docker Compose, which reads compose files without an engine too.

python tests/servers/compose.py --install
"""

from __future__ import annotations

import shutil
import subprocess
import sys

DEBIAN_PACKAGE = "docker-compose"


def find_compose() -> list[str] | None:
    """The command: Docker's plugin, else the program of its own; None without either."""
    if shutil.which("docker") is not None:
        plugin = ["docker", "compose"]
        asked = subprocess.run([*plugin, "version"], capture_output=True, check=False)
        if asked.returncode == 0:
            return plugin
    program = shutil.which("docker-compose")
    return [program] if program is not None else None


def install() -> None:
    """Bring Debian's package where there is neither and apt can; else the tests that need it are skipped."""
    if find_compose() is None and shutil.which("apt-get") is not None:
        apt = ["apt-get", "install", "--yes", "--quiet", "--no-install-recommends", DEBIAN_PACKAGE]
        subprocess.run(apt, check=False)


if __name__ == "__main__" and sys.argv[1:] == ["--install"]:
    install()
