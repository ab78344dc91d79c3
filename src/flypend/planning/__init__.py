"""Plans at the physical limit: optimal flights to inverted hover, and their tracking."""
