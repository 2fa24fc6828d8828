"""Simulates one segment of a recording again, up to the first tick that differs from it."""

import math
from pathlib import Path
from typing import NamedTuple

from recordings.reading.command_check import CommandMismatch
from recordings.reading.record_order import RecordOrder
from recordings.reading.recorded_config import config_of
from recordings.reading.recording import Recording, open_recording
from recordings.reading.tick_index import Segment
from recordings.reading.tick_records import TickRecord, command_check_of, tick_records
from schemas.messages.applied import Applied, chained_part_of
from schemas.topics import EVENT, STATE
from schemas.wire.message import BadMessageError
from sim_host.games import arena_of_recording, game_of_recording
from sim_host.match.game_resimulation import GameResimulation, OfficiatedTick
from sim_host.match.resimulation import ImpossibleTickError, Resimulation
from sim_host.match.world_difference import differences
from touchline.verify.game_comparison import event_differences, state_differences
from touchline.verify.recorded_keys import is_recorded
from touchline.verify.resim_start import opening_conflict, resim_start, tick_length
from touchline.verify.verdict import Detail, Discrepancy

_MAY_FOLLOW = ("command", "belief")
"""Mismatches that prove nothing where a segment ended early: the command may have been recorded later."""


class SegmentResult(NamedTuple):
    """The result of one segment."""

    ticks: int
    without_world: int
    difference: Discrepancy | None


class SegmentCheck:
    """Simulates the ticks of a segment and compares each with its record."""

    def __init__(self, recording: Recording, segment: Segment, *, referee: bool) -> None:
        """With `referee`, the referee judges the match again, too."""
        self._recording, self._segment = recording, segment
        self._tick_s = tick_length(recording)
        self._world: Resimulation | None = None
        game = game_of_recording(config_of(recording), recording.manifest.setup) if referee else None
        self._referee = GameResimulation(game, self._tick_s) if game is not None else None
        self._states, self._events = is_recorded(recording, STATE.key), is_recorded(recording, EVENT.key)

    def close(self) -> None:
        """Free the engine."""
        if self._world is not None:
            self._world.close()

    def compare(self, record: TickRecord, before: TickRecord | None) -> Discrepancy | None:
        """Simulate and compare one tick; None if it is identical. `before` is the record of the tick before it.

        Raises:
            BadMessageError: `host/applied` of this tick is not a valid message.
            ImpossibleTickError: no host can have applied this tick.
        """
        applied: Applied = record.applied or record.recorded.message()  # raises the reason if it is damaged
        if self._world is None:
            start, config = resim_start(self._recording, self._segment, before), config_of(self._recording)
            arena = arena_of_recording(config, self._recording.manifest.setup)
            self._world = Resimulation(arena, *start, seed=config.seed if config is not None else None)
        simulated = self._world.step(applied, chained_part_of(record.recorded.payload))
        fields, judged = simulated.bodies, None
        if self._referee is not None:
            judged = self._referee.judge(applied, simulated.snapshot, simulated.profile)
            fields = self._referee.world_fields(fields)
        found = differences(record.world, fields) if record.world is not None else []
        bodies = [Detail(one.body, one.field, one.recorded, one.simulated, one.by) for one in found]
        same_chain = simulated.chain == applied.chain
        game = self._game_differences(record, applied, judged) if judged is not None and same_chain else []
        if same_chain and not found and not game:
            return None
        why = _reason(same_chain, bool(found), bool(game), record.world is not None)
        return Discrepancy(applied.tick, applied.time, why, bodies + game)

    def compare_next(self, record: TickRecord) -> Discrepancy | None:
        """Compare the state of the referee at the start of the next segment, which begins with the recorded one."""
        if self._referee is None or record.applied is None:
            return None
        conflicts = self._referee.begin_tick(record.applied)
        if not conflicts:
            return None
        details = [Detail("referee", one.field, one.recorded, one.simulated) for one in conflicts]
        return Discrepancy(record.tick, record.applied.time, _STATE_DIFFERS, details)

    def _game_differences(self, record: TickRecord, applied: Applied, judged: OfficiatedTick) -> list[Detail]:
        found = [Detail("referee", one.field, one.recorded, one.simulated) for one in judged.conflicts]
        if self._states:
            found += state_differences(record.states, judged)
        if self._events:
            found += event_differences(record.events, judged)
        if self._recording.damaged_records:  # the repair has left out messages, which `not_checked` reports
            found = [one for one in found if one.recorded is not None or one.field != "message"]
        if applied.tick == 0 and self._referee is not None:
            found += opening_conflict(self._recording, self._referee.state)
        if not math.isclose(applied.time, applied.tick * self._tick_s, abs_tol=1e-9):
            found.append(Detail("host/applied", "time", applied.time, applied.tick * self._tick_s))
        return found


