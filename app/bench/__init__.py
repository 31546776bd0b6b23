"""Machines whose causes are known: the diagnosis of each, beside what is known."""
