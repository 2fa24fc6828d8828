"""The shared estimate: what this robot and its teammates believe, fused, each part with its age.

Own pictures and the freshest ball of the team are the world model's. This adds what teammates send besides (`extra`):
the opponents that each sees, and when it could be at the ball. All robots compare the same numbers that way, their own
included as they were sent, and so agree on who plays the ball.
"""

import math
from typing import NamedTuple

from robot_agent.sdk.contract import Briefing
from robot_agent.sdk.world_model import STALE, WorldBelief, WorldModel, places_of
from robot_agent.teams.reference.parameters import Parameters
from schemas.frames import Point
from schemas.messages.sight import Sight

HOLDS = -1.0
"""s until a robot that holds the ball could be at it: less than for any other."""
MOST_OPPONENTS = 6
"""Opponents in a radio message: two entries each, of sixteen."""
_PLACES = tuple((f"x{number}", f"y{number}") for number in range(MOST_OPPONENTS))
"""Names of their entries."""


class Words(NamedTuple):
    """What a teammate sent besides its pose and ball."""

    arrival: float
    """s until it could be at the ball, by now; infinite when it does not know."""
    age: float
    """s since it was sent."""


class SharedEstimate(WorldModel):
    """The world model, fused with the opponents that teammates report."""

    def __init__(self, briefing: Briefing, parameters: Parameters) -> None:
        super().__init__(briefing)
        self._briefing = briefing
        self._parameters = parameters
        self.words: dict[str, Words] = {}
        """Teammate → its newest words, while they are fresh."""
        self.stuck = 0.0
        """s for which this robot has been stuck."""
        self.height: float | None = None
        """m; height of the ball's centre in the newest picture; None for a ball that this robot does not see."""

    @property
    def is_flying(self) -> bool:
        """Whether the ball is too high for a dribbler."""
        return self.height is not None and self.height > self._parameters.flies_above

    def update(self, sight: Sight) -> WorldBelief:
        """The belief after one more sight."""
        belief = super().update(sight)
        self.stuck = self.stuck + belief.dt if sight.stuck else 0.0
        ball = sight.ball
        self.height = ball.z if ball is not None and ball.visible else None
        self.words = {
            name: Words(arrival_in(received.extra) - received.age, received.age)
            for name, received in sight.radio.items()
            if received.age <= STALE
        }
        return belief._replace(opponents=self._with_reports(belief, sight))

    def _with_reports(self, belief: WorldBelief, sight: Sight) -> list[Point]:
        """The own opponents, and those that only teammates see."""
        theirs = self._briefing.setup.teams[self._briefing.side.opponent].robots
        same, most = self._parameters.same_robot, len(theirs)
        known = list(belief.opponents)
        taken = [*known, belief.me[:2], *places_of(belief.mates).values()]
        for received in sorted(sight.radio.values(), key=lambda received: received.age):
            if len(known) >= most or received.age > self._parameters.told_age:
                break
            for place in reported(received.extra):
                is_new = len(known) < most and all(math.dist(place, other) > same for other in taken)
                if is_new and self._is_ground(place):
                    known.append(place)
                    taken.append(place)
        return known

    def _is_ground(self, place: Point) -> bool:
        """Whether a robot can be there; a teammate of another author may use the same names otherwise."""
        pitch = self._briefing.setup.pitch
        return abs(place[0]) <= pitch.goal_line + pitch.border and abs(place[1]) <= pitch.touch_line + pitch.border


def report(opponents: list[Point], me: Point, arrival: float) -> dict[str, float]:
    """The words of one robot: its arrival at the ball, and the opponents nearest to it, in centimetres."""
    words = {"arrival": round(arrival, 2)} if math.isfinite(arrival) else {}
    nearest = sorted(opponents, key=lambda place: math.dist(place, me))[:MOST_OPPONENTS]
    for (name_x, name_y), (x, y) in zip(_PLACES, nearest, strict=False):
        words[name_x], words[name_y] = round(x, 2), round(y, 2)
    return words


def arrival_in(words: dict[str, float | int | bool | str]) -> float:
    """When a teammate could be at the ball, in its words: `HOLDS` with the ball, infinite where it sent no time."""
    arrival = words.get("arrival")
    return float(arrival) if isinstance(arrival, float | int) and arrival >= HOLDS else math.inf


def reported(words: dict[str, float | int | bool | str]) -> list[Point]:
    """The opponents in a teammate's words."""
    places = []
    for name_x, name_y in _PLACES:
        x, y = words.get(name_x), words.get(name_y)
        if not isinstance(x, (float, int)) or not isinstance(y, (float, int)):
            break
        places.append((float(x), float(y)))
    return places
