"""`python -m sphear`."""

from sphear.cli import main

main()
