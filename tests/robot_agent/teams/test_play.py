"""Behaviour of whole squads: which robot plays, distances of the others, obedience to coach and referee."""

import itertools
import math

import pytest
from msgspec.structs import replace

from robot_agent.loading.brain_loader import load_brain
from robot_agent.sdk.contract import Briefing
from robot_agent.teams.player import RADIO_EVERY
from robot_agent.teams.set_piece import required_distance
from robot_agent.teams.simple.striker import PATIENCE
from schemas.messages.coach import CoachMode, CoachOrder
from schemas.messages.command import Drive
from schemas.messages.soccer.game import DisciplinaryRecord
from schemas.side import Side
from schemas.soccer.game import OffField, Point, TeamPhase

TEAMS = ("simple", "nubot")
PLAYING = {"simple": "striker", "nubot": "plays the ball"}
SET_PIECES = [phase for phase in TeamPhase if phase.ours or phase.theirs or phase is TeamPhase.DROP_BALL]
SPOTS = {"kick_off": (0.0, 0.0), "corner": (10.7, 6.7), "throw_in": (3.0, 6.85), "penalty": (7.4, 0.0)}


def spot_of(phase):
    x, y = next((spot for word, spot in SPOTS.items() if word in phase), (1.5, -2.0))
    return (-x, -y) if phase.theirs else (x, y)


def settle(squad, phase, ticks=300, running=False):
    x, y = spot_of(phase)
    for _ in range(ticks):
        squad.move(squad.act(ball=(x, y), phase=phase, running=running, spot=Point(x=x, y=y)))
    return x, y


def players(squad):
    playing = PLAYING["simple" if "simple" in type(next(iter(squad.brains.values()))).__module__ else "nubot"]
    return [name for name, word in squad.said.items() if word.role == playing]


@pytest.mark.parametrize("team", TEAMS)
@pytest.mark.parametrize("ball", [(0.0, 0.0), (-6.0, 0.0), (4.0, 5.0), (-2.0, 0.0), (-5.0, 0.0)])
def test_exactly_one_robot_plays_the_ball(squad, team, ball):
    made = squad(team)
    for _ in range(2 * RADIO_EVERY):
        made.act(ball=ball)
    assert len(players(made)) == 1


@pytest.mark.parametrize("team", TEAMS)
def test_of_two_equally_near_robots_the_same_one_plays_the_ball(squad, team):
    made = squad(team, {1: (-10.5, 0.0, 0.0), 2: (0.0, 2.0, 0.0), 3: (0.0, -2.0, 0.0)})
    seen = set()
    for tick in range(60):
        made.act(ball=(0.0, 0.05 if tick % 2 else -0.05))
        if tick > 2 * RADIO_EVERY:
            seen.add(tuple(players(made)))
    assert len(seen) == 1


@pytest.mark.parametrize("team", TEAMS)
@pytest.mark.parametrize("is_held", [False, True])
def test_a_taker_between_two_equally_good_receivers_turns_to_one_of_them(squad, team, is_held):
    """As seen in a match: the noise made now one, now the other the better one, and the taker danced for 6 s."""
    poses = {1: (-10.5, 0.0, 0.0), 2: (-7.75, 0.0, 0.0), 3: (-4.0, 3.4, 3.0), 4: (-4.0, -3.4, 3.0)}
    made, turns, spot = squad(team, poses), [], Point(x=-7.4, y=0.0)
    for tick in range(100):
        better = 3 if tick // 10 % 2 else 4
        for number in (3, 4):
            made.poses[f"cyan{number}"] = (-3.95 if number == better else -4.05, *poses[number][1:])
        said = made.act(ball=(-7.4, 0.0), phase=TeamPhase.OUR_GOAL_KICK, running=True, spot=spot, holding=is_held)
        turns.append(said["cyan2"].drive.omega if is_held else said["cyan2"].drive.vy)
    settled = turns[20:]
    assert min(settled) > 0.0 or max(settled) < 0.0


def test_a_striker_in_a_hurry_between_two_receivers_turns_to_one_of_them(squad):
    """The one that it had chosen was forgotten in every tick without a kick."""
    poses = {2: (-3.0, 0.0, 0.0), 3: (-1.0, 4.0, 3.0), 4: (-1.0, -4.0, 3.0)}
    made, turns = squad("simple", poses), []
    made.brains = {"cyan2": made.brains["cyan2"]}
    for tick in range(round(1.5 * PATIENCE * 50)):
        better = 3 if tick // 10 % 2 else 4
        for number in (3, 4):
            made.poses[f"cyan{number}"] = (-0.9 if number == better else -1.1, *poses[number][1:])
        made.meet()
        turns.append(made.act(ball=(-2.65, 0.0), holding=True)["cyan2"].drive.omega)
    hurried = turns[round(1.1 * PATIENCE * 50) :]
    assert min(hurried) > 0.0 or max(hurried) < 0.0


