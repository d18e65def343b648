#pragma once

#include "analyse/columns.h"
#include "plan/Analysis.h"

#include <string>

namespace faintline {

/// Writes the events of an analysis; the extension selects the format: .csv, .json, .txt (Audacity labels), .sigmf-meta
/// (annotations).
///
/// CSV columns: event, t_onset, t_detect, t_end (s from the first sample), f (Hz, of the straight line fitted to the
/// track, at (t_onset + t_end)/2; on several axes one column for each, at detection), drift_hz_per_s (slope of that
/// line, or along the last axis), statistic (in the detector's unit: nat, or multiples of the noise; the .json
/// names it), confirmed, open; on several axes AXIS_per_s of each. Numbers are in the C locale, in the shortest form
/// that reads back the same. Lines with a two-sided second pass also have snr_db (mean, in one window), band_hz (width
/// of the position's 5-95 % band) and noise_probability (probability that noise alone produces such an event in this
/// recording). A bank's events have model (which found the event) and model_changes ("t:model;…", the times in s from
/// which other models followed it). Areas, which are not events, are in the .json ("areas": t_onset, t_end, f_low,
/// f_high, level_db) and in the .sigmf-meta with the label "area". Files appear only when complete. Throws Error for an
/// unknown extension or a full disk.
void writeEvents(const Analysis &analysis, const std::string &path);

/// The text of such a .csv or .json file, for a list of events.
std::string eventsCsv(const AnalysisPlan &plan, const std::vector<Event> &events);
std::string eventsJson(const AnalysisPlan &plan, const std::vector<Event> &events,
                       const std::vector<AreaEvent> &areas = {});
/// The text of such a .sigmf-meta file. Throws Error for frames.
std::string eventsSigmf(const Analysis &analysis);

/// Throws Error if `writeEvents` or `writeTracks` does not know the extension of a name; call it before a long run.
void checkEventsPath(const std::string &path);
void checkTracksPath(const std::string &path);

/// Writes the tracks: .csv with one row per frame of each track (track, t, f, statistic; after a two-sided second pass
/// also f_low and f_high, 5 and 95 % of the position, presence, a probability, and snr_db; for a bank also the model
/// that followed it in that frame), or .json. Frames in which the signal is probably absent are left out
/// (Track::presentPoints). The statistic is the score of the track's path, in nats for every detector: if it has no
/// paths, that of the sequential Markov detector that guides it.
void writeTracks(const Analysis &analysis, const std::string &path);
/// The same for the tracks of these events only.
void writeTracksOf(const std::vector<Event> &events, const Analysis &analysis, const std::string &path);

} // namespace faintline
