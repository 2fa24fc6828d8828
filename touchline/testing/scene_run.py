"""Plays a scene in this process until its verdict, or for a given time."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from recordings.stats.match_tick import MatchTick, match_ticks
from schemas.config.drill import Drill
from touchline.matches.judging.judge import Verdict, verdict_of
from touchline.matches.judging.occurrences import Occurrence, OccurrenceTracker
from touchline.play import InProcessMatch
from touchline.tick_messages import TickMessages

Watch = Callable[[MatchTick, Sequence[Occurrence]], None]


def run_scene(
    match: InProcessMatch,
    tracker: OccurrenceTracker,
    drill: Drill | None,
    seconds: float | None,
    watch: Watch = lambda *_: None,
    poll: Callable[[], None] = lambda: None,
) -> Verdict | None:
    """Play a match that has just begun for `seconds` of simulated time; without that, until the drill's verdict.

    Returns the first verdict; None without a drill, or if the time was over before. `watch` gets each tick.
    """
    setup, verdict = match.simulation.setup(), None
    for tick in match_ticks(setup, _messages(match, poll)):
        occurrences = tracker.update(tick)
        watch(tick, occurrences)
        if verdict is None and drill is not None:
            verdict = verdict_of(drill, tick.world.time, occurrences)
        if tick.world.time >= seconds - 1e-9 if seconds is not None else verdict is not None:
            break
    return verdict


def _messages(match: InProcessMatch, poll: Callable[[], None]) -> Iterator[tuple[int, Any]]:
    messages = TickMessages(match.simulation)
    yield from messages.of(match.simulation.now)
    while not match.simulation.over:
        yield from messages.of(match.step())
        poll()
