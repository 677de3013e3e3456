"""For those who have gymnasium: its own check of the environment. PYTHONPATH=build/release/python python3 scripts/check_gymnasium.py"""
import gymnasium
import osteomill  # noqa: F401  registers osteomill/Mill-v0
from gymnasium.utils.env_checker import check_env

check_env(gymnasium.make("osteomill/Mill-v0").unwrapped)
