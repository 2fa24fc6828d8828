import signal
from pathlib import Path

import pytest

from recordings.recorder.settings import RecorderSettings
from robot_agent.process.settings import FIRST_SIGHT_FAILED, AgentSettings
from runtime.process.settings_file import WRONG
from schemas.errors import TouchlineError
from support.stepped_clock import SteppedClock
from touchline.launch.processes.process_table import Process, ProcessKind
from touchline.launch.processes.supervisor import ABANDONED, AFTER_THE_MATCH, AT_ONCE, Supervisor


class Actor:
    """A process that plays its part: runs until it is signalled, or ends with a status when the test sets one."""

    def __init__(self, name: str, clock: SteppedClock, deaf_to: frozenset[signal.Signals] = frozenset()) -> None:
        self.name = name
        self.exceeded = ""
        self.ended: int | None = None
        self.heard: list[tuple[float, signal.Signals]] = []
        self.has_core = self.speaks = True
        self._clock = clock
        self._deaf_to = deaf_to

    def status(self) -> int | None:
        return self.ended

    def send(self, number: signal.Signals) -> None:
        self.heard.append((round(self._clock.now(), 2), number))
        if number not in self._deaf_to and self.ended is None:
            self.ended = -number

    def core_wait(self) -> float:
        return 0.0 if self.has_core else self._clock.now()

    def last_lines(self, count: int = 5) -> list[str]:
        return [f"last word of {self.name}"] if self.speaks else []

    def breach(self) -> str:
        return self.exceeded


class Stage:
    """A supervisor over actors; `cast` holds each name's launches, the newest last."""

    def __init__(
        self,
        deaf_to: frozenset[signal.Signals] = frozenset(),
        agents: AgentSettings | None = None,
        *,
        page: bool = False,
    ) -> None:
        """The agents are brains where `agents` are their settings, a team's own programs otherwise."""
        self.clock = SteppedClock()
        self.deaf_to = deaf_to
        self.cast: dict[str, list[Actor]] = {}
        self.launched: list[Process] = []
        self.disk_is_full = False
        kinds = {
            "host": ProcessKind.HOST,
            "recorder": ProcessKind.RECORDER,
            "cyan1": ProcessKind.AGENT,
            "magenta1": ProcessKind.AGENT,
            **({"page": ProcessKind.PAGE} if page else {}),
        }
        processes = [
            Process(name, kind, ("program",), {}, *((3, agents) if kind is ProcessKind.AGENT else (0, None)))
            for name, kind in kinds.items()
        ]
        self.supervisor = Supervisor(processes, self.launch, self.clock)
        self.supervisor.start()

    def launch(self, process: Process) -> Actor:
        self.launched.append(process)
        if self.disk_is_full:
            raise TouchlineError("match.json: No space left on device; recorder reads its settings there")
        actor = Actor(process.name, self.clock, self.deaf_to)
        self.cast.setdefault(process.name, []).append(actor)
        return actor

    def end(self, name: str, status: int) -> None:
        self.cast[name][-1].ended = status


def test_processes_are_launched_in_the_order_of_the_table() -> None:
    assert list(Stage().cast) == ["host", "recorder", "cyan1", "magenta1"]


def test_a_crashed_agent_is_reported_with_its_last_words_and_launched_again() -> None:
    stage = Stage()
    stage.end("cyan1", 1)
    (notice,) = stage.supervisor.check()
    assert notice.sentence == "cyan1 ended with status 1; started again (1 of 3)"
    assert notice.log == ("last word of cyan1",)
    assert len(stage.cast["cyan1"]) == 2
    assert stage.supervisor.check() == []
    assert "cyan1" not in stage.supervisor.ended


def test_an_agent_that_was_ended_for_exceeding_a_limit_is_reported_with_the_limit_and_the_remedy() -> None:
    stage = Stage()
    stage.cast["cyan1"][-1].exceeded = "it used more than 2 GB of memory; raise [limits] memory"
    stage.end("cyan1", -signal.SIGKILL)
    (notice,) = stage.supervisor.check()
    assert notice.sentence == (
        "cyan1 was ended: it used more than 2 GB of memory; raise [limits] memory; started again (1 of 3)"
    )


@pytest.mark.parametrize(("number", "name"), [(signal.SIGSEGV, "SIGSEGV"), (signal.SIGRTMIN + 6, "signal 40")])
def test_an_agent_that_keeps_crashing_is_launched_again_three_times_and_then_left(number: int, name: str) -> None:
    stage = Stage()
    sentences = []
    for _ in range(6):
        stage.end("cyan1", -number)
        sentences += [notice.sentence for notice in stage.supervisor.check()]
    assert len(stage.cast["cyan1"]) == 4
    assert sentences[-1] == f"cyan1 was ended by {name}; not started again"
    assert len(sentences) == 4
    assert len(stage.cast["magenta1"]) == 1
    assert stage.supervisor.host_status is None


