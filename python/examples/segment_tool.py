#!/usr/bin/env python3
"""Learns to find the tool in pictures of image sets (docs/datasets.md), pixel by pixel, and says how well it does on sets it has not seen.

    python3 segment_tool.py TRAINING_SET... --held-out SET... [--mask FILE.png]

Each pixel has 18 features: its colour, and of three neighbourhoods about it the mean colour, the mean of its differences and the spread of
brightness; no place in the picture, which would be learnt by heart. A network of one hidden layer of 32 units is fitted by Adam (Kingma and Ba
2015), and the threshold is chosen on the training sets alone. It needs NumPy and PIL, no GPU, and a minute."""

import argparse
import json
import pathlib

import numpy as np
from PIL import Image

TOOL = ("burr", "shank")
SCALE = 2  # pictures are taken at half their size
REACHES_PX = (1, 4, 12)
HIDDEN, STEPS, BATCH, RATE = 32, 3000, 4096, 3e-3


def frames_of(folder):
    """Each picture of a set with the mask of its tool."""
    folder = pathlib.Path(folder)
    frames = []
    for index in sorted(folder.glob("dataset*.json")):
        index = json.loads(index.read_text())
        for frame in index["frames"]:
            names = [label["name"] for label in index["sessions"][frame["session"]]["labels"]]
            tool = [names.index(name) for name in TOOL]
            for images in frame["images"]:
                colour = np.array(Image.open(folder / images["colour"]))[::SCALE, ::SCALE]
                labels = np.array(Image.open(folder / images["labels"]))[::SCALE, ::SCALE]
                frames.append((colour / np.float32(255.0), np.isin(labels, tool)))
    return frames


def box_mean(image, reach):
    """Mean of the (2 reach + 1)^2 pixels about each; beyond the edges the edge goes on."""
    for axis in (0, 1):
        padded = np.pad(image, [(reach + 1, reach) if i == axis else (0, 0) for i in (0, 1)], mode="edge")
        sums = np.cumsum(padded, axis=axis, dtype=np.float64)
        width = 2 * reach + 1
        image = (np.take(sums, range(width, sums.shape[axis]), axis) - np.take(sums, range(sums.shape[axis] - width), axis)) / width
    return image


def features_of(colour):
    """(pixels, 18)."""
    red, green, blue = np.moveaxis(colour, -1, 0)
    bright = (red + green + blue) / 3
    planes = [bright, red - blue, green - bright]
    for reach in REACHES_PX:
        mean = box_mean(bright, reach)
        planes += [mean, box_mean(red - blue, reach), box_mean(green - bright, reach), bright - mean,
                   np.sqrt(np.maximum(box_mean(bright**2, reach) - mean**2, 0.0))]
    return np.stack(planes, -1).reshape(-1, len(planes)).astype(np.float32)


class Network:
    def __init__(self, features, rng):
        self.mean, self.spread = features.mean(0), features.std(0) + 1e-6
        self.weights = [rng.normal(0, features.shape[1] ** -0.5, (features.shape[1], HIDDEN)), np.zeros(HIDDEN),
                        rng.normal(0, HIDDEN**-0.5, HIDDEN), np.zeros(1)]

    def chance(self, features):
        return self.forward((features - self.mean) / self.spread)[1]

    def forward(self, inputs):
        into, bias, out, last = self.weights
        hidden = np.tanh(inputs @ into + bias)
        return hidden, 1.0 / (1.0 + np.exp(-(hidden @ out + last)))

    def fit(self, features, is_tool, rng):
        """Every fourth pixel drawn is the tool's: it covers a hundredth of a picture."""
        inputs = (features - self.mean) / self.spread
        of_tool, others = np.flatnonzero(is_tool), np.flatnonzero(~is_tool)
        first, second = ([np.zeros_like(weight) for weight in self.weights] for _ in range(2))
        for step in range(1, STEPS + 1):
            batch = np.concatenate([rng.choice(of_tool, BATCH // 4), rng.choice(others, BATCH - BATCH // 4)])
            hidden, chance = self.forward(inputs[batch])
            error = (chance - is_tool[batch]) / BATCH
            back = np.outer(error, self.weights[2]) * (1.0 - hidden**2)
            slopes = inputs[batch].T @ back, back.sum(0), hidden.T @ error, error.sum(keepdims=True)
            for i, slope in enumerate(slopes):
                first[i] += 0.1 * (slope - first[i])
                second[i] += 0.001 * (slope**2 - second[i])
                self.weights[i] -= RATE * first[i] / (1 - 0.9**step) / (np.sqrt(second[i] / (1 - 0.999**step)) + 1e-8)


def score(found, truth):
    hits = (found & truth).sum()
    return {"iou": hits / max((found | truth).sum(), 1), "precision": hits / max(found.sum(), 1), "recall": hits / max(truth.sum(), 1)}


def learn(training, seed=1):
    """The network and its threshold."""
    rng = np.random.default_rng(seed)
    features = np.concatenate([features_of(colour) for colour, _ in training])
    truth = np.concatenate([is_tool.ravel() for _, is_tool in training])
    network = Network(features, rng)
    network.fit(features, truth, rng)
    chance = network.chance(features)
    thresholds = 1.0 / (1.0 + np.exp(-np.linspace(0.0, 6.0, 50)))
    return network, max(thresholds, key=lambda threshold: score(chance > threshold, truth)["iou"])


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("training", nargs="+")
    arguments.add_argument("--held-out", nargs="+", required=True)
    arguments.add_argument("--mask", help="the first held-out picture, with what was found in red")
    wanted = arguments.parse_args()
    training = [frame for folder in wanted.training for frame in frames_of(folder)]
    network, threshold = learn(training)
    for what, folders in (("training", wanted.training), ("held out", wanted.held_out)):
        for folder in folders:
            frames = frames_of(folder)
            truth = np.concatenate([is_tool.ravel() for _, is_tool in frames])
            found = np.concatenate([network.chance(features_of(colour)) > threshold for colour, _ in frames])
            print(f"{what} {folder}: {len(frames)} pictures, " + ", ".join(f"{name} {value:.3f}" for name, value in score(found, truth).items()))
    if wanted.mask:
        colour = frames_of(wanted.held_out[0])[0][0].copy()
        found = (network.chance(features_of(colour)) > threshold).reshape(colour.shape[:2])
        colour[found] = 0.5 * colour[found] + [0.5, 0.0, 0.0]
        Image.fromarray((255 * colour).astype(np.uint8)).save(wanted.mask)


if __name__ == "__main__":
    main()
