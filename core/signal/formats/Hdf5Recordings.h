#pragma once

#include "signal/Recording.h"
#include "signal/Stretches.h"
#include "signal/formats/Hdf5File.h"

namespace faintline {

/// One file of a Digital RF channel (rf@SECONDS.MILLISECONDS.h5). The channel's folder is a Timeline of such files.
///
///   rf_data         samples × subchannels, numbers or pairs of them ("r", "i")
///   rf_data_index   for each contiguous stretch: number of its first sample since 1970, and its row in rf_data
///
/// The rate is given by the attributes of rf_data: sample_rate_numerator over sample_rate_denominator, or
/// samples_per_second. Integers are scaled to ±1. The centre frequency is stored elsewhere and therefore unknown.
/// Source: Digital RF 2.6 (MIT Haystack). Thread-safe.
class DigitalRfRecording final : public Recording
{
public:
    /// Throws Error if either dataset is missing or invalid.
    explicit DigitalRfRecording(const std::string &path);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    bool isWhole(Index first, Index count) const override { return m_info.places.isWhole(first, count); }
    int scaleExponent(int channel) const override { return m_data->isFloat() ? measuredScaleExponent(channel) : 0; }

    /// Whether an HDF5 file holds both datasets.
    static bool recognises(const std::string &path);

private:
    void readIndex();

    std::unique_ptr<Hdf5File> m_file;
    std::unique_ptr<Hdf5Dataset> m_data;
};

/// Strain of a gravitational-wave detector as published by the Gravitational Wave Open Science Center (GWOSC, .hdf5):
/// strain/Strain with one number per sample; its attributes give the sample interval in seconds (Xspacing) and the GPS
/// time of the first sample (Xstart).
///
/// Samples are in their own unit, around 1e-21. Missing samples are NaN in the file and read as 0. If
/// quality/simple/DQmask exists, its lowest bit tells for each second whether data was taken, and isWhole reports it.
/// GPS time is converted to UTC with the leap seconds of 2017 on (18), of 2015 (17), 2012 (16), 2009 (15) and before.
/// Thread-safe.
class StrainRecording final : public Recording
{
public:
    /// Throws Error if the file holds no strain or its attributes are invalid.
    explicit StrainRecording(const std::string &path);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    bool isWhole(Index first, Index count) const override;
    int scaleExponent(int channel) const override { return measuredScaleExponent(channel); }

    /// Whether an HDF5 file holds strain/Strain.
    static bool recognises(const std::string &path);

private:
    void readMask();

    std::unique_ptr<Hdf5File> m_file;
    std::unique_ptr<Hdf5Dataset> m_strain;
    bool m_hasMask = false;
    Stretches m_taken; ///< stretches that the mask marks as taken
};

} // namespace faintline
