"""`breakpoint()` in a brain whose process has no terminal is skipped; the log has the command that stops there."""

import inspect
import os
import shlex
import sys
from pathlib import Path

from robot_agent.loading.user_code import shown_path
from robot_agent.process.settings import AgentSettings
from runtime.process.clock import UNKNOWN_SIM_NS, Clock
from runtime.process.process_log import log_note

_OWN_HOOK = "PYTHONBREAKPOINT"
"""Python's variable with which users choose a debugger of their own."""


class SkippedBreakpoints:
    """Called in place of a debugger; reports each line of code once."""

    def __init__(self, settings: AgentSettings, clock: Clock) -> None:
        """`clock` has the simulated time of the sight in hand."""
        self.tick_s: float | None = None
        """Length of a tick in s; None while the setup of the match is unknown."""
        self._settings = settings
        self._clock = clock
        self._reported: set[tuple[str, int]] = set()

    def __call__(self, *_arguments: object, **_named: object) -> None:
        """Skip a breakpoint."""
        here = inspect.currentframe()
        frame = here.f_back if here is not None else None
        if frame is None:
            return
        place = (frame.f_code.co_filename, frame.f_lineno)
        if place in self._reported:
            return
        self._reported.add(place)
        log_note(
            f"breakpoint() at {shown_path(place[0])}, line {place[1]}, was skipped",
            f"{self._settings.robot} has no terminal; to stop there: {self._remedy()}",
        )

    def _remedy(self) -> str:
        """The command that plays the match again up to the sight in hand."""
        settings = self._settings
        recording = str(settings.recording) if settings.recording is not None else "RECORDING.mcap"
        words = ["touchline", "replay", recording, "--agent", f"{settings.robot}={settings.brain}"]
        here = (settings.launch_folder or Path.cwd()).resolve()
        folder = settings.brain_folder.resolve() if settings.brain_folder is not None else here
        if folder != here:
            words += ["--brain-folder", str(folder.relative_to(here) if folder.is_relative_to(here) else folder)]
        sim_ns = self._clock.sim_ns
        if self.tick_s is not None and sim_ns != UNKNOWN_SIM_NS:
            words += ["--from", f"tick:{round(sim_ns * 1e-9 / self.tick_s)}"]
        return shlex.join([*words, "--pdb"])


def skip_breakpoints(settings: AgentSettings, clock: Clock) -> SkippedBreakpoints | None:
    """Skip breakpoints from now on; None where they work: at a terminal, or with a debugger of the user's choice."""
    if os.environ.get(_OWN_HOOK) is not None or (sys.stdin is not None and sys.stdin.isatty()):
        return None
    skipped = SkippedBreakpoints(settings, clock)
    sys.breakpointhook = skipped
    return skipped
