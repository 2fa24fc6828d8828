import json

import pytest
from typer.testing import CliRunner, Result

from coach_gateway.access.referee_name import terminal_name
from schemas.messages.health import Health, RobotHealth
from schemas.messages.soccer.game import ActionReply, GameState, RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName, Phase, Score
from schemas.topics import ACTION, HEALTH, REFEREE_SEAT, STATE
from sim_host.server.services.referee_seat import RefereeSeat
from support.fake_host import FakeHost
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock
from support.terminal import Terminal
from touchline.commands import referee
from touchline.commands.cli.command_line import app


class TalkingClock(SteppedClock):
    """Lets the host publish whenever a client waits."""

    __slots__ = ("host",)

    def sleep_until(self, moment: float) -> None:
        super().sleep_until(moment)
        self.host.speak()


class Host(FakeHost):
    """Accepts `stop` and `corner`, refuses the rest, and publishes the same whenever its client waits."""

    def __init__(self) -> None:
        self.says: list[GameState | Health] = []
        answers = {ACTION: self._act, REFEREE_SEAT: RefereeSeat().handle}
        super().__init__(SharedState(), answers=answers, clock=SteppedClock(), in_threads=True)

    def speak(self) -> None:
        for message in self.says:
            self.put(STATE if isinstance(message, GameState) else HEALTH, message)

    def _act(self, action: RefereeAction) -> ActionReply:
        accepted = action.action in (ActionName.STOP, ActionName.CORNER)
        return ActionReply(accepted=accepted, reason="" if accepted else "the game is running")


@pytest.fixture
def host(terminal: Terminal) -> Host:
    there = Host()

    def make_clock() -> TalkingClock:
        clock = TalkingClock()
        clock.host = there
        return clock

    terminal.join(there, make_clock)
    return there


def touchline(*words: str) -> Result:
    return CliRunner().invoke(app, ["coach" if words[0] == "state" else "referee", *words], prog_name="touchline")


def test_an_accepted_action_is_a_success(host: Host) -> None:
    result = touchline("corner", "magenta")
    assert (result.exit_code, result.stdout) == (0, "corner accepted\n")
    assert [(action.action, action.side) for action in host.asked] == [(ActionName.CORNER, Side.MAGENTA)]


def test_a_refused_action_fails_with_the_referees_reason(host: Host) -> None:
    result = touchline("place-ball", "-3.5", "2")
    assert (result.exit_code, result.stderr) == (1, "touchline: refused: the game is running\n")
    assert host.asked[0].place is not None
    assert (host.asked[0].place.x, host.asked[0].place.y) == (-3.5, 2.0)


ABOUT = {
    referee.NoTarget: [],
    referee.SideTarget: ["cyan"],
    referee.RobotTarget: ["cyan1"],
    referee.PlaceTarget: ["-3.5", "2"],
}


@pytest.mark.parametrize("word", referee.REFEREE_COMMANDS)
def test_every_word_of_the_referee_box_asks_for_its_own_action(host: Host, word: str) -> None:
    """The actions that simatch's automatic referee has keys for."""
    deed = referee.REFEREE_COMMANDS[word]
    touchline(word, *ABOUT[deed.target])
    (asked,) = host.asked
    assert asked.action is deed.action
    assert word.replace("-", "") == deed.action.value.replace("_", "")
    assert asked.side == (Side.CYAN if deed.target is referee.SideTarget else None)
    assert asked.robot == ("cyan1" if deed.target is referee.RobotTarget else None)
    assert (asked.place is not None) == (deed.target is referee.PlaceTarget)


def test_a_terminal_keeps_its_name_as_referee_from_one_command_to_the_next(host: Host) -> None:
    touchline("corner", "magenta")
    touchline("stop")
    assert {action.referee for action in host.asked} == {terminal_name()}


def test_a_terminal_takes_shows_and_leaves_the_seat_of_the_referee(host: Host) -> None:
    holder = f"coach ({terminal_name()}) officiates\n"
    commands = ("seat", "take-over", "seat", "leave", "seat")
    results = [touchline(command) for command in commands]
    free = "the referee's seat is free\n"
    assert [(one.exit_code, one.stdout) for one in results] == [
        (0, output) for output in (free, holder, holder, free, free)
    ]
    left_again = touchline("leave")
    assert left_again.exit_code == 1
    assert left_again.stderr == f"touchline: refused: the seat is not held by coach ({terminal_name()})\n"


def test_every_action_has_one_word() -> None:
    assert len(referee.REFEREE_COMMANDS) == len(ActionName)
    assert {deed.action for deed in referee.REFEREE_COMMANDS.values()} == set(ActionName)


def test_a_name_that_no_robot_can_have_is_wrong_input(host: Host) -> None:
    result = touchline("repair", "Cyan 1")
    assert result.exit_code == 2 and "Cyan 1" in result.stderr
    assert host.asked == []


def test_an_action_in_a_match_without_a_host_is_wrong_input(host: Host) -> None:
    result = touchline("stop", "--match", "final")
    assert result.exit_code == 2
    assert 'match "final": no process answers game/action' in result.stderr


def test_the_state_is_shown_once_in_words_and_as_json(host: Host) -> None:
    host.says = [GameState(tick=5, time=61.0, clock=61.0, phase=Phase.PLAY, score=Score(cyan=2))]
    assert touchline("state").stdout == " 1:01.0  half 1  Simple 2 : 0 NuBot  play\n"
    shown = json.loads(touchline("state", "--json").stdout)
    assert (shown["phase"], shown["score"]) == ("play", {"cyan": 2, "magenta": 0})


def test_the_state_of_a_match_that_waits_for_robots_has_the_number_of_present_ones(host: Host) -> None:
    robots = {"cyan1": RobotHealth(alive=True), "cyan2": RobotHealth()}
    host.says = [Health(tick=0, time=0.0, pace="lockstep", real_time_factor=0.0, robots=robots)]
    result = touchline("state")
    assert result.exit_code == 1
    assert result.stderr == 'touchline: match "friendly" has not begun: 1 of 2 robots are connected\n'


def test_a_host_that_publishes_no_state_is_reported(host: Host) -> None:
    result = touchline("state")
    assert result.exit_code == 2
    assert 'match "friendly": the host publishes no state of it' in result.stderr
