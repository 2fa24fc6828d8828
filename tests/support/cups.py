"""Cups of short matches, played without a display."""

from pathlib import Path

from support.brisk import BRISK
from touchline.matches.cup.cup_config import load_cup
from touchline.matches.cup.cup_state import CupState
from touchline.matches.cup.run_cup import CupRun
from touchline.matches.engine.fresh_process import FreshProcesses

CUP = f"""
name = "mini"
size = 1
[match]
duration = 2.0
rules = "{BRISK}"
scene = "one_against_keeper"
[[teams]]
name = "One"
brain = "reference"
[[teams]]
name = "Two"
brain = "simple"
[[teams]]
name = "Three"
brain = "random"
"""


def play(run: CupRun, jobs: int) -> CupState:
    """Play a cup in processes of this machine."""
    executor = FreshProcesses(jobs)
    try:
        return run.play(executor)
    finally:
        executor.shutdown(cancel_futures=True)


def mini_cup(folder: Path, *, resume: bool = False) -> CupRun:
    """The cup of three teams in a folder, whose results are in its folder `out`."""
    file = folder / "mini.toml"
    if not file.exists():
        file.write_text(CUP)
    return CupRun(load_cup(file), folder, folder / "out", resume=resume)
