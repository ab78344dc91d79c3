"""Flights: what is flown, how it is flown, what comes of it."""
