"""Bones and scans in files, for programs."""

import dataclasses
import gzip
import re

import numpy as np


def nrrd_header(sizes, spacing_mm=(1, 1, 1), origin_mm=(0, 0, 0), type="int16", encoding="raw", more=""):
    """With its blank line. Sizes and spacing along x, y and z (LPS)."""
    x, y, z = spacing_mm
    return (f"NRRD0004\ntype: {type}\ndimension: 3\nspace: left-posterior-superior\nsizes: {sizes[0]} {sizes[1]} {sizes[2]}\n"
            f"space directions: ({x},0,0) (0,{y},0) (0,0,{z})\nspace origin: ({origin_mm[0]},{origin_mm[1]},{origin_mm[2]})\n"
            f"encoding: {encoding}\nendian: little\n{more}\n").encode()


def write_nrrd(file, voxels, spacing_mm=1, origin_mm=(0, 0, 0), more=""):
    """Voxels (z, y, x) of int16 or uint8."""
    file.write_bytes(nrrd_header(voxels.shape[::-1], 3 * (spacing_mm,), origin_mm, voxels.dtype.name, more=more) + voxels.tobytes())


@dataclasses.dataclass
class BoneFile:
    hu: np.ndarray  # (z, y, x)
    spacing_mm: float
    origin_mm: tuple
    threshold_hu: float


def read_bone_file(file):
    """As bone_import writes it."""
    header, _, voxels = file.read_bytes().partition(b"\n\n")
    fields = dict(re.findall("^([^#:]+):[ =](.*)$", header.decode(), re.MULTILINE))
    numbers = {name: [float(number) for number in re.findall("[-+.e0-9]+", fields[name])]
               for name in ("sizes", "space directions", "space origin")}
    hu = np.frombuffer(gzip.decompress(voxels), "<i2").reshape([int(size) for size in numbers["sizes"][::-1]])
    return BoneFile(hu, numbers["space directions"][0], tuple(numbers["space origin"]), float(fields.get("osteomill_threshold_hu", "nan")))


def write_block(file):
    """9.6 x 8 x 6.4 mm of bone round the origin, ever stiffer upwards: there in no time."""
    hu = np.full((32, 40, 48), 400, np.int16) + 30 * np.arange(32, dtype=np.int16)[:, None, None]
    write_nrrd(file, hu, 0.2, (-4.7, -3.9, -4.1))


def write_milling_motion(file):
    """A motion that mills the block for five minutes: a stroke every two seconds, each a little farther and deeper, with the burr lifted clear
    of the bone between them. A burr that a busy machine left in bone without force and spindle stays so until it is held clear."""
    lines = ["t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal"]
    for stroke in range(150):
        share = stroke / 150
        for after_s, z_mm, pedal in ((0.0, 5.0, 0), (0.3, 5.0, 0), (0.6, 2.5, 1), (1.0, 1.5 - 0.5 * share, 1), (1.7, 1.5 - 0.5 * share, 1)):
            lines.append(f"{2.0 * stroke + after_s:g},{6.0 * share - 3.0:g},0,{z_mm:g},0,0,1,{pedal}")
    file.write_text("\n".join(lines) + "\n")
