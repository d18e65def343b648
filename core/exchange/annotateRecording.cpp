#include "exchange/annotateRecording.h"

#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "exchange/annotationText.h"
#include "signal/formats/SigmfRecording.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

namespace faintline {

namespace {

    constexpr const char *generatorKey = "core:generator", *generatorName = "Faintline";
    constexpr const char *labelKey = "core:label", *statisticKey = "faintline:statistic";

    bool isOurs(const Json &one)
    {
        return one.value(generatorKey, Json()) == generatorName;
    }

    /// Whether a member of an annotation by Faintline holds nothing that a person said.
    bool isOurWord(const std::string &key, const Json &value)
    {
        static const std::set<std::string> places{"core:sample_start",    "core:sample_count", "core:freq_lower_edge",
                                                  "core:freq_upper_edge", generatorKey,        statisticKey};
        if (places.contains(key) || !value.is_string())
            return places.contains(key);
        const std::string text = value.get<std::string>();
        return key == labelKey             ? isEventLabel(text)
               : key == "core:comment"     ? text.empty() || isEventComment(text)
               : key == "faintline:review" ? text.empty()
                                           : false;
    }

    /// Whether a run made an annotation, and no person has said anything of it since.
    bool isReplaceable(const Json &one)
    {
        return isOurs(one) && std::ranges::all_of(one.items(), [](const auto &member) {
                   return isOurWord(member.key(), member.value());
               });
    }

    /// Whether an annotation of the file is of the same place and has the same label, or one that a person gave the
    /// event. Those of other programs may leave out a count or an edge, which ours of it has, or the label.
    bool isOfOnePlace(const Json &one, const Json &ours)
    {
        constexpr const char *edges[]{"core:sample_count", "core:freq_lower_edge", "core:freq_upper_edge"};
        const auto isEvent = [&] { return isOurs(one) && isOurWord(labelKey, ours.value(labelKey, Json())); };
        return one.value("core:sample_start", Json()) == ours.value("core:sample_start", Json())
               && (one.value(labelKey, Json("")) == ours.value(labelKey, Json("")) || isEvent())
               && std::ranges::all_of(edges, [&](const char *key) {
                      return one.value(key, Json()) == ours.value(key, Json())
                             || (!isOurs(one) && (!one.contains(key) || !ours.contains(key)));
                  });
    }

    /// Takes what a new run says of an annotation's event, except in place of what a person said.
    void renew(Json &one, const Json &made)
    {
        one.erase(statisticKey);
        for (const auto &[key, value] : made.items())
            if (!one.contains(key) || isOurWord(key, one[key]) || !isOurWord(key, value))
                one[key] = value;
    }

    /// The namespaces that annotations use are declared, as SigMF requires.
    void declareExtensions(Json &global, const Json &extensions)
    {
        Json &declared = global["core:extensions"];
        if (!declared.is_array())
            declared = Json::array();
        for (const Json &one : extensions)
            if (std::none_of(declared.begin(), declared.end(),
                             [&](const Json &other) { return other.value("name", Json()) == one["name"]; }))
                declared.push_back(one);
    }

    int addTo(Json &annotations, const Json &added)
    {
        std::vector<Json> kept, replaced, made;
        for (const Json &one : annotations.is_array() ? annotations : Json::array())
            (isReplaceable(one) ? replaced : kept).push_back(one);
        int count = 0;
        for (Json one : added) {
            one[generatorKey] = generatorName;
            const auto isSame = [&](const Json &other) { return isOfOnePlace(other, one); };
            const auto same = std::ranges::find_if(kept, isSame);
            if (same != kept.end()) {
                if (isOurs(*same))
                    renew(*same, one);
                continue;
            }
            count += std::ranges::none_of(replaced, isSame);
            made.push_back(std::move(one));
        }
        kept.insert(kept.end(), made.begin(), made.end());
        std::ranges::stable_sort(kept, {}, [](const Json &one) { return one.value("core:sample_start", 0.0); });
        annotations = kept;
        return count;
    }

} // namespace

bool isMetadataOf(const std::string &path, const std::string &recording)
{
    std::error_code ignored;
    return SigmfRecording::isNamedSo(recording)
           && std::filesystem::equivalent(path, SigmfRecording::metaPath(recording), ignored);
}

int annotateRecording(const std::string &recording, const std::string &sigmf)
{
    if (!SigmfRecording::isNamedSo(recording))
        throw Error(recording, "is not a SigMF recording, which holds its annotations itself");
    const std::string path = SigmfRecording::metaPath(recording);
    Json meta = readJsonFile(path);
    const Json made = parseJson(sigmf, "events");
    int count = 0;
    readingJson(path, [&] {
        if (made["global"].contains("core:extensions"))
            declareExtensions(meta.at("global"), made["global"]["core:extensions"]);
        count = addTo(meta["annotations"], made["annotations"]);
    });
    writeTextFile(path, meta.dump(4) + "\n", Durability::Machine, Written::Document);
    return count;
}

} // namespace faintline
