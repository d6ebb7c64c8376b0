"""From notebook sources to a book: executed copies, their records, and the pages made of them.

A notebook is executed by papermill in a process of its own, only when something it was
computed from has changed; each executed copy has a record beside it that says what it was
computed from, and the pages are built only from copies whose record still holds.
"""
