"""The limits of the robots of one match while it runs: control groups where they can be written, looks elsewhere."""

from dataclasses import replace

from schemas.config.confinement import Isolation, Limits
from schemas.config.match_config import MatchConfig
from schemas.process.clock import Clock
from schemas.process.leash import adopt_orphans
from touchline.launch.child_process import ProcessHandle
from touchline.launch.control_groups import ControlGroups, control_groups
from touchline.launch.process_table import Process
from touchline.launch.usage_watch import PERIOD_S, UsageWatch


class RobotLimits:
    """Enforces limits on launched robots, and ends what they leave behind."""

    def __init__(self, config: MatchConfig, clock: Clock) -> None:
        """From now on orphaned descendants become children of this process."""
        adopt_orphans()
        self._clock = clock
        self._watch = UsageWatch()
        self._groups: ControlGroups | None = None
        self._groups, self._why_no_groups = control_groups()
        self._is_asked = config.isolate is not Isolation.NONE or any(
            part.model_fields_set
            for part in (config.limits, *(config.team(side).limits for side in config.local_sides))
        )
        self._robots: dict[str, tuple[ProcessHandle, Limits]] = {}
        self._next_look = 0.0

    @property
    def note(self) -> str:
        """What this machine does not enforce, if the match asks for limits or isolation; empty otherwise."""
        if self._groups is not None or not self._is_asked:
            return ""
        return (
            f"no control groups ({self._why_no_groups}): memory, processes and CPU time of a robot are checked "
            f"every {PERIOD_S:g} s, and [limits] cores is not enforced"
        )

    def placed(self, process: Process) -> Process:
        """A process that is going to be launched, with its control group where there are any.

        Raises:
            TouchlineError: its limits cannot be written.
        """
        self._watch.end_left_behind()
        if process.confinement is None or self._groups is None:
            return process
        group = self._groups.make(process.name, process.confinement.limits)
        return replace(process, confinement=replace(process.confinement, control_group=group))

    def add_helpers(self) -> None:
        """Regard all present children of this process as its own."""
        self._watch.add_own()

    def launched(self, handle: ProcessHandle) -> None:
        """Watch a process that has been launched."""
        self._watch.add_own()
        if handle.process.confinement is not None:
            self._robots[handle.process.name] = (handle, handle.process.confinement.limits)

    def check(self) -> list[str]:
        """Look at all robots if that is due; returns a sentence for each thing that a user should know."""
        if self._clock.now() < self._next_look:
            return []
        self._next_look = self._clock.now() + PERIOD_S
        self._watch.check(self._robots)
        return self._end_left_behind()

    def look_before_the_end(self) -> None:
        """Find the descendants of all robots, which are theirs also when they have ended."""
        self._watch.check(self._robots)

    def close(self) -> list[str]:
        """End all that robots have left behind, after they have ended; returns as `check`."""
        sentences = self._end_left_behind()
        if self._groups is not None:
            self._groups.close()
        for handle, _ in self._robots.values():
            if handle.process.confinement is not None:
                handle.process.confinement.remove_empty_folder()
        return sentences

    def _end_left_behind(self) -> list[str]:
        return [
            f"{robot or 'a robot'} left process {pid} behind, outside its process group; it was ended"
            for pid, robot in self._watch.end_left_behind().items()
        ]
