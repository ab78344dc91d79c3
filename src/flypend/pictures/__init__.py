"""Figures, stop motion, movies and maps."""
