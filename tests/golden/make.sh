#!/usr/bin/env bash
# Makes the golden files of a version with its own programs; once a version, for they are kept as they are.
#   tests/golden/make.sh FOLDER_OF_PROGRAMS tests/golden/VERSION
# A block of bone, 10 x 10 x 4 mm of 1000 HU, with a nerve above it, becomes a case; a session mills a slot into it.
set -euo pipefail
programs=$(realpath "$1")
mkdir "$2"
cd "$2"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

/usr/bin/python3 - "$scratch" <<'PYTHON'
import struct, sys
edges = (40, 40, 24)
def write(name, kind, code, value):
    voxels = [value(x, y, z) for z in range(edges[2]) for y in range(edges[1]) for x in range(edges[0])]
    with open(f"{sys.argv[1]}/{name}.nrrd", "wb") as file:
        file.write((f"NRRD0004\ntype: {kind}\ndimension: 3\nspace: left-posterior-superior\nsizes: 40 40 24\n"
                    "space directions: (0.25,0,0) (0,0.25,0) (0,0,0.25)\nspace origin: (-4.875,-4.875,-3.875)\n"
                    "encoding: raw\nendian: little\n\n").encode() + struct.pack(f"<{len(voxels)}{code}", *voxels))
write("scan", "int16", "h", lambda x, y, z: 1000 if z < 16 else -1000)
write("nerve", "uint8", "B", lambda x, y, z: 1 if 26 <= y < 30 and 18 <= z < 22 else 0)
PYTHON
cat >"$scratch/motion.csv" <<'CSV'
t_s,x_mm,y_mm,z_mm,axis_x,axis_y,axis_z,pedal
0.0,-1,-2,3,0,0,1,0
0.1,-1,-2,3,0,0,1,1
0.5,-1,-2,0.3,0,0,1,1
1.3,1,-2,0.3,0,0,1,1
1.5,1,-2,3,0,0,1,0
CSV

"$programs/bone_import" "$scratch/scan.nrrd" --case case --threshold-hu 300 --spacing-mm 0.25 \
    --segmentation "$scratch/nerve.nrrd" --protect nerve
"$programs/haptic_server" --case case --clock virtual --trajectory "$scratch/motion.csv" --trainee golden \
    --record recording.pcap --save-bone saved.nrrd --json session.json
rm session.histograms.json
