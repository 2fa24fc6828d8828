"""`python -m schemas.protocol > docs/protocol.md` writes the page on the protocol."""

import sys

from schemas.protocol.page import page

if __name__ == "__main__":
    sys.stdout.write(page())
