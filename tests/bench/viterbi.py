"""Compares fl.viterbi with a dense Viterbi in numpy, in the log domain, on one lattice: ratio of frames per second.

    PYTHONPATH=build/python python3 tests/bench/viterbi.py [CELLS [FRAMES]]
"""

import sys
import time

import numpy as np

import faintline as fl

CELLS = int(sys.argv[1]) if len(sys.argv) > 1 else 400
FRAMES = int(sys.argv[2]) if len(sys.argv) > 2 else 2000
RATES = (-1, 0, 1)
CHANGE = {0: 0.8, 1: 0.1, -1: 0.1}


def transition():
    """ln P of all pairs of states (rate, cell): from rate a to b the cell moves by (a + b)/2, halves rounded down."""
    states = CELLS * len(RATES)
    ln = np.full((states, states), -np.inf)
    for i, a in enumerate(RATES):
        for j, b in enumerate(RATES):
            if b - a not in CHANGE:
                continue
            step = int(np.ceil((a + b) / 2 - 0.5))
            for cell in range(CELLS):
                if 0 <= cell + step < CELLS:
                    ln[i * CELLS + cell, j * CELLS + cell + step] = np.log(CHANGE[b - a])
    return ln


def dense(loglik, ln):
    score = np.tile(loglik[0], len(RATES)) - np.log(ln.shape[0])
    back = np.empty((len(loglik), ln.shape[0]), dtype=np.int32)
    for t in range(1, len(loglik)):
        every = score[:, None] + ln
        back[t] = every.argmax(axis=0)
        score = every[back[t], np.arange(ln.shape[0])] + np.tile(loglik[t], len(RATES))
    states = [int(score.argmax())]
    for t in range(len(loglik) - 1, 0, -1):
        states.append(int(back[t, states[-1]]))
    return np.array(states[::-1]), float(score.max())


def best(run, times):
    """The shortest of several, and what it answers."""
    seconds = []
    for _ in range(times):
        begin = time.perf_counter()
        answer = run()
        seconds.append(time.perf_counter() - begin)
    return min(seconds), answer


loglik = np.random.default_rng(1).normal(size=(FRAMES, CELLS))
law = {"rates": list(RATES), "rateChange": [0.8, 0.1]}
few = max(2, FRAMES // 50)
ln = transition()
ours, _ = best(lambda: fl.viterbi(loglik, law), 5)
theirs, (states, score) = best(lambda: dense(loglik[:few], ln), 3)
path = fl.viterbi(loglik[:few], law)
assert np.array_equal(path.cells, states % CELLS), "the paths differ"
rates = FRAMES / ours, few / theirs
print(f"{CELLS} cells, {len(RATES)} rates: {rates[0]:.0f} frames a second, numpy {rates[1]:.1f}: {rates[0] / rates[1]:.0f} times as many")
