"""`python -m coach_gateway --settings FILE`: one gateway process, for the match's page and other bridges."""

import sys

from coach_gateway import run
from coach_gateway.settings import GatewaySettings
from runtime.process.settings_file import run_process

if __name__ == "__main__":
    sys.exit(run_process("coach_gateway", GatewaySettings, run))
