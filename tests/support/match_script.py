"""A scripted match: four robots, ticks of 0.1 s, the ball in play from the second on."""

from collections.abc import Iterable
from typing import Any

from recordings.container.manifest import Manifest
from recordings.soccer.stats.figures import MatchFigures
from recordings.soccer.stats.match_statistics import MatchStatistics
from recordings.soccer.stats.match_tick import MatchTick, match_ticks
from recordings.soccer.stats.page.content import content_of
from recordings.soccer.stats.page.game_history import GameHistory
from recordings.soccer.stats.tracks import Tracks
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.roster import Placement, RosterEntry
from schemas.config.soccer.rule_book import load_rule_book
from schemas.messages.applied import Applied, AppliedInput
from schemas.messages.command import Drive, Kick, KickMode
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.messages.world import BallTruth, World
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase, Score
from support.messages import make_robot

TICK = 0.1
CORNERS = {"cyan1": (-10.0, 0.0), "cyan2": (-2.0, 3.0), "magenta1": (10.0, 0.0), "magenta2": (2.0, -3.0)}


class MatchScript:
    """Messages of a match, made tick by tick; what is not given keeps its last value."""

    def __init__(self) -> None:
        teams = {f"teams.{side}": {"name": f"Team {side}", "size": 2} for side in Side}
        self.setup = Setup.of(load_match(None, teams), load_profile("msl"), load_rule_book("friendly"))
        self.manifest = Manifest(
            contract="2.0", match="cup", recorder="r", started="2026-01-01", sights=False, versions={}, libm=""
        )
        self.messages: list[tuple[int, Any]] = []
        self.tick = -1
        self.places = dict(CORNERS)
        self.headings = dict.fromkeys(CORNERS, 0.0)
        self.ball = (0.0, 0.0)
        self.held_by: str | None = None
        self.episode = 1
        self.game: dict[str, Any] = {"phase": Phase.PLAY, "running": True}
        self.shot()

    def shot(
        self,
        *,
        touches: Iterable[str] = (),
        kicked: str | None = None,
        speed: tuple[float, float, float] = (0.0, 0.0, 0.0),
        mode: KickMode = KickMode.GROUND,
        events: Iterable[dict[str, Any]] = (),
        placed: Iterable[str] = (),
        roster: list[RosterEntry] | None = None,
        moving: dict[str, tuple[float, float]] | None = None,
        off: Iterable[str] = (),
        stuck: Iterable[str] = (),
        clock: float | None = None,
        **game: Any,
    ) -> None:
        """One more tick: touches, kick, velocity of the ball, events, and fields of the game state from now on."""
        self.tick += 1
        time, log_ns = self.tick * TICK, round(self.tick * TICK * 1e9)
        robots = {
            name: make_robot(
                x,
                y,
                self.headings.get(name, 0.0),
                vx=(moving or {}).get(name, (0.0, 0.0))[0],
                vy=(moving or {}).get(name, (0.0, 0.0))[1],
                holding=name == self.held_by,
                stuck=name in stuck,
                off_field="repair" if name in off else None,
            )
            for name, (x, y) in self.places.items()
        }
        (x, y), (vx, vy, vz) = self.ball, speed
        ball = BallTruth(x=x, y=y, z=0.11, vx=vx, vy=vy, vz=vz)
        world = World(
            tick=self.tick,
            time=time,
            robots=robots,
            ball=ball,
            possession=self.held_by,
            touches=list(touches),
            kicked=kicked,
            clock=time if clock is None else clock,
            episode=self.episode,
        )
        asked = Kick(mode=mode, speed=max(0.1, abs(vx))) if kicked is not None else None
        inputs = {
            name: AppliedInput(drive=Drive(), dribble=False, kick=asked if name == kicked else None) for name in robots
        }
        placements = [Placement(body=name, x=0.0, y=0.0) for name in placed]
        applied = Applied(
            tick=self.tick, time=time, inputs=inputs, placements=placements, robots=roster, chain="00", episode=1
        )
        calls = [GameEvent(tick=self.tick, time=time, clock=time, rule="rule", text="x", **event) for event in events]
        self.game |= game
        state = GameState(tick=self.tick, time=time, clock=time, **self.game)
        news = [state] if game or self.tick == 0 else []
        self.messages += [(log_ns, message) for message in (*calls, *news, world, applied)]

    def rest(self, ticks: int = 3) -> None:
        """Ticks in which nothing happens."""
        for _ in range(ticks):
            self.shot()

    def goal(self, side: Side, robot: str | None = None) -> None:
        """A goal, and the stop that comes with it."""
        score = self.game.get("score", Score()).plus(side)
        event = {"kind": EventKind.GOAL, "side": side, "robot": robot, "score": score}
        self.shot(events=[event], phase=Phase.STOPPED, running=False, score=score)

    def out(self) -> None:
        """The ball leaves the pitch, and the game is stopped."""
        self.shot(events=[{"kind": EventKind.BALL_OUT}], phase=Phase.STOPPED, running=False)

    def match_ticks(self) -> list[MatchTick]:
        """The ticks so far."""
        return list(match_ticks(self.setup, self.messages))

    def figures(self) -> MatchFigures:
        """The figures of the ticks so far."""
        return self.history()[0]

    def history(self) -> tuple[MatchFigures, Tracks, GameHistory]:
        """The same, with the tracks of all bodies and the history of the game."""
        end = self.tick * TICK
        statistics, tracks, history = MatchStatistics(self.setup, 0.0, end), Tracks(self.setup, 0.0, end), GameHistory()
        for match_tick in self.match_ticks():
            for observer in (statistics, tracks, history):
                observer.update(match_tick)
        return statistics.figures(), tracks, history

    def content(self) -> dict[str, Any]:
        """The content of a page on the ticks so far."""
        return content_of(self.manifest, self.setup, *self.history())
