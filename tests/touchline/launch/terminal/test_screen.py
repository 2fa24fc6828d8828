import io

from support.stepped_clock import SteppedClock
from touchline.launch.terminal.screen import LiveScreen, screen_for


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_a_pipe_gets_plain_lines_and_a_terminal_a_live_one() -> None:
    with screen_for(io.StringIO(), SteppedClock()) as plain, screen_for(Terminal(), SteppedClock()) as live:
        assert isinstance(live, LiveScreen) and not isinstance(plain, LiveScreen)


def test_plain_status_lines_come_every_five_seconds_and_events_at_once() -> None:
    out, clock = io.StringIO(), SteppedClock()
    with screen_for(out, clock) as screen:
        for second in range(11):
            clock.sleep_until(float(second))
            screen.status(f"status at {second}")
            if second == 2:
                screen.event("goal", notable=True)
                screen.warn("cyan1 crashed")
    assert out.getvalue().splitlines() == [*("status at 0", "goal", "cyan1 crashed", "status at 5", "status at 10")]


def test_a_terminal_shows_notable_events_above_the_live_line_and_leaves_no_status_behind() -> None:
    out, clock = Terminal(), SteppedClock()
    with screen_for(out, clock) as screen:
        screen.status("1:00 cyan 0 : 0 magenta")
        screen.event("goal by cyan3", notable=True)
        screen.event("STOP", notable=False)
        screen.warn("cyan1 crashed")
    text = out.getvalue()
    assert "1:00 cyan 0 : 0 magenta" in text
    assert "goal by cyan3\n" in text and "cyan1 crashed" in text
    assert "STOP" not in text
    assert text.endswith("\x1b[2K") or "\x1b[2K" in text.rpartition("goal by cyan3")[2]
