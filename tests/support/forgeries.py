"""Changes that somebody could make to the messages of a recording."""

from collections.abc import Callable
from typing import Any


def each(key: str, edit: Callable[[dict[str, Any]], None], at: Callable[[dict[str, Any]], bool] = lambda _: True):
    """Edit the fields of the messages of a key."""

    def messages(copied):
        for one in copied:
            if one.key == key and at(one.fields):
                edit(one.fields)
        return copied

    return messages


def at_tick(tick: int):
    return lambda fields: fields["tick"] == tick


def is_goal(fields) -> bool:
    return fields["kind"] == "goal"


def renumbered(copied):
    """Gives each key the sequence numbers of a recording without losses."""
    counts: dict[str, int] = {}
    found = []
    for one in copied:
        number = counts.get(one.key, 0)
        counts[one.key] = number + 1
        found.append(one._replace(sequence=number))
    return found


def nine_nil(copied):
    return each("game/state", lambda fields: fields.update(score={"cyan": 9, "magenta": 0}))(copied)


def switch_goal(copied):
    return each("game/event", lambda fields: fields.update(side="magenta", robot="magenta2"), is_goal)(copied)


def delete_goal(copied):
    return renumbered([one for one in copied if not (one.key == "game/event" and is_goal(one.fields))])


def add_goal(copied):
    goal = next(one for one in copied if one.key == "game/event" and is_goal(one.fields))
    later = next(n for n, one in enumerate(copied) if one.key == "world" and one.fields["tick"] == 300)
    fields = {**goal.fields, "tick": 300, "time": 6.0}
    added = goal._replace(fields=fields, log_ns=copied[later].log_ns)
    return renumbered([*copied[:later], added, *copied[later:]])


def double_world(copied):
    return renumbered([twice for one in copied for twice in ([one, one] if is_world(one, 150) else [one])])


def is_world(one, tick: int) -> bool:
    return one.key == "world" and one.fields["tick"] == tick


def swap_worlds(copied):
    """Exchange two worlds, which keep their log times and sequence numbers."""
    first, second = (next(n for n, one in enumerate(copied) if is_world(one, tick)) for tick in (150, 151))
    copied[first], copied[second] = copied[second], copied[first]
    return copied


def swap_contents(copied):
    """Exchange the payloads of two worlds."""
    first, second = (next(n for n, one in enumerate(copied) if is_world(one, tick)) for tick in (150, 151))
    theirs, ours = copied[first].fields, copied[second].fields
    copied[first], copied[second] = copied[first]._replace(fields=ours), copied[second]._replace(fields=theirs)
    return copied


def shift(*keys: str):
    """Shift the log times of some keys, or of all, by five ticks."""
    return lambda copied: [
        one._replace(log_ns=one.log_ns + 100_000_000) if not keys or one.key in keys else one for one in copied
    ]


def change_command(copied):
    drive = {"vx": 1.25, "vy": 0.0, "omega": 0.0}
    return each("robot/cyan2/command", lambda fields: fields.update(drive=drive), answers(150))(copied)


def answers(tick: int):
    return lambda fields: fields["answers_tick"] == tick


def change_input_and_command(copied):
    drive = {"vx": 1.25, "vy": 0.0, "omega": 0.0}
    edit = each("host/applied", lambda fields: fields["inputs"]["cyan2"].update(drive=drive), at_tick(151))
    return edit(change_command(copied))


def drop_action(copied):
    return each("host/applied", lambda fields: fields.pop("actions", None))(copied)


def remove_chunk(copied):
    return [one for one in copied if not 3_000_000_000 <= one.log_ns < 3_200_000_000]


def change_belief(copied):
    for one in copied:
        if one.key == "team/cyan/belief/cyan2" and one.fields["tick"] >= 150:
            one.fields["radio"]["self"]["x"] += 2.0
            break
    return copied


def delete_card(copied):
    return renumbered([one for one in copied if not (one.key == "game/event" and one.fields["kind"] == "card")])


def hide_absence(copied):
    return each("world", lambda fields: fields["robots"]["magenta1"].update(off_field=None))(copied)


def delete_states(copied):
    return renumbered([one for one in copied if one.key != "game/state" or one.fields["tick"] % 50])


def add_state(copied):
    number = next(n for n, one in enumerate(copied) if is_world(one, 333))
    before = next(one for one in reversed(copied[:number]) if one.key == "game/state")
    fields = {**before.fields, "tick": 333, "time": 6.66}
    return renumbered(
        [*copied[:number], before._replace(fields=fields, log_ns=copied[number].log_ns), *copied[number:]]
    )


def delete_worlds(copied):
    return renumbered([one for one in copied if one.key != "world" or one.fields["tick"] % 7])
