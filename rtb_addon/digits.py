"""Numbers drawn in pixels, where there is no font at hand."""

from __future__ import annotations

import numpy as np

WIDTH, HEIGHT = 6, 7  # of a letter, with the gap behind it [pixels]

# Seven rows from the top; each row's five pixels as bits, the left one highest.
_ROWS = {
    "0": (14, 17, 17, 17, 17, 17, 14),
    "1": (4, 12, 4, 4, 4, 4, 14),
    "2": (14, 17, 1, 2, 4, 8, 31),
    "3": (31, 2, 4, 2, 1, 17, 14),
    "4": (2, 6, 10, 18, 31, 2, 2),
    "5": (31, 16, 30, 1, 1, 17, 14),
    "6": (6, 8, 16, 30, 17, 17, 14),
    "7": (31, 1, 2, 4, 8, 8, 8),
    "8": (14, 17, 17, 14, 17, 17, 14),
    "9": (14, 17, 17, 15, 1, 2, 12),
    ".": (0, 0, 0, 0, 0, 12, 12),
    "-": (0, 0, 0, 31, 0, 0, 0),
    "+": (0, 4, 4, 31, 4, 4, 0),
    "e": (0, 0, 14, 17, 31, 16, 14),
}


def letters(number: str, magnified: int = 1) -> np.ndarray:
    """Return a number's shape, 1 where it is and 0 around, from the lowest row up."""
    shape = np.zeros((HEIGHT, WIDTH * len(number)), np.float32)
    for place, letter in enumerate(number):
        for row, bits in enumerate(_ROWS[letter]):
            for column in range(WIDTH - 1):
                shape[HEIGHT - 1 - row, place * WIDTH + column] = bits >> (WIDTH - 2 - column) & 1
    return np.kron(shape, np.ones((magnified, magnified), np.float32))
