"""A match without a network: commands and actions in, one tick, sights and truth out.

The host steps it for agents on the bus, tests and learning step it with brains in the same process.
"""

from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from schemas.config.match_config import MatchConfig
from schemas.config.profile import STANDARD, Profile
from schemas.config.roster import Placement
from schemas.config.rule_book import RuleBook, load_rule_book
from schemas.config.scene import SceneReply, SceneRequest
from schemas.errors import TouchlineError
from schemas.game import ActionReply, EventKind, GameEvent, Phase, RefereeAction
from schemas.message import VERSION
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command
from schemas.messages.host import AppliedInput, Setup, TeamSetup, chained_part
from schemas.messages.parameters import ParameterOperation, ParametersReply, ParametersRequest, Setting
from schemas.side import Side
from schemas.struct import encode
from sim_host.match.live_parameters import LiveParameters
from sim_host.match.pending_changes import PendingChanges
from sim_host.match.sights import Send
from sim_host.match.start_scene import opening_layout
from sim_host.match.subsystems import Subsystems
from sim_host.match.world import World
from sim_host.match.world_fields import Fields, world_fields
from sim_host.physics.fingerprint import fingerprint
from sim_host.referee.core import Referee, Ruling
from sim_host.referee.evidence import NO_EVIDENCE
from sim_host.snapshot import BALL, Roster, Snapshot
from sim_host.staging.layout import Layout, LayoutChange, Specs
from sim_host.staging.operations import ResetScenes, apply_request


@dataclass(frozen=True, slots=True)
class TickResult:
    """Everything that one tick brought, as messages or as their plain fields."""

    tick: int
    time: float
    world: Fields
    """`schemas.messages.world.World`."""
    sights: dict[str, bytes]
    """Robot → `schemas.messages.sight.Sight`, encoded."""
    applied: Fields
    """`schemas.messages.host.Applied`."""
    applied_encoded: bytes
    """The same as it goes over the bus, and as the hash chain has taken it in."""
    beliefs: Sequence[tuple[Side, str, bytes]] = ()
    """Side, robot, `schemas.messages.host.Belief` of each word said, encoded."""
    events: tuple[GameEvent, ...] = ()
    replies: tuple[ActionReply, ...] = ()
    """One for each action, in order."""
    refused: Mapping[str, int] = field(default_factory=dict)
    """Robot → how many parts of its command could not be done."""


def _discard_sight(robot: str, sight: bytes) -> None:
    """Send nothing: whoever steps the simulation finds the sights in its tick."""


