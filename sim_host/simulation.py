"""A match without a network: commands and actions in, one tick, sights and truth out.

The host steps it for agents on the bus, tests and learning step it with brains in the same process.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from schemas.coach import CoachOrder
from schemas.command import Command
from schemas.game import ActionReply, GameEvent, Phase, RefereeAction
from schemas.host import AppliedInput, Placement, Setup, TeamSetup
from schemas.match_config import MatchConfig
from schemas.noise import sensing_of
from schemas.profile import Profile, load_profile
from schemas.profile import Radio as Air
from schemas.rule_book import RuleBook, load_rule_book
from schemas.side import Side
from sim_host.actuation.commands import Commands
from sim_host.radio import RadioAir
from sim_host.referee.core import Referee, Ruling
from sim_host.sensing.perception import Perception
from sim_host.sensing.streams import Streams
from sim_host.sights import Send, Sights
from sim_host.snapshot import Roster, Snapshot
from sim_host.start import start_poses
from sim_host.world.engine import fingerprint
from sim_host.world.world import World

Fields = dict[str, Any]
"""A message as plain fields, laid out as its model has them."""


@dataclass(frozen=True, slots=True)
class Tick:
    """Everything that one tick brought, as messages or as their plain fields."""

    tick: int
    time: float
    world: Fields
    """`schemas.world.World`."""
    sights: dict[str, bytes]
    """Robot → `schemas.sight.Sight`, encoded."""
    applied: Fields
    """`schemas.host.Applied`."""
    beliefs: Sequence[tuple[Side, str, Fields]] = ()
    """Side, robot, `schemas.host.Belief` of each word said."""
    events: tuple[GameEvent, ...] = ()
    replies: tuple[ActionReply, ...] = ()
    """One for each action, in order."""
    refused: Mapping[str, int] = field(default_factory=dict)
    """Robot → how many parts of its command could not be done."""


def _keep(robot: str, sight: bytes) -> None:
    """Send nothing: whoever steps the simulation finds the sights in its tick."""


class Simulation:
    """World, referee, sensors and radio of one match, stepped from outside."""

    def __init__(self, config: MatchConfig) -> None:
        self.config = config
        self.profile: Profile = load_profile(config.profile)
        self.book: RuleBook = load_rule_book(config.rules)
        self.roster = Roster.of(config, self.profile)
        p, streams = self.profile, Streams(config.seed)
        starts = start_poses(self.roster, p.field)
        self.referee = Referee(
            self.book,
            p.field,
            p.ball,
            p.robot,
            self.roster,
            duration=config.duration,
            kick_off=config.referee.kick_off,
            automatic=config.referee.automatic,
            starts=starts,
        )
        self.state = self.referee.begin()
        self.world = World(p, self.roster)
        self.orders: dict[Side, CoachOrder] = {}
        self._commands = Commands(self.roster.names, p.safety.watchdog / p.time.tick)
        sensing = sensing_of(config.noise.preset, p.sensing)
        self._radio = RadioAir(_air(config, p), self.roster, p.time.tick, streams)
        self._sights = Sights(self.roster, p.robot.radius, Perception(sensing, self.roster, streams), self._radio)
        self._to_place = tuple(Placement(body=n, x=at.x, y=at.y, heading=at.heading) for n, at in starts.items())
        self._to_rebuild = False
        self.now = self._begin()

    @property
    def over(self) -> bool:
        """The match has been played to its end."""
        return self.state.phase is Phase.FULL_TIME

    def close(self) -> None:
        """Free the engine."""
        self.world.close()

    def step(self, commands: Mapping[str, Command], actions: Sequence[RefereeAction] = (), send: Send = _keep) -> Tick:
        """One tick: apply commands, move the world, let the referee decide, let everyone perceive.

        `send` is given each robot's sight as soon as it is written: robots think while the rest is still done.
        """
        placements, is_checkpoint = self._change_world()
        inputs = self._commands.inputs(self.world.tick, commands)
        advance = self.world.advance(inputs)
        snapshot = advance.snapshot
        refusals = {name: [reason] for name, reason in advance.refused.items()}
        beliefs = self._talk(snapshot, commands, refusals)
        ruling = self.referee.step(self.state, snapshot, actions, self.profile.time.tick)
        self._follow(ruling)
        sights = self._sights.at(snapshot, self.state, advance.stuck, self.orders, commands, refusals, send)
        self.now = Tick(
            tick=snapshot.tick,
            time=snapshot.time,
            world=_world_fields(snapshot, advance.stuck, self.state.clock),
            sights=sights,
            applied=self._applied(snapshot, inputs, placements, is_checkpoint),
            beliefs=beliefs,
            events=ruling.events,
            replies=ruling.replies,
            refused={name: len(sentences) for name, sentences in refusals.items()},
        )
        return self.now

    def setup(self) -> Setup:
        """What agents and viewers must know before the first tick."""
        p, config = self.profile, self.config
        return Setup(
            match=config.name,
            pace=config.pace,
            profile=p.name,
            rules=self.book.name,
            time=p.time,
            pitch=p.field,
            robot=p.robot,
            ball=p.ball,
            drive=p.drive,
            dribble=p.dribble,
            kicker=p.kicker,
            periods=self.book.periods,
            restarts=self.book.restarts,
            teams={
                side: TeamSetup(name=config.team(side).name or side.value, robots=config.robots(side)) for side in Side
            },
            engine=fingerprint(),
        )

    def _begin(self) -> Tick:
        """Tick 0: everybody has been set down, nobody has moved."""
        placements, _ = self._change_world()
        self._to_place = ()
        snapshot = self.world.snapshot()
        stuck = [False] * len(self.roster.names)
        return Tick(
            tick=snapshot.tick,
            time=snapshot.time,
            world=_world_fields(snapshot, stuck, self.state.clock),
            sights=self._sights.at(snapshot, self.state, stuck, self.orders, {}, {}, _keep),
            applied=self._applied(snapshot, {}, placements, True),
        )

    def _change_world(self) -> tuple[tuple[Placement, ...], bool]:
        """What was decided after the last tick happens before this one: bodies placed, and whether rebuilt."""
        self.world.place(self._to_place)
        if self._to_rebuild:
            self.world.rebuild()
        return self._to_place, self._to_rebuild

    def _follow(self, ruling: Ruling) -> None:
        self.state = ruling.state
        self._to_place = ruling.placements
        self._to_rebuild = ruling.checkpoint

    def _talk(
        self, snapshot: Snapshot, commands: Mapping[str, Command], refusals: dict[str, list[str]]
    ) -> list[tuple[Side, str, Fields]]:
        """Send this tick's words on their way."""
        beliefs = []
        for name in self.roster.names:  # not in the order of arrival, which no two runs share
            command = commands.get(name)
            if command is None or command.radio is None:
                continue
            refusal = self._radio.say(snapshot.tick, name, command.radio)
            if refusal is not None:
                refusals.setdefault(name, []).append(refusal)
                continue
            fields = {"tick": snapshot.tick, "time": snapshot.time, "robot": name, "radio": command.radio}
            beliefs.append((self.roster.side_of(name), name, fields))
        return beliefs

    def _applied(
        self,
        snapshot: Snapshot,
        inputs: Mapping[str, AppliedInput],
        placements: tuple[Placement, ...],
        is_checkpoint: bool,
    ) -> Fields:
        return {
            "tick": snapshot.tick,
            "time": snapshot.time,
            "inputs": inputs,
            "placements": placements,
            "checkpoint": is_checkpoint,
            "chain": self.world.chain(),
        }


def _air(config: MatchConfig, profile: Profile) -> Air:
    """The profile's radio, with the numbers that the match file gives."""
    given = {key: value for key, value in config.radio.model_dump().items() if value is not None}
    return replace(profile.radio, **given)


def _world_fields(snapshot: Snapshot, stuck: list[bool], clock: float) -> Fields:
    ball = snapshot.ball
    return {
        "tick": snapshot.tick,
        "time": snapshot.time,
        "robots": {
            name: {
                "x": robot.x,
                "y": robot.y,
                "z": robot.z,
                "heading": robot.heading,
                "vx": robot.vx,
                "vy": robot.vy,
                "omega": robot.omega,
                "holding": robot.holding,
                "stuck": is_stuck,
                "off_field": None,
            }
            for name, robot, is_stuck in zip(snapshot.roster.names, snapshot.robots, stuck, strict=True)
        },
        "ball": ball._asdict(),
        "possession": snapshot.possession,
        "clock": clock,
    }
