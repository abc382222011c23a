"""`python -m reina` is `reina`."""

import sys

from reina.cli import main

if __name__ == "__main__":
    sys.exit(main())
