#!/usr/bin/env python3
"""The costs of learning: copies of sessions, steps of many environments, pictures. Each line says the clock's time and this process's CPU
time; on a busy machine the second is what counts.

    PYTHONPATH=build/release/python python3 tests/benchmarks/learning_benchmark.py [copies] [steps] [pictures]"""

import argparse
import multiprocessing
import os
import pathlib
import time

import numpy as np

import osteomill as om

STEPS = 40  # of 20 ms, each environment


def resident_mb():
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


class Timed:
    def __enter__(self):
        self.began, self.cpu_began = time.perf_counter(), time.process_time()
        return self

    def __exit__(self, *_):
        self.s, self.cpu_s = time.perf_counter() - self.began, time.process_time() - self.cpu_began


def milling(start_mm, ms):
    """Down for half a second, then circles."""
    s = np.arange(1, ms + 1) / 1000.0
    angle = 2 * np.pi * np.maximum(0.0, s - 0.5)
    return start_mm + np.column_stack([0.8 * np.sin(angle), 0.8 * (1.0 - np.cos(angle)), -6.0 * np.minimum(s, 0.5) - 0.3 * np.maximum(0.0, s - 0.5)])


def copies():
    case = om.Case("tooth")
    session = om.Session(case)
    hands = milling(case.start_mm, 4000)
    session.rollout(hands, pedals=True)
    with Timed() as making:
        for _ in range(50):
            om.Session(case)
    print(f"a session of the tooth is made in {1e3 * making.cpu_s / 50:.2f} ms of CPU")
    with Timed() as copying:
        kept = [session.copy() for _ in range(50)]
    print(f"a copy after 4 s of milling ({session.now.removed_mm3['total']:.1f} mm^3): {1e3 * copying.cpu_s / 50:.2f} ms of CPU, {1e3 * copying.s / 50:.2f} ms of the clock")
    state = session.save_state()
    with Timed() as loading:
        kept[0].load_state(state)
    print(f"load_state of the same: {1e3 * loading.cpu_s:.0f} ms of CPU")
    del kept
    before = resident_mb()
    branches = [session.copy() for _ in range(100)]
    copied = resident_mb()
    for number, branch in enumerate(branches):
        angle = 0.0628 * number
        branch.rollout(hands[-1] + np.linspace(0.0, 1.0, 100)[:, None] * [np.cos(angle), np.sin(angle), 0.0], pedals=True)
    print(f"100 copies hold {copied - before:.0f} MB, and {resident_mb() - before:.0f} MB after each has milled another 0.1 s")


def act(env, rng, count):
    """Downward and aside, the pedal down."""
    actions = np.column_stack([rng.uniform(-5, 5, (count, 2)), rng.uniform(-8.0, 0.0, count), np.ones(count)])
    return env.step(actions)


def work(pipe, case_name):
    env = om.Env(om.Case(case_name))
    env.reset(seed=0)
    pipe.send("there")
    while (action := pipe.recv()) is not None:
        observation, reward, terminated, truncated, _ = env.step(action)
        pipe.send((observation, reward, terminated, truncated))


def steps():
    case = om.Case("tooth")
    for count in (1, 8, 64):
        for threads in (1, 2):
            env = om.VectorEnv(case, count, threads=threads)
            env.reset(seed=0)
            rng = np.random.default_rng(0)
            with Timed() as timed:
                for _ in range(STEPS):
                    act(env, rng, count)
            print(f"{count} environments, {threads} threads: {count * STEPS / timed.s:.0f} steps a second, {1e3 * timed.cpu_s / (count * STEPS):.3f} ms of CPU a step")
            env.close()
    env = om.Env(case)
    env.reset(seed=0)
    rng = np.random.default_rng(0)
    with Timed() as timed:
        for _ in range(STEPS):
            env.step([*rng.uniform(-5, 5, 2), rng.uniform(-8.0, 0.0), 1.0])
    print(f"one Env: {STEPS / timed.s:.0f} steps a second, {1e3 * timed.cpu_s / STEPS:.3f} ms of CPU a step")
    context = multiprocessing.get_context("spawn")
    for count in (1, 8):
        pipes, processes = [], []
        for _ in range(count):
            mine, its = context.Pipe()
            processes.append(context.Process(target=work, args=(its, "tooth"), daemon=True))
            processes[-1].start()
            pipes.append(mine)
        for pipe in pipes:
            pipe.recv()
        rng = np.random.default_rng(0)
        with Timed() as timed:
            for _ in range(STEPS):
                for pipe in pipes:
                    pipe.send(np.array([*rng.uniform(-5, 5, 2), rng.uniform(-8.0, 0.0), 1.0]))
                for pipe in pipes:
                    pipe.recv()
        print(f"{count} processes, each with a tooth of its own: {count * STEPS / timed.s:.0f} steps a second")
        for pipe in pipes:
            pipe.send(None)
        for process in processes:
            process.join()


def pictures():
    case = om.Case("tooth")
    session = om.Session(case)
    hands = milling(case.start_mm, 2000)
    for width, height in ((84, 84), (128, 128), (320, 240)):
        for images in (("colour",), ("depth", "labels"), ("colour", "depth", "labels")):
            with Timed() as making:
                view = om.View(session, [{"name": "view", "eye_mm": case.start_mm + [25.0, -25.0, 20.0], "target_mm": case.start_mm,
                                          "width_px": width, "height_px": height}], images=images)
                view.draw(session)
            other = session.copy()
            drawing_s = drawing_cpu_s = 0.0
            for row in range(60):
                other.rollout(hands[20 * row:20 * (row + 1)], pedals=True)
                with Timed() as timed:
                    view.draw(other)
                drawing_s, drawing_cpu_s = drawing_s + timed.s, drawing_cpu_s + timed.cpu_s
            print(f"{width} x {height}, {'+'.join(images)}: {60 / drawing_s:.0f} a second, {1e3 * drawing_cpu_s / 60:.1f} ms of CPU each; "
                  f"the view is made in {making.s:.2f} s")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split(".")[0])
    parser.add_argument("parts", nargs="*", choices=["copies", "steps", "pictures", []], default=[])
    for part in parser.parse_args().parts or ["copies", "steps", "pictures"]:
        {"copies": copies, "steps": steps, "pictures": pictures}[part]()
