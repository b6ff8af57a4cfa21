"""The engine: formulas traced to straight-line code, vector lanes, sweeps over pairs, threads and the cache."""
