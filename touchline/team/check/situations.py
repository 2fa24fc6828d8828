"""Sights of situations that are rare in play: made from a sight of a match by replacing parts of it."""

from collections.abc import Iterator
from typing import Any, NamedTuple

from msgspec.structs import replace

from schemas.messages.radio import BallBelief, Motion
from schemas.messages.setup import Setup
from schemas.messages.sight import BallSight, ReceivedRadio, Sight
from schemas.messages.soccer.game import DisciplinaryRecord
from schemas.soccer.game import GameStage, OffField, Point, TeamPhase

TICKS = 15
"""Sights in a row of each situation."""
GAP = 500
"""Ticks between two situations: a time without sights, as after a cut link."""
_FAR = 1e4
"""Age of what was seen long ago, in s."""
_OUTSIDE_PLAY = (TeamPhase.PRE_GAME, TeamPhase.STOPPED, TeamPhase.HALF_TIME, TeamPhase.PARKING, TeamPhase.FULL_TIME)
SET_PIECES = tuple(phase for phase in TeamPhase if phase.ours or phase.theirs or phase is TeamPhase.DROP_BALL)


class NamedSight(NamedTuple):
    """A sight of one situation, with its name in messages."""

    name: str
    sight: Sight


def over_time(situations: Iterator[NamedSight], tick_s: float) -> Iterator[NamedSight]:
    """Each situation for `TICKS` ticks, with time between two of them."""
    for number, (name, sight) in enumerate(situations):
        first = sight.tick + number * GAP
        for tick in range(first, first + TICKS):
            yield NamedSight(name, replace(sight, tick=tick, time=tick * tick_s))


def ball_unseen(sight: Sight, setup: Setup) -> Iterator[NamedSight]:
    """The ball was never seen, or long ago, in play and at a restart without a spot."""
    del setup
    old = BallSight(x=30.0, y=-30.0, vx=5.0, vy=0.0, age=_FAR, visible=False)
    for phase in (TeamPhase.PLAY, TeamPhase.OUR_KICK_OFF, TeamPhase.THEIR_FREE_KICK):
        game = replace(sight.game, phase=phase, running=True, spot=None)
        for name, ball in (("never seen", None), ("seen long ago", old)):
            yield NamedSight(
                f"the ball {name}, {phase.value}",
                replace(sight, ball=ball, holding=False, obstacles=[], radio={}, game=game),
            )


def stopped(sight: Sight, setup: Setup) -> Iterator[NamedSight]:
    """The game does not run: before it, after it, between halves, after STOP."""
    del setup
    at_feet = BallSight(x=sight.self.x + 0.3, y=sight.self.y, vx=0.0, vy=0.0)
    for phase in _OUTSIDE_PLAY:
        for holding in (False, True):
            game = replace(sight.game, phase=phase, running=False, spot=None, left=None)
            yield NamedSight(phase.value, replace(sight, game=game, holding=holding, ball=at_feet))


def sent_off(sight: Sight, setup: Setup) -> Iterator[NamedSight]:
    """The robot is off the field, or all its teammates are."""
    mates = [name for team in setup.teams.values() if sight.robot in team.robots for name in team.robots]
    for reason in OffField:
        record = DisciplinaryRecord(yellow=2, red=1, off_field=reason, left=None)
        others = [name for name in mates if name != sight.robot]
        for who, gone in (("the robot", [sight.robot]), ("all teammates", others)):
            game = replace(sight.game, phase=TeamPhase.PLAY, running=True, robots=dict.fromkeys(gone, record))
            yield NamedSight(f"{who} off the field ({reason.value})", replace(sight, game=game, radio={}))


def set_pieces(sight: Sight, setup: Setup) -> Iterator[NamedSight]:
    """Each restart before and after START, with the spot of its kind; penalties of a shoot-out, too."""
    pitch = setup.pitch
    spots = {
        "corner": Point(x=pitch.goal_line, y=pitch.touch_line),
        "throw_in": Point(x=2.0, y=-pitch.touch_line),
        "goal_kick": Point(x=-pitch.goal_line + 2.0, y=1.0),
        "penalty": Point(x=pitch.goal_line - pitch.penalty_mark, y=0.0),
    }
    for phase in SET_PIECES:
        kind = phase.value.partition("_")[2] if phase.ours or phase.theirs else phase.value
        spot = spots.get(kind, Point(x=0.0, y=0.0))
        if phase.theirs:
            spot = Point(x=-spot.x, y=-spot.y)
        ball = BallSight(x=spot.x, y=spot.y, vx=0.0, vy=0.0)
        stages = (GameStage.REGULAR, GameStage.SHOOT_OUT) if kind == "penalty" else (GameStage.REGULAR,)
        for running in (False, True):
            for stage in stages:
                game = replace(sight.game, phase=phase, running=running, spot=spot, stage=stage)
                when = "after START" if running else "before START"
                yield NamedSight(f"{phase.value} {when}", replace(sight, game=game, ball=ball, holding=False))


def radio_fields(sight: Sight, setup: Setup) -> Iterator[NamedSight]:
    """Messages of teammates that lack each field, or have content that the team does not know."""
    mates = [name for team in setup.teams.values() if sight.robot in team.robots for name in team.robots]
    mates = [name for name in mates if name != sight.robot]
    whole: dict[str, Any] = {
        "self": Motion(x=1.0, y=2.0, heading=0.5),
        "ball": BallBelief(x=0.5, y=0.5),
        "role": "unknown role",
        "intention": "unknown intention",
        "pass_to": "nobody_of_this_team",
        "extra": {"unknown": 1.0, "text": "text", "flag": True, "large": 10**12},
    }
    cases = {"without fields": ReceivedRadio(age=_FAR), "with unknown content": ReceivedRadio(age=0.02, **whole)}
    for name in whole:
        rest = {key: value for key, value in whole.items() if key != name}
        cases[f"without {name}"] = ReceivedRadio(age=0.02, **rest)
    for kind, value in (("text", "x"), ("a number", -1e9), ("true", True)):
        extra = {key: value for received in sight.radio.values() for key in received.extra}
        cases[f"with {kind} in place of each value in extra"] = ReceivedRadio(age=0.02, extra=extra)
    for name, received in cases.items():
        yield NamedSight(f"radio {name}", replace(sight, radio=dict.fromkeys(mates, received)))


def repeated(sight: Sight, setup: Setup) -> Iterator[NamedSight]:
    """The same sight twice, a gap, and a world that is set up anew."""
    del setup
    game = replace(sight.game, phase=TeamPhase.PLAY, running=True)
    yield NamedSight("a sight twice", replace(sight, game=game))
    yield NamedSight("a new episode", replace(sight, game=replace(game, episode=game.episode + 1), ball=None))
