"""Drawings of robots' programs: published for their own side, turned into the field frame, without effect."""

import pytest

from runtime.access.accounts import Account
from runtime.access.rights import Rights
from runtime.bus.batch_publisher import BatchPublisher
from schemas.config.match_config import MatchConfig
from schemas.messages.command import Command, Drive
from schemas.messages.debug import Debug, DebugPoint
from schemas.messages.manual import ManualDrive
from schemas.messages.radio import Radio
from schemas.messages.sight import Sight
from schemas.side import Side
from schemas.topics import APPLIED, BELIEF, DEBUG, MANUAL, SIGHT, WORLD
from sim_host.server.reports.debug_publisher import DebugPublisher
from support.host_rig import TEAMS, HostRig

CONFIG = MatchConfig.model_validate({"name": "drawn", "duration": 2.0, "teams": TEAMS})
ROBOTS = {Side.CYAN: ["cyan1", "cyan2"], Side.MAGENTA: ["magenta1"]}


class Draws:
    """Drives ahead, and draws where it is."""

    def __init__(self, *, draws: bool = True) -> None:
        self.draws = draws

    def act(self, sight: Sight) -> Command:
        point = DebugPoint(x=sight.self.x, y=sight.self.y, colour="red")
        debug = Debug(values={"tick": sight.tick}, points=[point]) if self.draws else None
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0), radio=Radio(role="a"), debug=debug)


def rig_of(*, draws: bool = True) -> HostRig:
    rig = HostRig(CONFIG, settings={})
    for robot in ("cyan1", "cyan2", "magenta1"):
        rig.join(robot, Draws(draws=draws))
    return rig


@pytest.mark.parametrize("robot", ["cyan2", "magenta1"])
def test_a_drawing_is_published_in_the_field_frame_with_the_tick_of_its_sight(robot: str) -> None:
    rig = rig_of()
    drawings, worlds = rig.listen(DEBUG), rig.listen(WORLD)
    rig.begin()
    rig.ticks(3)
    positions = {world.tick: world.robots[robot] for world in worlds.all()}
    published = [frame for frame in drawings.all() if frame.robot == robot]
    assert [frame.tick for frame in published] == [0, 1, 2]
    for frame in published:
        assert frame.time == pytest.approx(frame.tick * 0.02)
        assert frame.debug.values == {"tick": frame.tick}
        truth = positions[frame.tick]
        assert frame.debug.points[0].x == pytest.approx(truth.x, abs=0.3)
        assert frame.debug.points[0].y == pytest.approx(truth.y, abs=0.3)


@pytest.mark.parametrize(
    ("cyan_attacks", "x"), [(1, {"cyan1": 2.0, "magenta1": -2.0}), (-1, {"cyan1": -2.0, "magenta1": 2.0})]
)
def test_a_drawing_is_turned_as_its_side_attacks_in_this_half(cyan_attacks: int, x: dict[str, float]) -> None:
    rig = HostRig(CONFIG, settings={})
    drawings = rig.listen(DEBUG)
    state = rig.host.simulation.state._replace(cyan_attacks=cyan_attacks)
    debug = Debug(points=[DebugPoint(x=2.0, y=0.0)])
    commands = {robot: Command(answers_tick=0, debug=debug) for robot in x}
    publisher = DebugPublisher(BatchPublisher(rig.seat()), 0.02)
    publisher.publish(commands, rig.host.simulation.roster, state)
    assert {drawing.robot: drawing.debug.points[0].x for drawing in drawings.all()} == x


def test_a_robot_under_manual_control_goes_on_drawing() -> None:
    rig = rig_of()
    drawings = rig.listen(DEBUG)
    rig.begin()
    rig.outside.publisher(MANUAL, robot="cyan1").put(ManualDrive(drive=Drive(vx=0.1)))
    rig.ticks(3)
    assert [drawing.tick for drawing in drawings.all() if drawing.robot == "cyan1"] == [0, 1, 2]


def test_a_match_with_drawings_is_the_same_match() -> None:
    chains, sights = [], []
    for draws in (True, False):
        rig = rig_of(draws=draws)
        applied, seen = rig.listen(APPLIED), rig.listen(SIGHT)
        rig.begin()
        rig.ticks(10)
        chains.append([message.chain for message in applied.all()])
        sights.append([message.encode() for message in seen.all()])
    assert chains[0] == chains[1]
    assert sights[0] == sights[1], "no sight has anything of a drawing"


def test_a_drawing_is_no_part_of_the_radio() -> None:
    beliefs, used = [], []
    for draws in (True, False):
        rig = rig_of(draws=draws)
        published = rig.listen(BELIEF)
        rig.begin()
        rig.ticks(4)
        beliefs.append([message.encode() for message in published.all()])
        used.append(rig.host.simulation.radio_use.of_robot("cyan1"))
    assert beliefs[0] == beliefs[1] != []
    assert used[0] == used[1]


def test_without_a_drawing_nothing_is_published() -> None:
    rig = rig_of(draws=False)
    drawings = rig.listen(DEBUG)
    rig.begin()
    rig.ticks(3)
    assert drawings.all() == []


@pytest.mark.parametrize(
    ("account", "robots"),
    [
        (Account.CYAN, []),
        (Account.MAGENTA, []),
        (Account.CYAN_COACH, ["team/cyan/debug/*"]),
        (Account.MAGENTA_COACH, ["team/magenta/debug/*"]),
        (Account.REFEREE, []),
        (Account.VIEWER, []),
        (Account.OPERATOR, ["team/*/debug/*"]),
        (Account.RECORDER, ["team/*/debug/*"]),
    ],
)
def test_only_the_own_coach_the_operator_and_recorders_read_drawings(account: Account, robots: list[str]) -> None:
    keys = Rights(account, ROBOTS).subscribes
    assert [key for key in keys if "/debug/" in key] == robots
    if account not in (Account.RECORDER,):
        assert not any(key.endswith("/command") for key in keys), "commands have drawings, too"
