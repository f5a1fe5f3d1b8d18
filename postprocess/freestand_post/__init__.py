"""Figures and the report of freestand, from its files alone."""
