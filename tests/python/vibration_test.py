"""Sessions of the server with --vibration beside ones without."""

import unittest

import numpy as np

from support import FolderTest, run_server

SPINDLE_HZ = 10_000 / 60


def amplitude_between(force_n, from_hz, to_hz):
    """Mean over the seconds of the largest amplitude between two frequencies, of sines in samples 1 ms apart, through a Hann window, so that
    slow drift does not leak into it. Root of the sum of squares over the axes."""
    ticks = np.arange(1000)
    frequencies_hz = np.arange(from_hz, to_hz, 1.0)
    kernel = (1.0 - np.cos(2.0 * np.pi * ticks / 1000)) * np.exp(-2j * np.pi * frequencies_hz[:, None] * 0.001 * ticks)
    seconds = force_n[: len(force_n) // 1000 * 1000].reshape(-1, 1000, 3)
    return np.linalg.norm(kernel @ seconds * 2.0 / 1000, axis=2).max(axis=1).mean()


class VibrationTest(FolderTest):
    def run_of(self, *options):
        """Measurements, log and messages; and the force from two seconds on, when the simulated hand is in the bone."""
        measured, log, lines, said = run_server(self.folder, "--duration-s", "8", *options)
        force_n = np.stack([log[f"force_{axis}_n"] for axis in "xyz"], axis=1)
        return measured, lines, said, force_n[log["t_s"] >= 2.0]

    def test_is_a_line_at_the_spindles_frequency_and_nothing_else(self):
        for grip in ("light", "firm"):
            still, _, _, still_n = self.run_of("--scene", "cube", "--grip", grip)
            measured, _, _, force_n = self.run_of("--scene", "cube", "--grip", grip, "--vibration")
            print(f"{grip} grip: amplitude in mN, without and with vibration")
            for hz in range(0, 500, 50):
                without_mn, with_mn = (1000.0 * amplitude_between(one, hz + 1.0, hz + 51.0) for one in (still_n, force_n))
                print(f"{hz} to {hz + 50} Hz: {without_mn:.3g}  {with_mn:.3g}")
            print("energy to the hand, mJ, peak force, N:", *((one["energy_to_hand_mj"]["most"], one["peak_force_n"]) for one in (still, measured)))
            line_n = amplitude_between(force_n, SPINDLE_HZ - 2.0, SPINDLE_HZ + 2.0)
            # A light hand's cut takes 0.04 mW, and half of that is all that its hum may give.
            self.assertGreater(line_n, 0.08 if grip == "light" else 0.4, grip)
            self.assertLess(amplitude_between(still_n, SPINDLE_HZ - 2.0, SPINDLE_HZ + 2.0), 0.1 * line_n, grip)
            self.assertLess(amplitude_between(force_n, 200.0, 500.0), amplitude_between(still_n, 200.0, 500.0) + 0.05 * line_n,
                            f"{grip}: nothing is aliased")
            self.assertLessEqual(measured["peak_force_n"], 3.3, "what the arm gives")
            # Whole steps of an encoder are read as energy, too, that a sampled spring gave a light hand.
            self.assertLessEqual(measured["energy_to_hand_mj"]["most"],
                                 still["energy_to_hand_mj"]["most"] + (0.3 if grip == "light" else 0.01), grip)
            self.assertEqual(measured["faults"], {fault: still["faults"][fault] for fault in measured["faults"]}, grip)

    def test_repeats_to_the_bit(self):
        first, again = (self.run_of("--scene", "cube", "--vibration", "--grip", "light") for _ in range(2))
        self.assertEqual(first[1], again[1])
        self.assertEqual(first[0]["bone_checksum"], again[0]["bone_checksum"])

    def test_of_burrs_that_turn_too_fast_is_nothing_and_the_server_says_so(self):
        without = self.run_of("--scene", "tooth")
        _, lines, said, _ = self.run_of("--scene", "tooth", "--vibration")
        self.assertEqual(lines, without[1])
        self.assertIn("--vibration: no burr of the scene vibrates at 300 Hz or below", said)


if __name__ == "__main__":
    unittest.main()
