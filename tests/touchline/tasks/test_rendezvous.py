"""Rendezvous: the time together is the score, and the baseline knows no places."""

from pytest import approx

from robot_agent.sdk.contract import Briefing
from schemas.messages.sight import Sight
from support.task_moment import scored, task_config
from touchline.play.play_match import InProcessMatch
from touchline.tasks.rendezvous import Stranger


def near(gap: float) -> dict[str, tuple[float, float]]:
    """Five robots in a row, `gap` m from each other."""
    return {name: (2.0 + place * gap, 1.0) for place, name in enumerate(("one", "two", "three", "four", "five"))}


def test_the_time_counts_in_which_all_are_near_their_middle() -> None:
    apart = scored("rendezvous", near(1.0), time=1.0)
    met = scored("rendezvous", near(0.7), apart.memory, time=1.5)
    parted = scored("rendezvous", near(0.8), met.memory, time=2.5)
    assert (apart.value, met.value, parted.value) == (0.0, approx(0.5), approx(0.5))


def test_a_learner_is_paid_for_coming_nearer() -> None:
    apart = scored("rendezvous", near(2.0), time=1.0)
    nearer = scored("rendezvous", near(1.5), apart.memory, time=1.02)
    assert nearer.reward == approx(1.0) and nearer.value == 0.0


def test_the_baseline_answers_the_same_wherever_it_is_told_to_be() -> None:
    match = InProcessMatch(task_config("rendezvous"))
    briefing = Briefing.of("two", match.simulation.setup())
    informed, blind = Stranger(briefing), Stranger(briefing)
    for _ in range(20):
        sight: Sight = match.simulation.now.sights.perceived["two"]
        elsewhere = sight.self.replace(x=0.0, y=0.0, heading=0.0)
        command = informed.act(sight)
        assert command == blind.act(sight.replace(self=elsewhere, obstacles=[], radio={}))
        match.step()
    match.close()
    assert command.drive.vx != 0.0
