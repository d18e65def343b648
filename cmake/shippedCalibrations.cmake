# cmake -DFOLDER=… -DOUT=… -P shippedCalibrations.cmake: writes the source of shippedCalibrations(), the files of the folder as texts.
file(GLOB files ${FOLDER}/*.json)
list(SORT files)
list(LENGTH files count)
foreach(file IN LISTS files)
    file(READ ${file} text)
    string(JSON key GET "${text}" key)
    cmake_path(GET file STEM name)
    string(APPEND rows "    {\"${name}\", R\"key(${key})key\", R\"text(${text})text\"},\n")
endforeach()
file(WRITE ${OUT} "#include \"calibrate/CalibrationStore.h\"

#include <array>

namespace faintline {

static constexpr std::array<ShippedCalibration, ${count}> shippedList{{
${rows}}};

std::span<const ShippedCalibration> shippedCalibrations()
{
    return shippedList;
}

} // namespace faintline
")
