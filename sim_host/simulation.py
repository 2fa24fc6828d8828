"""A match without a network: commands and actions in, one tick, sights and truth out.

The host steps it for agents on the bus, tests and learning step it with brains in the same process.
"""

from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from schemas.coach import CoachOrder
from schemas.command import Command
from schemas.errors import TouchlineError
from schemas.game import ActionReply, EventKind, GameEvent, Phase, RefereeAction
from schemas.host import AppliedInput, Setup, TeamSetup, chained
from schemas.light import light_encode, light_encode_exactly
from schemas.match_config import MatchConfig
from schemas.message import VERSION
from schemas.parameters import ParameterDeed, ParametersReply, ParametersRequest, Setting
from schemas.profile import STANDARD, Profile
from schemas.roster import Placement
from schemas.rule_book import RuleBook, load_rule_book
from schemas.scene import SceneReply, SceneRequest
from schemas.side import Side
from sim_host.crew import Crew
from sim_host.due import Due
from sim_host.referee.core import Referee, Ruling
from sim_host.referee.evidence import NOTHING
from sim_host.sights import Send
from sim_host.snapshot import Roster, Snapshot
from sim_host.staging.deeds import Scenes, do
from sim_host.staging.stage import BALL, Rig, Stage, Staged
from sim_host.start import opening
from sim_host.truth import Fields, world_fields
from sim_host.tuning import Tuning
from sim_host.world.engine import fingerprint
from sim_host.world.world import World


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
    applied_encoded: bytes
    """The same as it goes over the bus, and as the hash chain has taken it in."""
    beliefs: Sequence[tuple[Side, str, bytes]] = ()
    """Side, robot, `schemas.host.Belief` of each word said, encoded."""
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
        self.tuning = Tuning.of(config)
        """The numbers in force from the next tick on."""
        self.book: RuleBook = load_rule_book(config.rules)
        self._engine = fingerprint()
        start, began = opening(config, self.tuning, self.book.restarts)
        self._scenes = Scenes(start, start)
        self._stage = began.stage
        self.episode = 1
        """Counts the starts: the match's own, each scene that is loaded, each reset."""
        self._crew = Crew(config, self.book, self.tuning, self._stage.robots)
        self.state = self.referee.begin_at(start.game, began.ball)
        self.world = World(self.profile, self.roster)
        for obstacle in self._stage.obstacles:
            self.world.put_obstacle(obstacle)
        self.orders: dict[Side, CoachOrder] = {}
        self._due = Due(began.placements, recast=True, rebuilt=bool(self._stage.obstacles))
        self.now = self._begin()

    @property
    def profile(self) -> Profile:
        """The numbers in force from the next tick on."""
        return self.tuning.profile

    @property
    def roster(self) -> Roster:
        """Who takes part from the next tick on."""
        return self._crew.roster

    @property
    def referee(self) -> Referee:
        """Who judges from the next tick on."""
        return self._crew.referee

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
        send: Send = _keep,
        silent: Container[str] = (),
    ) -> Tick:
        """One tick: apply commands, move the world, let the referee decide, let everyone perceive.

        `send` is given each robot's sight as soon as it is written: robots think while the rest is still done.
        `silent` are robots whose program is gone, which the referee may take out.
        """
        done = self._change_world()
        if done.begins_anew:
            commands = {}
        inputs = self._crew.commands.inputs(self.world.tick, commands, self.state.people.away)
        advance = self.world.advance(inputs)
        snapshot = advance.snapshot
        refusals = {name: [reason] for name, reason in advance.refused.items()}
        for name in self.roster.still:
            if name in commands:
                refusals.setdefault(name, []).append("command: this robot stands still in the scene")
        beliefs = self._talk(snapshot, commands, refusals)
        if silent:
            gone = tuple([name for name in self.roster.names if name in silent and name not in self.roster.still])
            snapshot = replace(snapshot, silent=gone)
        ruling = self.referee.step(self.state, snapshot, actions, self.profile.time.tick)
        self._follow(ruling)
        sights = self._crew.sights.at(
            snapshot, self.state, self.episode, advance.stuck, self.orders, commands, refusals, send
        )
        self.now = Tick(
            tick=snapshot.tick,
            time=snapshot.time,
            world=world_fields(snapshot, advance.stuck, self.state, self.episode),
            sights=sights,
            **self._applied(snapshot, inputs, done),
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
            if self._crew.take(self.tuning):
                self._due.remake = self._due.is_checkpoint = True
            self._due.parameters.update(changed)
            values = ", ".join(f"{name} = {_in_words(value)}" for name, value in changed.items())
            text = f"{request.source} sets {values}"
            self._due.said.append((EventKind.PARAMETERS, request.deed.value, text))
        return ParametersReply(accepted=True, parameters=described)

    def scene(self, request: SceneRequest) -> SceneReply:
        """Load a scene, place, add or remove bodies, or begin anew: before the next tick, or refused whole."""
        try:
            if self.over:
                raise TouchlineError("the match is over")
            staged, self._scenes = do(self._stage_now(), request, self._scenes, self._rig())
        except TouchlineError as error:
            return SceneReply(accepted=False, reason=str(error), episode=self.episode)
        self._carry_out(staged)
        follows = f"; episode {self.episode} begins" if staged.game is not None else ""
        self._due.said.append((EventKind.SCENE, request.deed.value, f"{request.source} {staged.says}{follows}"))
        return SceneReply(accepted=True, episode=self.episode)

    def setup(self) -> Setup:
        """What agents and viewers must know before the first tick."""
        p, changed = self.profile, self.tuning.since(self.tuning.at_start)
        setup = Setup.of(self.config, p, self.book, self._engine, changed)
        teams = {side: self._team_setup(side) for side in Side}
        orders = {side: order.sequence for side, order in self.orders.items()}
        return setup.model_copy(update={"teams": teams, "orders": orders})

    def _team_setup(self, side: Side) -> TeamSetup:
        robots = [entry for entry in self._stage.robots if entry.side is side]
        return TeamSetup(
            name=self.config.team(side).name or side.value,
            robots=[entry.name for entry in robots],
            types={entry.name: entry.type for entry in robots if entry.type != STANDARD},
            goalkeeper=side in self.roster.keepers,
        )

    def _begin(self) -> Tick:
        """Tick 0: everybody has been set down, nobody has moved."""
        done = self._change_world()
        done.is_checkpoint = True
        snapshot = self.world.snapshot()
        stuck = [False] * len(self.roster.names)
        return Tick(
            tick=snapshot.tick,
            time=snapshot.time,
            world=world_fields(snapshot, stuck, self.state, self.episode),
            sights=self._crew.sights.at(snapshot, self.state, self.episode, stuck, self.orders, {}, {}, _keep),
            **self._applied(snapshot, {}, done),
        )

    def _change_world(self) -> Due:
        """What is due happens, in this order: other numbers, bodies placed, the world rebuilt; returns what was."""
        done, self._due = self._due, Due()
        if done.remake:
            self.world.remake(self.profile, self.roster, self._stage.obstacles)
        self.world.place(done.placements)
        if done.is_checkpoint:
            self.world.rebuild()
        return done

    def _stage_now(self) -> Stage:
        """The stage, with bodies where they are or are about to be set down."""
        snapshot = self.world.snapshot()
        ball = snapshot.ball
        at = {BALL: Placement(body=BALL, x=ball.x, y=ball.y, z=ball.z)}
        for name, robot in zip(snapshot.roster.names, snapshot.robots, strict=True):
            at[name] = Placement(body=name, x=robot.x, y=robot.y, heading=robot.heading)
        at.update({one.body: one for one in self._due.placements})
        return replace(self._stage, at=at)

    def _carry_out(self, staged: Staged) -> None:
        """Let everybody take what an operator has done to the stage; the world does so before the next tick."""
        before, self._stage, due = self._stage, staged.stage, self._due
        anew = staged.game is not None
        due.place(staged.placements, [] if anew else self._stage.names)
        due.recast = due.recast or self._stage.robots != before.robots
        due.rebuilt = due.rebuilt or self._stage.obstacles != before.obstacles
        due.remake = due.remake or due.recast or due.rebuilt or anew
        due.begins_anew = due.begins_anew or anew
        self._crew.serve(self._stage.robots, anew=anew)
        if staged.game is not None:
            self.episode += 1
            self.state = self.referee.begin_at(staged.game, staged.ball)
        elif staged.placements or self._stage.robots != before.robots:
            people = self.state.people.among(self.roster.names)
            self.state = self.state._replace(people=people, evidence=NOTHING)  # nobody ran or dribbled there

    def _rig(self) -> Rig:
        return Rig(self.profile.field, self.profile.ball, self.tuning.types)

    def _told(self, done: Due, snapshot: Snapshot) -> Iterator[GameEvent]:
        """The events of what was done between the ticks."""
        for kind, rule, text in done.said:
            yield GameEvent(
                tick=snapshot.tick, time=snapshot.time, clock=self.state.clock, kind=kind, rule=rule, text=text
            )

    def _follow(self, ruling: Ruling) -> None:
        self.state = ruling.state
        self._due = Due(list(ruling.placements), ruling.checkpoint)

    def _talk(
        self, snapshot: Snapshot, commands: Mapping[str, Command], refusals: dict[str, list[str]]
    ) -> list[tuple[Side, str, bytes]]:
        """Send this tick's words on their way."""
        beliefs = []
        for name in self.roster.names:  # not in the order of arrival, which no two runs share
            command = commands.get(name)
            if command is None or command.radio is None:
                continue
            word = command.radio
            refusal = self._crew.radio.say(snapshot.tick, name, word)
            if refusal is not None:
                refusals.setdefault(name, []).append(refusal)
                continue
            belief = {"version": VERSION, "tick": snapshot.tick, "time": snapshot.time, "robot": name, "radio": word}
            beliefs.append((self.roster.side_of(name), name, light_encode_exactly(belief)))
        return beliefs

    def _applied(self, snapshot: Snapshot, inputs: Mapping[str, AppliedInput], done: Due) -> dict[str, Any]:
        """The fields of a tick that tell what was applied."""
        fields: Fields = {"tick": snapshot.tick, "time": snapshot.time, **done.noted()}
        if done.recast:
            fields["robots"] = self._stage.robots
        if done.rebuilt:
            fields["obstacles"] = self._stage.obstacles
        fields["episode"] = self.episode
        rest = light_encode_exactly({"version": VERSION, **fields}).removesuffix(b"}")
        noted = b'%s,"inputs":%s' % (rest, light_encode(inputs))
        chain = self.world.chain(noted)
        return {"applied": {**fields, "inputs": inputs, "chain": chain}, "applied_encoded": chained(noted, chain)}


def _in_words(value: Setting) -> str:
    if value is None:
        return "the standard robot's"
    return f"{value:g}" if isinstance(value, float) else str(value)
