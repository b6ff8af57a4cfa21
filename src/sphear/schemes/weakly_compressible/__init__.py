"""The weakly compressible scheme: formulas and stages of its explicit steps."""
