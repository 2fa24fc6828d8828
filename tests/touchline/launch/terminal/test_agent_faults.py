import pytest

from schemas.messages.health import Health, RobotHealth
from schemas.wire.part_faults import validated
from touchline.launch.terminal.agent_faults import InvalidAgents, SlowAgents, agent_faults


def health(pace: str = "lockstep", **robots: RobotHealth) -> Health:
    return Health(tick=100, time=2.0, pace=pace, real_time_factor=0.06, robots=robots)


def taking(latency_ms: float | None, **more: object) -> RobotHealth:
    return validated(RobotHealth, {"alive": True, "answering": True, "latency_ms": latency_ms, **more})


@pytest.mark.parametrize(
    ("pace", "latency_ms", "is_slow"),
    [
        ("lockstep", 100.0, False),
        ("lockstep", 101.0, True),
        ("realtime", 20.0, False),
        ("realtime", 21.0, True),
        ("x4", 5.0, False),
        ("x4", 6.0, True),
        ("lockstep", None, False),
    ],
)
def test_an_agent_is_slow_if_it_holds_the_match_or_misses_its_ticks(
    pace: str, latency_ms: float | None, is_slow: bool
) -> None:
    faults = agent_faults(health(pace, cyan1=taking(latency_ms)))
    assert [str(fault) for fault in faults] == ([f"cyan1 takes {latency_ms:.0f} ms a tick"] if is_slow else [])


def test_no_agent_is_slow_in_real_time_before_the_first_tick() -> None:
    before = Health(tick=0, time=0.0, pace="realtime", real_time_factor=0.0, robots={"cyan1": taking(50.0)})
    assert agent_faults(before) == []


def test_agents_whose_messages_are_no_answers_come_first_then_the_slowest() -> None:
    reported = health(
        cyan1=taking(200.0),
        cyan2=taking(310.0),
        cyan3=taking(300.0, answering=False, fault="answers tick 0, the match is at 100; use sight.tick"),
        magenta1=taking(900.0, still=True),
        magenta2=taking(900.0, removed=True),
        magenta3=taking(900.0, alive=False),
    )
    assert [str(fault) for fault in agent_faults(reported)] == [
        "cyan3 answers tick 0, the match is at 100; use sight.tick",
        "cyan2 takes 310 ms a tick",
        "cyan1 takes 200 ms a tick",
    ]


def test_a_slow_agent_is_reported_once_with_a_remedy_when_it_lasts() -> None:
    slow = SlowAgents()
    sentences = [slow.update(health(cyan1=taking(310.0))) for _ in range(10)]
    expected = (
        "cyan1 takes 310 ms a tick, the match runs at ×0.1; make its act faster, or play with --pace realtime, "
        "where a late command misses its tick"
    )
    assert sentences == [[], [], [], [expected], *[[]] * 6]
    assert slow.update(health(cyan1=taking(1.0))) == slow.update(health(cyan1=taking(310.0))) == []


def test_a_hiccup_is_not_reported() -> None:
    slow = SlowAgents()
    for latency in (310.0, 310.0, 310.0, 2.0) * 3:
        assert slow.update(health(cyan1=taking(latency))) == []


def test_in_real_time_a_slow_agent_is_reported_with_the_length_of_a_tick() -> None:
    slow = SlowAgents()
    (sentence,) = [line for _ in range(4) for line in slow.update(health("realtime", cyan1=taking(35.0)))]
    assert sentence == (
        "cyan1 takes 35 ms a tick, a tick lasts 20 ms, so its commands are late; make its act faster, "
        "or play in lockstep"
    )


def test_an_agent_whose_messages_are_no_commands_is_reported_once() -> None:
    agents = InvalidAgents()
    assert agents.update(health(cyan1=taking(1.0), cyan2=taking(1.0))) == []
    assert agents.update(health(cyan1=taking(1.0), cyan2=taking(1.0, invalid=3))) == [
        "cyan2 sends messages that are no commands, 3 so far; its log names them, and touchline health counts them"
    ]
    assert agents.update(health(cyan1=taking(1.0), cyan2=taking(1.0, invalid=9))) == []
