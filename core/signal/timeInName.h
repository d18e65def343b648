#pragma once

#include <optional>
#include <string>

namespace faintline {

/// Start time of a recording, as recorders write it into file names; seconds since 1970, UTC.
///
///   20260123_235959   2026-01-23T23:59:59Z   20260123T235959+0100   20260123235959.125   year to second
///   260123_235959     260123235959                                                        the same for 2000 … 2099
///   23-59-59_23-01-2026                                                                   time, then day to year
///   1769212799        1769212799123                                                       seconds, milliseconds
///
/// A T, _, - or blank separates date and time; a fraction has 3 or 6 digits behind a point or comma, or 3 behind a _ or -
/// (20260123_235959_250); without a zone the time is UTC. Ten digits with a unit (1420405751Hz) are a frequency. The
/// first matching pattern of this table counts. Returns nothing if the name (without its folders) holds no such time.
std::optional<double> timeInName(const std::string &path);

/// The same, and whether the name tells more than whole seconds, which may be 0.
struct NamedTime {
    double unixSeconds = 0.0;
    bool hasFraction = false;
};
std::optional<NamedTime> stampInName(const std::string &path);

/// What a receiver's program writes into a file's name of the recording's centre frequency, sample rate and type.
///
///   gqrx_20260123_235959_100000000_2000000_fc.raw                              complex floats
///   SDRSharp_20260123_235959Z_100000000Hz_IQ.wav   HDSDR_…_7100kHz_RF.wav      I and Q in two channels
///   baseband_100000000Hz_23-59-59_23-01-2026.wav   (SDR++)                     the same
///
/// Their names of demodulated sound (_AF, audio_) have no centre frequency.
struct ReceiverName {
    std::string program;
    double centreHz = 0.0;
    double rateHz = 0.0; ///< 0: not told
    std::string rawType; ///< empty: not told
};
std::optional<ReceiverName> receiverName(const std::string &path);

/// The time nearest to `about` that lies `secondOfWeek` seconds after the start of a GPS week; seconds since 1970, UTC.
double unixFromGpsWeekSecond(double secondOfWeek, double about);

/// Converts GPS time (seconds since 1980-01-06, counting leap seconds) to seconds since 1970.
double unixFromGps(double gps);

} // namespace faintline
