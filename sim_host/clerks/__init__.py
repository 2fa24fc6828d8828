"""Who answers at the desk: one clerk for each kind of question."""
