"""The paper's machine alone, on an ideal drive and an ideal ball: states, constants and trajectories of figure 5."""

import math
from itertools import pairwise

import pytest

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.teams.nubot.machine import TRANSITIONS, Machine, Points, Situation, State
from robot_agent.teams.nubot.trajectory import ROTATION, TRANSLATION
from schemas.frames import wrap
from schemas.messages.command import KickMode

DT = 0.021
PATH = [State.CHASE_BALL, State.MOVE_BALL, State.ROTATE_BALL, State.KICK_BALL, State.RESET, State.HOME]


class Field:
    """A robot that moves exactly as the machine wants, and a ball that lies still until it is held."""

    def __init__(self, points=None, at=(0.0, 0.0, 2.0), ball=(2.0, 1.0), dt=DT):
        self.machine = Machine(points or Points())
        self.me = Body(*at)
        self.ball = ball
        self.dt = dt
        self.holding = False
        self.trace = []
        self.done = []

    def step(self, world_reset=False):
        away = math.dist(self.ball, self.me[:2])
        bearing = math.atan2(self.ball[1] - self.me.y, self.ball[0] - self.me.x) - self.me.heading
        self.holding = away <= 0.5 and abs(wrap(bearing)) <= math.radians(15.0)
        doing = self.machine.step(Situation(self.me, self.ball, self.holding, self.dt, world_reset))
        self.trace.append((self.machine.state, self.me, doing))
        heading = wrap(self.me.heading + doing.omega * self.dt)
        x, y = self.me.x + doing.vx * self.dt, self.me.y + doing.vy * self.dt
        self.me = Body(x, y, heading, doing.vx, doing.vy, doing.omega)
        if doing.kick:
            self.ball = (9.0, 0.0)
        elif self.holding and doing.dribble:
            self.ball = (x + 0.43 * math.cos(heading), y + 0.43 * math.sin(heading))
        return doing

    def run(self, until, most=4000):
        for _ in range(most):
            self.step()
            if self.machine.state is until:
                return
        pytest.fail(f"never came to {until}; is in {self.machine.state} at {self.me}")

    def path(self):
        states = [state for state, _, _ in self.trace]
        return [state for place, state in enumerate(states) if place == 0 or states[place - 1] is not state]


@pytest.fixture
def played():
    field = Field()
    field.run(State.HOME)
    return field


def test_a_run_goes_through_the_states_of_the_paper_in_their_order(played):
    assert played.path() == PATH


def test_the_table_has_exactly_the_papers_transitions():
    assert [(row.state.value, row.condition.__name__, row.next.value) for row in TRANSITIONS] == [
        ("CHASE_BALL", "ball_in_reach", "DRIBBLE_BALL/MOVE_BALL"),
        ("DRIBBLE_BALL/MOVE_BALL", "hold_lost", "CHASE_BALL"),
        ("DRIBBLE_BALL/MOVE_BALL", "at_dribble_point", "DRIBBLE_BALL/ROTATE_BALL"),
        ("DRIBBLE_BALL/ROTATE_BALL", "hold_lost", "CHASE_BALL"),
        ("DRIBBLE_BALL/ROTATE_BALL", "facing_goal", "KICK_BALL"),
        ("KICK_BALL", "at_once", "RESET"),
        ("RESET", "at_reset_point", "HOME"),
        ("HOME", "world_reset", "CHASE_BALL"),
    ]


def test_the_points_and_tolerances_are_the_papers(played):
    first = {}
    for state, me, _ in played.trace:
        first.setdefault(state, me)
    assert math.dist(first[State.ROTATE_BALL][:2], (4.0, -2.0)) <= 0.1
    kicking = first[State.KICK_BALL]
    assert abs(wrap(math.atan2(-kicking.y, 9.0 - kicking.x) - kicking.heading)) <= math.radians(0.25)
    assert math.dist(first[State.HOME][:2], (-4.0, -2.0)) <= 0.1


def test_the_kick_is_one_lob_at_twenty_metres_a_second(played):
    kicks = [doing.kick for _, _, doing in played.trace if doing.kick]
    assert [(kick.mode, kick.speed) for kick in kicks] == [(KickMode.LOB, 20.0)]


def test_a_kicker_that_charges_is_waited_for():
    """The paper's is always charged; the league's is not."""
    machine, now = Machine(Points()), Situation(Body(4.0, 0.0, 0.0), (4.43, 0.0), True, DT, kicker_ready=False)
    machine._enter(State.ROTATE_BALL)
    assert {machine.step(now).kick for _ in range(20)} == {None}
    assert machine.step(now._replace(kicker_ready=True)).kick is not None