@pytest.mark.parametrize("team", TEAMS)
@pytest.mark.parametrize("phase", SET_PIECES)
def test_before_start_all_robots_keep_the_required_distance_from_the_ball(squad, setup, team, phase):
    made = squad(team)
    spot = settle(made, phase)
    radius, asked = setup.robot.radius, required_distance(phase, setup.restarts)
    distances = {name: math.dist(pose[:2], spot) - radius for name, pose in made.poses.items()}
    taker = min(distances, key=distances.get) if phase.ours else None
    for name, distance in distances.items():
        if name == taker:
            assert distance > setup.ball.radius  # waits, without touching
        elif not (phase is TeamPhase.THEIR_PENALTY and name == "cyan1"):
            assert distance >= asked, f"{name} {distance}"


@pytest.mark.parametrize("team", TEAMS)
@pytest.mark.parametrize("phase", [TeamPhase.OUR_KICK_OFF, TeamPhase.THEIR_KICK_OFF])
def test_at_a_kick_off_all_robots_return_to_their_own_half(squad, setup, team, phase):
    made = squad(team, {1: (-10.5, 0.0, 0.0), 2: (8.0, 1.0, 0.0), 3: (2.0, -5.0, 0.0), 4: (5.0, 2.0, 0.0)})
    spot = settle(made, phase)
    distances = {name: math.dist(pose[:2], spot) for name, pose in made.poses.items()}
    taker = min(distances, key=distances.get) if phase.ours else None
    for name, (x, _, _) in made.poses.items():
        assert x < (0.0 if name == taker else -setup.robot.radius)


@pytest.mark.parametrize("team", TEAMS)
def test_a_robot_too_near_leaves_the_circle_at_once_and_the_others_go_around_it(squad, setup, team):
    made = squad(team, {1: (-10.5, 0.0, 0.0), 2: (1.0, 0.5, 0.0), 3: (4.5, 0.0, 0.0), 4: (-5.0, 2.0, 0.0)})
    phase, spot = TeamPhase.THEIR_FREE_KICK, (0.0, 0.0)
    outside = setup.restarts.opponent_distance + setup.robot.radius
    nearest = math.inf
    for tick in range(300):
        seen = {"ball": spot, "phase": phase, "running": False, "spot": Point(x=0.0, y=0.0)}
        made.move(made.act(**seen))
        nearest = min(nearest, math.dist(made.poses["cyan3"][:2], spot))
        if tick == 100:
            assert math.dist(made.poses["cyan2"][:2], spot) > outside
    assert nearest > outside


@pytest.mark.parametrize("team", TEAMS)
@pytest.mark.parametrize("phase", [TeamPhase.STOPPED, TeamPhase.HALF_TIME, TeamPhase.PRE_GAME, TeamPhase.FULL_TIME])
def test_in_a_pause_all_robots_stand_still(squad, team, phase):
    commands = squad(team).act(ball=(0.0, 0.0), phase=phase, running=False)
    assert all(command.drive == Drive() and not command.dribble for command in commands.values())


@pytest.mark.parametrize("team", TEAMS)
@pytest.mark.parametrize("phase", [TeamPhase.OUR_THROW_IN, TeamPhase.OUR_FREE_KICK, TeamPhase.OUR_KICK_OFF])
def test_after_start_the_taker_kicks_the_ball_it_holds_hard_enough_to_be_in_play(squad, setup, team, phase):
    made = squad(team)
    x, y = settle(made, phase)
    spot = {"ball": (x, y), "phase": phase, "running": True, "spot": Point(x=x, y=y)}
    taker = min(made.poses, key=lambda name: math.dist(made.poses[name][:2], (x, y)))
    for _ in range(100):
        commands = {name: brain.act(made.sight(name, **spot)) for name, brain in made.brains.items()}
        away = math.dist(made.poses[taker][:2], (x, y))
        if away <= setup.dribble.distance:
            break
        made.move(commands)
        made.tick += 1
    assert commands[taker].dribble
    for _ in range(50):
        command = made.brains[taker].act(made.sight(taker, **spot, holding=True))
        made.tick += 1
        if command.kick is not None:
            break
        made.move({taker: command})
    speed = command.kick.speed
    assert speed * speed / (2.0 * setup.ball.rolling_deceleration) > 2.0 * setup.restarts.in_play_distance


