"""`python -m fluxbore`: the same as the command `fluxbore`."""

import sys

from fluxbore.cli import main

if __name__ == "__main__":
    sys.exit(main())
