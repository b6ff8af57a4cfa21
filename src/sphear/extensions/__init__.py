"""Extensions: formulas and parts of schemes of others, by names like the package's own."""
