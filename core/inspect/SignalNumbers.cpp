#include "inspect/SignalNumbers.h"

#include "base/wholeNumber.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr int numberLimit = 1'000'000'000; ///< in a file: others are counted on from it

    struct NumberedPair {
        double distance = 0.0;
        std::size_t track = 0;
        std::size_t known = 0;
    };

} // namespace

std::shared_ptr<const Analysis> SignalNumbers::number(std::shared_ptr<const Analysis> analysis)
{
    if (analysis->calibration && analysis->calibration->isFirstEstimate)
        return analysis;
    const std::vector<Track> &tracks = analysis->tracks;
    std::vector<SignalPath> paths;
    for (const Track &track : tracks)
        paths.push_back(pathOf(*analysis, track));
    std::vector<NumberedPair> pairs;
    for (std::size_t t = 0; t < tracks.size(); ++t)
        for (std::size_t k = 0; k < m_known.size(); ++k)
            if (const auto apart = distance(paths[t], m_known[k].path, analysis->grid()))
                pairs.push_back({*apart, t, k});
    std::ranges::stable_sort(pairs, {}, &NumberedPair::distance);

    std::vector<int> numbers(tracks.size(), 0);
    std::vector<bool> isTaken(m_known.size(), false);
    for (const NumberedPair &pair : pairs)
        if (numbers[pair.track] == 0 && !isTaken[pair.known]) {
            numbers[pair.track] = m_known[pair.known].number;
            isTaken[pair.known] = true;
            m_known[pair.known].path = paths[pair.track];
        }
    const bool isFirst = m_known.empty();
    int last = isFirst ? 0 : std::ranges::max(m_known, {}, &Known::number).number;
    for (std::size_t t = 0; t < tracks.size(); ++t)
        if (numbers[t] == 0) {
            numbers[t] = isFirst ? tracks[t].id : ++last;
            m_known.push_back({numbers[t], paths[t]});
        }
    if (std::ranges::equal(numbers, tracks, {}, {}, &Track::id))
        return analysis;
    m_areUsual = false;
    auto renumbered = std::make_shared<Analysis>(*analysis);
    for (std::size_t t = 0; t < tracks.size(); ++t)
        renumbered->tracks[t].id = numbers[t];
    return renumbered;
}

Json toJson(const SignalNumbers &numbers)
{
    Json json = Json::array();
    for (const SignalNumbers::Known &known : numbers.m_known)
        json.push_back({{"number", known.number}, {"path", toJson(known.path)}});
    return json;
}

SignalNumbers SignalNumbers::fromJson(const Json &json, const std::string &where)
{
    SignalNumbers numbers;
    for (const Json &known : json) {
        const std::string here = where + "[" + std::to_string(numbers.m_known.size()) + "]";
        checkKeys(known, here, {"number", "path"});
        const int number = wholeNumber<int>(known.at("number"), here + ".number");
        if (number < 1 || number > numberLimit)
            throw Error(here + ".number", "must lie in 1 … " + std::to_string(numberLimit));
        numbers.m_known.push_back({number, signalPathFromJson(known.at("path"), here + ".path")});
    }
    numbers.m_areUsual = numbers.m_known.empty();
    return numbers;
}

} // namespace faintline
