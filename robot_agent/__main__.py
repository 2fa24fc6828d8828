"""`python -m robot_agent --settings FILE`: one robot's process."""

import sys

from robot_agent import run
from robot_agent.process.settings import AgentSettings
from runtime.process.settings_file import run_process

if __name__ == "__main__":
    sys.exit(run_process("robot_agent", AgentSettings, run))
