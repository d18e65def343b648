"""A survey by the command line stores the same events of a recording as the module finds."""

import contextlib
import csv
import json
import sqlite3
import unittest

import faintline as fl
from support import SCENE, InFolder

WINDOW = ("--set", "spectrogram.windowSeconds=0.5", "--set", "decide.falseAlarmsPerHour=2")


class Survey(InFolder):
    def rows_of_file(self, name):
        with open(self.folder / name, newline="") as file:
            reader = csv.reader(file)
            columns = next(reader)
            return columns, [tuple(float(cell) for cell in row) for row in reader]

    def assert_same_rows(self, database, table, order, name):
        columns, expected = self.rows_of_file(name)
        kinds = len(set(columns) & {"keyed", "spread", "call"})  # behind the columns that surveys have
        columns, expected = columns[:len(columns) - kinds], [row[:len(row) - kinds] for row in expected]
        query = f"SELECT {', '.join(columns)} FROM {table} ORDER BY {order}"
        rows = [tuple(map(float, row)) for row in database.execute(query)]
        self.assertGreater(len(rows), 0)
        self.assertEqual(rows, expected)

    def test_events_and_tracks_to_the_last_bit(self):
        (self.folder / "scene.json").write_text(json.dumps(SCENE))
        (self.folder / "night").mkdir()
        self.command_line("simulate", "scene.json", "--out", "night/line.wav")
        self.command_line("survey", "night", "--out", "s.sqlite", *WINDOW)
        result = fl.detect(self.folder / "night/line.wav", window_seconds=0.5, false_alarms_per_hour=2)
        result.save(events=self.folder / "e.csv", tracks=self.folder / "t.csv")
        with contextlib.closing(sqlite3.connect(self.folder / "s.sqlite")) as database:
            self.assert_same_rows(database, "events", "id", "e.csv")
            self.assert_same_rows(database, "tracks", "track, point", "t.csv")


if __name__ == "__main__":
    unittest.main()
