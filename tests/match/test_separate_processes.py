"""Host, agents and recorder started one by one, as on several machines: the host is killed, and another one comes."""

import os
import signal

import pytest

from recordings.container.manifest import EndReason
from recordings.reading.recording import open_recording
from recordings.recorder.settings import RecorderSettings
from robot_agent.process.settings import AgentSettings
from schemas.config.match_config import MatchConfig
from sim_host.server.settings import HostSettings

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

TEAMS = {"cyan": {"robots": ["cyan1"]}, "magenta": {"robots": ["magenta1"]}}
MIND = """
from schemas.messages.command import Command, Drive

class Marked:
    made = 0

    def __init__(self, briefing):
        Marked.made += 1
        print(f"brain {Marked.made}", flush=True)
        self.first = True

    def act(self, sight):
        if self.first:
            print(f"first sight {sight.tick}", flush=True)
            self.first = False
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0, omega=1.0))
"""
WITHOUT = """
import touchline.commands.cli.command_line, coach_gateway.process, robot_agent.process.run
import recordings.recorder.process, sim_host.server.process
try:
    import pybullet
except ModuleNotFoundError:
    print("all without")
"""


class Story:
    """Two agents on machines without PyBullet, a recorder, and two hosts, one after the other."""

    def __init__(self, start, listen, folder, endpoint, without_pybullet):
        self._start, self._folder, self._endpoint = start, folder, endpoint
        first_host = self.host("first", 80_000)
        joined = {"connect": endpoint, "match": "apart"}
        self.agents = [
            start(
                "robot_agent",
                folder=folder,
                name=robot,
                settings=AgentSettings(robot=robot, brain="mind:Marked", patience=90, **joined),
                **without_pybullet,
            )
            for robot in ("cyan1", "magenta1")
        ]
        recorder = start(
            "recordings", folder=folder, name="recorder", settings=RecorderSettings(out="m.mcap", **joined)
        )
        heard = listen("apart", endpoint, first_host)
        heard.until_tick(300)
        os.kill(first_host.popen.pid, signal.SIGKILL)
        heard.until(lambda one: not one.bus.connected(), "the end of the host's connections")
        recorder.popen.send_signal(signal.SIGTERM)
        self.recorder_status = recorder.status()
        heard.update()
        self.last_tick = heard.tick
        heard.bus.close()

        second_host = self.host("second", 2)
        again = listen("apart", endpoint, second_host)
        again.until(lambda one: one.logs["game/state"] and one.logs["game/state"][-1].phase == "full_time", "full time")
        self.second_healths, self.second_worlds = again.healths, again.worlds
        again.bus.close()
        self.second_status = second_host.status()
        for agent in self.agents:
            agent.popen.send_signal(signal.SIGTERM)
        self.agent_statuses = [agent.status() for agent in self.agents]

    def host(self, name, duration):
        match = MatchConfig.model_validate({"name": "apart", "seed": 7, "duration": duration, "teams": TEAMS})
        settings = HostSettings(listen=self._endpoint, config=match)
        return self._start("sim_host", folder=self._folder, name=name, settings=settings)


@pytest.fixture(scope="module")
def story(start, listen, folder, endpoint, without_pybullet):
    (folder / "mind.py").write_text(MIND)
    return Story(start, listen, folder, endpoint, without_pybullet)


def test_a_recorder_whose_host_was_killed_finishes_its_file_when_it_is_told_to(story, folder):
    """It would wait for the host to return, and end by itself after a while: tests/recordings/recorder."""
    assert story.recorder_status == 0
    recording = open_recording(folder / "m.mcap", whole=True)
    assert recording.result.ended is EndReason.HOST_GONE


def test_the_recording_of_a_killed_host_is_readable_to_its_last_half_second(story, folder):
    ticks = [world.tick for _, world in open_recording(folder / "m.mcap").decoded("world")]
    assert ticks == list(range(ticks[0], ticks[-1] + 1))
    assert ticks[-1] >= story.last_tick - 500  # ten times as many as lockstep plays in half a second


def test_agents_meet_the_next_host_with_a_new_brain_from_its_first_sight_on(story):
    for agent in story.agents:
        brains = [line for line in agent.out.splitlines() if line.startswith("brain")]
        assert brains == ["brain 1", "brain 2"]
        assert agent.out.splitlines()[-1] == "first sight 0"


def test_the_match_of_the_next_host_is_played_to_its_end_by_the_same_agents(story):
    assert story.second_status == 0
    last = story.second_healths[-1]
    assert {name: robot.alive for name, robot in last.robots.items()} == {"cyan1": True, "magenta1": True}
    assert all(robot.answers >= last.tick - 5 for robot in last.robots.values())
    assert story.second_worlds[-1].tick > 100


def test_an_agent_plays_where_pybullet_is_not_installed_and_leaves_politely(story):
    assert story.agent_statuses == [0, 0]
    lines = [line for agent in story.agents for line in agent.err.splitlines()]
    assert [line for line in lines if "waiting for it for up to" not in line] == []  # it may be there before its host


def test_an_agent_whose_host_does_not_come_back_ends_by_itself(start, folder, without_pybullet):
    settings = AgentSettings(connect="tcp/127.0.0.1:9", match="apart", robot="cyan1", brain="mind:Marked", patience=0.1)
    agent = start("robot_agent", folder=folder, name="lonely", settings=settings, **without_pybullet)
    assert agent.status() == 2
    assert "no host answers there" in agent.err
    assert len(agent.err.splitlines()) == 1


def test_every_process_but_the_simulation_imports_without_pybullet(start, folder, without_pybullet):
    (folder / "without.py").write_text(WITHOUT)
    program = start("without", folder=folder, name="without", **without_pybullet)
    assert program.status() == 0, program.err
    assert program.out.split("\n")[0] == "all without"
