"""Whole files, whole folders, NetCDF: what is written appears whole or not at all."""
