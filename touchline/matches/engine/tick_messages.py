"""The ticks of a match in one process, as a recording of it has them."""

from collections.abc import Callable, Iterator
from typing import Any

from recordings.soccer.stats.match_tick import MatchTick, match_ticks
from schemas.messages.applied import Applied
from schemas.messages.world import World
from schemas.wire.part_faults import validated
from sim_host.match.simulation import TickResult
from sim_host.match.state_schedule import StateSchedule
from touchline.play.play_match import InProcessMatch


def played_ticks(match: InProcessMatch, after: Callable[[TickResult], None] = lambda _: None) -> Iterator[MatchTick]:
    """Play a match that has just begun, and yield its ticks; `after` is called after each step of the match.

    A step may be ahead of the tick that is yielded.
    """
    return match_ticks(match.simulation.setup(), _messages(match, after))


def _messages(match: InProcessMatch, after: Callable[[TickResult], None]) -> Iterator[tuple[int, Any]]:
    """The messages that statistics read, `recordings.soccer.stats.match_tick.KEYS`, each with its log time in ns."""
    simulation, schedule = match.simulation, StateSchedule(match.simulation.profile.time.tick)
    tick = simulation.now
    while True:
        state, episode, log_ns = simulation.state, tick.world["episode"], round(tick.time * 1e9)
        for event in tick.events:
            yield log_ns, event
        if schedule.is_due(state, tick.tick, episode, had_actions=bool(tick.replies)):
            yield log_ns, state.game_state(tick.tick, tick.time, episode)
        # without the readings, which are structs already, and which no figure needs
        yield log_ns, validated(World, {key: value for key, value in tick.world.items() if key != "sensors"})
        yield log_ns, Applied.decode(tick.applied_encoded)
        if simulation.over:
            return
        tick = match.step()
        after(tick)