@pytest.mark.parametrize("team", TEAMS)
def test_at_their_restart_no_robot_goes_for_the_ball_even_after_start(squad, setup, team):
    made = squad(team)
    spot = settle(made, TeamPhase.THEIR_THROW_IN, 300, running=True)
    nearest = min(math.dist(pose[:2], spot) for pose in made.poses.values())
    assert nearest - setup.robot.radius >= setup.restarts.opponent_distance


@pytest.mark.parametrize("team", TEAMS)
def test_after_a_kick_the_dribbler_lets_go_so_that_a_soft_kick_leaves(squad, team):
    made = squad(team, {1: (-10.5, 0.0, 0.0), 3: (-0.35, 0.0, 0.0)})
    kick = {"ball": (0.0, 0.0), "phase": TeamPhase.OUR_FREE_KICK, "spot": Point(x=0.0, y=0.0)}
    for _ in range(100):
        commands = made.act(holding=True, **kick)
        made.poses["cyan3"] = (-0.35, 0.0, made.poses["cyan3"][2] + 0.02 * commands["cyan3"].drive.omega)
        if commands["cyan3"].kick is not None:
            break
    assert commands["cyan3"].kick is not None
    after = [made.act(**kick)["cyan3"].dribble for _ in range(40)]
    assert not any(after[:15])
    assert after[-1]


@pytest.mark.parametrize("team", TEAMS)
def test_a_robot_that_cannot_kick_yet_keeps_the_ball_and_kicks_as_soon_as_the_kicker_is_charged(squad, team):
    made = squad(team, {1: (-10.5, 0.0, 0.0), 2: (-0.35, 0.0, 0.0)})
    kick = {"ball": (0.0, 0.0), "phase": TeamPhase.OUR_FREE_KICK, "spot": Point(x=0.0, y=0.0), "holding": True}
    for _ in range(100):
        command = made.act(kicker_ready=False, **kick)["cyan2"]
        made.poses["cyan2"] = (-0.35, 0.0, made.poses["cyan2"][2] + 0.02 * command.drive.omega)
        assert command.kick is None and command.dribble
    commands = [made.act(**kick)["cyan2"] for _ in range(5)]
    assert any(command.kick for command in commands)


@pytest.mark.parametrize("team", TEAMS)
def test_all_robots_send_ten_times_a_second_and_not_all_at_once(squad, setup, team):
    made = squad(team)
    spoken = {name: [] for name in made.poses}
    for tick in range(50):
        for name, command in made.act(ball=(0.0, 0.0)).items():
            if command.radio is not None:
                spoken[name].append(tick)
                assert command.radio.self is not None and command.radio.ball is not None and command.radio.role
    assert {len(ticks) for ticks in spoken.values()} == {10}
    assert len({tuple(ticks) for ticks in spoken.values()}) == 5


@pytest.mark.parametrize("team", TEAMS)
def test_an_unseen_ball_is_searched_for_and_the_keeper_stays(squad, setup, team):
    made = squad(team)
    for _ in range(290):
        made.move(made.act(ball=None))
    quarters = {(x > 0, y > 0) for name, (x, y, _) in made.poses.items() if name != "cyan1"}
    assert len(quarters) == 4
    assert made.poses["cyan1"][0] < -setup.pitch.goal_line + 1.0


@pytest.mark.parametrize("team", TEAMS)
def test_what_was_believed_is_void_in_another_episode(squad, team):
    """A reset restarts what robots do."""
    made = squad(team, {2: (0.0, 0.0, 0.0)})
    brain = made.brains["cyan2"]
    for episode, anew in ((1, False), (2, True), (2, False)):
        believed = brain._world
        sight = made.sight("cyan2", ball=(3.0, 1.0))
        brain.act(replace(sight, game=replace(sight.game, episode=episode)))
        made.tick += 1
        assert (brain._world is not believed) is anew


@pytest.mark.parametrize("team", TEAMS)
def test_both_sides_do_the_same_in_the_same_situation(squad, team):
    sides = [squad(team, side=side) for side in Side]
    for _ in range(30):
        commands = [
            [replace(command, radio=None) for command in made.act(ball=(1.0, 0.5, -0.5, 0.0)).values()]
            for made in sides
        ]
        assert commands[0] == commands[1]


@pytest.mark.parametrize("team", TEAMS)
def test_equal_sights_give_equal_commands(squad, team):
    first, second = squad(team), squad(team)
    for _ in range(30):
        commands = [made.act(ball=(1.0, 0.5, -0.5, 0.0), opponents=[(2.0, 0.0)]) for made in (first, second)]
        assert commands[0] == commands[1]
        first.move(commands[0])
        second.move(commands[1])


