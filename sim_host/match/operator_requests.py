"""The requests of an operator to a running match: parameters, bodies on the pitch, scenes and resets."""

from dataclasses import replace

from schemas.config.roster import Placement
from schemas.config.scene import Scene
from schemas.errors import TouchlineError
from schemas.messages.applied import OperatorChange
from schemas.messages.parameters import ParameterOperation, ParametersReply, ParametersRequest, Setting
from schemas.messages.scene import SceneReply, SceneRequest
from schemas.soccer.game import EventKind
from sim_host.game.contract import Game
from sim_host.game.judging import PlayState
from sim_host.match.live_parameters import LiveParameters
from sim_host.match.pending_changes import PendingChanges
from sim_host.match.subsystems import Subsystems
from sim_host.snapshot import BALL, Snapshot
from sim_host.staging.layout import Layout, LayoutChange, Specs
from sim_host.staging.operations import ResetScenes, apply_request


class OperatorRequests:
    """Holds the layout, the parameters and the episode of a match, and the changes that its next tick applies."""

    def __init__(
        self, live_parameters: LiveParameters, subsystems: Subsystems, game: Game, start: Scene, began: LayoutChange
    ) -> None:
        """`start` is the scene that the match begins with, and `began` the layout that it makes."""
        self.live_parameters = live_parameters
        self.layout = began.layout
        self.episode = 1
        self.pending = PendingChanges(
            began.placements, roster_changed=True, obstacles_changed=bool(began.layout.obstacles)
        )
        """Changes to apply before the next tick."""
        self._subsystems = subsystems
        self._game = game
        self._reset_scenes = ResetScenes(start, start)

    def pop_pending(self) -> PendingChanges:
        """The changes to apply before this tick; none are pending afterwards."""
        changes, self.pending = self.pending, PendingChanges()
        return changes

    def handle_parameters(self, request: ParametersRequest, over: bool) -> ParametersReply:
        """List, read, set or reset live parameters; changes are refused once the match is `over`."""
        before = self.live_parameters
        if over and request.operation in (ParameterOperation.SET, ParameterOperation.RESET):
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
                self.pending.rebuild_world = self.pending.checkpoint = True
            self.pending.parameters.update(changed)
            values = ", ".join(f"{name} = {_setting_text(value)}" for name, value in changed.items())
            text = f"{request.source} sets {values}"
            self.pending.by_operator.append(OperatorChange(EventKind.PARAMETERS, request.operation.value, text))
        return ParametersReply(accepted=True, parameters=described)

    def handle_scene(self, request: SceneRequest, state: PlayState, snapshot: Snapshot) -> tuple[SceneReply, PlayState]:
        """Change the layout, or refuse all of it; the reply, and the state of the game from the next tick on."""
        try:
            if state.over:
                raise TouchlineError("the match is over")
            change, self._reset_scenes = apply_request(
                self._current_layout(snapshot), request, self._reset_scenes, self._specs
            )
        except TouchlineError as error:
            return SceneReply(accepted=False, reason=str(error), episode=self.episode), state
        state = self._apply_layout_change(change, state)
        follows = f"; episode {self.episode} begins" if change.game is not None else ""
        text = f"{request.source} {change.summary}{follows}"
        self.pending.by_operator.append(OperatorChange(EventKind.SCENE, request.operation.value, text))
        return SceneReply(accepted=True, episode=self.episode), state

    def _current_layout(self, snapshot: Snapshot) -> Layout:
        """The layout, with bodies where they are or are about to be set down."""
        ball = snapshot.ball_state
        at = {} if ball is None else {BALL: Placement(body=BALL, x=ball.x, y=ball.y, z=ball.z)}
        for one in snapshot.obstacles:
            if one.pushed is not None:
                at[one.name] = Placement(body=one.name, x=one.x, y=one.y, heading=one.heading)
        for name, robot in zip(snapshot.roster.names, snapshot.robots, strict=True):
            at[name] = Placement(body=name, x=robot.x, y=robot.y, heading=robot.heading)
        at.update({one.body: one for one in self.pending.placements})
        return replace(self.layout, at=at)

    def _apply_layout_change(self, change: LayoutChange, state: PlayState) -> PlayState:
        """Pass a new layout on to the subsystems, and to the world before the next tick; the state of the game."""
        before, self.layout, pending = self.layout, change.layout, self.pending
        new_episode = change.game is not None
        pending.add_placements(change.placements, [] if new_episode else self.layout.names)
        pending.roster_changed = pending.roster_changed or self.layout.robots != before.robots
        pending.obstacles_changed = pending.obstacles_changed or self.layout.obstacles != before.obstacles
        pending.rebuild_world = (
            pending.rebuild_world or pending.roster_changed or pending.obstacles_changed or new_episode
        )
        pending.new_episode = pending.new_episode or new_episode
        self._subsystems.set_roster(self.layout.robots, new_episode=new_episode)
        if change.game is not None:
            self.episode += 1
            begun: PlayState = self._subsystems.judge.begin_at(change.game, change.ball)
            return begun
        if change.placements or self.layout.robots != before.robots:
            changed: PlayState = state.after_layout_change(self._subsystems.roster.names)
            return changed
        return state

    @property
    def _specs(self) -> Specs:
        profile = self.live_parameters.profile
        game = self._game
        return Specs(
            profile.field, profile.ball, self.live_parameters.types, game.check_team_sizes, game.arena.furniture
        )


def _setting_text(value: Setting) -> str:
    if value is None:
        return "the standard robot's"
    return f"{value:g}" if isinstance(value, float) else str(value)
