"""Small pictures of spectra, as files."""

import numpy as np

from rtb_addon.exr import write_exr
from rtb_addon.spectra.channels import channel_name


def write_spectra(path, texels, bands, kind="S0"):
    """Write (height, width, bands) texels with a channel at the centre of each band, and return the file."""
    names = [channel_name(centre).replace("S0.", f"{kind}.") for centre in bands.centres]
    write_exr(path, {}, {name: np.float32(texels[..., band]) for band, name in enumerate(names)})
    return path
