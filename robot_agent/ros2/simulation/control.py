"""Serves simulation_interfaces below `/touchline`: a thread of its own handles one request after the other."""

import re
import threading
import traceback
from collections.abc import Callable
from queue import Empty, SimpleQueue
from typing import Any

from robot_agent.ros2.simulation.codes import Code, RefusedError
from robot_agent.ros2.simulation.match_client import MatchClient
from robot_agent.ros2.simulation.services import PACKAGE, Fields, SimulationServices
from robot_agent.ros2.simulation.step_action import StepAction
from robot_agent.ros2.simulation.steps import Outcome, Steps
from runtime.process.process_log import Level, log_line
from runtime.process.timing import POLL_S
from runtime.ros2.graph import Graph, Request
from runtime.ros2.graph_names import CONTROL
from runtime.ros2.message_builder import MessageBuilder
from runtime.ros2.message_types import PACKAGES, typestore
from runtime.ros2.topic_type import TopicType

OLDER = "1.x"
"""Releases 1.0 to 1.6, in which some services have other fields, and therefore another hash in their key."""


class SimulationControl:
    """Lets the nodes of a graph control a match until it is closed."""

    def __init__(self, graph: Graph, match: MatchClient) -> None:
        self._services, self._match, self._graph = SimulationServices(match), match, graph
        self._build = MessageBuilder()
        self._tasks: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self._action = StepAction(graph, f"/{CONTROL}", self._tasks.put, self._begin_steps, self._services.result)
        self._steps: list[tuple[Steps, Callable[[int, int], None]]] = []
        """Steps that are under way, and what is told of ticks that are done and left."""
        for name in (*self._services.handlers, "StepSimulation"):
            for version in ("", OLDER):
                if not version or (PACKAGES / PACKAGE / version / "srv" / f"{name}.srv").exists():
                    self._serve(TopicType(f"{PACKAGE}/srv/{name}", version=version))
        self._thread = threading.Thread(target=self._run, name="simulation", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End after the request that is being handled; what waits gets no reply."""
        self._tasks.put(None)
        self._thread.join()

    def __enter__(self) -> "SimulationControl":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _serve(self, topic_type: TopicType) -> None:
        name = topic_type.message.rpartition("/")[2]
        handler = self._services.handlers.get(name)
        handle = self._step if handler is None else lambda request, asked, _: self._reply(request, name, handler(asked))
        service = re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower()
        self._graph.serve(
            f"/{CONTROL}/{service}",
            topic_type,
            lambda request: self._tasks.put(lambda: self._answer(request, topic_type, name, handle)),
        )

    def _answer(self, request: Request, topic_type: TopicType, name: str, handle: Callable[..., None]) -> None:
        """Handle a request, and reply to one that is refused."""
        try:
            handle(request, _decoded(request, topic_type), name)
        except RefusedError as error:
            self._reply(request, name, {"result": self._services.result(error.code, str(error))})
        except Exception as error:  # the thread goes on: without it all services would be silent
            log_line(traceback.format_exc(), Level.ERROR)
            reason = f"{type(error).__name__}: {error}"
            self._reply(request, name, {"result": self._services.result(Code.FAILED, reason)})

    def _reply(self, request: Request, name: str, fields: Fields) -> None:
        response = f"{PACKAGE}/srv/{name}_Response"
        filled = self._build.filled(response, {"result": self._services.result(), **fields})
        request.reply(self._build.encode(filled, TopicType(response)))

    def _step(self, request: Request, asked: Any, name: str) -> None:
        def end(outcome: Outcome) -> None:
            self._reply(request, name, {"result": self._services.result(outcome.code, outcome.reason)})

        self._begin_steps(int(asked.steps), end, lambda *_: None)

    def _begin_steps(self, ticks: int, end: Callable[[Outcome], None], tell: Callable[[int, int], None]) -> Steps:
        """Begin so many ticks.

        Raises:
            RefusedError: the match is not paused, or this is no number of ticks.
        """
        steps = Steps(self._match, self._graph.clock, ticks, end)
        self._steps.append((steps, tell))
        return steps

    def _run(self) -> None:
        while True:
            try:
                task = self._tasks.get_nowait() if self._steps else self._tasks.get()
            except Empty:
                self._follow()
            else:
                if task is None:
                    return
                task()

    def _follow(self) -> None:
        """Wait a moment for a tick of the steps that are under way."""
        going = []
        for steps, tell in self._steps:
            found = steps.follow(POLL_S)
            if found is not None:
                tell(*found)
                going.append((steps, tell))
        self._steps = going


def _decoded(request: Request, topic_type: TopicType) -> Any:
    """The request; None of a service whose requests have no fields.

    Raises:
        RefusedError: bytes of another form.
    """
    store, name = typestore(topic_type.version), f"{topic_type.message}_Request"
    if store.fielddefs[name][1][0][0] == "structure_needs_at_least_one_member":
        return None
    try:
        return store.deserialize_cdr(request.payload, name)
    except Exception as error:  # whatever rosbags raises at bytes of another form
        raise RefusedError(Code.FAILED, f"no {topic_type.message}: {error}") from None
