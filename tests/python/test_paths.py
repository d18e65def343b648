"""viterbi and forward_backward against dense matrices in numpy, and against all paths one by one."""

import itertools
import unittest

import numpy as np

import faintline as fl
from support import InFolder

LN0 = -np.inf


def displacement(rate, next_rate):
    """Halves go down: Billon's half-open interval."""
    return int(np.ceil((rate + next_rate) / 2 - 0.5))


def dense_law(cells, rates, change, cyclic=False):
    """P(from, to) of states (rate, cell), rates before cells."""
    states = len(rates) * cells
    p = np.zeros((states, states))
    for (i, r), (j, s) in itertools.product(enumerate(rates), repeat=2):
        steps = abs(j - i)
        if steps >= len(change):
            continue
        for cell in range(cells):
            to = cell + displacement(r, s)
            if cyclic:
                to %= cells
            if 0 <= to < cells:
                p[i * cells + cell, j * cells + to] += change[steps]
    return p


def dense_walk(cells, step):
    p = np.zeros((cells, cells))
    for cell, other in itertools.product(range(cells), repeat=2):
        if abs(cell - other) < len(step):
            p[cell, other] = step[abs(cell - other)]
    return p


def dense_viterbi(loglik, p, initial):
    with np.errstate(divide="ignore"):
        ln_p, score = np.log(p), np.log(initial) + loglik[0]
    back = []
    for lam in loglik[1:]:
        ways = score[:, None] + ln_p
        back.append(ways.argmax(axis=0))
        score = ways.max(axis=0) + lam
    path = [int(score.argmax())]
    for origins in reversed(back):
        path.append(int(origins[path[-1]]))
    return np.array(path[::-1]), score.max()


def enumerate_paths(loglik, p, initial):
    """Posterior of every state of every frame, and ln of the sum over all paths."""
    frames, states = loglik.shape
    sums, total = np.zeros((frames, states)), 0.0
    for path in itertools.product(range(states), repeat=frames):
        weight = initial[path[0]] * np.exp(sum(loglik[t, s] for t, s in enumerate(path)))
        for a, b in zip(path, path[1:]):
            weight *= p[a, b]
        total += weight
        for t, s in enumerate(path):
            sums[t, s] += weight
    return sums / total, np.log(total)


class Paths(InFolder):
    LAWS = {
        "rates": ({"rates": [-1, 0, 1], "rateChange": [0.5, 0.25]}, 3, lambda n: dense_law(n, [-1, 0, 1], [0.5, 0.25])),
        "cyclic": (
            {"rates": [-1, 0, 1], "rateChange": [0.8, 0.1], "cyclic": True},
            3,
            lambda n: dense_law(n, [-1, 0, 1], [0.8, 0.1], cyclic=True),
        ),
        "walk": ({"step": [0.6, 0.2]}, 1, lambda n: dense_walk(n, [0.6, 0.2])),
    }

    def lattice(self, frames, cells, seed=1):
        return np.random.default_rng(seed).normal(scale=2.0, size=(frames, cells))

    def test_viterbi_is_the_dense_one(self):
        for name, (law, rates, dense) in self.LAWS.items():
            with self.subTest(name):
                loglik = self.lattice(40, 12)
                initial = np.full(rates * 12, 1 / (rates * 12))
                states, score = dense_viterbi(np.tile(loglik, rates), dense(12), initial)
                path = fl.viterbi(loglik, law)
                self.assertAlmostEqual(path.score, score, delta=1e-9)
                self.assertTrue(np.array_equal(path.cells, states % 12))

    def test_a_matrix_is_a_law(self):
        rng = np.random.default_rng(2)
        p = rng.dirichlet(np.ones(6), size=6)
        initial = rng.dirichlet(np.ones(6))
        loglik = self.lattice(30, 6)
        states, score = dense_viterbi(loglik, p, initial)
        path = fl.viterbi(loglik, p, initial=initial)
        self.assertAlmostEqual(path.score, score, delta=1e-9)
        self.assertTrue(np.array_equal(path.cells, states))

    def test_forward_backward_is_the_sum_over_all_paths(self):
        for name, (law, rates, dense) in self.LAWS.items():
            with self.subTest(name):
                cells = 2 if rates == 3 else 5
                loglik = self.lattice(5, cells)
                initial = np.full(rates * cells, 1 / (rates * cells))
                states, evidence = enumerate_paths(np.tile(loglik, rates), dense(cells), initial)
                posterior = fl.forward_backward(loglik, law)
                self.assertAlmostEqual(posterior.log_evidence, evidence, delta=1e-9)
                self.assertLess(np.abs(posterior.p_states.reshape(states.shape) - states).max(), 1e-9)
                self.assertLess(np.abs(posterior.p.sum(axis=1) - 1).max(), 1e-12)

    def test_two_axes(self):
        loglik = self.lattice(6, 12).reshape(6, 3, 4)
        path = fl.viterbi(loglik, [{"step": [0.6, 0.2]}, {"step": [0.8, 0.1]}])
        p = np.kron(dense_walk(3, [0.6, 0.2]), dense_walk(4, [0.8, 0.1]))
        states, score = dense_viterbi(loglik.reshape(6, 12), p, np.full(12, 1 / 12))
        self.assertAlmostEqual(path.score, score, delta=1e-9)
        self.assertTrue(np.array_equal(path.cells, np.stack([states // 4, states % 4], axis=1)))
        posterior = fl.forward_backward(loglik, [{"step": [0.6, 0.2]}, {"step": [0.8, 0.1]}])
        self.assertEqual(posterior.p.shape, (6, 3, 4))

    def test_renormalised_ends_lose_nothing(self):
        loglik = np.zeros((4, 5))
        posterior = fl.forward_backward(loglik, {"step": [0.6, 0.2], "renormalised": True})
        self.assertAlmostEqual(posterior.log_evidence, 0.0, delta=1e-12)

    def test_what_was_not_observed_is_no_evidence(self):
        loglik = self.lattice(8, 5)
        loglik[3] = np.nan
        known = loglik.copy()
        known[3] = 0
        law = {"step": [0.6, 0.2]}
        self.assertEqual(fl.viterbi(loglik, law).score, fl.viterbi(known, law).score)

    def test_refusals(self):
        loglik = self.lattice(8, 5)
        self.assertEqual(self.refusal(fl.viterbi, loglik, {"steps": [1.0]}).where, "law.steps")
        self.assertIn("cells", self.refusal(fl.viterbi, loglik, {"step": [1.0], "cells": 4}).where)
        self.assertIn("shape", self.refusal(fl.viterbi, loglik[0], {"step": [1.0]}).why)
        self.assertIn("+inf", self.refusal(fl.viterbi, loglik + np.inf, {"step": [1.0]}).why)
        self.assertIn("no path", self.refusal(fl.viterbi, np.full((2, 2), LN0), {"step": [1.0]}).why)
        self.assertIn("no path", self.refusal(fl.forward_backward, np.full((2, 2), LN0), {"step": [1.0]}).why)
        self.assertIn("(5, 5)", self.refusal(fl.viterbi, loglik, np.eye(4)).why)


if __name__ == "__main__":
    unittest.main()
