"""The variant that shows what collaboration is worth: the same team with its radios off."""

import msgspec

from robot_agent.sdk.contract import Briefing
from robot_agent.teams.reference import Reference, WithoutRadio

PLACES = {"cyan2": (-3.0, 0.0, 0.0), "cyan3": (-2.0, 3.0, 0.0), "magenta1": (11.0, 0.0, 3.14)}


def test_robots_without_radio_neither_send_nor_use_what_they_receive(scene, setup, monkeypatch):
    sights = []
    act = Reference.act
    monkeypatch.setattr(Reference, "act", lambda robot, sight: (sights.append(sight), act(robot, sight))[1])
    scene(PLACES, (0.0, 0.0)).play(1.0)
    monkeypatch.undo()
    received = [sight for sight in sights if "cyan3" in sight.radio]
    deaf, alone = (WithoutRadio(Briefing.of("cyan2", setup)) for _ in range(2))
    answers = [(deaf.act(sight), alone.act(msgspec.structs.replace(sight, radio={}))) for sight in received]
    assert len(answers) > 20
    assert all(one == other and one.radio is None for one, other in answers)


def test_without_radio_one_robot_takes_the_own_free_kick_and_nobody_is_cautioned(scene):
    """Each took itself for the taker: three stood at the ball, and a match had eleven cards in ten minutes."""
    field = {"cyan2": (-2, 2, 0), "cyan3": (-2, -2, 0), "cyan4": (-5, 1, 0), "cyan5": (-5, -2, 0)}
    teams = {
        "cyan": {"name": "Deaf", "brain": "robot_agent.teams.reference:WithoutRadio"},
        "magenta": {"name": "Reference", "brain": "robot_agent.teams.reference:Reference"},
    }
    robots = {"cyan1": (-10.5, 0, 0), **field, "magenta1": (10.5, 0, 3.14)}
    played = scene(robots, (-2.5, 0.0), "free_kick", "cyan", teams=teams).play(12.0)
    assert not [event for tick in played.ticks for event in tick.events if event.kind.value == "card"]
    assert [name for name in field if played.kicks(name)]
