from schemas.natural_order import natural_order


def test_numbers_in_names_and_keys_are_sorted_as_numbers():
    assert sorted(["cyan10", "magenta2", "cyan2", "cyan1"], key=natural_order) == [
        "cyan1",
        "cyan2",
        "cyan10",
        "magenta2",
    ]
    keys = ["world", "robot/cyan10/command", "robot/cyan2/command", "robot/cyan2/sight"]
    assert sorted(keys, key=natural_order) == [
        "robot/cyan2/command",
        "robot/cyan2/sight",
        "robot/cyan10/command",
        "world",
    ]


def test_any_text_has_a_place():
    assert sorted(["b", "a1b10", "7", "a1b2", "a", "", "a1b"], key=natural_order) == [
        "",
        "7",
        "a",
        "a1b",
        "a1b2",
        "a1b10",
        "b",
    ]
