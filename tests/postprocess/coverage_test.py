#!/usr/bin/python3
"""Which draw the title of the coverage names: only what is more than chance, among all draws that were tried, by its own unit."""
import unittest
from unittest import mock

import support  # noqa: F401

import numpy as np
from freestand_post import separation
from freestand_post.pictures import coverage
from scipy import stats


def sweep_of(outcome, motions=("A",), motion=None, ground=None, **draws):
    size = outcome.size
    motion = np.zeros(size) if motion is None else motion
    return mock.Mock(outcome=outcome, draws={**draws, "motion": motion}, motions=list(motions), kept=size, part="",
                     ground=np.arange(len(motions)) if ground is None else ground)


def title(sweep):
    return coverage._finding(sweep, coverage.swept(sweep, limit=None))


NAMES = ("friction_mu_k", "pulse_period_s", "block_mass_kg", "pta_g")


class FewEvents(unittest.TestCase):
    def test_chance_names_a_draw_in_one_of_twenty_sweeps_at_most(self):
        """Events dealt out at random: |2 AUC - 1| of the best of four draws was above 0.1, and named, in nearly every set with few."""
        random = np.random.default_rng(3)
        for events in (1, 3, 14, 985):
            named, above = 0, 0
            for _ in range(100):
                outcome = np.ones(1000, int)
                outcome[random.choice(1000, events, replace=False)] = 2
                sweep = sweep_of(outcome, **{name: random.uniform(size=1000) for name in NAMES})
                above += separation.separation(sweep, coverage.swept(sweep)[0]).size > 0.1
                named += "is decided" in title(sweep)
            with self.subTest(events=events):
                self.assertLessEqual(named, stats.binom.isf(1e-3, 100, 0.05))
                if events < 20:
                    self.assertGreater(above, 60)

    def test_too_few_are_told(self):
        random = np.random.default_rng(1)
        draws = {name: random.uniform(size=3000) for name in NAMES}
        for few, rest, said in ((2, 1, "3 specimens overturned: too few to tell what decides"), (1, 2, "3 specimens did not overturn: too few to tell what decides")):
            outcome = np.full(3000, rest)
            outcome[[10, 1000, 2000]] = few
            self.assertEqual(title(sweep_of(outcome, **draws)), said)
        self.assertEqual(title(sweep_of(np.zeros(3000, int), **draws)), "No specimen moved")
        self.assertEqual(title(sweep_of(np.ones(3000, int), **draws)), "Every specimen moved")
        self.assertEqual(title(sweep_of(1 + (random.uniform(size=3000) < 0.3), **draws)), "No single draw decides which specimen overturns")

    def test_an_effect_is_named_where_there_are_enough(self):
        random = np.random.default_rng(2)
        x, y, z = random.uniform(size=(3, 3000))
        draws = {"friction_mu_k": x, "pulse_period_s": y, "block_mass_kg": z}
        many = sweep_of(np.where(2 * x + y + random.normal(size=3000) > 2, 2, 1), **draws)
        self.assertEqual(title(many), "Which specimen overturns is decided most by the friction coefficient μk, then by the pulse period")
        few = sweep_of(np.where(np.argsort(np.argsort(x)) >= 2994, 2, 1), **draws)
        self.assertTrue(title(few).startswith("Which specimen overturns is decided"))
        self.assertIn("the friction coefficient μk", title(few))
        self.assertNotIn("then by", title(few))

    def test_two_that_are_not_parted_are_named_together(self):
        random = np.random.default_rng(4)
        x, y, z = random.uniform(size=(3, 3000))
        sweep = sweep_of(np.where(x + y + 0.3 * random.normal(size=3000) > 1, 2, 1), friction_mu_k=x, pulse_period_s=y, block_mass_kg=z)
        said = title(sweep)
        self.assertRegex(said, "is decided most by the (friction coefficient μk and the pulse period|pulse period and the friction coefficient μk)$")