@pytest.mark.parametrize("team", TEAMS)
def test_an_order_is_acknowledged_and_hold_holds_and_park_parks(squad, setup, team):
    made = squad(team)
    order = CoachOrder(sequence=7, mode=CoachMode.HOLD)
    commands = made.act(ball=(0.0, 0.0), order=order)
    assert all(command.acknowledges_order == 7 and command.drive == Drive() for command in commands.values())
    for _ in range(700):
        made.move(made.act(ball=(0.0, 0.0), order=CoachOrder(sequence=8, mode=CoachMode.PARK)))
    assert all(y < -setup.pitch.touch_line + 0.5 for _, y, _ in made.poses.values())
    assert len({round(x) for x, _, _ in made.poses.values()}) == 5


@pytest.mark.parametrize("team", TEAMS)
def test_robots_go_round_each_other_on_their_way_to_park(squad, setup, team):
    """As seen in a match: two pushed each other along for a second, each in the other's straight way."""
    poses = {1: (-10.5, 0.0, 0.0), 2: (-2.0, 1.0, 0.0), 3: (-9.0, 2.0, 0.0), 4: (-3.0, -2.0, 0.0), 5: (-3.2, 0.4, 0.0)}
    made, nearest = squad(team, poses), math.inf
    for _ in range(600):
        made.move(made.act(ball=(0.0, 0.0), phase=TeamPhase.PARKING))
        places = [pose[:2] for pose in made.poses.values()]
        nearest = min(nearest, *(math.dist(a, b) for a, b in itertools.combinations(places, 2)))
    assert nearest > 2.0 * setup.robot.reach
    assert all(y < -setup.pitch.touch_line + 0.5 for _, y, _ in made.poses.values())


@pytest.mark.parametrize("team", TEAMS)
def test_the_coachs_top_speed_is_kept(squad, team):
    made = squad(team)
    for _ in range(30):
        for command in made.act(ball=(8.0, 3.0), order=CoachOrder(sequence=1, max_speed=0.5)).values():
            assert math.hypot(command.drive.vx, command.drive.vy) <= 0.5 + 1e-9


@pytest.mark.parametrize("team", TEAMS)
def test_a_keeper_stays_in_its_goal_and_a_single_robot_follows_its_teams_description(squad, setup, sight_of, team):
    made = squad(team)
    for _ in range(200):
        made.move(made.act(ball=(5.0, 3.0)))
    x, y, _ = made.poses["cyan1"]
    assert x < -setup.pitch.goal_line + 1.0 and abs(y) < setup.pitch.goal_width / 2
    cyan = setup.teams[Side.CYAN].replace(robots=["cyan1"])
    alone = setup.replace(teams={**setup.teams, Side.CYAN: cyan})
    spec = {"simple": "robot_agent.teams.simple:Simple", "nubot": "robot_agent.teams.nubot:NuBot"}[team]
    brain = load_brain(spec, Briefing.of("cyan1", alone))
    command = brain.act(sight_of(4, "cyan1", (-4.0, 0.0, 0.0), ball=(0.0, 0.0)))
    toward_the_ball = command.drive.vx > 0.5
    assert toward_the_ball == (team == "nubot"), "the paper's robot plays, another keeps the goal"


@pytest.mark.parametrize("team", TEAMS)
@pytest.mark.parametrize("phase", list(TeamPhase))
@pytest.mark.parametrize("ball", [None, (10.9, 0.0), (0.0, 6.9, 3.0, 3.0)])
def test_every_phase_has_an_answer_with_or_without_a_ball(squad, team, phase, ball):
    made = squad(team)
    for running in (False, True):
        for command in made.act(ball=ball, phase=phase, running=running).values():
            assert math.isfinite(command.drive.vx + command.drive.vy + command.drive.omega)


@pytest.mark.parametrize("team", TEAMS)
def test_while_the_goalkeeper_is_off_the_field_the_next_robot_keeps_the_goal_until_it_is_back(squad, setup, team):
    made = squad(team)
    off = {"cyan1": DisciplinaryRecord(off_field=OffField.REPAIR)}

    def play(robots, ticks=400):
        for _ in range(ticks):
            made.move(made.act(ball=(3.0, 1.0), game={"robots": robots}))

    play({})
    made.poses["cyan1"] = (-1.0, -8.0, 1.5)
    play(off)
    goal = (-setup.pitch.goal_line, 0.0)
    assert math.dist(made.poses["cyan2"][:2], goal) < 1.0 and math.dist(made.poses["cyan3"][:2], goal) > 3.0
    assert made.said["cyan2"].role == "keeper" and len(players(made)) == 1
    play({}, ticks=600)
    assert math.dist(made.poses["cyan1"][:2], goal) < 1.0 and math.dist(made.poses["cyan2"][:2], goal) > 3.0
    assert made.said["cyan2"].role != "keeper" and len(players(made)) == 1