@pytest.mark.parametrize(("ended_first", "failure"), [("host", 1), ("cyan1", 2)])
def test_a_restarted_process_that_finds_no_host_any_more_has_failed_for_the_reason_before(
    ended_first: str, failure: int
) -> None:
    stage = Stage()
    for status in (3, 3, 1):  # restarted after each
        stage.end("cyan1", status)
        stage.supervisor.check()
    statuses = {"host": 0, "cyan1": 2}
    for name in sorted(statuses, key=lambda name: name != ended_first):
        stage.end(name, statuses[name])
        stage.supervisor.check()
    assert stage.supervisor.ended == statuses
    assert stage.supervisor.failure("cyan1") == (failure, ["last word of cyan1"])


def test_a_process_that_did_not_end_has_not_failed() -> None:
    stage = Stage()
    assert stage.supervisor.failure("cyan1") == (None, ["last word of cyan1"])
    assert stage.supervisor.failure("page") == (None, [])


def test_an_agent_that_leaves_with_status_0_is_reported_and_not_launched_again() -> None:
    stage = Stage()
    stage.end("cyan1", 0)
    (notice,) = stage.supervisor.check()
    assert notice.sentence == (
        "cyan1 ended with status 0 before the match was over; a robot's program runs until it receives SIGTERM"
    )
    assert notice.log == ("last word of cyan1",)
    assert stage.supervisor.check() == []
    assert len(stage.cast["cyan1"]) == 1
    assert stage.supervisor.ended == {"cyan1": 0}


def test_an_agent_that_leaves_after_the_host_is_not_reported() -> None:
    stage = Stage()
    stage.end("host", 0)
    stage.end("cyan1", 0)
    assert stage.supervisor.check() == []


def test_a_brain_that_fails_at_its_first_sight_is_not_launched_again() -> None:
    stage = Stage(agents=AgentSettings(robot="cyan1", brain="my_team:Striker"))
    stage.end("cyan1", FIRST_SIGHT_FAILED)
    (notice,) = stage.supervisor.check()
    assert notice.sentence == "cyan1 failed at its first sight; not started again"
    assert len(stage.cast["cyan1"]) == 1


def test_a_brain_that_failed_later_is_launched_again_even_if_it_then_fails_at_its_first_sight() -> None:
    stage = Stage(agents=AgentSettings(robot="cyan1", brain="my_team:Striker"))
    sentences = []
    for status in (1, FIRST_SIGHT_FAILED, FIRST_SIGHT_FAILED, FIRST_SIGHT_FAILED):
        stage.end("cyan1", status)
        sentences += [notice.sentence for notice in stage.supervisor.check()]
    assert sentences == [
        "cyan1 ended with status 1; started again (1 of 3)",
        "cyan1 failed at its first sight; started again (2 of 3)",
        "cyan1 failed at its first sight; started again (3 of 3)",
        "cyan1 failed at its first sight; not started again",
    ]


def test_a_brain_that_cannot_begin_is_not_launched_again_even_after_a_crash() -> None:
    stage = Stage(agents=AgentSettings(robot="cyan1", brain="my_team:Striker"))
    sentences = []
    for status in (1, WRONG):
        stage.end("cyan1", status)
        sentences += [notice.sentence for notice in stage.supervisor.check()]
    assert sentences == [
        "cyan1 ended with status 1; started again (1 of 3)",
        f"cyan1 ended with status {WRONG}; not started again",
    ]


@pytest.mark.parametrize("status", [WRONG, FIRST_SIGHT_FAILED])
def test_a_team_s_own_program_may_use_any_status(status: int) -> None:
    stage = Stage()
    stage.end("cyan1", status)
    (notice,) = stage.supervisor.check()
    assert notice.sentence == f"cyan1 ended with status {status}; started again (1 of 3)"


def test_a_brain_that_ends_its_process_later_is_launched_again_whatever_its_status() -> None:
    stage = Stage(agents=AgentSettings(robot="cyan1", brain="my_team:Striker"))
    stage.end("cyan1", 3)
    (notice,) = stage.supervisor.check()
    assert notice.sentence == "cyan1 ended with status 3; started again (1 of 3)"


