"""Extensions: viscous terms, kernels, corrections and equations of state of others, by names like the package's."""