class Units(unittest.TestCase):
    def test_the_error_is_that_of_mann_and_whitney(self):
        random = np.random.default_rng(5)
        sizes = []
        for _ in range(600):
            sweep = sweep_of(np.where(np.arange(300) < 12, 2, 1), friction_mu_k=random.uniform(size=300))
            found = separation.separation(sweep, "friction_mu_k")
            sizes.append(found.size)
        exact = np.sqrt(4 * 301 / (12 * 12 * 288))
        self.assertAlmostEqual(found.error, exact, delta=1e-12)
        self.assertAlmostEqual(np.sqrt(np.mean(np.square(sizes))), exact, delta=4 * exact / np.sqrt(2 * 600))
        values = sweep.draws["friction_mu_k"]
        p = stats.mannwhitneyu(values[:12], values[12:], method="asymptotic", use_continuity=False).pvalue
        self.assertAlmostEqual(found.p, p, delta=1e-9)

    def test_what_a_motion_has_once_was_drawn_once_a_motion(self):
        """Twelve buildings whose periods mean nothing, and in each another share of 200 samples that overturn. With samples as the unit
        nearly every such period is beyond chance."""
        random = np.random.default_rng(6)
        names = [f"r{i}.csv" for i in range(12)]
        by_motion, by_sample = 0, 0
        for _ in range(200):
            motion = np.repeat(np.arange(12), 200)
            outcome = np.where(random.uniform(size=2400) < random.uniform(size=12)[motion], 2, 1)
            sweep = sweep_of(outcome, names, motion, building_period_s=random.uniform(size=12)[motion])
            found = separation.separation(sweep, "building_period_s")
            by_motion += found.p < 0.05
            sweep.motions = []  # what it would be if each sample had drawn its own
            by_sample += separation.separation(sweep, "building_period_s").p < 0.05
        self.assertLessEqual(by_motion, stats.binom.isf(1e-3, 200, 0.05))
        self.assertGreater(by_sample, 120)

    def test_floors_of_one_record_are_one_motion(self):
        names, ground = [f"r{i // 2}.csv" if i % 2 == 0 else f"r{i // 2}.csv hall storey 2" for i in range(24)], np.arange(24) // 2 * 2
        motion = np.repeat(np.arange(24), 50)
        outcome = np.where(np.random.default_rng(7).uniform(size=1200) < 0.5, 2, 1)
        sweep = sweep_of(outcome, names, motion, ground, building_period_s=ground[motion] + 1.0, storey=2.0 * (motion % 2))
        n1, n0, rank = (outcome == 2).sum(), (outcome == 1).sum(), stats.rankdata(ground[motion])
        parts = ((outcome == 2) - n1 / 1200) * (rank - rank.mean())
        sums = [parts[ground[motion] == record].sum() for record in range(0, 24, 2)]
        self.assertAlmostEqual(separation.separation(sweep, "building_period_s").error, 2 * np.sqrt(np.square(sums).sum()) / (n1 * n0), delta=1e-12)
        self.assertAlmostEqual(separation.separation(sweep, "storey").error, np.sqrt(1201 / (3 * n1 * n0)), delta=1e-12)  # drawn by each sample

    def test_motions_that_are_alike_are_not_ranked_into_an_effect(self):
        """Seven motions ranked by their own shares part some events by chance alone."""
        random = np.random.default_rng(8)
        named = 0
        for _ in range(60):
            motion = random.integers(0, 7, 1000)
            sweep = sweep_of(np.where(random.uniform(size=1000) < 0.02, 2, 1), list("ABCDEFG"), motion)
            named += separation.separation(sweep, "motion").p < 0.05
        self.assertLessEqual(named, stats.binom.isf(1e-3, 60, 0.05))
        sweep.outcome = np.where(random.uniform(size=1000) < 0.02 + 0.2 * (motion == 3), 2, 1)
        self.assertLess(separation.separation(sweep, "motion").p, 0.001)


if __name__ == "__main__":
    unittest.main()