def test_the_reason_of_an_end_is_what_the_process_said_or_else_its_status() -> None:
    stage = Stage()
    assert stage.supervisor.reason("cyan1") == "last word of cyan1"
    for actor in stage.cast["cyan1"]:
        actor.speaks = False
    assert stage.supervisor.reason("cyan1") == "logged nothing"
    stage.end("cyan1", 0)
    stage.supervisor.check()
    assert stage.supervisor.reason("cyan1") == "it ended with status 0 and logged nothing"


def test_a_page_and_a_recorder_that_end_with_status_0_are_not_reported() -> None:
    stage = Stage(page=True)
    for name in ("page", "recorder"):
        stage.end(name, 0)
    assert stage.supervisor.check() == []
    assert stage.supervisor.ended == {"recorder": 0, "page": 0}


def test_a_side_has_no_robot_when_all_its_programs_have_ended_for_good() -> None:
    stage = Stage()
    sides: tuple[list[str], ...] = (["cyan1"], ["cyan1", "magenta1"], [])
    stage.end("cyan1", 1)
    stage.supervisor.check()
    assert [stage.supervisor.has_no_robot(names) for names in sides] == [False, False, False]
    stage.end("cyan1", 0)
    stage.supervisor.check()
    assert [stage.supervisor.has_no_robot(names) for names in sides] == [True, False, False]


def test_programs_that_end_with_their_host_are_no_loss_but_brains_that_failed_are() -> None:
    stage = Stage(agents=AgentSettings(robot="cyan1", brain="my_team:Striker"))
    stage.end("host", 0)
    stage.end("cyan1", FIRST_SIGHT_FAILED)
    stage.end("magenta1", 1)
    stage.supervisor.check()
    assert [stage.supervisor.has_no_robot([name]) for name in ("cyan1", "magenta1")] == [True, False]


def test_an_abandoned_match_ends_its_host_first_and_gives_the_recorder_time() -> None:
    stage = Stage(deaf_to=frozenset({signal.SIGTERM}))
    stage.supervisor.end(ABANDONED, should_abort=lambda: stage.clock.now() > 20.0)
    assert stage.cast["host"][-1].heard[0] == (0.0, signal.SIGTERM)
    assert stage.cast["recorder"][-1].heard == []


def test_the_recorder_of_an_abandoned_match_finishes_a_second_after_its_host_has_ended() -> None:
    """Without a signal it would wait for the host to return."""
    stage = Stage(page=True)
    stage.supervisor.end(ABANDONED)
    heard = {name: launches[-1].heard for name, launches in stage.cast.items()}
    assert heard.pop("recorder") == [(pytest.approx(1.0, abs=0.05), signal.SIGTERM)]
    assert heard == {name: [(0.0, signal.SIGTERM)] for name in ("host", "cyan1", "magenta1", "page")}


def test_the_recorder_of_a_host_that_failed_is_not_left_to_wait_for_its_return() -> None:
    stage = Stage()
    stage.end("host", 3)
    stage.supervisor.end(ABANDONED)
    assert stage.cast["host"][-1].heard == []
    assert stage.cast["recorder"][-1].heard == [(pytest.approx(1.0, abs=0.05), signal.SIGTERM)]


def test_an_abandoned_match_ends_whatever_ignores_its_signal() -> None:
    stage = Stage(deaf_to=frozenset({signal.SIGTERM}))
    stage.supervisor.end(ABANDONED)
    assert all(launches[-1].heard[-1][1] is signal.SIGKILL for launches in stage.cast.values())


def test_a_process_without_restarts_is_reported_and_not_launched_again() -> None:
    stage = Stage()
    stage.end("recorder", 1)
    assert [notice.sentence for notice in stage.supervisor.check()] == [
        "recorder ended with status 1; not started again"
    ]
    assert len(stage.cast["recorder"]) == 1


def test_a_killed_recorder_is_launched_again_with_the_settings_it_had(tmp_path: Path) -> None:
    settings = RecorderSettings(out=tmp_path / "match.mcap")
    process = Process("recorder", ProcessKind.RECORDER, ("program",), {}, 3, settings, tmp_path / "recorder.json")
    clock = SteppedClock()
    actors: list[tuple[Process, Actor]] = []

    def launch(process: Process) -> Actor:
        actors.append((process, Actor(process.name, clock)))
        return actors[-1][1]

    supervisor = Supervisor([process], launch, clock)
    supervisor.start()
    actors[0][1].ended = -signal.SIGKILL
    (notice,) = supervisor.check()
    assert notice.sentence == "recorder was ended by SIGKILL; started again (1 of 3)"
    assert [launched.settings for launched, _ in actors] == [settings, settings]


