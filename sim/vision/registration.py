"""By how much one whole image is shifted against another, and whether that can be told at all.

Phase correlation gives the whole pixels: with the spectra F of the reference and G of the image,
each flattened and tapered::

    r = ℱ⁻¹{ F* G / |F G| · exp(−2π² σ² f²) }

is a peak of width σ at the shift. Its height over the scatter of everything else (the
*peak-to-sidelobe ratio*) says whether there are features, the second highest peak whether they
repeat. The part that both images show is then aligned by least squares.
Sources: C. Kuglin, D. Hines, IEEE Cybernetics and Society 1975; D. Bolme et al., CVPR 2010 (ratio).
"""

from dataclasses import dataclass
from typing import cast

import cv2
import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.messages import message
from rotemina.sim.quantities import fixed
from rotemina.sim.vision.alignment import align
from rotemina.sim.vision.errors import RegistrationError
from rotemina.sim.vision.image import Image

LEAST_PEAK_TO_SIDELOBE = 9.0  # noise alone reaches 5 to 6
MOST_SECOND_PEAK = 0.75  # of the highest; what repeats comes to 1
LEAST_OVERLAP = 0.2  # of each side
_PEAK_WIDTH = 1.2  # px, σ
_ABOUT_PEAK = 8  # px that belong to a peak
_COARSE = 16  # flattening looks at every so many pixels
_MOST_CORRECTION_PX = 2.0
_ENOUGH_PIXELS = 60_000


@dataclass(frozen=True, slots=True, eq=False)
class Registration:
    """A shift and how far it can be trusted.

    Attributes
    ----------
    shift : (2,)
        By how many columns and rows what is in the reference has moved in the image, px.
    covariance : (2, 2)
        px².
    peak_to_sidelobe : float
        See the module; at least :data:`LEAST_PEAK_TO_SIDELOBE`.
    second_peak : float
        Height of the second peak, of the first; at most :data:`MOST_SECOND_PEAK`.
    correlation : float
        Of what both images show, after the shift.
    """

    shift: FloatArray
    covariance: FloatArray
    peak_to_sidelobe: float
    second_peak: float
    correlation: float


