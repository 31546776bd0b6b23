"""How well a few typed letters fit a text. Free of Qt."""

_WORD_START, _RUN, _OTHER = 8, 10, 1
_LATE = 0.02  # taken off for each letter that is passed over, so that the shorter wins


def score(typed: str, text: str) -> float | None:
    """Return how well typed letters fit a text, higher is better; None where they do not.

    Every word that was typed must be found, its letters in their order; spaces do not matter
    otherwise. Letters at the start of a word and in a row count more.
    """
    total = 0.0
    folded = text.casefold()
    for word in typed.casefold().split():
        best = _best(word, folded)
        if best is None:
            return None
        total += best
    return total


def _best(word: str, text: str) -> float | None:
    starts = [at for at, letter in enumerate(text) if letter == word[0]]
    scores = [found for at in starts if (found := _from(word, text, at)) is not None]
    return max(scores, default=None)


def _from(word: str, text: str, at: int) -> float | None:
    """Score a word whose first letter is at a place; the others are taken as early as possible."""
    total, before, passed = 0.0, -2, at
    for letter in word:
        found = text.find(letter, max(before + 1, at))
        if found < 0:
            return None
        if found == before + 1:
            total += _RUN
        elif found == 0 or not text[found - 1].isalnum():
            total += _WORD_START
        else:
            total += _OTHER
        passed += 0 if before < 0 else found - before - 1
        before = found
    return total - _LATE * (passed + len(text))
