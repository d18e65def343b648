#include "detect/BlockViterbi.h"

#include <algorithm>
#include <limits>

namespace faintline {

const std::vector<Field<BlockViterbiSettings>> &BlockViterbiSettings::fields()
{
    using S = BlockViterbiSettings;
    static const std::vector<Field<S>> table{
        field(&S::durationWindows, "durationWindows", "windows", 0.0, 1e5,
              "Length of a block in windows of the spectrogram; a decision is made at the end of each block.")
            .labelled("Block length")
            .advised("Lengthen it for weaker signals. A signal that fills only part of a block loses evidence, and the "
                     "decision comes at the block's end."),
    };
    return table;
}

BlockViterbi::BlockViterbi(const MarkovModel &model, Index framesPerBlock, Index phase)
    : m_smd(model, {ResetLaw::None}), m_beginning(m_smd.state()), m_framesPerBlock(std::max<Index>(1, framesPerBlock)),
      m_frame(phase % m_framesPerBlock)
{
}

void BlockViterbi::update(std::span<const float> y, std::span<float> statistic)
{
    if (m_frame == 0)
        m_smd.setState(*m_beginning);
    m_smd.update(y, statistic);
    m_frame = (m_frame + 1) % m_framesPerBlock;
    if (m_frame != 0)
        std::fill(statistic.begin(), statistic.end(), -std::numeric_limits<float>::infinity());
}

} // namespace faintline
