#include "exchange/annotateRecording.h"

#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "signal/formats/SigmfRecording.h"

#include <algorithm>
#include <filesystem>

namespace faintline {

namespace {

    constexpr const char *generatorKey = "core:generator", *generatorName = "Faintline";

    bool isOurs(const Json &one)
    {
        return one.value(generatorKey, Json()) == generatorName;
    }

    /// Whether an annotation of the file is of the same place and has the same label. Those of other programs may leave
    /// out a count or an edge, which ours of it has, or the label.
    bool isOfOnePlace(const Json &one, const Json &ours)
    {
        constexpr const char *edges[]{"core:sample_count", "core:freq_lower_edge", "core:freq_upper_edge"};
        return one.value("core:sample_start", Json()) == ours.value("core:sample_start", Json())
               && one.value("core:label", Json("")) == ours.value("core:label", Json(""))
               && std::ranges::all_of(edges, [&](const char *key) {
                      return one.value(key, Json()) == ours.value(key, Json())
                             || (!isOurs(one) && (!one.contains(key) || !ours.contains(key)));
                  });
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
        if (!annotations.is_array())
            annotations = Json::array();
        int count = 0;
        for (Json one : added) {
            one[generatorKey] = generatorName;
            const auto isSame = [&](const Json &other) { return isOfOnePlace(other, one); };
            const auto same = std::find_if(annotations.begin(), annotations.end(), isSame);
            count += same == annotations.end();
            if (same == annotations.end()) {
                annotations.push_back(std::move(one));
                continue;
            }
            // Copies that earlier runs left go.
            annotations.erase(std::remove_if(same + 1, annotations.end(),
                                             [&](const Json &other) { return isOurs(other) && isSame(other); }),
                              annotations.end());
            if (isOurs(*same))
                *same = std::move(one);
        }
        std::stable_sort(annotations.begin(), annotations.end(), [](const Json &a, const Json &b) {
            return a.value("core:sample_start", 0.0) < b.value("core:sample_start", 0.0);
        });
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
