"""Printed equations as SymPy expressions: a reader for each form."""
