#include "app/document/rawFields.h"

#include "signal/openFields.h"

#include <algorithm>
#include <string_view>

namespace faintline {

std::vector<Field<OpenOptions>> rawFields()
{
    constexpr std::string_view usual[] = {"ci16_le", "ci8", "cu8", "cf32_le", "ri16_le", "rf32_le"};
    std::vector<Field<OpenOptions>> fields = openFields();
    std::ranges::stable_partition(std::ranges::find(fields, "rawType", &FieldInfo::name)->choices,
                                  [&](const std::string &type) { return std::ranges::count(usual, type) > 0; });
    return fields;
}

} // namespace faintline
