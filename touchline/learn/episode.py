"""One episode of a task in this process: some robots are controlled from outside, the others by their brains."""

from collections.abc import Container, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robot_agent.sdk.contract import Briefing
from runtime.process.installed import need
from schemas.config.match_config import MatchConfig
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from schemas.messages.world import World
from schemas.wire.part_faults import validated
from sim_host.task.judge import TaskState
from touchline.play.match_recording import MatchRecording
from touchline.play.play_match import InProcessMatch

PICTURE_WIDTH = 8.0
"""Width of a picture in hundreds of pixels."""


class _Seat:
    """In place of the brain of a robot that is controlled from outside."""

    def act(self, sight: Sight) -> Command:
        """Stand still."""
        return Command(answers_tick=sight.tick)


class Episode:
    """A match that is stepped with the commands of the controlled robots; to be closed."""

    def __init__(
        self,
        config: MatchConfig,
        folder: Path,
        controlled: Sequence[str],
        recording: Path | None = None,
        adviser: str | None = None,
    ) -> None:
        """`config` is of a task; brains are looked for in `folder`; the match is written into `recording`.

        `adviser`: the brain that gives advice for each controlled robot; empty: the one of the match file; None: none.

        Raises:
            TouchlineError: a brain cannot be loaded, or the recording cannot be written.
        """
        seats = {} if adviser == "" else dict.fromkeys(controlled, adviser or _Seat())
        self._match = InProcessMatch(config, seats, folder, chained=recording is not None)
        self._simulation = self._match.simulation
        self._others = [name for name in self._match.brains if name not in controlled]
        self._advised = controlled if adviser is not None else ()
        self._recording: MatchRecording | None = None
        try:
            if recording is not None:
                self._recording = MatchRecording(recording, config, self._simulation)
            self._ask()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Free the engine, and finish the recording."""
        self._match.close()
        if self._recording is not None:
            self._recording.close()
            self._recording = None

    @property
    def sights(self) -> Mapping[str, Sight]:
        """Robot → what it perceives now. Robots and ticks share parts of sights: a reader must not change these."""
        return self._simulation.now.sights.perceived

    @property
    def kicker(self) -> str | None:
        """The robot that can kick now: it holds the ball, and its kicker is charged."""
        snapshot = self._simulation.now.snapshot
        holder = snapshot.possession
        return holder if holder and snapshot.kickers_ready[snapshot.roster.names.index(holder)] else None

    @property
    def off_field(self) -> Container[str]:
        """The robots that do not take part now."""
        return self._simulation.state.absences

    @property
    def state(self) -> TaskState:
        """Score, reward and end."""
        state: Any = self._simulation.state
        assert isinstance(state, TaskState)
        return state

    @property
    def tick(self) -> int:
        """Control ticks since it began."""
        return self._simulation.now.tick

    def briefing(self, robot: str) -> Briefing:
        """The briefing of a robot."""
        return Briefing.of(robot, self._simulation.setup())

    def picture(self) -> NDArray[np.uint8]:
        """A picture from above, shape (height, width, 3).

        Raises:
            TouchlineError: matplotlib is not installed.
        """
        need("render_mode needs matplotlib", "study", "matplotlib")
        from touchline.drawing.picture import drawn, pixels

        fields = {key: one for key, one in self._simulation.now.world.items() if key != "sensors"}
        figure, _, _ = drawn(self._simulation.setup(), [validated(World, fields)], PICTURE_WIDTH)
        return pixels(figure)

    def step(self, commands: Mapping[str, Command]) -> None:
        """One tick: the controlled robots do these commands, the others what their brains answer."""
        all_commands = {**commands, **self._match.answers(self._others)}
        tick = self._simulation.step(all_commands)
        if self._recording is not None:
            self._recording.add(tick, all_commands)
        self._ask()

    def _ask(self) -> None:
        """Hear what the advisers would do now; a brain sees every sight once, in order."""
        self.advice = self._match.answers(self._advised)
        """Controlled robot → the command that its adviser would give now; empty without advisers."""
