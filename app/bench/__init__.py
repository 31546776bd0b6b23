"""Benchmark of the diagnosis: it compares the diagnosed causes of machines with the known ones.

A machine is a folder of records with its known causes. ``bench_run`` diagnoses each machine in a
separate process, and ``result`` lists the requirements that a diagnosis does not meet.
``diagnosis_program`` runs a diagnosis, and ``engine_comparison`` compares the answers of two
versions; the blind test uses these, too.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
