"""The environment for Gymnasium; without Gymnasium, against a stand-in with the few parts that the environment uses."""
import sys
import types

import pytest

numpy = pytest.importorskip("numpy")

try:
    import gymnasium
except ImportError:
    gymnasium = types.ModuleType("gymnasium")

    class Box:
        def __init__(self, low, high):
            self.low, self.high = low, high
            self.shape, self.dtype = low.shape, low.dtype

        def contains(self, value):
            return value.shape == self.shape and bool((value >= self.low).all() and (value <= self.high).all())

    class Env:
        def reset(self, *, seed=None, options=None):
            if seed is not None or not hasattr(self, "np_random"):
                self.np_random = numpy.random.default_rng(seed)

    registry = {}
    envs = types.ModuleType("gymnasium.envs")
    # While Gymnasium loads what other packages have, it has no `register` of its own.
    envs.registration = types.SimpleNamespace(
        registry=registry, register=lambda **options: registry.setdefault(options["id"], []).append(options))
    gymnasium.Env, gymnasium.spaces = Env, types.SimpleNamespace(Box=Box)
    sys.modules.update({"gymnasium": gymnasium, "gymnasium.envs": envs})

from orb_robot.gym_env import BallEnv, register  # noqa: E402

COURSE = ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="-100 -200 200 300">'
          '<circle class="start" cx="0" cy="0" r="4"/><circle class="zone" id="goal" cx="0" cy="-80" r="15"/></svg>')


def drive(env, seed=1, heading=0, speed=100, steps=40):
    seen, _ = env.reset(seed=seed)
    total, all_seen = 0, [seen]
    for _ in range(steps):
        seen, reward, reached, over, _ = env.step([heading, speed])
        assert env.observation_space.contains(seen)
        all_seen.append(seen)
        total += reward
        if reached or over:
            return total, reached, all_seen
    return total, False, all_seen


@pytest.mark.parametrize("kind", ["bolt", "mini", "sprk+", "rvr"])
def test_reaches_a_goal_ahead(kind):
    total, reached, seen = drive(BallEnv(kind, goal=(0, 60)))
    assert reached and total > 100 and seen[0].dtype == numpy.float32


def test_misses_a_goal_behind():
    total, reached, _ = drive(BallEnv(goal=(0, -60)))
    assert not reached and total < 0


def test_a_goal_is_a_zone_of_a_course():
    assert drive(BallEnv(goal="goal", course=COURSE))[1]
    with pytest.raises(ValueError, match="no zone 'home'; it has"):
        BallEnv(goal="home", course=COURSE)


def test_the_same_seed_is_the_same_episode():
    def make():
        return BallEnv(latency=(20, 80), loss=0.1, noise=1)
    one, two, other = drive(make(), 3), drive(make(), 3), drive(make(), 4)
    assert numpy.array_equal(one[2], two[2]) and not numpy.array_equal(one[2][:5], other[2][:5])


def test_steps_before_an_episode_are_an_error():
    env = BallEnv(render_mode="svg")
    with pytest.raises(RuntimeError, match="reset"):
        env.step([0, 0])
    with pytest.raises(ValueError, match="step_s"):
        BallEnv(step_s=0)
    env.reset(seed=1)
    assert env.render().startswith("<svg")
    env.close()


def test_its_import_makes_it_known():
    from gymnasium.envs import registration

    known = registration.registry["orb/Ball-v0"]
    register()  # what an entry point calls after that
    assert registration.registry["orb/Ball-v0"] is known
    if isinstance(known, list):
        assert len(known) == 1
