"""The scores of episodes that brains play in this process, as `touchline task run` plays them."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from sim_host.task.judge import TaskState
from touchline.matches.task.task import load_task
from touchline.play.play_match import InProcessMatch


def scores(
    task: str | Path, seeds: Iterable[int], brain: str | None = None, overrides: Mapping[str, Any] | None = None
) -> list[float]:
    """The score of the episode of each seed, of a task that ships or one in a match file.

    Args:
        task: its name, or the path of its match file.
        seeds: of the episodes.
        brain: who does it, such as `policy:FILE`; by default the brain in the match file.
        overrides: keys of the match file, with dots, such as `teams.cyan.parameters.observe`.

    Raises:
        TouchlineError: there is no such task, or a brain cannot be loaded.
    """
    loaded, found = load_task(task, brain, overrides), []
    for seed in seeds:
        match = InProcessMatch(loaded.episode(seed), brain_folder=loaded.folder, chained=False)
        try:
            while not match.simulation.over:
                match.step()
            state: Any = match.simulation.state
            assert isinstance(state, TaskState)
            found.append(state.value or 0.0)
        finally:
            match.close()
    return found
