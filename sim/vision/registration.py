"""Registration of whole images: their shift, and checks whether it can be determined.

Phase correlation gives the whole pixels. With the spectra F of the reference and G of the image,
each flattened and tapered::

    r = ℱ⁻¹{ F* G / |F G| · exp(−2π² σ² f²) }

is a peak of width σ at the shift. The ratio of its height to the standard deviation of everything
else (the *peak-to-sidelobe ratio*) shows whether there are features. The height of the second
highest peak shows whether they repeat. The part that both images show is then aligned by least
squares. Sources: C. Kuglin, D. Hines, IEEE Cybernetics and Society 1975; D. Bolme et al., CVPR 2010
(ratio).
"""

from dataclasses import dataclass
from typing import cast

import cv2
import numpy as np
import scipy

from rotemina.sim.arrays import FloatArray
from rotemina.sim.errors import RegistrationError
from rotemina.sim.messages import format_fixed
from rotemina.sim.vision.alignment import align_template
from rotemina.sim.vision.image import Image

# Noise alone reaches a peak-to-sidelobe ratio of 5 to 6.
MIN_PEAK_TO_SIDELOBE_RATIO = 9.0
# Largest ratio of the second peak to the first. A repeating pattern reaches 1.
MAX_SECOND_PEAK_RATIO = 0.75
# Smallest overlap of the two images, as a share of each side.
MIN_OVERLAP_RATIO = 0.2
_PEAK_SIGMA_PX = 1.2
# Half the side of the square around a peak that belongs to it.
_PEAK_HALF_WIDTH_PX = 8
# Reduction of the image from which the brightness is flattened.
_COARSE_STRIDE_PX = 16
_MAX_CORRECTION_PX = 2.0
# Larger images are subsampled to about this number of pixels for the alignment.
_MAX_ALIGNED_PIXELS = 60_000


@dataclass(frozen=True, slots=True, eq=False)
class ImageRegistration:
    """Shift between two images and the figures of its reliability.

    Attributes
    ----------
    shift : (2,)
        Columns and rows by which the image has moved relative to the reference, px.
    covariance : (2, 2)
        Covariance of ``shift``, px².
    peak_to_sidelobe : float
        See the module; at least :data:`MIN_PEAK_TO_SIDELOBE_RATIO`.
    second_peak : float
        Ratio of the height of the second peak to the first; at most :data:`MAX_SECOND_PEAK_RATIO`.
    correlation : float
        Correlation of the common part of both images after the shift.
    """

    shift: FloatArray
    covariance: FloatArray
    peak_to_sidelobe: float
    second_peak: float
    correlation: float


