#pragma once

#include "recording/Hdf5File.h"
#include "recording/Recording.h"
#include "recording/Stretches.h"

namespace faintline {

/// Strain of a gravitational-wave detector as the open science centre gives it out (GWOSC, .hdf5): strain/Strain, one
/// number a sample, its distance in seconds as attribute Xspacing and the GPS time of the first as Xstart.
///
/// Samples are in their own unit, around 1e-21. Those that the detector did not take are NaN in the file, and read as
/// 0; where quality/simple/DQmask is there, whose lowest bit says for each second whether it did, isWhole tells. GPS time becomes UTC with the leap seconds of 2017 on (18), of 2015 (17), 2012 (16), 2009 (15) and before.
/// Thread-safe.
class StrainRecording final : public Recording
{
public:
    /// Throws Error where the file holds no strain, or says of it what cannot be.
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
    Stretches m_taken; ///< by the mask
};

} // namespace faintline