def test_a_process_that_cannot_be_launched_again_is_reported_and_the_match_goes_on() -> None:
    stage = Stage()
    stage.end("cyan1", 1)
    stage.disk_is_full = True
    (notice,) = stage.supervisor.check()
    assert "cyan1 ended with status 1; cannot be started again: match.json: No space left" in notice.sentence
    assert stage.supervisor.ended == {"cyan1": 1}
    assert stage.supervisor.check() == []


def test_no_process_is_restarted_for_a_host_that_is_gone() -> None:
    stage = Stage()
    stage.end("cyan1", 1)
    stage.end("host", 3)
    assert stage.supervisor.check() == []
    assert stage.supervisor.host_status == 3
    assert len(stage.cast["cyan1"]) == 1


def test_a_recorder_that_has_no_core_is_not_ended_after_the_match_before_it_has_had_its_time() -> None:
    stage = Stage(deaf_to=frozenset({signal.SIGTERM}))
    stage.end("host", 0)
    recorder = stage.cast["recorder"][-1]
    recorder.has_core = False
    stage.supervisor.end(AFTER_THE_MATCH, should_abort=lambda: stage.clock.now() > 300.0)
    assert recorder.heard == []
    recorder.has_core = True
    stage.supervisor.end(AFTER_THE_MATCH)
    assert recorder.ended == -signal.SIGKILL


def test_a_page_that_has_no_core_is_not_killed_after_the_match_before_it_has_had_its_time() -> None:
    stage = Stage(deaf_to=frozenset({signal.SIGTERM}), page=True)
    stage.end("host", 0)
    page = stage.cast["page"][-1]
    page.has_core = False
    stage.supervisor.end(AFTER_THE_MATCH, should_abort=lambda: stage.clock.now() > 20.0)
    assert page.heard == [(0.0, signal.SIGTERM)]


def test_at_once_the_host_hears_first_and_the_recorder_last() -> None:
    stage = Stage()
    stage.supervisor.end(AT_ONCE)
    first = {name: actors[-1].heard[0] for name, actors in stage.cast.items()}
    assert first["host"] == (0.0, signal.SIGTERM)
    assert first["host"][0] < first["cyan1"][0] == first["magenta1"][0] < first["recorder"][0]
    assert set(stage.supervisor.ended) == set(stage.cast)


def test_whoever_does_not_listen_is_killed_within_two_seconds() -> None:
    stage = Stage(deaf_to=frozenset({signal.SIGTERM}))
    stage.supervisor.end(AT_ONCE)
    assert stage.supervisor.ended == dict.fromkeys(stage.cast, -signal.SIGKILL)
    assert stage.clock.now() < 2.0


def test_at_once_a_recorder_is_not_killed_while_it_waits_for_a_core() -> None:
    stage = Stage(deaf_to=frozenset({signal.SIGTERM}))
    recorder = stage.cast["recorder"][-1]
    recorder.has_core = False
    stage.supervisor.end(AT_ONCE, should_abort=lambda: stage.clock.now() > 10.0)
    assert recorder.ended is None and recorder.heard


def test_after_the_match_a_recorder_has_time_to_finish_while_agents_are_sent_away() -> None:
    stage = Stage(deaf_to=frozenset({signal.SIGTERM}))
    stage.end("host", 0)
    stage.supervisor.end(AFTER_THE_MATCH, should_abort=lambda: stage.clock.now() > 20.0)
    assert stage.cast["recorder"][-1].heard == []
    assert stage.supervisor.ended["cyan1"] == -signal.SIGKILL


def test_a_process_that_has_ended_gets_no_signal() -> None:
    stage = Stage()
    for name in stage.cast:
        stage.end(name, 0)
    stage.supervisor.end(AFTER_THE_MATCH)
    assert all(actors[-1].heard == [] for actors in stage.cast.values())


def test_a_page_with_the_result_goes_on_after_the_match() -> None:
    stage = Stage(page=True)
    for name in ("host", "recorder"):
        stage.end(name, 0)
    stage.supervisor.end(AFTER_THE_MATCH, keep=frozenset({ProcessKind.PAGE}))
    assert set(stage.supervisor.ended) == {"host", "recorder", "cyan1", "magenta1"}
    assert stage.cast["page"][-1].heard == []
    stage.supervisor.end(AT_ONCE)
    assert stage.supervisor.ended["page"] == -signal.SIGTERM


def test_a_second_interrupt_does_not_wait_for_the_recorder() -> None:
    stage = Stage()
    stage.end("host", 0)
    stage.supervisor.end(AFTER_THE_MATCH, should_abort=lambda: stage.clock.now() > 3.0)
    assert stage.clock.now() < 4.0
    assert "recorder" not in stage.supervisor.ended
    stage.supervisor.end(AT_ONCE)
    assert stage.supervisor.ended["recorder"] == -signal.SIGTERM
