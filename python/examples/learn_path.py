#!/usr/bin/env python3
"""Learns a path that takes a tooth's carious lesion and leaves the sound tissue: cross-entropy search (Rubinstein 1999) over a helix.

    python3 learn_path.py [--generations 8] [--population 24] [--seed 1]

A path has five parameters: where its axis is, its radius, how deep it goes, and its turns. Each generation draws paths from a
normal distribution, mills each in a session of its own, and fits the distribution to the best quarter. The score is the lesion's bone
that was removed less the sound bone, as a share of the lesion: 1 would be all of it and nothing else."""

import argparse
import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import osteomill as om

LESION = "carious lesion"
MILLISECONDS = 3000
#                 x_mm  y_mm  radius_mm  depth_mm  turns
MEAN = np.array([0.00, 0.00, 0.40, 3.50, 4.00])
SPREAD = np.array([0.40, 0.40, 0.30, 0.60, 1.50])
LEAST = np.array([-1.5, -1.5, 0.00, 1.00, 0.00])
MOST = np.array([1.50, 1.50, 1.50, 5.50, 8.00])


def path(case, parameters):
    """The hand, a row a millisecond: straight down for a tenth of the time, then along a helix."""
    x, y, radius, depth, turns = parameters
    u = np.linspace(0.0, 1.0, MILLISECONDS)
    angle = 2.0 * np.pi * turns * u
    outward = radius * np.minimum(1.0, 4.0 * u)
    offset = np.column_stack([x + outward * np.cos(angle), y + outward * np.sin(angle), -depth * u])
    return case.start_mm + offset * np.minimum(1.0, 10.0 * u)[:, None]


def score(case, lesion_mm3, parameters):
    session = om.Session(case)
    removed = session.rollout(path(case, parameters), pedals=True)["removed_mm3"]
    lesion = removed[LESION][-1]
    return (lesion - (removed["total"][-1] - lesion)) / lesion_mm3


def search(case, generations, population, seed):
    """The best parameters, and the mean score of each generation, the first first."""
    bone = case.bone
    lesion_mm3 = bone.fraction()[bone.tissue() == case.tissues[LESION]].sum() / 255 * bone.spacing_mm**3
    rng = np.random.default_rng(seed)
    mean, spread = MEAN, SPREAD
    best, best_score, means = mean, -np.inf, []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for _ in range(generations):
            drawn = np.clip(rng.normal(mean, spread, (population, len(mean))), LEAST, MOST)
            scores = np.array(list(pool.map(lambda one: score(case, lesion_mm3, one), drawn)))
            order = np.argsort(-scores)
            elite = drawn[order[: max(2, population // 4)]]
            mean, spread = elite.mean(axis=0), elite.std(axis=0) + 0.02 * SPREAD
            if scores[order[0]] > best_score:
                best, best_score = drawn[order[0]], scores[order[0]]
            means.append(scores.mean())
    return best, best_score, means


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--generations", type=int, default=8)
    arguments.add_argument("--population", type=int, default=24)
    arguments.add_argument("--seed", type=int, default=1)
    wanted = arguments.parse_args()
    case = om.Case("tooth")
    best, best_score, means = search(case, wanted.generations, wanted.population, wanted.seed)
    for generation, mean in enumerate(means, 1):
        print(f"generation {generation}: mean score {mean:+.3f}")
    print(f"best {best_score:+.3f}: axis at ({best[0]:+.2f}, {best[1]:+.2f}) mm of the start, radius {best[2]:.2f} mm, "
          f"depth {best[3]:.2f} mm, {best[4]:.1f} turns")


if __name__ == "__main__":
    main()
