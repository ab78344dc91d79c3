"""Pages for a browser: the replay and the bundle that the laboratory shares."""