class Simulation:
    """World, referee, sensors and radio of one match, stepped from outside."""

    def __init__(self, config: MatchConfig) -> None:
        self.config = config
        self.live_parameters = LiveParameters.of(config)
        """The numbers in force from the next tick on."""
        self.book: RuleBook = load_rule_book(config.rules)
        self._engine = fingerprint()
        start, began = opening_layout(config, self.live_parameters, self.book.restarts)
        self._reset_scenes = ResetScenes(start, start)
        self._layout = began.layout
        self.episode = 1
        """Counts the starts: the match's own, each scene that is loaded, each reset."""
        self._subsystems = Subsystems(config, self.book, self.live_parameters, self._layout.robots)
        self.state = self.referee.begin_at(start.game, began.ball)
        self.world = World(self.profile, self.roster)
        for obstacle in self._layout.obstacles:
            self.world.put_obstacle(obstacle)
        self.orders: dict[Side, CoachOrder] = {}
        self._pending = PendingChanges(
            began.placements, roster_changed=True, obstacles_changed=bool(self._layout.obstacles)
        )
        self.now = self._begin()

    @property
    def profile(self) -> Profile:
        """The numbers in force from the next tick on."""
        return self.live_parameters.profile

    @property
    def roster(self) -> Roster:
        """Who takes part from the next tick on."""
        return self._subsystems.roster

    @property
    def referee(self) -> Referee:
        """Who judges from the next tick on."""
        return self._subsystems.referee

    @property
    def over(self) -> bool:
        """The match has been played to its end."""
        return self.state.phase is Phase.FULL_TIME

    def close(self) -> None:
        """Free the engine."""
        self.world.close()

    def step(
        self,
        commands: Mapping[str, Command],
        actions: Sequence[RefereeAction] = (),
        send: Send = _discard_sight,
        silent: Container[str] = (),
    ) -> TickResult:
        """One tick: apply commands, move the world, let the referee decide, let everyone perceive.

        `send` is given each robot's sight as soon as it is written: robots think while the rest is still done.
        `silent` are robots whose program is gone, which the referee may take out.
        """
        changes = self._apply_pending()
        if changes.new_episode:
            commands = {}
        inputs = self._subsystems.commands.inputs(self.world.tick, commands, self.state.participation.absences)
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
        ruling = self.referee.step(self.state, snapshot, actions, self.profile.time.tick)
        self._apply_ruling(ruling)
        sights = self._subsystems.sights.at(
            snapshot, self.state, self.episode, world_tick.stuck, self.orders, commands, refusals, send
        )
        self.now = TickResult(
            tick=snapshot.tick,
            time=snapshot.time,
            world=world_fields(snapshot, world_tick.stuck, self.state, self.episode),
            sights=sights,
            **self._applied(snapshot, inputs, changes),
            beliefs=beliefs,
            events=(*self._change_events(changes, snapshot), *ruling.events),
            replies=ruling.replies,
            refused={name: len(sentences) for name, sentences in refusals.items()},
        )
        return self.now

    def handle_parameters(self, request: ParametersRequest) -> ParametersReply:
        """List, read, set or reset live parameters; a change is in force from the next tick on, or refused whole."""
        before = self.live_parameters
        if self.over and request.operation in (ParameterOperation.SET, ParameterOperation.RESET):
            return ParametersReply(accepted=False, reason="the match is over")
        try:
            self.live_parameters = before.after_request(request)
            asked = tuple(request.values) or tuple(request.names)
            described = self.live_parameters.describe(asked)
        except TouchlineError as error:
            self.live_parameters = before
            return ParametersReply(accepted=False, reason=str(error))
        changed = self.live_parameters.changes_since(before)
        if changed:
            if self._subsystems.set_live_parameters(self.live_parameters):
                self._pending.rebuild_world = self._pending.checkpoint = True
            self._pending.parameters.update(changed)
            values = ", ".join(f"{name} = {_setting_text(value)}" for name, value in changed.items())
            text = f"{request.source} sets {values}"
            self._pending.events.append((EventKind.PARAMETERS, request.operation.value, text))
        return ParametersReply(accepted=True, parameters=described)

    def handle_scene(self, request: SceneRequest) -> SceneReply:
        """Load a scene, place, add or remove bodies, or begin anew: before the next tick, or refused whole."""
        try:
            if self.over:
                raise TouchlineError("the match is over")
            change, self._reset_scenes = apply_request(
                self._current_layout(), request, self._reset_scenes, self._specs()
            )
        except TouchlineError as error:
            return SceneReply(accepted=False, reason=str(error), episode=self.episode)
        self._apply_layout_change(change)
        follows = f"; episode {self.episode} begins" if change.game is not None else ""
        self._pending.events.append(
            (EventKind.SCENE, request.operation.value, f"{request.source} {change.summary}{follows}")
        )
        return SceneReply(accepted=True, episode=self.episode)

    def setup(self) -> Setup:
        """What agents and viewers must know before the first tick."""
        p, changed = self.profile, self.live_parameters.changes_since(self.live_parameters.at_start)
        setup = Setup.of(self.config, p, self.book, self._engine, changed)
        teams = {side: self._team_setup(side) for side in Side}
        orders = {side: order.sequence for side, order in self.orders.items()}
        return setup.model_copy(update={"teams": teams, "orders": orders})

    def _team_setup(self, side: Side) -> TeamSetup:
        robots = [entry for entry in self._layout.robots if entry.side is side]
        return TeamSetup(
            name=self.config.team(side).name or side.value,
            robots=[entry.name for entry in robots],
            types={entry.name: entry.type for entry in robots if entry.type != STANDARD},
            goalkeeper=side in self.roster.keepers,
        )

    def _begin(self) -> TickResult:
        """Tick 0: everybody has been set down, nobody has moved."""
        changes = self._apply_pending()
        changes.checkpoint = True
        snapshot = self.world.snapshot()
        stuck = [False] * len(self.roster.names)
        return TickResult(
            tick=snapshot.tick,
            time=snapshot.time,
            world=world_fields(snapshot, stuck, self.state, self.episode),
            sights=self._subsystems.sights.at(
                snapshot, self.state, self.episode, stuck, self.orders, {}, {}, _discard_sight
            ),
            **self._applied(snapshot, {}, changes),
        )

    def _apply_pending(self) -> PendingChanges:
        """Apply what is pending, in this order: other numbers, bodies placed, a checkpoint; returns what was done."""
        changes, self._pending = self._pending, PendingChanges()
        if changes.rebuild_world:
            self.world.rebuild_with(self.profile, self.roster, self._layout.obstacles)
        self.world.place(changes.placements)
        if changes.checkpoint:
            self.world.make_checkpoint()
        return changes

    def _current_layout(self) -> Layout:
        """The layout, with bodies where they are or are about to be set down."""
        snapshot = self.world.snapshot()
        ball = snapshot.ball
        at = {BALL: Placement(body=BALL, x=ball.x, y=ball.y, z=ball.z)}
        for name, robot in zip(snapshot.roster.names, snapshot.robots, strict=True):
            at[name] = Placement(body=name, x=robot.x, y=robot.y, heading=robot.heading)
        at.update({one.body: one for one in self._pending.placements})
        return replace(self._layout, at=at)

    def _apply_layout_change(self, change: LayoutChange) -> None:
        """Let everybody take what an operator has done to the layout; the world does so before the next tick."""
        before, self._layout, pending = self._layout, change.layout, self._pending
        new_episode = change.game is not None
        pending.add_placements(change.placements, [] if new_episode else self._layout.names)
        pending.roster_changed = pending.roster_changed or self._layout.robots != before.robots
        pending.obstacles_changed = pending.obstacles_changed or self._layout.obstacles != before.obstacles
        pending.rebuild_world = (
            pending.rebuild_world or pending.roster_changed or pending.obstacles_changed or new_episode
        )
        pending.new_episode = pending.new_episode or new_episode
        self._subsystems.set_roster(self._layout.robots, new_episode=new_episode)
        if change.game is not None:
            self.episode += 1
            self.state = self.referee.begin_at(change.game, change.ball)
        elif change.placements or self._layout.robots != before.robots:
            participation = self.state.participation.of_robots(self.roster.names)
            self.state = self.state._replace(
                participation=participation, evidence=NO_EVIDENCE
            )  # nobody ran or dribbled there

    def _specs(self) -> Specs:
        return Specs(self.profile.field, self.profile.ball, self.live_parameters.types)

    def _change_events(self, changes: PendingChanges, snapshot: Snapshot) -> Iterator[GameEvent]:
        """The events of what was done between the ticks."""
        for kind, rule, text in changes.events:
            yield GameEvent(
                tick=snapshot.tick, time=snapshot.time, clock=self.state.clock, kind=kind, rule=rule, text=text
            )

    def _apply_ruling(self, ruling: Ruling) -> None:
        self.state = ruling.state
        self._pending = PendingChanges(list(ruling.placements), ruling.checkpoint)

    def _send_radio(
        self, snapshot: Snapshot, commands: Mapping[str, Command], refusals: dict[str, list[str]]
    ) -> list[tuple[Side, str, bytes]]:
        """Send this tick's words on their way."""
        beliefs = []
        for name in self.roster.names:  # not in the order of arrival, which no two runs share
            command = commands.get(name)
            if command is None or command.radio is None:
                continue
            word = command.radio
            refusal = self._subsystems.radio.send(snapshot.tick, name, word)
            if refusal is not None:
                refusals.setdefault(name, []).append(refusal)
                continue
            belief = {"version": VERSION, "tick": snapshot.tick, "time": snapshot.time, "robot": name, "radio": word}
            beliefs.append((self.roster.side_of(name), name, encode(belief)))
        return beliefs

    def _applied(
        self, snapshot: Snapshot, inputs: Mapping[str, AppliedInput], changes: PendingChanges
    ) -> dict[str, Any]:
        """The fields of a tick that tell what was applied."""
        fields: Fields = {"version": VERSION, "tick": snapshot.tick, "time": snapshot.time, **changes.applied_fields()}
        if changes.roster_changed:
            fields["robots"] = self._layout.robots
        if changes.obstacles_changed:
            fields["obstacles"] = self._layout.obstacles
        fields |= {"episode": self.episode, "inputs": inputs}
        fields["chain"] = self.world.chain(chained_part(fields))
        return {"applied": fields, "applied_encoded": encode(fields)}


def _setting_text(value: Setting) -> str:
    if value is None:
        return "the standard robot's"
    return f"{value:g}" if isinstance(value, float) else str(value)