def flatten_brightness(image: Image) -> Image:
    """Return an image divided by its smoothed brightness, which removes uneven lighting."""
    rows, columns = image.shape
    size = (max(2, columns // _COARSE_STRIDE_PX), max(2, rows // _COARSE_STRIDE_PX))
    small = cv2.resize(image, size, interpolation=cv2.INTER_AREA)
    smoothed = cv2.GaussianBlur(small, (0, 0), max(1.0, min(size) / 10.0))
    brightness = cv2.resize(smoothed, (columns, rows), interpolation=cv2.INTER_LINEAR)
    min_brightness = 1e-3 * max(float(np.abs(brightness).max()), 1e-12)
    return np.asarray(image / np.maximum(brightness, min_brightness), dtype=np.float32)


def register_images(reference: Image, image: Image) -> ImageRegistration:
    """Return the shift of ``image`` relative to ``reference``, both (rows, columns).

    The whole scene must move together. If only a part of it moves, register parts
    (:mod:`rotemina.sim.vision.background_drift`) or find the tip
    (:mod:`rotemina.sim.vision.tip_search`).

    Raises
    ------
    RegistrationError
        If the images differ in size, show too little detail, or detail that repeats.
    """
    if reference.shape != image.shape:
        raise RegistrationError(
            "registration: an image of {columns} × {rows} px against a reference of "
            "{other_columns} × {other_rows} px; use one camera setting for both",
            columns=image.shape[1],
            rows=image.shape[0],
            other_columns=reference.shape[1],
            other_rows=reference.shape[0],
        )
    flat_reference, flat_image = flatten_brightness(reference), flatten_brightness(image)
    pixel_shift, ratio, second_peak = _find_peak(
        _compute_phase_correlation(flat_reference, flat_image)
    )
    if ratio < MIN_PEAK_TO_SIDELOBE_RATIO:
        raise RegistrationError(
            "registration: peak-to-sidelobe ratio {ratio}, must be at least "
            "{least_peak_to_sidelobe}; the images share too little detail, or repeating "
            "detail: focus, increase the light, make the move smaller, or bring another "
            "object into view",
            ratio=format_fixed(ratio, 1),
            least_peak_to_sidelobe=MIN_PEAK_TO_SIDELOBE_RATIO,
        )
    if second_peak > MAX_SECOND_PEAK_RATIO:
        raise RegistrationError(
            "registration: a second shift fits {rival} % as well, must be at most "
            "{most_second_peak} %; the picture repeats itself (a grating?): use another object "
            "or smaller moves",
            rival=format_fixed(100.0 * second_peak, 0),
            most_second_peak=format_fixed(100.0 * MAX_SECOND_PEAK_RATIO, 0),
        )
    return _refine_shift(flat_reference, flat_image, pixel_shift, ratio, second_peak)


def _refine_shift(
    first: Image, second: Image, pixel_shift: FloatArray, ratio: float, second_peak: float
) -> ImageRegistration:
    margin = 4
    sizes = np.array(first.shape[::-1])
    begin = np.maximum(-pixel_shift, 0).astype(int) + margin
    end = sizes - np.maximum(pixel_shift, 0).astype(int) - margin
    if ((end - begin) < MIN_OVERLAP_RATIO * sizes).any():
        raise RegistrationError(
            "registration: the picture moved by {right}, {down} px and hardly overlaps the "
            "previous one; make the move smaller",
            right=format_fixed(pixel_shift[0], 0),
            down=format_fixed(pixel_shift[1], 0),
        )
    template = first[begin[1] : end[1], begin[0] : end[0]]
    # Both images are smoothed slightly, so that interpolation between pixels loses no contrast.
    smoothed_template = cv2.GaussianBlur(template, (0, 0), 1.0)
    alignment = align_template(
        np.asarray(smoothed_template, dtype=np.float32),
        np.asarray(cv2.GaussianBlur(second, (0, 0), 1.0), dtype=np.float32),
        begin + pixel_shift,
        stride=max(1, round((template.size / _MAX_ALIGNED_PIXELS) ** 0.5)),
        max_shift_px=_MAX_CORRECTION_PX,
    )
    if alignment is None or not alignment.settled:
        raise RegistrationError(
            "registration: the images cannot be aligned; they differ by more than a "
            "shift (rotation, another focus, or motion of only a part of the scene)"
        )
    return ImageRegistration(
        alignment.corner - begin, alignment.covariance, ratio, second_peak, alignment.correlation
    )


def _compute_phase_correlation(first: Image, second: Image) -> Image:
    window = cv2.createHanningWindow((first.shape[1], first.shape[0]), cv2.CV_32F)
    first_spectrum, second_spectrum = (
        scipy.fft.rfft2((image - image.mean()) * window) for image in (first, second)
    )
    cross_spectrum = np.conj(first_spectrum) * second_spectrum
    magnitude = np.abs(cross_spectrum)
    column_frequency = scipy.fft.rfftfreq(first.shape[1])
    row_frequency = scipy.fft.fftfreq(first.shape[0])[:, None]
    low_pass = np.exp(
        -2.0 * np.pi**2 * _PEAK_SIGMA_PX**2 * (column_frequency**2 + row_frequency**2)
    )
    cross_spectrum *= low_pass / np.maximum(magnitude, 1e-9 * float(magnitude.max()))
    return cast(
        Image, np.asarray(scipy.fft.irfft2(cross_spectrum, s=first.shape), dtype=np.float32)
    )


def _find_peak(surface: Image) -> tuple[FloatArray, float, float]:
    """Return the shift (2,) of the highest peak, its ratio to the sidelobes, and the second peak.

    The second peak is given by its height relative to the first.
    """
    rows, columns = surface.shape
    row, column = np.unravel_index(int(np.argmax(surface)), surface.shape)
    # Roll the peak to the middle, so that its neighbourhood is one rectangle.
    centred = np.roll(surface, (rows // 2 - int(row), columns // 2 - int(column)), axis=(0, 1))
    peak_height = float(centred[rows // 2, columns // 2])
    is_sidelobe = np.ones(surface.shape, dtype=bool)
    half_width = _PEAK_HALF_WIDTH_PX
    is_sidelobe[
        max(0, rows // 2 - half_width) : rows // 2 + half_width + 1,
        max(0, columns // 2 - half_width) : columns // 2 + half_width + 1,
    ] = False
    sidelobes = centred[is_sidelobe]
    ratio = (peak_height - float(sidelobes.mean())) / max(float(sidelobes.std()), 1e-12)
    shift = np.array(
        [
            int(column) - columns if column > columns // 2 else int(column),
            int(row) - rows if row > rows // 2 else int(row),
        ],
        dtype=np.float64,
    )
    return shift, ratio, float(sidelobes.max()) / peak_height if peak_height > 0.0 else 1.0
