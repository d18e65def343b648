#include "detect/ModelBank.h"

#include "base/Error.h"

namespace faintline {

ModelBank::ModelBank(const std::vector<Member> &members)
{
    if (members.empty() || members.size() > 255)
        throw Error("model bank", "must hold 1 … 255 models");
    const Index cells = members.front().model.space.cellCount();
    for (const Member &member : members) {
        if (member.model.space.cellCount() != cells)
            throw Error("model bank", "its models must lie on the same cells");
        m_detectors.emplace_back(member.model, member.reset);
        m_offsets.push_back(float(member.offset));
    }
    m_winners.resize(std::size_t(cells));
    m_own.resize(std::size_t(cells));
}

void ModelBank::update(std::span<const float> y, std::span<float> statistic)
{
    for (std::size_t i = 0; i < m_detectors.size(); ++i) {
        m_detectors[i].update(y, m_own);
        for (std::size_t cell = 0; cell < m_own.size(); ++cell) {
            const float value = m_own[cell] - m_offsets[i];
            if (i > 0 && !(value > statistic[cell]))
                continue;
            statistic[cell] = value;
            m_winners[cell] = static_cast<unsigned char>(i);
        }
    }
}

void ModelBank::forget(const Grid &grid, const CellBox &box)
{
    for (Smd &detector : m_detectors)
        detector.forget(grid, box);
}

void ModelBank::inhibit(std::span<const Index> cells)
{
    for (Smd &detector : m_detectors)
        detector.inhibit(cells);
}

void ModelBank::useThreads(int threads)
{
    for (Smd &detector : m_detectors)
        detector.useThreads(threads);
}

struct ModelBank::BankState final : DetectorState {
    std::vector<std::shared_ptr<const DetectorState>> members;
    std::vector<unsigned char> winners;

    std::size_t bytes() const override
    {
        std::size_t total = sizeof *this + members.capacity() * sizeof members.front() + winners.capacity();
        for (const auto &member : members)
            total += member->bytes();
        return total;
    }
};

std::shared_ptr<const DetectorState> ModelBank::state() const
{
    auto result = std::make_shared<BankState>();
    for (const Smd &detector : m_detectors)
        result->members.push_back(detector.state());
    result->winners = m_winners;
    return result;
}

void ModelBank::setState(const DetectorState &state)
{
    const auto &saved = static_cast<const BankState &>(state);
    for (std::size_t i = 0; i < m_detectors.size(); ++i)
        m_detectors[i].setState(*saved.members[i]);
    m_winners = saved.winners;
}

} // namespace faintline
