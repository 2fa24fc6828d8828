"""The sparring teams of `examples/sparring`: each plays in its style."""

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from robot_agent.loading.brain_loader import load_brain
from robot_agent.sdk.contract import Briefing
from schemas.config.match_config import load_match
from schemas.messages.command import Command, KickMode
from schemas.messages.radio import Motion
from schemas.messages.sight import ReceivedRadio
from schemas.soccer.game import EventKind
from support.imports import forgotten_imports
from touchline import skills
from touchline.play.play_match import InProcessMatch

FOLDER = Path(__file__).parents[3] / "examples"
POSES = {
    "cyan1": (-10.5, 0.0, 0.0),
    "cyan2": (-2.0, 1.0, 0.0),
    "cyan3": (-2.0, -2.0, 0.0),
    "cyan4": (-5.0, 3.0, 0.0),
    "cyan5": (-6.0, 0.0, 0.0),
}
Acts = Callable[..., dict[str, Command]]


@pytest.fixture(autouse=True, scope="module")
def sparring() -> Iterator[None]:
    with forgotten_imports(FOLDER):
        yield


@pytest.fixture
def acts(setup, sight_of) -> Acts:
    """The commands of a team's robots, each at its pose, that see a ball and opponents."""

    def commands(
        brain: str, ball: tuple[float, float], opponents: tuple[tuple[float, float], ...]
    ) -> dict[str, Command]:
        said = {name: ReceivedRadio(age=0.0, self=Motion(x=x, y=y, heading=h)) for name, (x, y, h) in POSES.items()}
        found = {}
        for name, pose in POSES.items():
            radio = {other: word for other, word in said.items() if other != name}
            others = (*opponents, *(other[:2] for mate, other in POSES.items() if mate != name))
            sight = sight_of(1, name, pose, ball=ball, obstacles=others, radio=radio)
            found[name] = load_brain(brain, Briefing.of(name, setup), FOLDER).act(sight)
        return found

    return commands


def test_early_shoots_on_the_run(setup, sight_of):
    brain = load_brain("sparring.early:Early", Briefing.of("cyan2", setup), FOLDER)
    command = brain.act(aimed(setup, sight_of, 5.2, (2.0, 0.0, 0.0)))
    assert command.kick is not None
    assert command.drive.vx > 1.0


def test_press_closes_the_ball_in_with_three_robots(acts):
    ball = (0.0, 0.0)
    commands = acts("sparring.press:Press", ball, ((0.35, 0.0), (4.0, 3.0)))
    toward = [name for name in POSES if _nears(commands[name], POSES[name], ball) > 1.0]
    assert toward == ["cyan2", "cyan3", "cyan4"]


def test_deep_leaves_the_ball_to_opponents_that_are_far_from_its_goal(acts):
    commands = acts("sparring.deep:Deep", (4.0, 0.0), ((4.35, 0.0),))
    assert not any(command.dribble for name, command in commands.items() if name != "cyan1")


def test_deep_lobs_at_the_goal(setup, sight_of):
    kick = load_brain("sparring.deep:Deep", Briefing.of("cyan2", setup), FOLDER).act(aimed(setup, sight_of, 4.0)).kick
    assert kick is not None
    assert kick.mode is KickMode.LOB


@pytest.mark.slow
@pytest.mark.parametrize("brain", ["sparring.early:Early", "sparring.press:Press", "sparring.deep:Deep"])
def test_a_sparring_team_takes_its_kick_off(brain):
    team = {"name": brain, "brain": brain}
    config = load_match(None, {"rules": "msl", "teams": {"cyan": team, "magenta": team}})
    match, kinds = InProcessMatch(config, brain_folder=FOLDER, chained=False), list[EventKind]()
    while EventKind.IN_PLAY not in kinds and match.simulation.now.time < 15.0:
        kinds += [event.kind for event in match.step().events]
    match.close()
    assert kinds.index(EventKind.START) < kinds.index(EventKind.IN_PLAY)
    assert EventKind.FOUL not in kinds[: kinds.index(EventKind.IN_PLAY)]


def aimed(setup, sight_of, x: float, velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)):
    """The sight of a robot at `x` that holds the ball and faces the widest lane into the goal, beside the keeper."""
    keeper = (10.9, -0.5)
    aim, _ = skills.best_place((x + setup.dribble.gap, 0.0), [keeper], setup.pitch)
    heading = math.atan2(aim, setup.pitch.goal_line - x)
    ball = x + setup.dribble.gap * math.cos(heading), setup.dribble.gap * math.sin(heading)
    pose = (x, 0.0, heading)
    return sight_of(1, "cyan2", pose, velocity, ball, holding=True, kicker_ready=True, obstacles=(keeper,))


def _nears(command: Command, pose: tuple[float, float, float], ball: tuple[float, float]) -> float:
    """m/s at which a robot nears the ball by its demand."""
    x, y, heading = pose
    way = math.atan2(ball[1] - y, ball[0] - x) - heading
    return command.drive.vx * math.cos(way) + command.drive.vy * math.sin(way)
