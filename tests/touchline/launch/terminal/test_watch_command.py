"""`touchline watch`: a match in the terminal until its host goes, and what one brain shows."""

import io

import pytest
from rich.console import Console
from rich.text import Text
from typer.testing import CliRunner

from schemas.errors import TouchlineError
from schemas.messages.debug import Debug, RobotDebug
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase, Score
from schemas.topics import DEBUG, EVENT, STATE, WORLD
from support.in_process_bus import SharedState
from support.messages import make_setup, make_world
from support.stepped_clock import SteppedClock
from touchline.commands.cli.command_line import app
from touchline.commands.watch import watch_lines, watch_on
from touchline.launch.terminal.debug_values import values

SETUP = make_setup()


def plain(rows: list[Text]) -> list[str]:
    return [row.plain for row in rows]


def test_values_are_listed_by_name() -> None:
    debug = Debug(values={"gap": 0.123456789, "plan": "pass\n", "open": True, "count": 3})
    drawings = {"cyan2": RobotDebug(tick=1, time=0.02, robot="cyan2", debug=debug)}
    rows = ["cyan2 shows", " gap    0.123457", " plan   pass�", " open   true", " count  3"]
    assert plain(values("cyan2", drawings)) == rows
    assert plain(values("cyan1", drawings)) == ["cyan1 shows no values"]


class HostOfTicks(SteppedClock):
    """Goes on by a tick whenever the watcher waits; after three ticks the host leaves."""

    __slots__ = ("host", "tick")

    def sleep_until(self, moment: float) -> None:
        """Play the next tick."""
        super().sleep_until(moment)
        self.tick += 1
        if self.tick > 3:
            self.host.close()
        else:
            at = {"tick": self.tick, "time": self.tick * 0.02}
            debug = Debug(values={"gap": self.tick / 8})
            drawn = RobotDebug(**at, robot="cyan2", debug=debug)
            self.host.publisher(DEBUG, side="cyan", robot="cyan2").put(drawn)
            self.host.publisher(WORLD).put(make_world(self.tick, (self.tick, 0.0)))


def watched(monkeypatch: pytest.MonkeyPatch, robot: str | None) -> str:
    """The last state of the panel of a match of three ticks."""
    medium, clock = SharedState(), HostOfTicks()
    clock.host, clock.tick = medium.open_bus("friendly", SteppedClock()), 0
    clock.host.declare_alive("host", "host")
    monkeypatch.setattr("coach_gateway.match.host_client.HostClient.setup", lambda self: SETUP)
    console = Console(file=io.StringIO(), force_terminal=True, width=140, height=40, color_system="truecolor")
    watch_on(medium.open_bus("friendly", clock), console, robot)
    shown: str = console.file.getvalue()  # type: ignore[attr-defined]
    return shown[shown.rindex("Simple") :]


def test_a_match_is_shown_until_its_host_goes_with_the_values_of_one_robot(monkeypatch: pytest.MonkeyPatch) -> None:
    shown = watched(monkeypatch, "cyan2")
    assert "cyan2 shows" in shown and "gap  0.375" in shown
    assert "gap" not in watched(monkeypatch, None)


def test_a_robot_that_does_not_take_part_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(TouchlineError, match="--robot cyan77: no such robot takes part"):
        watched(monkeypatch, "cyan77")


def test_values_are_not_listed_in_plain_lines() -> None:
    result = CliRunner().invoke(app, ["watch", "--robot", "cyan2"])
    assert result.exit_code == 2
    assert "--robot lists values on a terminal only" in " ".join(result.output.split())


def test_a_match_without_a_host_is_wrong_input() -> None:
    with pytest.raises(TouchlineError, match='match "cup": no process answers host/setup'):
        watch_on(SharedState().open_bus("cup", SteppedClock()), Console(file=io.StringIO()))


class HostOf(SteppedClock):
    """Publishes its next message whenever the watcher waits, and leaves after the last."""

    __slots__ = ("host", "messages")

    def sleep_until(self, moment: float) -> None:
        super().sleep_until(moment)
        if not self.messages:
            self.host.close()
            return
        message = self.messages.pop(0)
        self.host.publisher(STATE if isinstance(message, GameState) else EVENT).put(message)


def lines_of(*messages: GameState | GameEvent) -> list[str]:
    medium, clock, logged = SharedState(), HostOf(), list[str]()
    clock.host, clock.messages = medium.open_bus("friendly", SteppedClock()), list(messages)
    clock.host.declare_alive("host", "host")
    watch_lines(medium.open_bus("friendly", clock), logged.append)
    return logged


def state(clock: float, phase: Phase = Phase.PLAY, side: Side | None = None) -> GameState:
    return GameState(tick=1, time=clock, clock=clock, phase=phase, side=side, running=False, score=Score(cyan=2))


def test_a_line_is_logged_for_every_event_and_when_more_changes_than_the_clock() -> None:
    event = GameEvent(tick=5, time=0.1, clock=0.1, kind=EventKind.BALL_OUT, rule="ball_out", text="over the touch line")
    throw_in = state(61.25, Phase.THROW_IN, Side.MAGENTA)
    assert lines_of(state(0.0), state(1.0), event, event, throw_in, state(62.0)) == [
        " 0:00.0  half 1  cyan 2 : 0 magenta  play",
        *[" 0:00.1  ball out: over the touch line"] * 2,
        " 1:01.2  half 1  cyan 2 : 0 magenta  throw in, magenta",
        " 1:02.0  half 1  cyan 2 : 0 magenta  play",
    ]


def test_lines_of_a_match_without_a_host_are_an_error_with_the_remedy() -> None:
    with pytest.raises(TouchlineError, match='match "cup": no host plays it there; name the match'):
        watch_lines(SharedState().open_bus("cup", SteppedClock()), lambda line: None)