_STATE_DIFFERS = "the recorded state of the referee is not the simulated one"


def _reason(same_chain: bool, world_differs: bool, game_differs: bool, has_world: bool) -> str:
    if same_chain and game_differs:
        also = ", and the recorded world differs" if world_differs else ""
        return f"the referee decides otherwise than recorded{also}"
    if same_chain:
        return "the hash chain is the same, but the recorded world differs"
    if world_differs:
        return "the simulated world differs"
    if not has_world:
        return "the hash chain differs, and no world was recorded to compare"
    return (
        "the hash chain differs and the world does not: the recorded inputs of this tick were changed, "
        "or the ball's spin differs"
    )


def resimulate_segment(path: Path, segment: Segment, referee: bool = False) -> SegmentResult:
    """Simulate one segment again, up to the first tick that differs from the recording.

    Raises:
        TouchlineError: the recording is damaged, or lacks the setup of the match.
    """
    recording = open_recording(path)
    check = command_check_of(recording, segment)
    order = RecordOrder(segment.ticks, tick_length(recording))
    again = SegmentCheck(recording, segment, referee=referee)
    ticks = without_world = 0
    difference: Discrepancy | None = None
    before: TickRecord | None = None
    try:
        for record in tick_records(recording, segment, check, order):
            if record.tick < segment.ticks.start:
                before = record
                continue
            try:
                if record.tick >= segment.ticks.stop:
                    difference = again.compare_next(record)
                    break
                if record.applied is not None:
                    check.add_applied(record.applied)
                difference = _misplaced(order, record.tick, record.recorded.time) or again.compare(record, before)
            except (BadMessageError, ImpossibleTickError) as error:
                difference = Discrepancy(record.tick, record.recorded.time, f"this tick is impossible: {error}")
            if difference is not None:
                break
            ticks += 1
            without_world += record.world is None
    finally:
        again.close()
    if difference is None:
        difference = _misplaced(order, segment.ticks.stop - 1, segment.seconds[1])
        if difference is None and ticks < len(segment.ticks):
            tick = segment.ticks.start + ticks
            difference = Discrepancy(tick, segment.seconds[0], "host/applied of this tick is not at its log time")
    return _with_contradictions(SegmentResult(ticks, without_world, difference), check.mismatches(), segment)


def _misplaced(order: RecordOrder, tick: int, seconds: float) -> Discrepancy | None:
    """The first message up to this tick that is not where it belongs."""
    fault = order.fault_until(tick)
    if fault is None:
        return None
    return Discrepancy(fault.tick, seconds, f"{fault.key} is doubled, out of order or shifted: {fault.why}")


def _with_contradictions(result: SegmentResult, mismatches: list[CommandMismatch], segment: Segment) -> SegmentResult:
    """The first difference, including inputs and beliefs that differ from the recorded commands."""
    end = result.difference.tick if result.difference is not None else segment.ticks.stop
    known = [
        one for one in mismatches if one.tick <= end and (result.difference is None or one.field not in _MAY_FOLLOW)
    ]
    if not known:
        return result
    tick = known[0].tick
    details = [_detail(one) for one in known if one.tick == tick]
    why = "; ".join(_contradictions(known, tick))
    if result.difference is not None and result.difference.tick == tick:
        why, details = f"{why}; {result.difference.why}", details + result.difference.details
    begins, ends = segment.seconds
    share = (tick - segment.ticks.start) / max(1, len(segment.ticks) - 1)
    moment = begins + share * (ends - begins)
    return result._replace(ticks=tick - segment.ticks.start, difference=Discrepancy(tick, moment, why, details))


def _contradictions(known: list[CommandMismatch], tick: int) -> list[str]:
    now = [one for one in known if one.tick == tick]
    inputs = ", ".join(dict.fromkeys(one.robot for one in now if one.field != "belief"))
    beliefs = ", ".join(dict.fromkeys(one.robot for one in now if one.field == "belief"))
    sentences = [f"the applied input of {inputs} is not its recorded command"] if inputs else []
    return sentences + ([f"the belief of {beliefs} is in none of its recorded commands"] if beliefs else [])


def _detail(one: CommandMismatch) -> Detail:
    if one.field == "belief":
        return Detail(f"belief of {one.robot}", "radio", one.applied, one.sent)
    numbers = [value for value in (one.applied, one.sent) if isinstance(value, float)]
    by = abs(numbers[0] - numbers[1]) if len(numbers) == 2 else None
    return Detail(f"input of {one.robot}", one.field, one.applied, one.sent, by)
