"""A match without a network: a step takes commands and referee actions, and returns sights and the true state.

The host steps it for agents on the bus; tests and learning step it with brains in the same process.
"""

from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Any

from msgspec import Raw

from schemas.config.match_config import MatchConfig
from schemas.config.profile import STANDARD, Profile
from schemas.messages.applied import AppliedInput, chained_part
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command
from schemas.messages.parameters import ParametersReply, ParametersRequest
from schemas.messages.radio import Belief
from schemas.messages.scene import SceneReply, SceneRequest
from schemas.messages.setup import Setup, TeamSetup
from schemas.messages.soccer.game import ActionReply, GameEvent, RefereeAction
from schemas.side import Side
from schemas.wire.message import VERSION
from schemas.wire.part import encode
from sim_host.game.judging import Judge, PlayState, Ruling
from sim_host.games import game_of_match
from sim_host.match.live_parameters import LiveParameters
from sim_host.match.opening import opening_layout
from sim_host.match.operator_requests import OperatorRequests
from sim_host.match.pending_changes import PendingChanges
from sim_host.match.radio_use import RadioUse
from sim_host.match.sights import Send, TickSights
from sim_host.match.subsystems import Subsystems
from sim_host.match.world import World
from sim_host.match.world_fields import Fields, world_fields
from sim_host.physics.fingerprint import fingerprint
from sim_host.snapshot import Roster, Snapshot


@dataclass(frozen=True)
class TickResult:
    """The result of one tick, as messages or as their plain fields."""

    tick: int
    time: float
    snapshot: Snapshot
    """The true state in the field frame."""
    make_world: Callable[[], Fields]
    sights: TickSights
    """Robot → `schemas.messages.sight.Sight`, encoded when it is read; `sights.perceived` has the messages."""
    applied: Fields = field(default_factory=dict)
    """`schemas.messages.applied.Applied`; empty without a hash chain."""
    applied_encoded: bytes = b""
    """The same as it is published, and as it enters the hash chain."""
    beliefs: Sequence[tuple[Side, Belief]] = ()
    """Side and content of each radio message sent."""
    events: tuple[GameEvent, ...] = ()
    replies: tuple[ActionReply, ...] = ()
    """One for each action, in order."""
    refused: Mapping[str, int] = field(default_factory=dict)
    """Robot → number of parts of its command that could not be carried out."""

    @cached_property
    def world(self) -> Fields:
        """`schemas.messages.world.World`, made when it is first read."""
        return self.make_world()


