"""Orders from the terminal: what was typed in, and who has acknowledged it."""

import json

import pytest
from typer.testing import CliRunner, Result

from schemas.messages.coach import CoachMode, CoachOrder, CoachTest
from schemas.messages.command import KickMode
from schemas.messages.setup import Setup
from schemas.soccer.game import Point
from schemas.topics import SETUP
from support.fake_host import FakeHost
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock
from support.terminal import Terminal
from touchline.commands.cli.command_line import app


class Host(FakeHost):
    """All but the deaf robots acknowledge an order as soon as it comes."""

    def __init__(self) -> None:
        self.deaf: set[str] = set()
        self.refused: dict[str, str] = {}
        self._acknowledged = 0
        super().__init__(
            SharedState(), answers={SETUP: lambda _: self._acknowledge()}, clock=SteppedClock(), in_threads=True
        )

    def _acknowledge(self) -> Setup:
        for side, order in self.given_orders[self._acknowledged :]:
            names = [f"{side}{number}" for number in range(1, 6)]
            self.stand(side, order, refused=self.refused, **{name: name not in self.deaf for name in names})
            self._acknowledged += 1
        return self.setup


@pytest.fixture
def host(terminal: Terminal) -> FakeHost:
    return terminal.join(Host())


def coach(*words: str) -> Result:
    return CliRunner().invoke(app, ["coach", *words], prog_name="touchline")


def test_an_order_is_sent_and_the_robots_that_acknowledged_it_are_printed(host: Host) -> None:
    result = coach("order", "cyan", "--mode", "hold", "--max-speed", "1.5")
    ((side, order),) = host.given_orders
    assert (side, order.mode, order.max_speed) == ("cyan", CoachMode.HOLD, 1.5)
    everyone = "cyan1, cyan2, cyan3, cyan4, cyan5"
    assert result.stdout == f"order {order.sequence} to cyan: hold; acknowledged by {everyone}\n"
    assert result.exit_code == 0


def test_robots_that_do_not_acknowledge_are_waited_for_and_named(host: Host) -> None:
    host.deaf = {"magenta2", "magenta4"}
    result = coach("order", "magenta", "--wait", "1")
    assert result.stdout.endswith("acknowledged by magenta1, magenta3, magenta5; not yet by magenta2, magenta4\n")
    assert result.exit_code == 0


def test_an_order_that_robots_refuse_fails_and_names_them_with_the_reason(host: Host) -> None:
    host.refused = dict.fromkeys(("cyan1", "cyan2", "cyan3", "cyan4", "cyan5"), "unknown test: machine")
    result = coach("test", "cyan", "machine", "--robot", "cyan2")
    assert result.exit_code == 1
    everyone = "cyan1, cyan2, cyan3, cyan4, cyan5"
    assert result.stdout.endswith(f"test machine; refused by {everyone}: unknown test: machine\n")
    assert json.loads(coach("test", "cyan", "machine", "--robot", "cyan2", "--json").stdout)["refused"] == host.refused


def test_a_point_outside_the_field_is_wrong_input(host: Host) -> None:
    result = coach("test", "cyan", "move", "--robot", "cyan2", "--point-a", "50,0")
    assert result.exit_code == 2 and host.given_orders == []
    assert "point_a at (50, 0) is outside the field and its border; |x| is at most 12 m" in result.stderr


def test_the_result_of_an_order_is_printed_as_json_for_programs(host: Host) -> None:
    host.deaf = {"cyan5"}
    said = json.loads(coach("order", "cyan", "--json").stdout)
    assert said == {
        "side": "cyan",
        "sequence": host.given_orders[0][1].sequence,
        "status": "active",
        "acknowledged": ["cyan1", "cyan2", "cyan3", "cyan4"],
        "missing": ["cyan5"],
        "refused": {},
    }


def test_a_test_is_ordered_in_its_own_words(host: Host) -> None:
    words = ["--robot", "cyan2", "--receiver", "cyan3", "--point-a", "-2,1.5", "--point-b", "3,-1", "--angle-a", "-0.5"]
    result = coach("test", "cyan", "pass", *words, "--kick-speed", "4", "--avoid")
    assert result.exit_code == 0, result.stderr
    _, order = host.given_orders[0]
    assert order == CoachOrder(
        sequence=order.sequence,
        mode=CoachMode.TEST,
        test=CoachTest.PASS,
        robot_a="cyan2",
        robot_b="cyan3",
        point_a=Point(x=-2.0, y=1.5),
        point_b=Point(x=3.0, y=-1.0),
        angle_a=-0.5,
        kick_speed=4.0,
        avoid=True,
    )
    assert f"order {order.sequence} to cyan: test pass; acknowledged by" in result.stdout


def test_an_order_that_names_a_test_is_one(host: Host) -> None:
    coach("order", "cyan", "--test", "shoot", "--robot-a", "cyan2", "--kick-mode", "lob")
    _, order = host.given_orders[0]
    assert (order.mode, order.test, order.kick_mode) == (CoachMode.TEST, CoachTest.SHOOT, KickMode.LOB)


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (("test", "cyan", "move", "--robot", "cyan2"), "the test move needs point_a"),
        (("test", "cyan", "move", "--robot", "cyan2", "--point-a", "2"), "2 is no point; write x and y in m, like"),
        (("test", "cyan", "move", "--robot", "cyan2", "--point-a", "nan,1"), "nan,1 is no point"),
        (("test", "cyan", "juggle"), "juggle"),
        (("order", "cyan", "--mode", "hold", "--test", "stop"), "the mode hold has no test; leave out stop"),
        (("order", "cyan", "--angle-a", "90"), "--angle-a is 90.0"),
        (("order", "cyan", "--kick-speed", "50"), "--kick-speed is 50.0"),
        (("test", "cyan", "shoot", "--robot", "magenta1"), 'robot_a is "magenta1", no robot of cyan'),
        (("order", "cyan", "--wait", "-1"), "--wait"),
    ],
)
def test_an_impossible_order_is_wrong_input_and_is_not_sent(host: Host, words: tuple[str, ...], reason: str) -> None:
    result = coach(*words)
    assert result.exit_code == 2 and len(result.stderr.splitlines()) == 1
    assert reason in result.stderr
    assert host.given_orders == []
