"""Cross-sections for the field solver, and solids and drawings for the workshop."""
