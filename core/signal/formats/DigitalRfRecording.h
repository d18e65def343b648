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
    bool isWhole(Index first, Index count) const override { return m_stretches.isWhole(first, count); }
    int scaleExponent(int channel) const override { return m_data->isFloat() ? measuredScaleExponent(channel) : 0; }

    /// Whether an HDF5 file holds both datasets.
    static bool recognises(const std::string &path);

private:
    void readIndex();

    std::unique_ptr<Hdf5File> m_file;
    std::unique_ptr<Hdf5Dataset> m_data;
    Stretches m_stretches; ///< places of the rows in time
};

} // namespace faintline
