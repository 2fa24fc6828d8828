"""What a launcher shows of the log of a process is the same in both formats."""

from pathlib import Path

from touchline.launch.child_process import ProcessHandle
from touchline.launch.process_table import Process, ProcessKind

LINE = (
    '{"time": "2026-01-01T00:00:00.000Z", "process": "agent", "level": "error", "message": "act failed\\nkick: no"}\n'
)


class EndedProcess(ProcessHandle):
    """A process that has ended."""

    @property
    def pid(self) -> int:
        return 0

    def _poll(self) -> int | None:
        return 1


def last_lines(folder: Path, text: str) -> list[str]:
    log = folder / "cyan1.log"
    log.write_text(text)
    return EndedProcess(Process("cyan1", ProcessKind.AGENT, (), {}), log, 0).last_lines()


def test_of_json_the_messages_are_shown(tmp_path: Path) -> None:
    assert last_lines(tmp_path, "a print of the brain\n" + LINE) == ["a print of the brain", "act failed", "kick: no"]


def test_text_is_shown_as_it_is(tmp_path: Path) -> None:
    assert last_lines(tmp_path, "act failed\n\nkick: no\n") == ["act failed", "kick: no"]
