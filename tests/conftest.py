"""Settings of all tests: property tests are the same in every run, and may wait for a compiler."""

from __future__ import annotations

from hypothesis import settings

settings.register_profile("sphear", deadline=None, derandomize=True, max_examples=25)
settings.load_profile("sphear")
