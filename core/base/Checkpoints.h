#pragma once

#include "base/Axis.h"

#include <cstddef>
#include <iterator>
#include <map>
#include <memory>

namespace faintline {

/// States of a frame-by-frame process, evenly spaced, within a budget of bytes actually used.
///
/// A state is stored under the number of the next frame. When the budget is exceeded, every second state is dropped and
/// the interval doubles, so that spacing stays even and memory does not grow with the number of frames. At least one
/// state is kept.
template <class State>
class Checkpoints
{
public:
    using Pointer = std::shared_ptr<const State>;

    Checkpoints() = default; ///< keeps none
    Checkpoints(Index interval, std::size_t byteBudget) : m_interval(interval), m_budget(byteBudget) {}

    /// Current number of frames between two states.
    Index interval() const { return m_interval; }
    std::size_t bytes() const { return m_bytes; }
    bool isEmpty() const { return m_states.empty(); }
    std::size_t count() const { return m_states.size(); }

    /// Whether the state before `frame` should be kept and is not stored yet.
    bool lacks(Index frame) const { return frame > 0 && frame % m_interval == 0 && !m_states.contains(frame); }

    /// Stores or replaces the state before `frame`, which takes `bytes` bytes.
    void keep(Index frame, Pointer state, std::size_t bytes)
    {
        drop(m_states.find(frame));
        m_states.emplace(frame, Kept{std::move(state), bytes});
        m_bytes += bytes;
        while (m_bytes > m_budget && m_states.size() > 1) {
            m_interval *= 2;
            for (auto it = m_states.begin(); it != m_states.end();)
                it = it->first % m_interval == 0 ? std::next(it) : drop(it);
        }
    }

    /// The state stored before exactly `frame`, or null.
    Pointer at(Index frame) const
    {
        const auto found = m_states.find(frame);
        return found == m_states.end() ? Pointer() : found->second.state;
    }

    /// The latest frame ≤ `frame` whose state is stored, or 0.
    Index latest(Index frame) const
    {
        const auto after = m_states.upper_bound(frame);
        return after == m_states.begin() ? 0 : std::prev(after)->first;
    }

    void clear()
    {
        m_states.clear();
        m_bytes = 0;
    }

private:
    struct Kept {
        Pointer state;
        std::size_t bytes;
    };
    using States = std::map<Index, Kept>;

    typename States::iterator drop(typename States::iterator at)
    {
        if (at == m_states.end())
            return at;
        m_bytes -= at->second.bytes;
        return m_states.erase(at);
    }

    Index m_interval = 1;
    std::size_t m_budget = 0;
    std::size_t m_bytes = 0;
    States m_states;
};

} // namespace faintline