def test_chasing_first_rotates_to_half_a_degree_and_then_translates(played):
    chase = [(me, doing) for state, me, doing in played.trace if state is State.CHASE_BALL]
    moves = [place for place, (_, doing) in enumerate(chase) if math.hypot(doing.vx, doing.vy) > 0.0]
    before, _ = chase[moves[0]]
    assert abs(wrap(math.atan2(1.0 - before.y, 2.0 - before.x) - before.heading)) <= math.radians(0.25)
    assert moves == list(range(moves[0], len(chase)))


def test_speeds_keep_to_the_trapezoids_of_the_paper(played):
    speeds = [math.hypot(doing.vx, doing.vy) for _, _, doing in played.trace]
    rates = [abs(doing.omega) for state, _, doing in played.trace if state is State.ROTATE_BALL and doing.omega]
    assert max(speeds) <= 3.0 + 1e-9
    assert min(speed for speed in speeds if speed > 0.0) >= 0.2 - 1e-9
    assert max(rates) <= math.radians(120.0) + 1e-9
    assert min(rates) >= math.radians(10.0)
    gains = [after - before for before, after in pairwise(speeds) if before > 0.0]
    assert max(gains) <= 2.0 * DT + 1e-9


def test_the_real_time_between_ticks_counts_not_a_constant():
    slow, fast = Field(dt=0.04), Field(dt=0.01)
    for field in (slow, fast):
        field.run(State.HOME)
    times = [len(field.trace) * field.dt for field in (slow, fast)]
    assert times[0] == pytest.approx(times[1], rel=0.03)


@pytest.mark.parametrize("state", [State.MOVE_BALL, State.ROTATE_BALL])
def test_a_lost_ball_is_chased_again(state):
    field = Field()
    field.run(state)
    field.ball = (0.0, 3.0)
    field.step()
    assert field.machine.state is State.CHASE_BALL
    field.run(State.HOME)
    assert field.path()[-6:] == PATH


def test_at_home_it_idles_until_the_world_is_reset(played):
    assert all(played.step() == (0.0, 0.0, 0.0, False, None) for _ in range(20))
    played.step(world_reset=True)
    assert played.machine.state is State.CHASE_BALL


def test_a_ball_that_moved_more_than_half_a_metre_is_faced_anew():
    field = Field(at=(0.0, 0.0, 0.0), ball=(3.0, 0.0))
    for _ in range(10):
        field.step()
    assert math.hypot(field.me.vx, field.me.vy) > 0.0
    field.ball = (3.0, 0.4)
    assert math.hypot(*field.step()[:2]) > 0.0
    field.ball = (3.0, 1.0)
    doing = field.step()
    assert (doing.vx, doing.vy) == (0.0, 0.0)
    assert doing.omega > 0.0
    while math.hypot(doing.vx, doing.vy) == 0.0:
        doing = field.step()
    assert math.hypot(doing.vx, doing.vy) == pytest.approx(0.2)  # from rest again, at the floor


def test_points_scale_with_the_pitch(setup):
    points = Points().on(setup.pitch)
    assert points.goal == pytest.approx((11.0, 0.0))
    assert points.dribble == pytest.approx((4.0 * 22 / 18, -2.0 * 14 / 12))


def test_the_constants_of_the_trajectories_are_the_papers():
    assert TRANSLATION == (2.0, 3.0, 0.2)
    assert [math.degrees(value) for value in ROTATION] == pytest.approx([120.0, 120.0, 10.0])


def test_a_trapezoid_rises_holds_and_falls_to_its_floor():
    assert TRANSLATION.next_speed(0.0, 10.0, 0.5) == 1.0
    assert TRANSLATION.next_speed(3.0, 10.0, 0.5) == 3.0
    assert TRANSLATION.next_speed(3.0, 1.0, 0.5) == 2.0
    assert TRANSLATION.next_speed(3.0, 0.0, 0.5) == 0.2


def test_limits_of_the_paper_profile_are_those_of_the_trajectories(paper_setup):
    limits = DriveLimits.of(paper_setup)
    assert (limits.acceleration, limits.speed) == TRANSLATION[:2]
    assert (limits.turn_acceleration, limits.turn_rate) == pytest.approx(ROTATION[:2])