class Simulation:
    """World, game, sensors and radio of one match, stepped by the caller."""

    def __init__(self, config: MatchConfig, *, chained: bool = True) -> None:
        """`chained`: ticks extend a hash chain over all states and inputs, which whatever is recorded needs."""
        self.config, self._chained = config, chained
        live_parameters = LiveParameters.of(config)
        self._game = game_of_match(config)
        start, began = opening_layout(config, live_parameters, self._game)
        self._subsystems = Subsystems(config.seed, self._game, live_parameters, began.layout.robots)
        self._operator = OperatorRequests(live_parameters, self._subsystems, self._game, start, began)
        self.state: PlayState = self.judge.begin_at(start.game, began.ball)
        self.world = World(self.profile, self.roster, self._game.arena)
        for obstacle in began.layout.obstacles:
            self.world.put_obstacle(obstacle)
        self.orders: dict[Side, CoachOrder] = {}
        self.now = self._begin()

    @property
    def live_parameters(self) -> LiveParameters:
        """The numbers in force from the next tick on."""
        return self._operator.live_parameters

    @property
    def episode(self) -> int:
        """Number of the episode, from 1: the start of the match, each loaded scene and each reset begins one."""
        return self._operator.episode

    @property
    def profile(self) -> Profile:
        """The numbers in force from the next tick on."""
        return self.live_parameters.profile

    @property
    def roster(self) -> Roster:
        """The robots that take part from the next tick on."""
        return self._subsystems.roster

    @property
    def judge(self) -> Judge:
        """What judges the game from the next tick on."""
        return self._subsystems.judge

    @property
    def radio_use(self) -> RadioUse:
        """What the robots have sent by radio since the match began."""
        return self._subsystems.radio_use

    @property
    def over(self) -> bool:
        """Whether the match has been played to its end."""
        return self.state.over

    def close(self) -> None:
        """Free the engine."""
        self.world.close()

    def step(
        self,
        commands: Mapping[str, Command],
        actions: Sequence[RefereeAction] = (),
        send: Send | None = None,
        silent: Container[str] = (),
        refbox: bool = False,
    ) -> TickResult:
        """One tick: apply commands, move the world, let the referee decide, make the sights.

        `send` is called with each robot's encoded sight as soon as it is made, so that robots think while the tick
        ends; without it, sights are encoded when they are read from the result.
        `silent` are robots whose agent is gone or does not answer; the referee may take them off the field. `refbox` is
        whether a league's referee box is connected, which then decides alone when a part of the match ends.
        """
        changes = self._apply_pending()
        if changes.new_episode:
            commands = {}
        inputs = self._subsystems.commands.inputs(self.world.tick, commands, self.state.absences)
        world_tick = self.world.advance(inputs)
        snapshot = world_tick.snapshot
        refusals = {name: [reason] for name, reason in world_tick.refused.items()}
        for name in self.roster.still:
            if name in commands:
                refusals.setdefault(name, []).append("command: this robot stands still in the scene")
        beliefs = self._send_radio(snapshot, commands, refusals)
        if silent:
            gone = tuple([name for name in self.roster.names if name in silent and name not in self.roster.still])
            snapshot = replace(snapshot, silent=gone)
        if refbox:
            snapshot = replace(snapshot, refbox=True)
        officiated = self._officiating_inputs(changes, actions, snapshot.silent)
        ruling = self.judge.step(self.state, snapshot, actions, self.profile.time.tick)
        self._apply_ruling(ruling)
        sights = self._sights(snapshot, world_tick.stuck, commands, refusals, send)
        moment = snapshot.tick, snapshot.time, self.state.clock
        self.now = TickResult(
            tick=snapshot.tick,
            time=snapshot.time,
            snapshot=snapshot,
            make_world=self._world_of(snapshot, world_tick.stuck),
            sights=sights,
            **self._applied(snapshot, inputs, changes, officiated),
            beliefs=beliefs,
            events=(*(change.event(*moment) for change in changes.by_operator), *ruling.events),
            replies=ruling.replies,
            refused={name: len(sentences) for name, sentences in refusals.items()},
        )
        return self.now

    def handle_parameters(self, request: ParametersRequest) -> ParametersReply:
        """List, read, set or reset live parameters; a change applies from the next tick on, or is refused whole."""
        return self._operator.handle_parameters(request, self.over)

    def handle_scene(self, request: SceneRequest) -> SceneReply:
        """Load a scene, place, add or remove bodies, or reset, before the next tick; or refuse all of it."""
        reply, self.state = self._operator.handle_scene(request, self.state, self.world.snapshot())
        return reply

    def setup(self) -> Setup:
        """The setup of the match, which agents and viewers need before the first tick."""
        p, changed = self.profile, self.live_parameters.changes_since(self.live_parameters.at_start)
        engine = {**fingerprint(), **self._game.fingerprint()}
        setup = self._game.setup(self.config, p, engine, changed)
        teams = {side: self._team_setup(side) for side in Side}
        orders = {side: order.sequence for side, order in self.orders.items()}
        return setup.replace(teams=teams, orders=orders)

    def _team_setup(self, side: Side) -> TeamSetup:
        robots = [entry for entry in self._operator.layout.robots if entry.side is side]
        return TeamSetup(
            name=self.config.team(side).name or side.value,
            robots=[entry.name for entry in robots],
            types={entry.name: entry.type for entry in robots if entry.type != STANDARD},
            goalkeeper=side in self.roster.keepers,
            parameters=self.config.team(side).parameters,
        )

    def _sights(
        self,
        snapshot: Snapshot,
        stuck: Sequence[bool],
        commands: Mapping[str, Command],
        refusals: Mapping[str, list[str]],
        send: Send | None,
    ) -> TickSights:
        """The sights of all robots; with `send`, each is sent as soon as it is made."""
        views = partial(self.judge.views, self.state, self.episode)
        return self._subsystems.sights.at(
            snapshot, self.state.cyan_attacks, views, stuck, self.orders, commands, refusals, send
        )

    def _begin(self) -> TickResult:
        """Tick 0: all bodies are at their places, and none has moved."""
        changes = self._apply_pending()
        changes.checkpoint = True
        snapshot = self.world.snapshot()
        stuck = [False] * len(self.roster.names)
        sights = self._sights(snapshot, stuck, {}, {}, None)
        return TickResult(
            tick=snapshot.tick,
            time=snapshot.time,
            snapshot=snapshot,
            make_world=self._world_of(snapshot, stuck),
            sights=sights,
            **self._applied(snapshot, {}, changes, self._officiating_inputs(changes, (), ())),
        )

    def _world_of(self, snapshot: Snapshot, stuck: list[bool]) -> Callable[[], Fields]:
        """What makes the world of this tick, also in a later one."""
        return partial(world_fields, snapshot, stuck, self.state, self.episode, self._subsystems.sights.readings)

    def _apply_pending(self) -> PendingChanges:
        """Apply the pending changes in this order: rebuild the world, place bodies, make a checkpoint; returns them."""
        changes = self._operator.pop_pending()
        if changes.rebuild_world:
            self.world.rebuild_with(self.profile, self.roster, self._operator.layout.obstacles)
        self.world.place(changes.placements)
        if changes.checkpoint:
            self.world.make_checkpoint()
        return changes

    def _apply_ruling(self, ruling: Ruling) -> None:
        self.state = ruling.state
        self._operator.pending = PendingChanges(list(ruling.placements), ruling.checkpoint)

    def _send_radio(
        self, snapshot: Snapshot, commands: Mapping[str, Command], refusals: dict[str, list[str]]
    ) -> list[tuple[Side, Belief]]:
        """Send the radio messages of this tick; the beliefs to publish."""
        messages = {
            name: command.radio
            for name in self.roster.names  # the order of arrival differs between runs
            if (command := commands.get(name)) is not None and command.radio is not None
        }
        refused = self._subsystems.radio.send(snapshot.tick, messages)
        beliefs = []
        for name, message in messages.items():
            if name in refused:
                refusals.setdefault(name, []).append(refused[name])
                continue
            belief = Belief(tick=snapshot.tick, time=snapshot.time, robot=name, radio=message)
            beliefs.append((self.roster.side_of(name), belief))
        return beliefs

    def _officiating_inputs(
        self, changes: PendingChanges, actions: Sequence[RefereeAction], silent: Sequence[str]
    ) -> Fields:
        """The fields of a `schemas.messages.applied.Applied` on what the game judges, before it does."""
        fields: Fields = {}
        if actions:
            fields["actions"] = list(actions)
        if silent:
            fields["silent"] = list(silent)
        if changes.by_operator:
            fields["changes"] = changes.by_operator
        if changes.checkpoint:
            fields["referee"] = self._game.state_json(self.state)
        return fields

    def _applied(
        self, snapshot: Snapshot, inputs: Mapping[str, AppliedInput], changes: PendingChanges, officiated: Fields
    ) -> dict[str, Any]:
        """The fields of a `TickResult` on what was applied; extends the hash chain."""
        if not self._chained:
            return {}
        fields: Fields = {"version": VERSION, "tick": snapshot.tick, "time": snapshot.time, **changes.applied_fields()}
        if changes.roster_changed:
            fields["robots"] = self._operator.layout.robots
        if changes.obstacles_changed:
            fields["obstacles"] = self._operator.layout.obstacles
        if snapshot.refbox:
            fields["refbox"] = True
        fields["episode"] = self.episode
        fields |= officiated
        message = {**fields, "inputs": Raw(encode(inputs))}  # encoded once, for the chain and for the bus
        chain = self.world.chain(chained_part(message))
        return {
            "applied": {**fields, "inputs": inputs, "chain": chain},
            "applied_encoded": encode({**message, "chain": chain}),
        }
