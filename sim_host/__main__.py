"""`python -m sim_host --settings FILE`: one host process."""

import sys

from runtime.process.settings_file import run_process
from sim_host import run
from sim_host.server.settings import HostSettings

if __name__ == "__main__":
    sys.exit(run_process("sim_host", HostSettings, run))
