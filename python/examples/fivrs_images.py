#!/usr/bin/env python3
"""Puts the images of an image set (docs/datasets.md) into a recording in FIVRS's layout (docs/hdf5.md), which then has all that its recorder writes.

    packet_replay session.pcap --hdf5 20260102_103000.hdf5 --layout fivrs
    render_client --replay session.pcap --dataset images --cameras pair.toml
    python3 fivrs_images.py 20260102_103000.hdf5 images main

The set must hold every recorded state (no --dataset-fps) in colour, depth and labels, from the camera `main` or the pair `main_left` and `main_right`,
in 640 x 480: FIVRS's programs have that size built in."""

import argparse
import json
import os
import pathlib
import shutil

import h5py
import numpy as np
from PIL import Image

SIZE_PX = (640, 480)
TOOL_RGB = (34, 32, 33)
# Its cameras look along their own -x, with y to the right and z up; computer vision's along z, with x to the right and y down.
T_CV_AMBF = np.array([[0, 1, 0, 0], [0, 0, -1, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])
Q_CV_AMBF = np.array([0.5, 0.5, -0.5, 0.5])  # the same as a quaternion x, y, z, w


def product(a, b):
    """Product of two quaternions x, y, z, w: b acts first."""
    vector = a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3])
    return np.append(vector, a[3] * b[3] - a[:3] @ b[:3])


def pose_of(pose):
    """A camera's pose of the set, as FIVRS has it: m, its own axes."""
    pose = np.array(pose)
    rotation = product(pose[3:], Q_CV_AMBF)
    return np.concatenate([1e-3 * pose[:3], rotation / np.linalg.norm(rotation)])


def bgr_of(file):
    return np.array(Image.open(file).convert("RGB"))[..., ::-1]


def segmentation_of(file, labels):
    """Each label in its colour, the shank as the burr: BGR."""
    colours = np.array([TOOL_RGB if label["name"] == "shank" else label["rgb"] for label in labels], np.uint8)
    return colours[np.array(Image.open(file))][..., ::-1]


def put(session, folder, camera):
    """Into the open file; throws ValueError for a set that does not fit."""
    folder = pathlib.Path(folder)
    index = json.loads((folder / "dataset.json").read_text())
    known = {one["name"]: one for one in index["cameras"]}
    eyes = [camera] if camera in known else [f"{camera}_left", f"{camera}_right"]
    for eye in eyes:
        if eye not in known:
            raise ValueError(f"{folder}: has no camera {camera}, but {', '.join(known)}")
        if (known[eye]["width_px"], known[eye]["height_px"]) != SIZE_PX:
            raise ValueError(f"{folder}: the camera {eye} is not of 640 x 480 pixels")
        if known[eye]["intrinsics"] is None:
            raise ValueError(f"{folder}: the camera {eye} has the trainee's angle, which may change: give it intrinsics")
    frames, times = index["frames"], session["data/time"][:]
    recorded = np.array([frame["recorded_s"] for frame in frames])
    if len(recorded) != len(times) or not np.allclose(times - times[0], recorded - recorded[0], atol=1e-5):
        raise ValueError(f"{folder}: its {len(frames)} frames are not the {len(times)} states of the recording")

    count, (width, height) = len(frames), SIZE_PX
    data = session["data"]

    def rows(name, shape, dtype):
        return data.create_dataset(name, (count, *shape), dtype, chunks=(1, *shape) if len(shape) > 1 else None, compression="gzip")

    pictures = [rows(name, (height, width, 3), "u1") for name, _ in zip(("l_img", "r_img"), eyes)]
    segmentation = rows("segm", (height, width, 3), "u1")
    depth_m = rows("depth", (height, width), "f8")
    poses = rows("pose_main_camera", (7,), "f8")
    for i, frame in enumerate(frames):
        images = {one["camera"]: one for one in frame["images"]}
        for picture, eye in zip(pictures, eyes):
            picture[i] = bgr_of(folder / images[eye]["colour"])
        left = images[eyes[0]]
        segmentation[i] = segmentation_of(folder / left["labels"], index["sessions"][frame["session"]]["labels"])
        depth = np.load(folder / left["depth"])
        depth_m[i] = np.where(np.isfinite(depth), 1e-3 * depth.astype(float), 0.0)
        poses[i] = pose_of(left["pose"])
    session["metadata/camera_intrinsic"] = np.array(known[eyes[0]]["intrinsics"])
    session["metadata/camera_extrinsic"] = T_CV_AMBF
    if len(eyes) == 2:
        pair = [np.array(one["pose"][:3]) for one in frames[0]["images"] if one["camera"] in eyes]
        session["metadata/baseline"] = 1e-3 * np.linalg.norm(pair[1] - pair[0])


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("session")
    arguments.add_argument("set")
    arguments.add_argument("camera")
    wanted = arguments.parse_args()
    part = f"{wanted.session}.part"
    try:
        shutil.copyfile(wanted.session, part)
        with h5py.File(part, "r+") as session:
            put(session, wanted.set, wanted.camera)
        os.replace(part, wanted.session)
    except (OSError, ValueError, KeyError) as error:
        pathlib.Path(part).unlink(missing_ok=True)
        raise SystemExit(f"fivrs_images.py: {error}")


if __name__ == "__main__":
    main()