def flattened(image: Image) -> Image:
    """Return an image over its own slow course of brightness: lamp and vignetting go out."""
    rows, columns = image.shape
    size = (max(2, columns // _COARSE), max(2, rows // _COARSE))
    small = cv2.resize(image, size, interpolation=cv2.INTER_AREA)
    slow = cv2.GaussianBlur(small, (0, 0), max(1.0, min(size) / 10.0))
    course = cv2.resize(slow, (columns, rows), interpolation=cv2.INTER_LINEAR)
    least = 1e-3 * max(float(np.abs(course).max()), 1e-12)
    return np.asarray(image / np.maximum(course, least), dtype=np.float32)


def register(reference: Image, image: Image) -> Registration:
    """Return by how much ``image`` is shifted against ``reference``, both (rows, columns).

    The whole scene must move as one; where only a part does, look at parts
    (:mod:`rotemina.sim.vision.background_drift`) or at the tip (:mod:`rotemina.sim.vision.tip`).

    Raises
    ------
    RegistrationError
        If the images differ in size, show too little detail, or detail that repeats.
    """
    if reference.shape != image.shape:
        raise RegistrationError(
            message(
                "engine",
                "registration: an image of {columns} × {rows} px against a reference of "
                "{other_columns} "
                "× {other_rows} px; use one camera setting for both",
            ).fill(
                columns=image.shape[1],
                rows=image.shape[0],
                other_columns=reference.shape[1],
                other_rows=reference.shape[0],
            )
        )
    first, second = flattened(reference), flattened(image)
    whole, ratio, rival = _peak(_phase_correlation(first, second))
    if ratio < LEAST_PEAK_TO_SIDELOBE:
        raise RegistrationError(
            message(
                "engine",
                "registration: peak-to-sidelobe ratio {ratio}, must be at least "
                "{least_peak_to_sidelobe}; the images share too little detail, or repeating "
                "detail: focus, increase the light, make the move smaller, or bring another "
                "object into view",
            ).fill(ratio=fixed(ratio, 1), least_peak_to_sidelobe=LEAST_PEAK_TO_SIDELOBE)
        )
    if rival > MOST_SECOND_PEAK:
        raise RegistrationError(
            message(
                "engine",
                "registration: a second shift fits {rival} % as well, must be at most "
                "{most_second_peak} %; the picture repeats itself (a grating?): use another object "
                "or smaller moves",
            ).fill(
                rival=fixed(100.0 * rival, 0), most_second_peak=fixed(100.0 * MOST_SECOND_PEAK, 0)
            )
        )
    return _refined(first, second, whole, ratio, rival)


def _refined(
    first: Image, second: Image, whole: FloatArray, ratio: float, rival: float
) -> Registration:
    """Align what both images show."""
    margin = 4
    sizes = np.array(first.shape[::-1])
    begin = np.maximum(-whole, 0).astype(int) + margin
    end = sizes - np.maximum(whole, 0).astype(int) - margin
    if ((end - begin) < LEAST_OVERLAP * sizes).any():
        raise RegistrationError(
            message(
                "engine",
                "registration: the picture moved by {right}, {down} px and hardly "
                "overlaps the one before; make the move smaller",
            ).fill(right=fixed(whole[0], 0), down=fixed(whole[1], 0))
        )
    template = first[begin[1] : end[1], begin[0] : end[0]]
    # Light noise reduction: what is sampled between pixels then loses no contrast.
    smooth = cv2.GaussianBlur(template, (0, 0), 1.0)
    found = align(
        np.asarray(smooth, dtype=np.float32),
        np.asarray(cv2.GaussianBlur(second, (0, 0), 1.0), dtype=np.float32),
        begin + whole,
        stride=max(1, round((template.size / _ENOUGH_PIXELS) ** 0.5)),
        most_px=_MOST_CORRECTION_PX,
    )
    if found is None or not found.settled:
        raise RegistrationError(
            message(
                "engine",
                "registration: the images cannot be aligned; they differ by more than a "
                "shift (rotation, another focus, or motion of only a part of the scene)",
            )
        )
    return Registration(found.corner - begin, found.covariance, ratio, rival, found.correlation)


def _phase_correlation(first: Image, second: Image) -> Image:
    window = cv2.createHanningWindow((first.shape[1], first.shape[0]), cv2.CV_32F)
    one, two = (scipy.fft.rfft2((image - image.mean()) * window) for image in (first, second))
    cross = np.conj(one) * two
    size = np.abs(cross)
    across = scipy.fft.rfftfreq(first.shape[1])
    down = scipy.fft.fftfreq(first.shape[0])[:, None]
    low_pass = np.exp(-2.0 * np.pi**2 * _PEAK_WIDTH**2 * (across**2 + down**2))
    cross *= low_pass / np.maximum(size, 1e-9 * float(size.max()))
    return cast(Image, np.asarray(scipy.fft.irfft2(cross, s=first.shape), dtype=np.float32))


def _peak(surface: Image) -> tuple[FloatArray, float, float]:
    """Return the highest peak's shift (2,), its ratio to sidelobes, and its highest rival."""
    rows, columns = surface.shape
    row, column = np.unravel_index(int(np.argmax(surface)), surface.shape)
    # The peak in the middle, so that its neighbourhood is one rectangle.
    centred = np.roll(surface, (rows // 2 - int(row), columns // 2 - int(column)), axis=(0, 1))
    top = float(centred[rows // 2, columns // 2])
    others = np.ones(surface.shape, dtype=bool)
    half = _ABOUT_PEAK
    others[
        max(0, rows // 2 - half) : rows // 2 + half + 1,
        max(0, columns // 2 - half) : columns // 2 + half + 1,
    ] = False
    sidelobes = centred[others]
    ratio = (top - float(sidelobes.mean())) / max(float(sidelobes.std()), 1e-12)
    shift = np.array(
        [
            int(column) - columns if column > columns // 2 else int(column),
            int(row) - rows if row > rows // 2 else int(row),
        ],
        dtype=np.float64,
    )
    return shift, ratio, float(sidelobes.max()) / top if top > 0.0 else 1.0
