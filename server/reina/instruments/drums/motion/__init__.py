"""How sticks, feet and the kit move: pure functions of times, planned once from the hits."""
