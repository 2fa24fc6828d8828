"""Operations on the layout between two ticks: pure functions, whose results the simulation applies."""
