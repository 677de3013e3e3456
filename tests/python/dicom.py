"""DICOM files as bytes, element by element: explicit, little endian."""

import struct

import numpy as np

CT = "1.2.840.10008.5.1.4.1.1.2"
CT_OF_FRAMES = "1.2.840.10008.5.1.4.1.1.2.1"
SEGMENTATION = "1.2.840.10008.5.1.4.1.1.66.4"
EXPLICIT = "1.2.840.10008.1.2.1"
JPEG2000 = "1.2.840.10008.1.2.4.90"
UNDEFINED_LENGTH = 0xFFFFFFFF


def element(tag, kind, value, length=None):
    """`value`: text, a number of two bytes (US), or bytes; `length` is stated in place of its own."""
    value = struct.pack("<H", value) if kind == "US" else value.encode() if isinstance(value, str) else value
    if len(value) % 2:
        value += b"\0" if kind == "UI" else b" "
    length = len(value) if length is None else length
    stated = struct.pack("<2xI" if kind in ("OB", "OW", "SQ") else "<H", length)
    return struct.pack("<HH", tag >> 16, tag & 0xFFFF) + kind.encode() + stated + value


def item(content):
    return struct.pack("<HHI", 0xFFFE, 0xE000, len(content)) + content


def group(tag, content):
    """A sequence of one item."""
    return element(tag, "SQ", item(content))


def dicom(pixels, columns=4, rows=3, position_mm=(0, 0, 0), spacing_mm=1, kind=CT, modality="CT", syntax=EXPLICIT, is_signed=True, frames=None,
          more=b"", pixel_bytes=None):
    """An image of the pixels, int16 as bytes, or of these fragments of compressed ones; `more`: elements before its pixels, such as a rescale."""
    start = b"".join((
        bytes(128), b"DICM", element(0x00020010, "UI", syntax),
        element(0x00080016, "UI", kind), element(0x00080018, "UI", "1.2.3.4"), element(0x00080060, "CS", modality),
        element(0x0020000E, "UI", "1.2.3"), element(0x00200032, "DS", "\\".join(map(str, position_mm))),
        element(0x00200037, "DS", r"1\0\0\0\1\0"), element(0x00280002, "US", 1), element(0x00280004, "CS", "MONOCHROME2"),
        element(0x00280008, "IS", str(frames)) if frames else b"",
        element(0x00280010, "US", rows), element(0x00280011, "US", columns), element(0x00280030, "DS", f"{spacing_mm}\\{spacing_mm}"),
        element(0x00280100, "US", 16), element(0x00280101, "US", 16), element(0x00280102, "US", 15),
        element(0x00280103, "US", int(is_signed)), more))
    if isinstance(pixels, bytes):
        return start + element(0x7FE00010, "OW", pixels, pixel_bytes)
    fragments = b"".join(item(fragment + bytes(len(fragment) % 2)) for fragment in (b"", *pixels))
    return start + element(0x7FE00010, "OB", fragments, UNDEFINED_LENGTH) + struct.pack("<HHI", 0xFFFE, 0xE0DD, 0)


def rescale(slope, intercept):
    return element(0x00281052, "DS", str(intercept)) + element(0x00281053, "DS", str(slope))


def dicom_of_frames(pixels, z_mm, columns=12, rows=10, **more):
    """A multi-frame CT whose frames lie at these z, mm, and say that HU are 2 * pixel - 1000."""
    frames = b"".join(item(group(0x00209113, element(0x00200032, "DS", rf"0\0\{z}")) + group(0x00289145, rescale(2, -1000))) for z in z_mm)
    shared = group(0x00289110, element(0x00280030, "DS", r"1\1")) + group(0x00209116, element(0x00200037, "DS", r"1\0\0\0\1\0"))
    return dicom(pixels, columns, rows, kind=CT_OF_FRAMES, frames=len(z_mm),
                 more=group(0x52009229, shared) + element(0x52009230, "SQ", frames), **more)


def series(count, spacing_mm=1, apart_mm=2):
    """Slices of 12 x 10 pixels along z, of 0, 100, 200, ... HU."""
    return [dicom(np.full(120, 1024 + 100 * number, "<i2").tobytes(), 12, 10, (-5, -4, apart_mm * number), spacing_mm, more=rescale(1, -1024))
            for number in range(count)]


def write_series(folder, slices):
    """00.dcm, 01.dcm, ... in the folder, which is made."""
    folder.mkdir()
    for number, content in enumerate(slices):
        (folder / f"{number:02}.dcm").write_bytes(content)
    return folder
