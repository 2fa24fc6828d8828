"""Teams of other styles than those that ship, to play against."""
