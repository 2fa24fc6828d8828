"""Lets the game judge a recorded match again, along with the resimulation of its world.

Each `schemas.messages.applied.Applied` holds what the game was given: actions, silent robots, changes by operators.
At checkpoints it holds the complete state of the game, so that a resimulation can begin there.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from schemas.config.profile import Profile
from schemas.config.roster import Placement
from schemas.messages.applied import Applied
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.soccer.game import EventKind
from sim_host.game.contract import Game
from sim_host.game.judging import Judge, PlayState
from sim_host.match.resimulation import ImpossibleTickError
from sim_host.match.state_schedule import StateSchedule
from sim_host.match.world_fields import Fields
from sim_host.snapshot import Roster, Snapshot


class StateConflict(NamedTuple):
    """A field in which the recorded state of the game, or what it placed, differs from the simulated one."""

    field: str
    recorded: object
    simulated: object


class OfficiatedTick(NamedTuple):
    """What the game makes of one tick."""

    events: Sequence[GameEvent]
    """All events of the tick except events of agents, in their order."""
    state: GameState | None
    """The state of the game, where it is published in this tick."""
    state_may_be_missing: bool
    """At the start of a resimulation it is unknown whether the state has changed."""
    conflicts: Sequence[StateConflict]


class GameResimulation:
    """The game of a recorded match, tick by tick."""

    def __init__(self, game: Game, tick_s: float) -> None:
        self._game = game
        self._tick_s = tick_s
        self._schedule = StateSchedule(tick_s)
        self._judge: Judge | None = None
        self._roster: Roster | None = None
        self._state: PlayState | None = None
        self._placements: Sequence[Placement] = ()
        self._checkpoint = False
        self._episode = 1

    @property
    def state(self) -> PlayState:
        """The state after the last tick.

        Raises:
            ImpossibleTickError: no tick has been judged yet.
        """
        if self._state is None:
            raise ImpossibleTickError("a resimulation of the referee begins at a checkpoint")
        return self._state

    def begin_tick(self, applied: Applied) -> list[StateConflict]:
        """Apply what happened between two ticks, and compare it with the recorded state and placements.

        Raises:
            ImpossibleTickError: the recorded state is not a state of this version's referee.
        """
        recorded = self._recorded_state(applied)
        if self._state is None:
            if recorded is None:
                raise ImpossibleTickError(f"tick {applied.tick}: the state of the referee was not recorded")
            self._state, self._episode = recorded, applied.episode
            return []
        by_scene = any(change.kind is EventKind.SCENE for change in applied.changes)
        conflicts = [] if by_scene else self._unlike_the_ruling(applied)
        if recorded is not None:
            if not by_scene:
                conflicts += state_conflicts(recorded, self._state)
            elif applied.episode == self._episode:
                # an operator who moves bodies or robots changes what has been seen, and who takes part; nothing else
                expected = self._state._replace(
                    **{name: getattr(recorded, name) for name in self._game.changed_by_layout}
                )
                conflicts += state_conflicts(recorded, expected)
            self._state = recorded
        if applied.episode != self._episode and (not by_scene or applied.episode < self._episode):
            conflicts.append(StateConflict("episode", applied.episode, self._episode))
        self._episode = applied.episode
        return conflicts

    def judge(self, applied: Applied, snapshot: Snapshot, profile: Profile) -> OfficiatedTick:
        """Judge one tick with the bodies of its resimulation.

        Raises:
            ImpossibleTickError: the recorded state is not a state of this version's referee.
        """
        begins = self._state is None
        conflicts = self.begin_tick(applied)
        events: list[GameEvent] = []
        if applied.tick > 0:
            if applied.silent:
                snapshot = replace(snapshot, silent=tuple(applied.silent))
            if applied.refbox:
                snapshot = replace(snapshot, refbox=True)
            ruling = self._judge_of(snapshot.roster, profile).step(self.state, snapshot, applied.actions, self._tick_s)
            self._state, self._placements, self._checkpoint = ruling.state, ruling.placements, ruling.checkpoint
            moment = applied.tick, applied.time, self.state.clock
            events += [*(change.event(*moment) for change in applied.changes), *ruling.events]
        due = self._schedule.is_due(self.state, applied.tick, applied.episode, had_actions=bool(applied.actions))
        state = self.state.game_state(applied.tick, applied.time, applied.episode) if due else None
        return OfficiatedTick(events, state, begins and applied.tick > 0, conflicts)

    def world_fields(self, bodies: Fields) -> Fields:
        """The fields of the bodies with those that the game and the operator determine."""
        away = self.state.absences
        for name, robot in bodies["robots"].items():
            robot["off_field"] = away[name].why if name in away else None
        return {**bodies, "clock": self.state.clock, "episode": self._episode}

    def _judge_of(self, roster: Roster, profile: Profile) -> Judge:
        if self._judge is None or roster is not self._roster:
            self._roster = roster
            self._judge = self._game.judge(profile, roster)
        return self._judge

    def _recorded_state(self, applied: Applied) -> PlayState | None:
        if not applied.referee:
            return None
        try:
            state: PlayState = self._game.state_from_json(applied.referee)
        except ValueError as error:
            raise ImpossibleTickError(
                f"tick {applied.tick}: the state of the referee is not one of this version ({error})"
            ) from None
        return state

    def _unlike_the_ruling(self, applied: Applied) -> list[StateConflict]:
        """What was placed before this tick, unlike the referee ruled in the tick before."""
        conflicts = []
        if applied.placements != list(self._placements):
            conflicts.append(StateConflict("placements", _bodies(applied.placements), _bodies(self._placements)))
        if self._checkpoint and not applied.checkpoint:
            conflicts.append(StateConflict("checkpoint", applied.checkpoint, self._checkpoint))
        return conflicts


def state_conflicts(recorded: Any, simulated: Any) -> list[StateConflict]:
    """The fields that differ."""
    pairs = zip(recorded._fields, recorded, simulated, strict=True)
    return [StateConflict(name, theirs, ours) for name, theirs, ours in pairs if theirs != ours]


def _bodies(placements: Sequence[Placement]) -> str:
    return ", ".join(f"{one.body} at ({one.x:g}, {one.y:g})" for one in placements) or "no body"
