"""Operations on the pitch between two ticks: pure decisions, which the simulation carries out."""
