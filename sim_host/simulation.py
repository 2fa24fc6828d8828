"""A match without a network: commands and actions in, one tick, sights and truth out.

The host steps it for agents on the bus, tests and learning step it with brains in the same process.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from schemas.coach import CoachOrder
from schemas.command import Command
from schemas.errors import TouchlineError
from schemas.game import ActionReply, EventKind, GameEvent, Phase, RefereeAction
from schemas.host import AppliedInput, Placement, Setup
from schemas.match_config import MatchConfig
from schemas.parameters import ParameterDeed, ParametersReply, ParametersRequest, Value
from schemas.profile import Profile
from schemas.rule_book import RuleBook, load_rule_book
from schemas.side import Side
from sim_host.actuation.commands import Commands
from sim_host.radio import RadioAir
from sim_host.referee.core import Referee, Ruling
from sim_host.sensing.perception import Perception
from sim_host.sensing.streams import Streams
from sim_host.sights import Send, Sights
from sim_host.snapshot import ObstacleState, Roster, Snapshot
from sim_host.start import start_poses
from sim_host.tuning import Tuning
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


@dataclass(slots=True)
class _Due:
    """What happens between two ticks: decided by the referee in the last one, or by an operator since."""

    placements: list[Placement] = field(default_factory=list)
    is_checkpoint: bool = False
    parameters: dict[str, Value] = field(default_factory=dict)
    remake: bool = False
    """The world is built with numbers that have changed."""
    said: list[tuple[EventKind, str, str]] = field(default_factory=list)
    """Kind, rule and sentence of each event that tells of it."""


def _keep(robot: str, sight: bytes) -> None:
    """Send nothing: whoever steps the simulation finds the sights in its tick."""


class Simulation:
    """World, referee, sensors and radio of one match, stepped from outside."""

    def __init__(self, config: MatchConfig) -> None:
        self.config = config
        self.tuning = Tuning.of(config)
        """The numbers in force from the next tick on."""
        self.book: RuleBook = load_rule_book(config.rules)
        p = self.profile
        self.roster = Roster.of(config, p)
        self._streams = Streams(config.seed)
        self._engine = fingerprint()
        starts = start_poses(self.roster, p.field)
        self.referee = Referee(
            self.book,
            p.field,
            p.ball,
            self.roster,
            duration=config.duration,
            kick_off=config.referee.kick_off,
            automatic=config.referee.automatic,
            starts=starts,
        )
        self.state = self.referee.begin()
        self.world = World(p, self.roster)
        for obstacle in config.obstacles:
            self.world.put_obstacle(obstacle)
        self.orders: dict[Side, CoachOrder] = {}
        self._commands = Commands(self.roster.names, p.safety.watchdog / p.time.tick)
        self._radio = RadioAir(p.radio, self.roster, p.time.tick, self._streams)
        self._perception = Perception(self.tuning.sensing, self.roster, self._streams, p.time.tick)
        self._sights = Sights(self.roster, self._perception, self._radio)
        self._due = _Due([Placement(body=n, x=at.x, y=at.y, heading=at.heading) for n, at in starts.items()])
        self.now = self._begin()

    @property
    def profile(self) -> Profile:
        """The numbers in force from the next tick on."""
        return self.tuning.profile

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
        done = self._change_world()
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
            applied=self._applied(snapshot, inputs, done),
            beliefs=beliefs,
            events=(*self._told(done, snapshot), *ruling.events),
            replies=ruling.replies,
            refused={name: len(sentences) for name, sentences in refusals.items()},
        )
        return self.now

    def parameters(self, request: ParametersRequest) -> ParametersReply:
        """List, read, set or reset live parameters; a change is in force from the next tick on, or refused whole."""
        before = self.tuning
        if self.over and request.deed in (ParameterDeed.SET, ParameterDeed.RESET):
            return ParametersReply(accepted=False, reason="the match is over")
        try:
            self.tuning = before.changed(request)
            asked = tuple(request.values) or tuple(request.names)
            described = self.tuning.describe(asked)
        except TouchlineError as error:
            self.tuning = before
            return ParametersReply(accepted=False, reason=str(error))
        changed = self.tuning.since(before)
        if changed:
            self._take(before)
            self._due.parameters.update(changed)
            values = ", ".join(f"{name} = {_in_words(value)}" for name, value in changed.items())
            text = f"{request.source} sets {values}"
            self._due.said.append((EventKind.PARAMETERS, request.deed.value, text))
        return ParametersReply(accepted=True, parameters=described)

    def setup(self) -> Setup:
        """What agents and viewers must know before the first tick."""
        p, changed = self.profile, self.tuning.since(self.tuning.at_start)
        return Setup.of(self.config, p, self.book, self._engine, changed)

    def _begin(self) -> Tick:
        """Tick 0: everybody has been set down, nobody has moved."""
        done = self._change_world()
        done.is_checkpoint = True
        snapshot = self.world.snapshot()
        stuck = [False] * len(self.roster.names)
        return Tick(
            tick=snapshot.tick,
            time=snapshot.time,
            world=_world_fields(snapshot, stuck, self.state.clock),
            sights=self._sights.at(snapshot, self.state, stuck, self.orders, {}, {}, _keep),
            applied=self._applied(snapshot, {}, done),
        )

    def _change_world(self) -> _Due:
        """What is due happens, in this order: other numbers, bodies placed, the world rebuilt; returns what was."""
        done, self._due = self._due, _Due()
        if done.remake:
            self.world.remake(self.profile, self.roster)
        self.world.place(done.placements)
        if done.is_checkpoint:
            self.world.rebuild()
        return done

    def _take(self, before: Tuning) -> None:
        """Let everything that works with numbers take those in force now."""
        old, new = before.profile, self.profile
        if new.radio != old.radio:
            self._radio.change(new.radio)
        if self.tuning.sensing != before.sensing:
            self._perception.change(self.tuning.sensing)
        if new.safety != old.safety:
            self._commands = self._commands.with_watchdog(new.safety.watchdog / new.time.tick)
        if replace(new, radio=old.radio, safety=old.safety, sensing=old.sensing) != old:
            self.roster = self.roster.tuned(new)
            self._due.remake = self._due.is_checkpoint = True

    def _told(self, done: _Due, snapshot: Snapshot) -> Iterator[GameEvent]:
        """The events of what was done between the ticks."""
        for kind, rule, text in done.said:
            yield GameEvent(
                tick=snapshot.tick, time=snapshot.time, clock=self.state.clock, kind=kind, rule=rule, text=text
            )

    def _follow(self, ruling: Ruling) -> None:
        self.state = ruling.state
        self._due = _Due(list(ruling.placements), ruling.checkpoint)

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

    def _applied(self, snapshot: Snapshot, inputs: Mapping[str, AppliedInput], done: _Due) -> Fields:
        fields: Fields = {
            "tick": snapshot.tick,
            "time": snapshot.time,
            "inputs": inputs,
            "placements": done.placements,
            "checkpoint": done.is_checkpoint,
        }
        if done.parameters:
            fields["parameters"] = done.parameters
        fields["chain"] = self.world.chain()
        return fields


def _in_words(value: Value) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _obstacle_fields(obstacle: ObstacleState) -> Fields:
    fields = obstacle._asdict()
    del fields["name"]
    return fields


def _world_fields(snapshot: Snapshot, stuck: list[bool], clock: float) -> Fields:
    ball = snapshot.ball
    fields = {
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
    if snapshot.obstacles:
        fields["obstacles"] = {obstacle.name: _obstacle_fields(obstacle) for obstacle in snapshot.obstacles}
    return fields
