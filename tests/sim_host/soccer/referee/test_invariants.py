"""What holds in every match, however the ball flies and whatever people ask for."""

from hypothesis import example, given, settings
from hypothesis import strategies as st

from schemas.config.match_config import MatchConfig
from schemas.config.profile import load_profile
from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import RESTARTS, ActionName, EventKind, GameStage, OfficiatingMode, Phase, Point
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
TOO_MUCH = {
    "dribble_circle",
    "backward",
    "not_rolling",
    "long_hold",
    "goal_area",
    "penalty_area",
    "pushing",
    "charging",
    "lob",
}
"""Fouls of doing more than the limit."""
scuffles = st.none() | st.tuples(
    st.sampled_from(NAMES),
    st.floats(-11.5, 11.5),
    st.floats(-7.5, 7.5),
    st.sampled_from(NAMES),
    st.booleans(),
    st.booleans(),
)
"""A robot goes somewhere and leans on another, holds the ball for the whole flight, or hits the other in each tick."""
silences = st.sampled_from([(), (), ("cyan2",), ("magenta1", "magenta3")])


@settings(max_examples=20)
@example(
    rules="china-sim-2020",
    mode=OfficiatingMode.AUTOMATIC,
    winner=False,
    advantage=None,
    story=[
        ((0.0, 0.0, 0.0, "cyan1", 10), None, (), None),
        ((0.0, 0.0, 0.0, "cyan1", 1), RefereeAction(action=ActionName.DOUBLE_YELLOW, robot="cyan1"), (), None),
    ],
)
@given(
    rules=st.sampled_from(["friendly", "msl", "paper", "china-sim-2020"]),
    mode=st.sampled_from(OfficiatingMode),
    winner=st.booleans(),
    advantage=st.sampled_from([None, 3.0]),
    story=st.lists(st.tuples(flights, wishes, silences, scuffles), max_size=40),
)
def test_score_clock_and_restarts_are_sound_in_any_match(new_rig, rules, mode, winner, advantage, story):
    profile = "paper" if rules == "paper" else "msl"
    rig = new_rig(profile, rules, dt=0.1, duration=24.0, mode=mode, proposal=1.0, winner=winner, advantage=advantage)
    for (x, y, z, toucher, ticks), wish, silent, scuffle in story:
        seen = scuffled(rig, scuffle)
        for left in range(ticks, 0, -1):
            way = [b + (n - b) / left for b, n in zip(rig.ball, (x, y, z), strict=True)] if rig.state.running else None
            touches = [toucher] if toucher and left == ticks else []
            asked = [wish] if wish and left == ticks else []
            sound_step(rig, way, touches, asked, kicked=toucher if touches else None, silent=silent, **seen)
    for _ in range(9000):
        if rig.state.phase is Phase.FULL_TIME:
            break
        word = what_people_must_say(rig.state, mode)
        sound_step(rig, None, [], [RefereeAction(action=word)] if word else [])
    assert rig.state.phase is Phase.FULL_TIME
    every_stop_leads_on(rig.events)


def scuffled(rig, scuffle):
    """What there is to see of a scuffle: contact and motion of two robots, or a hold."""
    if scuffle is None:
        return {}
    name, x, y, other, holds, hits = scuffle
    if rig.robot(name) not in rig.state.participation.absences:
        rig.robots[name] = (x, y)
    speed = 4.0 if hits else 1.0
    pushing = {"motions": {name: (0.5, speed, 0.5), other: (0.5, 1.0, 0.4)}}
    if name != other:
        pushing["contacts"] = [(name, other)]
        pushing["impacts"] = [(name, other)] * hits
    return pushing | ({"possession": name} if holds else {})


def what_people_must_say(state, mode):
    """The word without which a match would not go on."""
    by_hand = mode is OfficiatingMode.MANUAL
    if state.stage is GameStage.SHOOT_OUT and state.shoot_out.taken.cyan + state.shoot_out.taken.magenta > 1:
        return ActionName.END_GAME  # it would take long without goals
    if by_hand and state.running and state.stage is GameStage.SHOOT_OUT:
        return ActionName.STOP
    if state.pending is not None or state.running:
        return None
    waits = state.phase is Phase.STOPPED or (by_hand and state.phase in RESTARTS)
    return ActionName.START if waits else None


def sound_step(rig, ball, touches, asked, **seen):
    before = rig.state
    ruling = rig.tick(ball, touches, asked, **seen)
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
    assert after.running <= (after.timing.runs or after.stage is GameStage.SHOOT_OUT)
    assert (after.spot is not None) == (after.phase in RESTARTS)
    assert after.spot is None or after.pending is None, "two restarts at once"
    assert after.timing.effective >= before.timing.effective or any(event.rule == "undo" for event in ruling.events)
    assert after.stage is not GameStage.SHOOT_OUT or after.score == before.score
    assert after.running or (after.advantage is None and not after.participation.owed), "a card is owed after a stop"
    assert after.advantage is None or after.phase is Phase.PLAY
    sent_off = {event.robot for event in ruling.events if event.kind is EventKind.OFF_FIELD}  # also for 0 s
    off_field = {*after.participation.absences, *before.participation.absences, *sent_off}
    for placement in ruling.placements:
        inside = abs(placement.x) <= rig.pitch.goal_line and abs(placement.y) <= rig.pitch.touch_line
        assert inside or placement.body in off_field
    for event in ruling.events:
        if event.kind is EventKind.FOUL and event.rule in TOO_MUCH:
            assert event.measured > event.limit and event.robot is not None and event.unit
    one_robot_of_each_number(rig)
    after.game_state(rig.at, rig.at * rig.dt)


def one_robot_of_each_number(rig):
    """Who is off the field stands beyond the boundary, all others within it."""
    reach = rig.pitch.touch_line + rig.pitch.border
    for name, (_, y) in rig.robots.items():
        assert (abs(y) > reach) == (rig.robot(name) in rig.state.participation.absences), name


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
