"""Twenty matches of the shipped teams by the league's rules: is each played to its end, and does play flow?

    python benchmarks/bench_referee.py --duration 1800

For each seed: the score, the share of the running clock in which the ball was in play, the longest time in which it was
not, and the longest time in which it was and made no progress. The rules allow for the first the sum of STOP to signal,
signal to START, and the limit for putting the ball in play; for the second the longer one of the clocks of a still and
of a contested ball. In the same runs the cost of the referee's step is measured, as a share of the whole tick.
"""

import argparse
import math
import multiprocessing
import sys
import time
from functools import partial
from typing import NamedTuple

from schemas.config.match_config import load_match
from schemas.config.soccer.rule_book import load_rule_book
from schemas.soccer.game import Phase
from touchline.play.play_match import InProcessMatch

RULES = "msl"
SEEDS = range(1, 21)
DURATION_S = 120.0
IN_PLAY_AT_LEAST = 0.6
PROGRESS_M = 0.5
"""A ball that stays within this distance of a point makes no progress."""
REFEREE_AT_MOST = 0.05


class Flow(NamedTuple):
    """Figures of one match."""

    seed: int
    cyan: int
    magenta: int
    in_play: float
    """Share of the running clock."""
    longest_stop: float
    """Longest time of the running clock without the ball in play, in s."""
    longest_stall: float
    """Longest time with the ball in play within `PROGRESS_M` of a point, in s."""
    referee: float
    """Referee's share of the host's CPU time."""
    over: bool


def flow_of(seed: int, duration: float) -> Flow:
    """Play one match in this process."""
    table = InProcessMatch(load_match(None, {"seed": seed, "rules": RULES, "duration": duration}))
    simulation = table.simulation
    judge, judging = simulation.judge.step, 0.0

    def timed_judge(*arguments: object) -> object:
        nonlocal judging
        began = time.thread_time()
        ruling = judge(*arguments)  # type: ignore[arg-type]
        judging += time.thread_time() - began
        return ruling

    simulation.judge.step = timed_judge  # type: ignore[assignment, method-assign]
    step, stepping = simulation.step, 0.0

    def timed_step(*arguments: object) -> object:
        nonlocal stepping
        began = time.thread_time()
        tick = step(*arguments)  # type: ignore[arg-type]
        stepping += time.thread_time() - began
        return tick

    simulation.step = timed_step  # type: ignore[assignment, method-assign]
    stopped = longest = stalled = longest_stall = 0.0
    anchor = (math.inf, math.inf)
    clock = simulation.state.timing.clock
    while not simulation.over:
        table.step()
        state = simulation.state
        passed, clock = state.timing.clock - clock, state.timing.clock
        stopped = 0.0 if state.phase is Phase.PLAY else stopped + passed
        longest = max(longest, stopped)
        ball = simulation.now.world["ball"]
        place = (ball["x"], ball["y"])
        if state.phase is Phase.PLAY and math.dist(anchor, place) < PROGRESS_M:
            stalled += passed
            longest_stall = max(longest_stall, stalled)
        else:
            anchor, stalled = place, 0.0
    timing, score = simulation.state.timing, simulation.state.score
    share = timing.effective / timing.clock
    return Flow(seed, score.cyan, score.magenta, share, longest, longest_stall, judging / stepping, simulation.over)


def main() -> int:
    """Print a line for each match and a summary. Returns 1 if a limit is exceeded."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--duration", type=float, default=DURATION_S, help="simulated s")
    options = parser.parse_args()
    book = load_rule_book(RULES)
    restarts, stall_allowed = book.restarts, max(book.stall.still_duration, book.scrum.duration)
    waiting = max(restarts.signal_to_start, restarts.positions_limit)
    allowed = restarts.stop_to_signal + waiting + max(restarts.time_limit, restarts.penalty_limit)
    with multiprocessing.get_context("spawn").Pool() as pool:
        flows = []
        for flow in pool.imap(partial(flow_of, duration=options.duration), SEEDS):
            flows.append(flow)
            print(
                f"seed {flow.seed:2}: {flow.cyan} : {flow.magenta}, ball in play {flow.in_play:4.0%}, "
                f"longest stop {flow.longest_stop:4.1f} s, longest stall {flow.longest_stall:4.1f} s",
                flush=True,
            )
    in_play = sum(flow.in_play for flow in flows) / len(flows)
    longest, stall = max(flow.longest_stop for flow in flows), max(flow.longest_stall for flow in flows)
    referee = sorted(flow.referee for flow in flows)[len(flows) // 2]
    print(
        f"referee: {sum(flow.over for flow in flows)} of {len(flows)} matches by {RULES} to full time, ball in play "
        f"{in_play:.0%} of the running clock (at least {IN_PLAY_AT_LEAST:.0%}), longest stop {longest:.1f} s (allowed "
        f"{allowed:g}), longest stall {stall:.1f} s (allowed {stall_allowed:g}), a step of the referee {referee:.1%} "
        f"of the tick (at most {REFEREE_AT_MOST:.0%})"
    )
    flowed = in_play >= IN_PLAY_AT_LEAST and longest <= allowed and stall <= stall_allowed
    return 0 if flowed and all(flow.over for flow in flows) else 1


if __name__ == "__main__":
    sys.exit(main())
