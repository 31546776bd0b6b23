"""Search of the command palette: which entries match a few typed letters, and in what order."""

from collections.abc import Sequence

from rotemina.app.shell.window.palette_entries import PaletteEntry

_WORD_START_SCORE, _CONSECUTIVE_SCORE, _OTHER_SCORE = 8, 10, 1
# Subtracted for each letter that is skipped, so that the shorter text wins.
_SKIPPED_LETTER_PENALTY = 0.02
# Factor on the score of commands that cannot run now, so that they come after similar matches.
_UNAVAILABLE_FACTOR = 0.7


def find_entries(search_text: str, entries: Sequence[PaletteEntry]) -> tuple[PaletteEntry, ...]:
    """Return the entries that match, best first.

    Panels with a matching title come first, then entries whose title is the typed text, then the
    others by score.
    """
    matches = []
    for number, entry in enumerate(entries):
        score = score_match(search_text, entry.text)
        if score is None:
            continue
        weighted_score = score if entry.objection is None else _UNAVAILABLE_FACTOR * score
        is_exact = search_text.strip().casefold() == entry.title.casefold()
        is_panel_match = entry.is_panel and score_match(search_text, entry.title) is not None
        rank = (
            not is_panel_match,
            not is_exact,
            -weighted_score,
            entry.objection is not None,
            number,
        )
        matches.append((rank, entry))
    matches.sort(key=lambda match: match[0])
    return tuple(entry for _, entry in matches)


def score_match(typed: str, text: str) -> float | None:
    """Return how well typed letters match a text (higher is better), or None if they do not match.

    Each typed word must occur with its letters in order. Letters at
    the start of a word and consecutive letters score higher.
    """
    total = 0.0
    folded_text = text.casefold()
    for word in typed.casefold().split():
        word_score = _score_word(word, folded_text)
        if word_score is None:
            return None
        total += word_score
    return total


def _score_word(word: str, text: str) -> float | None:
    starts = [start for start, letter in enumerate(text) if letter == word[0]]
    scores = [
        word_score
        for start in starts
        if (word_score := _score_word_from(word, text, start)) is not None
    ]
    return max(scores, default=None)


def _score_word_from(word: str, text: str, start: int) -> float | None:
    """Score a word whose first letter is at ``start``; match the others as early as possible."""
    total, previous, skipped = 0.0, -2, start
    for letter in word:
        position = text.find(letter, max(previous + 1, start))
        if position < 0:
            return None
        if position == previous + 1:
            total += _CONSECUTIVE_SCORE
        elif position == 0 or not text[position - 1].isalnum():
            total += _WORD_START_SCORE
        else:
            total += _OTHER_SCORE
        skipped += 0 if previous < 0 else position - previous - 1
        previous = position
    return total - _SKIPPED_LETTER_PENALTY * (skipped + len(text))
