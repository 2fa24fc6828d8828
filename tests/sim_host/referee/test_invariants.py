"""What holds in every match, however the ball flies and whatever people ask for."""

from hypothesis import given, settings
from hypothesis import strategies as st

from schemas.game import RESTARTS, ActionName, EventKind, Phase, Point, RefereeAction
from schemas.match_config import MatchConfig
from schemas.profile import load_profile
from schemas.side import Side
from sim_host.snapshot import Roster

NAMES = Roster.of(MatchConfig(), load_profile("msl")).names
flights = st.tuples(
    st.floats(-13.0, 13.0),
    st.floats(-9.0, 9.0),
    st.floats(0.0, 2.0),
    st.sampled_from([*NAMES, None]),
    st.integers(1, 20),
)
actions = st.builds(
    RefereeAction,
    action=st.sampled_from(ActionName),
    side=st.sampled_from([None, *Side]),
    place=st.none() | st.builds(Point, x=st.floats(-12.0, 12.0), y=st.floats(-8.0, 8.0)),
    robot=st.sampled_from([None, *NAMES]),
)
wishes = st.none() | actions


@settings(max_examples=60, deadline=None)
@given(profile=st.sampled_from(["msl", "paper"]), story=st.lists(st.tuples(flights, wishes), max_size=40))
def test_score_clock_and_restarts_are_sound_in_any_match(new_bench, profile, story):
    bench = new_bench(profile, "friendly", dt=0.1, duration=24.0)
    for (x, y, z, toucher, ticks), wish in story:
        for left in range(ticks, 0, -1):
            way = (
                [b + (n - b) / left for b, n in zip(bench.ball, (x, y, z), strict=True)]
                if bench.state.running
                else None
            )
            touches = [toucher] if toucher and left == ticks else []
            sound_step(bench, way, touches, [wish] if wish and left == ticks else [])
    for _ in range(2000):
        if bench.state.phase is Phase.FULL_TIME:
            break
        people_must_act = bench.state.phase is Phase.STOPPED and bench.state.pending is None
        sound_step(bench, None, [], [RefereeAction(action=ActionName.START)] if people_must_act else [])
    assert bench.state.phase is Phase.FULL_TIME
    every_stop_leads_on(bench.events)


def sound_step(bench, ball, touches, asked):
    before = bench.state
    ruling = bench.tick(ball, touches, asked)
    after = ruling.state
    kinds = {event.kind for event in ruling.events}
    goals = [event for event in ruling.events if event.kind is EventKind.GOAL]
    if any(event.rule == "undo" for event in ruling.events):
        assert after.score.cyan <= before.score.cyan + 1 and after.score.magenta <= before.score.magenta + 1
    elif EventKind.FORFEIT not in kinds:
        assert after.score.cyan - before.score.cyan == sum(goal.side is Side.CYAN for goal in goals)
        assert after.score.magenta - before.score.magenta == sum(goal.side is Side.MAGENTA for goal in goals)
    assert before.clock <= after.clock <= after.timing.limit
    assert len(ruling.replies) == len(asked)
    assert after.running <= after.timing.runs
    assert (after.spot is not None) == (after.phase in RESTARTS)
    for placement in ruling.placements:
        inside = abs(placement.x) <= bench.pitch.goal_line and abs(placement.y) <= bench.pitch.touch_line
        assert inside or placement.body in {*after.people.away, *before.people.away}
    one_robot_of_each_number(bench)
    after.game_state(bench.at, bench.at * bench.dt)


def one_robot_of_each_number(bench):
    """Who is off the field stands beyond the boundary, all others within it."""
    reach = bench.pitch.touch_line + bench.pitch.border
    for name, (_, y) in bench.robots.items():
        assert (abs(y) > reach) == (bench.robot(name) in bench.state.people.away), name


def every_stop_leads_on(events):
    """After a STOP comes a restart signal or the end of a half before any START."""
    stopped = False
    for event in events:
        if event.kind is EventKind.STOP:
            stopped = True
        elif event.kind in (EventKind.RESTART, EventKind.HALF_TIME, EventKind.FULL_TIME):
            stopped = False
        elif event.kind in (EventKind.START, EventKind.IN_PLAY):
            assert not stopped, f"{event.text} without a restart after STOP"
    assert not stopped
