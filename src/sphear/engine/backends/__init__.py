"""Backends: what turns the stages of a step into code for a machine."""
