#!/usr/bin/env python3
"""A session's bone as 3D Slicer's numpy convention has it, (k, j, i), with the matrix from its indices to RAS: nothing is mirrored.

    python3 bone_for_slicer.py [OUT.npz]

In Slicer's Python console:
    file = numpy.load("OUT.npz")
    volume = slicer.util.addVolumeFromArray(file["fraction"], ijkToRAS=file["ijk_to_ras"])"""
import sys

import numpy as np

import osteomill as om

session = om.Session(om.Case("tooth"), hand="firm")
session.run(4000)
bone = session.bone
fraction = bone.fraction().T  # (k, j, i): the same memory
ijk_to_ras = np.diag([-bone.spacing_mm, -bone.spacing_mm, bone.spacing_mm, 1.0])  # LPS to RAS: x and y the other way
ijk_to_ras[:3, 3] = bone.origin_mm * [-1, -1, 1]
np.savez_compressed(sys.argv[1] if len(sys.argv) > 1 else "bone.npz", fraction=fraction, ijk_to_ras=ijk_to_ras)
print(f"{fraction.shape} voxels, {bone.volume_mm3:.1f} mm^3")
