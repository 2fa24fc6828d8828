"""`python -m recordings --settings FILE`: one recorder process."""

import sys

from recordings import run
from recordings.recorder.settings import RecorderSettings
from runtime.process.settings_file import run_process

if __name__ == "__main__":
    sys.exit(run_process("recordings", RecorderSettings, run))
