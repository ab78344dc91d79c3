"""Flights: requests, simulation and results."""
