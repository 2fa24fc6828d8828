from schemas.natural_order import natural_order


def test_numbers_in_names_and_keys_are_sorted_as_numbers():
    names = ["cyan1", "cyan2", "cyan10", "cyan11", "magenta2", "magenta10"]
    assert sorted(reversed(names), key=natural_order) == names
    keys = ["robot/cyan2/command", "robot/cyan10/command", "team/cyan/belief/cyan1", "world"]
    assert sorted(reversed(keys), key=natural_order) == keys


def test_any_text_has_an_order():
    odd = ["", "7", "07", "a", "a٣", "a1b", "a1b2", "a1b10", "b"]
    assert sorted(sorted(odd, key=natural_order), key=natural_order) == sorted(odd, key=natural_order)
