"""Widgets shared by window and panels, in folders by purpose.

Import from the folder of the purpose: ``controls``, ``drawing``, ``layout``, ``style`` or ``text``.
Widgets know nothing of the machine: they use only ``app/language`` and the layers below.
"""
