"""Settings of all tests: property tests are the same in every run, and may wait for a compiler."""

from __future__ import annotations

import os

from hypothesis import settings

# a slow machine must not write lines or files that others do not
os.environ["SPHEAR_PROGRESS_SECONDS"] = "0"
os.environ["SPHEAR_SAVE_SECONDS"] = "inf"

settings.register_profile("sphear", deadline=None, derandomize=True, max_examples=25)
settings.load_profile("sphear")
