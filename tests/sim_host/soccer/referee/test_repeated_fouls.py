"""Repeated fouls: a robot that commits fouls of one kind again and again is shown a yellow card."""

import pytest

from schemas.side import Side
from schemas.soccer.game import EventKind, OfficiatingMode, Phase
from sim_host.soccer.referee.game.state_json import state_from_json, state_json

CYAN, MAGENTA = Side.CYAN, Side.MAGENTA
SPOT = (2.0, 1.0)


def encroach(rig, robot="magenta3"):
    """A robot encroaches on a free kick of cyan's."""
    if rig.state.phase is Phase.PRE_GAME:
        rig.playing()
    rig.robots |= {"cyan2": (1.6, 1.0), robot: (-6.0, 4.0)}
    if rig.state.phase is not Phase.STOPPED or rig.state.pending is None:
        rig.ask("free_kick", CYAN, SPOT)
    rig.until(lambda state: state.running)
    rig.tick()
    rig.robots[robot] = (2.0, 3.0)
    rig.tick()
    rig.robots[robot] = (-6.0, 4.0)


def charge(rig, robot="magenta3", victim="cyan4", speed=2.0):
    """A robot charges, with play on."""
    if rig.state.phase is not Phase.PLAY:
        rig.ask("drop_ball", place=(1.0, -4.0))
        rig.until(lambda state: state.phase is Phase.PLAY)
    rig.robots |= {victim: (0.0, 2.0), robot: (0.5, 2.0)}
    rig.tick(impacts=[(victim, robot)], motions={robot: (0.0, -speed, 0.0)})
    rig.robots[robot] = (-6.0, 4.0)


def cards(rig):
    return [(event.rule, event.robot) for event in rig.events if event.kind is EventKind.CARD]


@pytest.mark.parametrize("mirrored", [False, True])
def test_the_second_encroachment_of_a_robot_is_a_yellow_card(new_rig, mirrored):
    rig = new_rig(mirrored=mirrored)
    robot = rig.robot("magenta3")
    encroach(rig)
    assert cards(rig) == []
    encroach(rig)
    assert cards(rig) == [("encroachment", robot)]
    assert f"foul 2 of this kind by {robot}" in next(event.text for event in rig.events if event.card)


def test_each_further_encroachment_is_a_card_until_the_robot_is_off(new_rig):
    rig = new_rig()
    for _ in range(3):
        encroach(rig)
    assert cards(rig) == [("encroachment", "magenta3")] * 2
    assert "magenta3" in rig.state.participation.absences


def test_encroachments_of_different_robots_are_counted_apart(new_rig):
    rig = new_rig()
    encroach(rig, "magenta3")
    encroach(rig, "magenta4")
    assert cards(rig) == []


def test_a_robot_that_stood_too_near_at_start_repeats_it_by_encroaching(new_rig):
    """Its first offence is a card by itself, as the rule book says of positions."""
    rig = new_rig().playing()
    rig.robots |= {"cyan2": (1.6, 1.0), "magenta3": (2.0, 3.0)}
    rig.ask("free_kick", CYAN, SPOT)
    rig.until(lambda state: state.running, 30.0)
    assert cards(rig) == [("positions", "magenta3")]
    assert rig.state.participation.offences == {"magenta3": {"encroachment": 1}}
    rig.tick()
    rig.robots["magenta3"] = (2.0, 3.0)
    rig.tick()
    assert cards(rig) == [("positions", "magenta3"), ("encroachment", "magenta3")]


def test_the_third_foul_of_one_kind_is_a_yellow_card_and_fouls_of_other_kinds_do_not_count(new_rig):
    rig = new_rig().playing()
    charge(rig)
    charge(rig)
    encroach(rig)
    assert cards(rig) == []
    charge(rig)
    assert cards(rig) == [("charging", "magenta3")]


def test_a_foul_that_is_a_card_by_itself_is_one_card_and_counts(new_rig):
    rig = new_rig().playing()
    charge(rig, speed=3.5)
    charge(rig)
    assert cards(rig) == [("charging", "magenta3")]
    charge(rig)
    assert cards(rig) == [("charging", "magenta3")] * 2


def test_a_foul_that_is_overruled_does_not_count(new_rig):
    rig = new_rig(mode=OfficiatingMode.MIXED, proposal=2.0).playing()
    for _ in range(4):
        charge(rig)
        rig.ask("overrule")
    assert cards(rig) == [] and rig.state.participation.offences == {}


def test_a_proposal_has_the_card_that_follows(new_rig):
    rig = new_rig(mode=OfficiatingMode.MIXED, proposal=2.0).playing()
    for _ in range(3):
        charge(rig)
        rig.ask("confirm")
    proposals = [event.card for event in rig.events if event.kind is EventKind.PROPOSAL]
    assert proposals[:2] == [None, None] and proposals[2] is not None


def test_a_foul_that_is_undone_does_not_count(new_rig):
    rig = new_rig().playing()
    for _ in range(3):
        charge(rig)
        rig.ask("undo")
    charge(rig)
    assert cards(rig) == [] and rig.state.participation.offences == {"magenta3": {"charging": 1}}


@pytest.mark.parametrize(("lost", "rule"), [(True, "lost"), (False, "used")])
def test_a_foul_with_an_advantage_counts_once(new_rig, lost, rule):
    rig = new_rig(advantage=1.0).playing((1.0, 1.0))
    rig.robots["cyan3"] = (0.7, 1.0)
    rig.robots |= {"cyan4": (0.0, -3.0), "magenta3": (0.5, -3.0)}
    seen = {"impacts": [("cyan4", "magenta3")], "motions": {"magenta3": (0.0, -2.0, 0.0)}}
    rig.tick((1.0, 1.0), ["cyan3"], possession="cyan3", **seen)
    for _ in range(75):
        name = "magenta4" if lost else "cyan3"
        rig.tick((1.0, 1.0), [name], possession=name)
    assert rig.state.participation.offences == {"magenta3": {"charging": 1}}
    assert any(rule in event.text for event in rig.events)


def test_the_counts_are_part_of_the_recorded_state(new_rig):
    rig = new_rig().playing()
    charge(rig)
    encroach(rig)
    assert state_from_json(state_json(rig.state)) == rig.state


@pytest.mark.parametrize(("rules", "kept"), [("msl", True), ("china-sim-2020", False)])
def test_counts_are_cleared_at_half_time_with_the_cards(new_rig, rules, kept):
    rig = new_rig(rules=rules, duration=60.0).playing()
    charge(rig)
    rig.until(lambda state: state.half == 2, 200.0)
    assert bool(rig.state.participation.offences) is kept


def test_a_friendly_counts_nothing(new_rig):
    rig = new_rig(rules="friendly").playing()
    for _ in range(4):
        charge(rig, speed=3.0)
    assert cards(rig) == [] and rig.state.participation.offences == {}
