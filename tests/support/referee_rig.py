"""A rig for the referee: a world of points that does what the referee asks and nothing else."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.soccer.rule_book import load_rule_book
from schemas.frames import Pose
from schemas.messages.soccer.game import GameEvent, RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName, EventKind, Phase, Point
from sim_host.snapshot import BallState, Impact, ObstacleState, RobotState, RobotStates, Roster, Snapshot
from sim_host.soccer.referee.core import Referee, Ruling
from sim_host.soccer.referee.match_constants import MatchConstants


class RefereeRig:
    """Ball and robots as points at rest, moved by the test and by the referee's placements.

    Robots stand where no restart in the middle of the field disturbs them; `mirrored` swaps colours and turns the
    field by π.
    """

    def __init__(
        self,
        profile: str = "msl",
        rules: str | None = None,
        mirrored: bool = False,
        dt: float = 0.02,
        magenta_types: dict[str, str] | None = None,
        size: int = 5,
        **options: Any,
    ) -> None:
        chosen = load_profile(profile)
        self.dt = dt
        self.book = load_rule_book(rules or profile)
        self.pitch, self.radius, self.hull = chosen.field, chosen.ball.radius, chosen.robot.radius
        self.mirrored = mirrored
        self.roster = Roster.of(
            load_match(
                None, {"teams.magenta.types": magenta_types or {}, **{f"teams.{side}.size": size for side in Side}}
            ),
            chosen,
        )
        self.starts = {}
        for name, side in zip(self.roster.names, self.roster.sides, strict=True):
            row, column = divmod(int(name.removeprefix(side)) - 1, 5)
            self.starts[name] = Pose(-5.6 - 0.6 * column, -4.0 - 0.6 * row, 0.5).team(side.attack(1))
        settings = {"duration": None, "kick_off": Side.CYAN, "automatic": True, "starts": self.starts} | options
        settings["kick_off"] = self.side(settings["kick_off"])
        self.referee = Referee(self.book, self.pitch, chosen.ball, self.roster, **settings)
        self.constants = MatchConstants(
            self.book,
            self.pitch,
            chosen.ball,
            self.roster,
            half_duration=self.book.periods.half_duration,
            kick_off=settings["kick_off"],
            automatic=settings["automatic"],
            starts=self.starts,
        )
        """For functions of the referee that are called by themselves."""
        self.state = self.referee.begin()
        self.at = 0
        self.ball: tuple[float, float, float] = (0.0, 0.0, self.radius)
        self.velocity = (1.0, 0.0, 0.0)
        self.robots = {name: (pose.x, pose.y) for name, pose in self.starts.items()}
        self._stood: dict[str, tuple[float, float]] = {}
        self.events: list[GameEvent] = []
        self.obstacles: tuple[ObstacleState, ...] = ()
        self.refbox = False
        """A league's referee box is connected."""

    def side(self, side: Side) -> Side:
        return side.opponent if self.mirrored else side

    def robot(self, name: str) -> str:
        if not self.mirrored:
            return name
        return f"{(side := self.roster.side_of(name)).opponent}{name.removeprefix(side)}"

    def side_sign(self, name: str) -> int:
        """Sign of the x direction that the side of a robot attacks in the first half."""
        return self.roster.side_of(name).attack(1)

    def _turned(self, x: float, y: float) -> tuple[float, float]:
        return (-x, -y) if self.mirrored else (x, y)

    def snapshot(
        self,
        touches: Sequence[str] = (),
        kicked: str | None = None,
        possession: str | None = None,
        silent: Sequence[str] = (),
        motions: Mapping[str, tuple[float, float, float]] = {},
        contacts: Sequence[tuple[str, str]] = (),
        impacts: Sequence[tuple[str, str]] = (),
        spin: tuple[float, float] | None = None,
        level: Sequence[str] = (),
    ) -> Snapshot:
        """What there is to see; `motions`: robot → heading in rad, vx and vy in m/s; `contacts`: pairs of robots.

        `impacts`: pairs that hit each other along the line between their centres, with their motions of this tick.
        `level`: the last robots of `touches`, if they touched the ball at the same time.
        A ball without another `spin`, in rad/s, rolls.
        """
        turning = spin or (-self.velocity[1] / self.radius, self.velocity[0] / self.radius)
        robots = self._robot_states(motions)
        ball = BallState(
            *self._turned(*self.ball[:2]), self.ball[2], *self._turned(*self.velocity[:2]), self.velocity[2]
        )
        seen = tuple(self.robot(name) for name in touches)
        kicker, holder = (None if name is None else self.robot(name) for name in (kicked, possession))
        gone = tuple(self.robot(name) for name in silent)
        names = self.roster.names
        pairs, hits = (
            sorted(sorted(names.index(self.robot(name)) for name in pair) for pair in some)
            for some in (contacts, impacts)
        )
        return Snapshot(
            self.at,
            self.at * self.dt,
            self.roster,
            robots,
            ball,
            holder,
            seen,
            kicked=kicker,
            silent=gone,
            refbox=self.refbox,
            contacts=tuple((first, second) for first, second in pairs),
            impacts=tuple(_impact(robots, first, second) for first, second in hits),
            ball_spin=self._turned(*turning),
            level=tuple(self.robot(name) for name in level),
            obstacles=self.obstacles,
        )

    def _robot_states(self, motions: Mapping[str, tuple[float, float, float]]) -> RobotStates:
        """The same object while all robots rest: to make it takes as long as the referee's tick."""
        if motions or self._stood != self.robots:
            self._states = RobotStates(
                self._seen(name, *motions.get(self.robot(name), (0.0, 0.0, 0.0))) for name in self.roster.names
            )
            self._stood = {} if motions else dict(self.robots)
        return self._states

    def _seen(self, name: str, heading: float, vx: float, vy: float) -> RobotState:
        at, velocity = self._turned(*self.robots[self.robot(name)]), self._turned(vx, vy)
        return RobotState(*at, 0.4, heading + math.pi * self.mirrored, *velocity, 0.0, False)

    def tick(
        self,
        ball: Sequence[float] | None = None,
        touches: Sequence[str] = (),
        actions: Sequence[RefereeAction] = (),
        **seen: Any,
    ) -> Ruling:
        """One tick with the ball at `ball` (x, y and perhaps z); `seen` as `snapshot` takes it."""
        self.at += 1
        if ball is not None:
            self.ball = (ball[0], ball[1], ball[2] if len(ball) > 2 else self.radius)
        ruling = self.referee.step(self.state, self.snapshot(touches, **seen), actions, self.dt)
        self.state = ruling.state
        self.events.extend(ruling.events)
        for placement in ruling.placements:
            x, y = self._turned(placement.x, placement.y)
            if placement.body == "ball":
                self.ball = (x, y, self.radius)
            else:
                self.robots[self.robot(placement.body)] = (x, y)
        return ruling

    def run(self, seconds: float) -> list[Ruling]:
        return [self.tick() for _ in range(round(seconds / self.dt))]

    def play_on(self, seconds: float, **seen: Any) -> list[Ruling]:
        """Tick while the ball makes progress: every 2 s it is 4 m away from where it was; `seen` as in `tick`."""
        return [
            self.tick((1.0 + self.at * self.dt // 2.0 % 2.0 * 4.0, 0.0), **seen)
            for _ in range(round(seconds / self.dt))
        ]

    def until(self, done: Callable[[Any], bool], limit: float = 60.0) -> "RefereeRig":
        """Tick until the state is as wanted."""
        for _ in range(round(limit / self.dt)):
            if done(self.state):
                return self
            self.tick()
        raise AssertionError(f"not reached within {limit} s; the state is {self.state}")

    def playing(self, ball: Sequence[float] = (1.0, 0.0), touches: Sequence[str] = ("cyan2",)) -> "RefereeRig":
        """Bring the game into play, with the ball at `ball`, touched last by `touches`."""
        self.until(lambda state: state.running)
        takers = [name for name in self.roster.names if self.roster.side_of(name) is self.state.side][1:3]
        self.tick((1.0, 0.0), [self.robot(takers[0])] if touches else [])
        self.tick((1.0, 0.0), [self.robot(name) for name in takers[::-1]] if touches else [])
        assert self.state.phase is Phase.PLAY and (self.state.set_piece is None or not touches)
        self.tick(ball, touches)
        assert self.state.phase is Phase.PLAY
        return self

    def crossing(self, before: Sequence[float], now: Sequence[float], touches: Sequence[str] = ("cyan2",)) -> Ruling:
        """In play, the ball goes from `before` to `now` in one tick."""
        self.playing(before, touches)
        return self.tick(now)

    def ask(self, name: str, side: Side | None = None, place: Sequence[float] | None = None, **more: Any) -> Ruling:
        """One tick with one action."""
        where = None if place is None else self._turned(place[0], place[1])
        action = RefereeAction(
            action=ActionName(name),
            side=None if side is None else self.side(side),
            place=None if where is None else Point(x=where[0], y=where[1]),
            **more,
        )
        return self.tick(actions=[action])

    def unmirrored(self, event: GameEvent) -> tuple[object, ...]:
        """What the event would be if this match were not mirrored."""
        sign = -1 if self.mirrored else 1
        robot = event.robot and self.robot(event.robot)
        robots = sorted(self.robot(name) for name in event.robots)
        side = event.side and self.side(event.side)
        place = event.place and (sign * event.place.x + 0.0, sign * event.place.y + 0.0)
        score = event.score and tuple(event.score.of(self.side(one)) for one in Side)
        return event.tick, event.kind, event.rule, side, robot, robots, place, score, event.measured, event.card

    def fouls(self) -> list[tuple[str | None, str | None]]:
        """Rule and robot of each foul."""
        return [(event.rule, event.robot) for event in self.events if event.kind is EventKind.FOUL]

    def kinds(self) -> list[EventKind]:
        return [event.kind for event in self.events]


def _impact(robots: RobotStates, first: int, second: int) -> Impact:
    one, other = robots[first], robots[second]
    away = max(1e-9, math.dist((one.x, one.y), (other.x, other.y)))
    direction = ((other.x - one.x) / away, (other.y - one.y) / away)
    return Impact(first, second, direction, (one.vx, one.vy), (other.vx, other.vy))
