#pragma once

#include "signal/Stretches.h"
#include "signal/formats/RawRecording.h"

#include <vector>

namespace faintline {

/// A SigMF recording: samples in one file (.sigmf-data), their description in another (.sigmf-meta, JSON).
///
/// Reads core:datatype, sample_rate, num_channels, offset, dataset, trailing_bytes and the captures' sample_start,
/// frequency, datetime and header_bytes; a note says if later captures differ. Where captures' global_index, or without
/// it their datetime, grows by more than their sample_start, samples are missing: they keep their place in time and
/// read as 0, and isWhole reports them. Times must differ by more than their resolution (1 s without a fraction, else
/// 10 ms) and 200 ppm. Source: the SigMF specification, 1.2.
class SigmfRecording final : public RawRecording
{
public:
    /// Accepts either file's name; `iq` pairs real channels. Throws Error naming the invalid file and key.
    explicit SigmfRecording(const std::string &path, bool iq = false);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    bool isWhole(Index first, Index count) const override;

    /// Whether a name has one of the two extensions.
    static bool isNamedSo(const std::string &path);

    /// The file of samples, and the file that describes them.
    static std::string dataPath(const std::string &path);
    static std::string metaPath(const std::string &path);

private:
    struct Meta;
    SigmfRecording(const std::string &path, const Meta &meta, bool iq);
    static Meta readMeta(const std::string &path);
    void placeInTime(const Meta &meta);
};

} // namespace faintline
